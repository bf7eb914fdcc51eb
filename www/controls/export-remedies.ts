/** What the export dialog offers where a file is more than programs take: buttons by which there is less in it. */

import { html, nothing } from 'lit';
import type { TemplateResult } from 'lit';
import type { ErrorInfo } from '../base/errors.ts';
import type { ResolvedOptions } from '../export/options.ts';
import { fewestParts, MANY_OBJECTS, MOST_ZIP, SAFE } from '../export/parts.ts';
import type { Choosing } from './export-choosing.ts';
import type { MeshWords } from './export-meshes.ts';

type Forms = MeshWords['forms'];

/** @param count objects of the file that has the most. */
export function fewerObjects(choosing: Choosing, forms: Forms, count: number): TemplateResult {
  return row([...meshes(choosing, forms, ['kit', 'one']), split(choosing, count, MANY_OBJECTS)]);
}

/** For skirts that would be seen. */
export function cutAtGround({ words, choose }: Choosing): TemplateResult {
  return row([button(words('cutBelow'), () => choose({ belowGround: 'cut' }), 'input[name="export-below"]:checked')]);
}

/** For a file that is too large; nothing for any other error. */
export function fewerBytes(choosing: Choosing, forms: Forms, { name, key, value, max }: ErrorInfo): TemplateResult | typeof nothing {
  if (name !== 'ExportTooLarge' || key !== 'format' || typeof value !== 'number' || max === undefined) return nothing;
  const { words, options, choose } = choosing;
  const { lods, parts } = options;
  const levels = button(words('noLevels'), () => choose({ lods: 1 }), 'input[name="export-lods"]:checked');
  // What is too large for a ZIP is so in any number of parts.
  const isZipTooLarge = max === MOST_ZIP || (parts === 1 && value > SAFE * MOST_ZIP);
  return row([...meshes(choosing, forms, ['kit']), isZipTooLarge ? nothing : split(choosing, value, max), lods > 1 ? levels : nothing]);
}

function row(buttons: readonly (TemplateResult | typeof nothing)[]): TemplateResult {
  return html`<div class="button-row">${buttons}</div>`;
}

function meshes({ words, options, choose }: Choosing, forms: Forms, wanted: readonly ResolvedOptions['mesh'][]): TemplateResult[] {
  return wanted.flatMap((mesh) => {
    const label = forms[mesh];
    if (!label || options.mesh === mesh) return [];
    return [button(words(label), () => choose({ mesh }), 'input[name="export-mesh"]:checked')];
  });
}

/** @param value what the largest part has, of which it should have no more than `most`. */
function split({ words, options, choose }: Choosing, value: number, most: number): TemplateResult | typeof nothing {
  const parts = options.mesh === 'kit' ? undefined : fewestParts(value, most, options.parts);
  if (parts === undefined) return nothing;
  return button(words('splitInto', { n: parts }), () => choose({ parts }), '#export-parts');
}

/** `chosen` selects the control that has what a press chooses: the button itself is gone then. */
function button(label: string, choose: () => void, chosen: string): TemplateResult {
  const take = ({ currentTarget }: Event): void => {
    const dialog = (currentTarget as HTMLElement).closest('dialog');
    choose();
    dialog?.querySelector<HTMLElement>(chosen)?.focus();
  };
  return html`<button class="button" type="button" @click=${take}>${label}</button>`;
}
