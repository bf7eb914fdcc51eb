/** The dialog that saves rocks as a file. What is chosen is written at once, so that what it says of the file is true, and saving takes no time. */

import { html, nothing } from 'lit';
import type { TemplateResult } from 'lit';
import { errorInfo } from '../../base/errors.ts';
import type { ErrorInfo } from '../../base/errors.ts';
import { lazily } from '../../base/lazy.ts';
import { showDialog } from '../../controls/dialogs.ts';
import { icon } from '../../controls/icons.ts';
import { segments } from '../../controls/parts.ts';
import type { Place } from '../../controls/parts.ts';
import { errorText, later } from '../../controls/strings-later.ts';
import type { LaterKey } from '../../controls/strings-later.ts';
import type { ExportReport } from '../../export/file.ts';
import { FORMS, resolveOptions, TARGETS } from '../../export/options.ts';
import type { ExportTarget, ResolvedOptions } from '../../export/options.ts';
import type { RockStore } from './store.ts';

/** Null while it is being written. */
type Written = { file: File; report: ExportReport } | { error: ErrorInfo } | null;

/** The target, and what was chosen beside it. It counts the next time too, as long as the page is open. */
const chosen: { target: ExportTarget; changes: Partial<ResolvedOptions> } = { target: 'blender', changes: {} };

/** All options: what was chosen, and what the target wants beside it. */
function chosenOptions(): ResolvedOptions {
  return resolveOptions({ target: chosen.target, ...chosen.changes });
}

/** Opens the dialog about the field that is shown. */
export function showExport(store: RockStore, place: Place): void {
  const { field, params, preset } = store;
  if (!field) return;
  const newest = async () => ({ field, source: { params, preset } });
  let writing = new AbortController();

  const show = (written: Written): HTMLDialogElement =>
    showDialog(store, place, later(store.language, 'export'), content(store, written, choose));

  const write = async (): Promise<void> => {
    writing.abort();
    writing = new AbortController();
    const { signal } = writing;
    show(null);
    let written: Written;
    try {
      const { exportInWorker } = await lazily(() => import('../export-client.ts'));
      const color = store.color === 'natural' ? 'natural' : 'layer';
      written = await exportInWorker(newest, { ...chosenOptions(), color }, { signal });
    } catch (thrown) {
      written = { error: errorInfo(thrown) };
    }
    if (!signal.aborted) show(written);
  };

  const choose = (change: Partial<ResolvedOptions>): void => {
    chosen.changes = fitting({ ...chosen.changes, ...change }, change);
    void write();
  };

  show(null).addEventListener('close', () => writing.abort(), { once: true });
  void write();
}

/** What has just been chosen counts; what it cannot go with gives way. */
function fitting(changes: Partial<ResolvedOptions>, { format: isFormatNew }: Partial<ResolvedOptions>): Partial<ResolvedOptions> {
  const { format, mesh } = { ...resolveOptions({ target: chosen.target }), ...changes };
  if (meshesOf(format).includes(mesh)) return changes;
  return isFormatNew ? { ...changes, mesh: 'one' } : { ...changes, format: 'glb' };
}

/** What a format can hold. */
function meshesOf(format: ResolvedOptions['format']): readonly ResolvedOptions['mesh'][] {
  return (FORMS[format] ?? []).filter((mesh) => mesh !== 'points');
}

function content(store: RockStore, written: Written, choose: (change: Partial<ResolvedOptions>) => void): TemplateResult {
  const words = (key: LaterKey): string => later(store.language, key);
  const { target } = chosen;
  const options = chosenOptions();
  const chooseTarget = ({ currentTarget }: Event): void => {
    chosen.target = (currentTarget as HTMLSelectElement).value as ExportTarget;
    chosen.changes = {};
    choose({});
  };
  return html`
    <div class="control field-row">
      <label class="control-label" for="export-target">${words('exportFor')}</label>
      <select class="select" id="export-target" @change=${chooseTarget}>
        ${Object.entries(TARGETS).map(
          ([name, { title }]) => html`
            <option value=${name} ?selected=${name === target}>${name === 'gltf' || name === 'print' ? words(`target-${name}`) : title}</option>
          `,
        )}
      </select>
    </div>
    ${segments({
      name: 'export-mesh',
      label: words('exportMesh'),
      options: (['rocks', 'kit', 'one'] as const).map((value) => ({ value, label: words(`mesh-${value}`) })),
      value: options.mesh,
      action: (mesh) => choose({ mesh }),
    })}
    ${segments({
      name: 'export-format',
      label: words('exportFormat'),
      options: (['glb', 'obj', 'stl', 'ply'] as const).map((value) => ({ value, label: value.toUpperCase() })),
      value: options.format,
      action: (format) => choose({ format }),
    })}
    ${segments({
      name: 'export-bottom',
      label: words('exportBottom'),
      options: (['open', 'closed'] as const).map((value) => ({ value, label: words(`bottom-${value}`) })),
      value: options.solid ? 'closed' : 'open',
      action: (bottom) => choose({ solid: bottom === 'closed' }),
    })}
    <div class="export-report" role="status">${report(store, written)}</div>
    <div class="button-row">
      <button class="button button-primary" type="button" ?disabled=${!isFile(written)} @click=${() => isFile(written) && save(written.file)}>
        ${icon('save')}${words('save')}
      </button>
    </div>
  `;
}

function isFile(written: Written): written is { file: File; report: ExportReport } {
  return written !== null && 'file' in written;
}

function report({ language }: RockStore, written: Written): TemplateResult {
  if (!written) return html`<p class="quiet">${later(language, 'exportWriting')}</p>`;
  if (!isFile(written)) return html`<p class="control-problem">${errorText(language, written.error)}</p>`;
  const { file, report: found } = written;
  const megabytes = (file.size / 1e6).toLocaleString(language, { maximumFractionDigits: file.size < 1e7 ? 1 : 0 });
  const figures = {
    name: file.name,
    size: `${megabytes} MB`,
    objects: found.objects.toLocaleString(language),
    triangles: found.triangles.toLocaleString(language),
  };
  const unit = chosenOptions().scale === 1000 ? '1 mm' : '1 m';
  const notes = found.notes.map(
    ({ code, count }) => html`<li>${later(language, `note-${code}`, { unit, count: count?.toLocaleString(language) })}</li>`,
  );
  return html`<p>${later(language, 'exportFigures', figures)}</p>${notes.length > 0 ? html`<ul class="quiet">${notes}</ul>` : nothing}`;
}

/** The browser has taken the file by then, ms. */
const TAKEN_MS = 60_000;

function save(file: File): void {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(file);
  link.download = file.name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), TAKEN_MS);
}
