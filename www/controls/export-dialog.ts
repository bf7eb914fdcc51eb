/** The dialog that saves a scene as a file. What is chosen is written at once, so that what it says of the file is true, and saving takes no time. */

import { html, nothing } from 'lit';
import type { TemplateResult } from 'lit';
import { errorInfo } from '../base/errors.ts';
import type { ErrorInfo } from '../base/errors.ts';
import type { Language } from '../base/language.ts';
import { lazily } from '../base/lazy.ts';
import type { ExportInWorker } from '../element/export-client.ts';
import type { ExportReport } from '../export/file.ts';
import { agreeing, resolveOptions, TARGETS } from '../export/options.ts';
import type { ExportTarget, ResolvedOptions } from '../export/options.ts';
import type { Kind } from '../table/table.ts';
import { showDialog } from './dialogs.ts';
import { dropDown } from './drop-down.ts';
import type { Choosing } from './export-choosing.ts';
import type { MeshWords } from './export-meshes.ts';
import { cutAtGround, fewerBytes, fewerObjects } from './export-remedies.ts';
import { icon } from './icons.ts';
import type { Place } from './parts.ts';
import { saveFile } from './save-file.ts';
import type { Store } from './store.ts';
import { errorText, later } from './strings-later.ts';

/** What differs from one generator to another. */
export interface ExportKind<K extends Kind> {
  exporter: () => Promise<ExportInWorker<K>>;
  /** What is offered below the program. */
  controls: (choosing: Choosing, result: K['result']) => TemplateResult;
  /** All options, of which `change` has just been chosen: it counts, and what it cannot go with gives way. */
  fitting: (options: ResolvedOptions, change: Partial<ResolvedOptions>) => ResolvedOptions;
  /** What meshes can be, and what that is called. */
  forms: MeshWords['forms'];
  /** The change of options for another program; its defaults unless given. */
  retarget?: (options: ResolvedOptions, target: ExportTarget) => Partial<ResolvedOptions>;
}

interface Chosen {
  target: ExportTarget;
  options: ResolvedOptions;
}

/** While it is being written, how far that is: 0 … 1. */
type Written = { file: File; report: ExportReport; picture?: string | undefined } | { error: ErrorInfo } | number;

/** What opens the dialog about the scene that is shown. What was chosen last counts the next time, as long as the page is open. */
export function exportDialog<K extends Kind>(kind: ExportKind<K>): (store: Store<K>, place: Place) => void {
  const chosen: Chosen = { target: 'blender', options: resolveOptions({ target: 'blender' }) };
  return (store, place) => {
    const { result, params, preset } = store;
    if (!result) return;
    let writing = new AbortController();
    /** The address of the map that is shown. */
    let picture = '';

    const content = (written: Written): TemplateResult => {
      const words: Choosing['words'] = (key, slots) => later(store.language, key, slots);
      const choosing = { words, ...chosen, choose };
      const said = report(store.language, written, choosing, kind.forms);
      return layout(words, chosen.target, chooseTarget, kind.controls(choosing, result), said, written);
    };

    const show = (written: Written): HTMLDialogElement => showDialog(store, place, later(store.language, 'export'), content(written));

    const write = async (): Promise<void> => {
      writing.abort();
      writing = new AbortController();
      const { signal } = writing;
      show(0);
      URL.revokeObjectURL(picture);
      let written: Written;
      try {
        const exportInWorker = await lazily(kind.exporter);
        const { color: _, metresPerPixel, ...own } = chosen.options;
        const options = { ...own, metresPerPixel: store.metresPerPixel?.() ?? metresPerPixel };
        const shown = { color: store.color, backend: null };
        const made = await exportInWorker(async () => ({ result, params, preset }), options, { signal, onProgress: show }, shown);
        picture = made.file.type === 'image/png' && !signal.aborted ? URL.createObjectURL(made.file) : '';
        written = { ...made, picture };
      } catch (thrown) {
        written = { error: errorInfo(thrown) };
      }
      if (!signal.aborted) show(written);
    };

    const choose = (change: Partial<ResolvedOptions>): void => {
      // Hulls are the program's matter, wherever the file can have them.
      const { hulls } = resolveOptions({ target: chosen.target });
      chosen.options = agreeing({ ...kind.fitting({ ...chosen.options, ...change }, change), hulls });
      void write();
    };

    const chooseTarget = (target: ExportTarget): void => {
      chosen.target = target;
      choose(kind.retarget?.(chosen.options, target) ?? resolveOptions({ target }));
    };

    const end = (): void => {
      writing.abort();
      URL.revokeObjectURL(picture);
    };
    show(0).addEventListener('close', end, { once: true });
    void write();
  };
}

function layout(
  words: Choosing['words'],
  target: ExportTarget,
  chooseTarget: (target: ExportTarget) => void,
  controls: TemplateResult,
  said: TemplateResult,
  written: Written,
): TemplateResult {
  return html`
    ${dropDown({
      name: 'export-target',
      label: words('exportFor'),
      options: (Object.keys(TARGETS) as ExportTarget[]).map((value) => ({ value, label: titleOf(value, words) })),
      value: target,
      action: chooseTarget,
    })}
    ${controls}
    <div class="export-report" role="status">${said}</div>
    <div class="button-row">
      <button class="button button-primary" type="button" ?disabled=${!isFile(written)} @click=${() => isFile(written) && saveFile(written.file)}>
        ${icon('save')}${words('save')}
      </button>
    </div>
  `;
}

function titleOf(target: ExportTarget, words: Choosing['words']): string {
  return target === 'gltf' || target === 'print' ? words(`target-${target}`) : TARGETS[target].title;
}

function isFile(written: Written): written is { file: File; report: ExportReport } {
  return typeof written !== 'number' && 'file' in written;
}

function report(language: Language, written: Written, choosing: Choosing, forms: MeshWords['forms']): TemplateResult {
  const { scale, mesh } = choosing.options;
  if (typeof written === 'number') {
    const writing = later(language, 'exportWriting');
    return html`<p class="quiet">${writing}</p>${written > 0 ? html`<progress aria-label=${writing} .value=${written}></progress>` : nothing}`;
  }
  if (!isFile(written)) {
    const { error } = written;
    return html`<p class="control-problem">${errorText(language, error)}</p>${fewerBytes(choosing, forms, error)}`;
  }
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
  const unit = scale === 1000 ? '1 mm' : '1 m';
  const counted = (numbers: readonly number[]): string => numbers.map((number) => number.toLocaleString(language)).join(' → ');
  const { levels, hulls } = found;
  const notes = [
    ...(levels && levels.length > 1 ? [later(language, 'exportLevels', { triangles: counted(levels) })] : []),
    ...(hulls ? [later(language, 'exportHulls', { n: counted([hulls.objects]), triangles: counted([hulls.triangles]) })] : []),
    ...(found.texelsPerMetre ? [later(language, 'exportTexels', { texels: found.texelsPerMetre.toLocaleString(language) })] : []),
    ...found.notes.map(({ code, count }) => {
      const text = later(language, `note-${code}`, { unit, count: count?.toLocaleString(language), highest: map && short(map.highest) });
      if (code === 'below-ground') return html`${text}${cutAtGround(choosing)}`;
      return code === 'many-objects' && count ? html`${text}${fewerObjects(choosing, forms, count)}` : text;
    }),
  ].map((note) => html`<li>${note}</li>`);
  const said = later(language, map ? 'mapFigures' : mesh === 'points' ? 'pointFigures' : 'exportFigures', figures);
  return html`
    <p>${said}</p>
    ${picture ? html`<img class="export-picture" src=${picture} alt="">` : nothing}
    ${notes.length > 0 ? html`<ul class="quiet">${notes}</ul>` : nothing}
  `;
}
