/** A control that what is loaded later has. */

import { html } from 'lit';
import { live } from 'lit/directives/live.js';
import type { TemplateResult } from 'lit';
import type { Segments } from './parts.ts';

/** A choice of many: a list that opens. */
export function dropDown<T extends string>({
  name,
  label,
  options,
  value,
  action,
}: Pick<Segments<T>, 'name' | 'label' | 'options' | 'value' | 'action'>): TemplateResult {
  return html`
    <div class="control field-row">
      <label class="control-label" for=${name}>${label}</label>
      <select
        class="select"
        id=${name}
        .value=${live(value)}
        @change=${({ currentTarget }: Event) => action((currentTarget as HTMLSelectElement).value as T)}
      >
        ${options.map((option) => html`<option value=${option.value} ?selected=${option.value === value}>${option.label}</option>`)}
      </select>
    </div>
  `;
}
