/** The dialog that saves rocks as a file. What is chosen is written at once, so that what it says of the file is true, and saving takes no time. */

import { html, nothing } from 'lit';
import type { TemplateResult } from 'lit';
import { errorInfo } from '../../base/errors.ts';
import type { ErrorInfo } from '../../base/errors.ts';
import { lazily } from '../../base/lazy.ts';
import { showDialog } from '../../controls/dialogs.ts';
import { icon } from '../../controls/icons.ts';
import { dropDown } from '../../controls/drop-down.ts';
import { segments } from '../../controls/parts.ts';
import type { Place } from '../../controls/parts.ts';
import { errorText, later } from '../../controls/strings-later.ts';
import type { LaterKey } from '../../controls/strings-later.ts';
import type { ExportReport } from '../../export/file.ts';
import { FORMS, OPTIONS, resolveOptions, TARGETS } from '../../export/options.ts';
import type { ExportTarget, ResolvedOptions } from '../../export/options.ts';
import { CONTENTS, contentOf, fittingMap, mapControls, pointControls, retarget, turnTo } from './export-maps.ts';
import type { Choosing } from './export-maps.ts';
import type { RockStore } from './store.ts';

/** While it is being written, how far that is: 0 … 1. */
type Written = { file: File; report: ExportReport; picture?: string | undefined } | { error: ErrorInfo } | number;

/** What was chosen last counts the next time, as long as the page is open. */
const chosen: { target: ExportTarget; options: ResolvedOptions } = { target: 'blender', options: resolveOptions({ target: 'blender' }) };

/** Opens the dialog about the field that is shown. */
export function showExport(store: RockStore, place: Place): void {
  const { field, params, preset } = store;
  if (!field) return;
  const newest = async () => ({ field, source: { params, preset } });
  let writing = new AbortController();
  /** The address of the map that is shown. */
  let picture = '';

  const show = (written: Written): HTMLDialogElement =>
    showDialog(store, place, later(store.language, 'export'), content(store, written, choose));

  const write = async (): Promise<void> => {
    writing.abort();
    writing = new AbortController();
    const { signal } = writing;
    show(0);
    URL.revokeObjectURL(picture);
    let written: Written;
    try {
      const { exportInWorker } = await lazily(() => import('../export-client.ts'));
      const { color: _, ...options } = chosen.options;
      const made = await exportInWorker(newest, options, { signal, onProgress: show }, { color: store.color, backend: null });
      picture = made.file.type === 'image/png' && !signal.aborted ? URL.createObjectURL(made.file) : '';
      written = { ...made, picture };
    } catch (thrown) {
      written = { error: errorInfo(thrown) };
    }
    if (!signal.aborted) show(written);
  };

  const choose = (change: Partial<ResolvedOptions>): void => {
    chosen.options = fitting({ ...chosen.options, ...change }, change);
    void write();
  };

  const end = (): void => {
    writing.abort();
    URL.revokeObjectURL(picture);
  };
  show(0).addEventListener('close', end, { once: true });
  void write();
}

/** What has just been chosen counts; what it cannot go with gives way. */
function fitting(options: ResolvedOptions, change: Partial<ResolvedOptions>): ResolvedOptions {
  const content = contentOf(options);
  if (content === 'maps') return fittingMap(options, change);
  if (content === 'points') return options;
  const { format, mesh, textures } = options;
  const fits = meshesOf(format).includes(mesh) && (textures === 'none' || format === 'glb');
  if (fits) return options;
  return change.format
    ? { ...options, mesh: meshesOf(format).includes(mesh) ? mesh : 'one', textures: 'none' }
    : { ...options, format: 'glb' };
}

/** What a format can hold. */
function meshesOf(format: ResolvedOptions['format']): readonly ResolvedOptions['mesh'][] {
  return (FORMS[format] ?? []).filter((mesh) => mesh !== 'points');
}

function content(store: RockStore, written: Written, choose: (change: Partial<ResolvedOptions>) => void): TemplateResult {
  const words = (key: LaterKey): string => later(store.language, key);
  const { target, options } = chosen;
  const chooseTarget = (next: ExportTarget): void => {
    chosen.target = next;
    choose(retarget(options, next));
  };
  const content = contentOf(options);
  const choosing = { words, options, target, choose };
  return html`
    ${dropDown({
      name: 'export-target',
      label: words('exportFor'),
      options: (Object.keys(TARGETS) as ExportTarget[]).map((value) => ({ value, label: titleOf(value, words) })),
      value: target,
      action: chooseTarget,
    })}
    ${segments({
      name: 'export-content',
      label: words('exportContent'),
      options: CONTENTS.map((value) => ({ value, label: words(`content-${value}`) })),
      value: content,
      action: (next) => choose(turnTo(next, options, target)),
    })}
    ${content === 'maps' ? mapControls(choosing, Math.max(store.field!.imageWidth, store.field!.imageHeight)) : nothing}
    ${content === 'points' ? pointControls(choosing) : nothing} ${content === 'meshes' ? meshControls(choosing) : nothing}
    <div class="export-report" role="status">${report(store, written)}</div>
    <div class="button-row">
      <button class="button button-primary" type="button" ?disabled=${!isFile(written)} @click=${() => isFile(written) && save(written.file)}>
        ${icon('save')}${words('save')}
      </button>
    </div>
  `;
}

function titleOf(target: ExportTarget, words: Choosing['words']): string {
  return target === 'gltf' || target === 'print' ? words(`target-${target}`) : TARGETS[target].title;
}

function meshControls({ words, options, choose }: Choosing): TemplateResult {
  return html`
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
      name: 'export-textures',
      label: words('exportTextures'),
      options: OPTIONS.textures.choices.map((value) => ({ value, label: value === 'none' ? words('textures-none') : value })),
      value: options.textures,
      action: (textures) => choose({ textures }),
    })}
    ${segments({
      name: 'export-bottom',
      label: words('exportBottom'),
      options: (['open', 'closed'] as const).map((value) => ({ value, label: words(`bottom-${value}`) })),
      value: options.solid ? 'closed' : 'open',
      action: (bottom) => choose({ solid: bottom === 'closed' }),
    })}
  `;
}

function isFile(written: Written): written is { file: File; report: ExportReport } {
  return typeof written !== 'number' && 'file' in written;
}

function report({ language }: RockStore, written: Written): TemplateResult {
  if (typeof written === 'number') {
    return html`<p class="quiet">${later(language, 'exportWriting')}</p>${written > 0 ? html`<progress class="export-progress" .value=${written}></progress>` : nothing}`;
  }
  if (!isFile(written)) return html`<p class="control-problem">${errorText(language, written.error)}</p>`;
  const { file, report: found, picture } = written;
  const { map } = found;
  const megabytes = (file.size / 1e6).toLocaleString(language, { maximumFractionDigits: file.size < 1e7 ? 1 : 0 });
  const short = (metres: number): string => metres.toLocaleString(language, { maximumSignificantDigits: 3 });
  const figures = {
    name: file.name,
    size: `${megabytes} MB`,
    objects: found.objects.toLocaleString(language),
    triangles: found.triangles.toLocaleString(language),
    width: map?.width.toLocaleString(language),
    height: map?.height.toLocaleString(language),
    pixel: [...new Set(map?.metresPerPixel.map(short))].join(' × '),
  };
  const unit = chosen.options.scale === 1000 ? '1 mm' : '1 m';
  const notes = [
    ...(found.texelsPerMetre ? [later(language, 'exportTexels', { texels: found.texelsPerMetre.toLocaleString(language) })] : []),
    ...found.notes.map(({ code, count }) =>
      later(language, `note-${code}`, { unit, count: count?.toLocaleString(language), highest: map && short(map.highest) }),
    ),
  ].map((note) => html`<li>${note}</li>`);
  const said = later(language, map ? 'mapFigures' : chosen.options.mesh === 'points' ? 'pointFigures' : 'exportFigures', figures);
  return html`
    <p>${said}</p>
    ${picture ? html`<img class="export-picture" src=${picture} alt="">` : nothing}
    ${notes.length > 0 ? html`<ul class="quiet">${notes}</ul>` : nothing}
  `;
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
