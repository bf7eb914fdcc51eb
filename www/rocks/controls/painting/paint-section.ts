/** The part of the panel about what is painted on the ground, and about the mask. */

import { html, nothing } from 'lit';
import type { TemplateResult } from 'lit';
import { errorInfo } from '../../../base/errors.ts';
import { icon } from '../../../controls/icons.ts';
import { errorText } from '../../../controls/strings-later.ts';
import { strokesOfText } from '../../strokes.ts';
import type { RockStore } from '../store.ts';
import { isPainting, togglePainting } from './painter.ts';
import { PAINT_WORDS, paintWords } from './paint-words.ts';
import type { PaintKey } from './paint-words.ts';
import type { Paintable } from './paintable.ts';

/** `begin` is called before somebody begins to paint: the picture has to be in view. */
export function paintSection(store: RockStore, element: Paintable, begin: () => void): TemplateResult {
  const { params, language } = store;
  store.unlinked = () => (element.hasMask ? PAINT_WORDS.maskLeftOut : null);
  const words = (key: PaintKey) => paintWords(language, key);
  const count = strokesOfText(params.strokes ?? '').length;
  const paints = isPainting(element);
  const paint = (): void => {
    if (!paints) begin();
    togglePainting(element, store);
  };
  const take = ({ currentTarget }: Event): void => {
    const input = currentTarget as HTMLInputElement;
    const [file] = input.files ?? [];
    // So that the same file can be chosen again.
    input.value = '';
    if (file) void setMask(store, element, file);
  };
  return html`
    <details class="section" ?open=${count > 0 || element.hasMask}>
      <summary>
        <h2>${words('heading')} ${count > 0 ? html`<span class="quiet">${paintWords(language, count === 1 ? 'one' : 'many', { n: count })}</span>` : nothing}</h2>
        ${icon('down')}
      </summary>
      <p class="quiet">${words('help')}</p>
      <div class="button-row">
        <button class="button" type="button" aria-pressed=${paints} ?disabled=${!store.result} @click=${paint}>${words(paints ? 'end' : 'begin')}</button>
        ${count > 0 ? html`<button class="button" type="button" @click=${() => store.edit({ ...params, strokes: undefined })}>${words('clear')}</button>` : nothing}
        <label class="button file-button" title=${words('maskHelp')} data-help=${words('maskHelp')}>
          ${words('mask')}<input class="visually-hidden" type="file" accept="image/*" @change=${take} />
        </label>
        ${element.hasMask ? html`<button class="button" type="button" @click=${() => void setMask(store, element, null)}>${words('maskRemove')}</button>` : nothing}
      </div>
    </details>
  `;
}

/** Gives the element a mask, or takes it away, and says what came of it. True when it is there. */
export async function setMask(store: RockStore, element: Paintable, mask: File | null): Promise<boolean> {
  try {
    await element.setMask(mask);
    return true;
  } catch (thrown) {
    store.say((language) => errorText(language, errorInfo(thrown)), true);
    return false;
  } finally {
    store.notify('messages');
  }
}
