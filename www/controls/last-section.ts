/** What stands last in the panel, the page's own settings or a way to embed; and the way back to the log whose ground is edited. */

import { html, nothing } from 'lit';
import { addressOnGround, isGroundEdited } from './site.ts';
import { later } from './strings-later.ts';
import { LANGUAGES, LANGUAGE_NAMES } from './strings.ts';
import { drawn, icon } from './icons.ts';
import { segments } from './parts.ts';
import { THEMES } from '../base/view.ts';
import type { TemplateResult } from 'lit';
import type { Kind } from '../table/table.ts';
import type { Actions } from './actions.ts';
import type { Store } from './store.ts';

const PICTURE = 'M2.5 3h11v10h-11zM2.7 11l3.2-3.4 2.4 2.5 1.9-1.8 3.1 3M10.6 5.9h.01';
const OPEN = 'M2.5 12.8V3.3h3.9l1.5 1.9h5.6v7.6zM8 11.2V7.4M6.2 9.1 8 7.2l1.8 1.9';

/** What may have a scene in it. */
const OPENED = '.png,.glb,.gltf,.json,.zip,image/png,model/gltf-binary,model/gltf+json,application/json,application/zip';

export interface LastSection<K extends Kind> {
  store: Store<K>;
  actions: Actions<K>;
  isEmbedded: boolean;
  embedHelp: string;
  /** Opens what saves files. */
  exportFiles: () => void;
}

export function lastSection<K extends Kind>({
  store,
  actions,
  isEmbedded,
  embedHelp,
  exportFiles,
}: LastSection<K>): TemplateResult | typeof nothing {
  const embedButton = html`
    <button class="button" type="button" title=${embedHelp} data-help=${embedHelp} @click=${actions.embed}>
      ${icon('code')}${store.text('embed')}
    </button>
  `;
  const exportHelp = later(store.language, 'exportHelp');
  const exportButton = html`
    <button class="button" type="button" title=${exportHelp} data-help=${exportHelp} ?disabled=${!(store.result && store.isSettled)} @click=${exportFiles}>
      ${icon('save')}${later(store.language, 'export')}
    </button>
  `;
  const open = ({ currentTarget }: Event): void => {
    const input = currentTarget as HTMLInputElement;
    const files = [...(input.files ?? [])];
    // So that the same file can be chosen again.
    input.value = '';
    if (files.length > 0) actions.openFiles?.(files);
  };
  const openHelp = later(store.language, 'openFileHelp');
  const pictureHelp = later(store.language, 'pictureHelp');
  const pictureButton = actions.showPicture
    ? html`
        <button class="button" type="button" title=${pictureHelp} data-help=${pictureHelp} ?disabled=${!store.result} @click=${actions.showPicture}>
          ${drawn(PICTURE)}${store.text('picture')}
        </button>
      `
    : nothing;
  const openButton = actions.openFiles
    ? html`
        <label class="button file-button" title=${openHelp} data-help=${openHelp}>
          ${drawn(OPEN)}${later(store.language, 'openFile')}<input class="visually-hidden" type="file" accept=${OPENED} @change=${open} />
        </label>
      `
    : nothing;
  if (isEmbedded) {
    if (!actions.embed && !exportFiles) return nothing;
    return html`<div class="section"><div class="button-row">${exportButton} ${actions.embed ? embedButton : nothing}</div></div>`;
  }
  return html`
    <section class="section" aria-labelledby="page-heading">
      <h2 id="page-heading">${store.text('page')}</h2>
      ${segments({
        name: 'language',
        label: store.text('language'),
        options: LANGUAGES.map((value) => ({ value, label: LANGUAGE_NAMES[value] })),
        value: store.language,
        action: (language) => store.setLanguage(language),
      })}
      ${segments({
        name: 'theme',
        label: store.text('theme'),
        options: THEMES.map((value) => ({ value, label: store.text(`theme-${value}`) })),
        value: store.theme,
        action: (theme) => store.setTheme(theme),
      })}
      <div class="button-row">
        ${pictureButton} ${exportButton} ${openButton} ${embedButton}
        <button class="button" type="button" @click=${actions.help}>${icon('help')}${store.text('help')}</button>
        <a class="button" href="docs/" hreflang="en" data-help=${later(store.language, 'docsHelp')}>${store.text('docs')}</a>
      </div>
    </section>
  `;
}

/** Back to the log whose ground is being edited on this page. */
export function wayToLog<K extends Kind>(store: Store<K>, { link }: Actions<K>): TemplateResult | typeof nothing {
  if (!link || !isGroundEdited()) return nothing;
  // The address is made anew by the click: the last edit may be younger than the last render.
  const follow = ({ currentTarget }: Event) => ((currentTarget as HTMLAnchorElement).href = addressOnGround(link()));
  return html`<a class="button way-to-log" href=${addressOnGround(link())} @click=${follow}>${later(store.language, 'layLog')}</a>`;
}
