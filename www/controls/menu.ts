/** A choice among many as a menu that drops down. */

import { html } from 'lit';
import type { TemplateResult } from 'lit';
import { live } from 'lit/directives/live.js';
import { describedBy, description } from './parts.ts';
import type { Segments } from './parts.ts';

/** A choice of many. */
export function menu<T extends string>({ name, label, help = '', options, value, action, problem }: Segments<T>): TemplateResult {
  return html`
    <div class="control field-row" data-param=${name} data-help=${help}>
      <label class="control-label" for=${name}>${label}</label>
      <select
        class="select"
        id=${name}
        aria-describedby=${describedBy(name, help, problem)}
        .value=${live(value)}
        @change=${({ target }: Event) => action((target as HTMLSelectElement).value as T)}
      >
        ${options.map((option) => html`<option value=${option.value} ?selected=${option.value === value}>${option.label}</option>`)}
      </select>
      ${description(name, help, problem)}
    </div>
  `;
}
