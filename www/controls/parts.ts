/** Small pieces that every part of the panel is made of. */

import { html } from 'lit';
import { icon } from './icons.ts';
import type { TemplateResult } from 'lit';
import type { IconName } from './icons.ts';

/** Where dialogs appear: the page's body, or the root of an element's panel. */
export type Place = HTMLElement | ShadowRoot;

export function isDialogOpen(place: Place): boolean {
  return place.querySelector('dialog[open]') !== null;
}

/** `Taper base c_w1` with its symbol set as one: italic, the index below. A lone last letter is a symbol too. */
export function mathText(text: string): (string | TemplateResult)[] {
  return text.split(/(\b[A-Za-z]_[a-z]\w*\b|(?<=\s)[A-Za-z]$)/).map((part, index) => {
    if (index % 2 === 0) return part;
    const [letter = '', below] = part.split('_');
    return html`<var>${letter}${below === undefined ? '' : html`<sub>${below}</sub>`}</var>`;
  });
}

export interface IconButton {
  icon: IconName;
  label: string;
  action: () => void;
  disabled?: boolean;
  /** Added to the class list. */
  kind?: string;
}

export function iconButton({ icon: name, label, action, disabled = false, kind = '' }: IconButton): TemplateResult {
  return html`
    <button class="button icon-button ${kind}" type="button" title=${label} aria-label=${label} ?disabled=${disabled} @click=${action}>
      ${icon(name)}
    </button>
  `;
}

export interface Segments<T extends string> {
  /** Also the name of the radio group: one for the whole page. */
  name: string;
  label: string;
  /** Hide the label when what surrounds the group says it. */
  hideLabel?: boolean;
  help?: string;
  options: readonly { value: T; label: string }[];
  value: T;
  action: (value: T) => void;
  problem?: string | null;
  /** It would do nothing now. */
  disabled?: boolean;
}

/** A choice of a few: radio buttons that look like one. */
export function segments<T extends string>({
  name,
  label,
  hideLabel = false,
  help = '',
  options,
  value,
  action,
  problem,
  disabled = false,
}: Segments<T>): TemplateResult {
  return html`
    <div
      class="control segments"
      role="radiogroup"
      data-param=${name}
      data-help=${help}
      aria-labelledby="${name}-label"
      aria-describedby=${describedBy(name, help, problem)}
    >
      <span class=${hideLabel ? 'visually-hidden' : 'control-label'} id="${name}-label">${mathText(label)}</span>
      <div class="segment-row">
        ${options.map(
          (option) => html`
            <label class="segment">
              <input type="radio" name=${name} value=${option.value} .checked=${option.value === value} ?disabled=${disabled} @change=${() => action(option.value)} />
              <span>${mathText(option.label)}</span>
            </label>
          `,
        )}
      </div>
      ${description(name, help, problem)}
    </div>
  `;
}

/** What `aria-describedby` names: the help, and what is wrong. */
export function describedBy(id: string, help: string, problem: string | null | undefined): string {
  return [help && `${id}-help`, problem && `${id}-problem`].filter(Boolean).join(' ');
}

export function description(id: string, help: string, problem: string | null | undefined): TemplateResult {
  return html`
    ${help ? html`<span class="visually-hidden" id="${id}-help">${help}</span>` : ''}
    ${problem ? html`<p class="control-problem" id="${id}-problem" role="alert">${problem}</p>` : ''}
  `;
}
