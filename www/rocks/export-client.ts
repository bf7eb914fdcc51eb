/** The page's side of the export worker. */

import { lazily } from '../base/lazy.ts';
import type { ColorMode } from '../base/view.ts';
import type { Field } from '../data/field.ts';
import type { ExportedFile, ExportReport } from '../export/file.ts';
import { resolveOptions } from '../export/options.ts';
import type { ExportOptions, ResolvedOptions } from '../export/options.ts';
import type { Laid } from '../export/textures/textured.ts';
import { inWorker, taskWorker } from '../generator/one-task.ts';
import type { TaskKind, TaskOptions } from '../generator/one-task.ts';
import { backendsOf, wantedBackend } from '../renderer/load.ts';
import type { Drawn } from './bake-textures.ts';
import type { FieldSource } from './export.ts';

/** What the page asks for: a file, for which textures may have been drawn, or that the rocks are laid out for textures. */
export interface ExportTask {
  field: Field;
  source: FieldSource;
  options: ResolvedOptions;
  step?: Drawn | 'lay-out' | undefined;
}

/** A file, or what was laid out. */
export type ExportAnswer = ExportedFile | Laid;

/** What answers a task. */
const EXPORTER: TaskKind<ExportTask, ExportAnswer> = {
  what: 'that writes files',
  file: 'export-worker.js',
  // This literal form is the one that bundlers recognise.
  spawn: () => taskWorker(() => new Worker(new URL('./export-worker.js', import.meta.url), { type: 'module' })),
};

/** What is on the screen. */
export interface Shown {
  color: ColorMode;
  /** Of the attribute: what is to draw textures. */
  backend: string | null;
}

/** The share of the work that is done when textures are drawn. */
const DRAWN = 0.6;

/**
 * A field as a file, written in a worker of its own.
 *
 * @param newest resolves with the field, and where it comes from. It is called once the options are known to be good.
 * @param options has the colours that are shown, unless it says others or asks for textures, which are of natural stone.
 * @throws {RockFieldError} about an option; `ExportTooLarge`; `WorkerUnavailable`; what `newest` throws; `DeviceLost`.
 * @throws {DOMException} `AbortError` when `signal` says so.
 */
export async function exportInWorker(
  newest: () => Promise<{ field: Field; source: FieldSource }>,
  options: ExportOptions,
  { signal, onProgress }: TaskOptions,
  { color, backend }: Shown,
): Promise<{ file: File; report: ExportReport }> {
  const isNatural = color === 'natural' || (options.textures ?? 'none') !== 'none';
  const resolved = resolveOptions({ color: isNatural ? 'natural' : 'layer', ...options });
  const { field, source } = await newest();
  const task = { field, source, options: resolved };
  const from = (begin: number, end: number): TaskOptions => ({
    signal,
    onProgress: onProgress && ((fraction) => onProgress(begin + (end - begin) * fraction)),
  });
  let drawn: Drawn | undefined;
  if (resolved.textures !== 'none') {
    const { bakedTextures } = await lazily(() => import('./bake-textures.ts'));
    const layOut = async (run: TaskOptions): Promise<Laid> => (await inWorker(EXPORTER, { ...task, step: 'lay-out' }, run)) as Laid;
    drawn = await bakedTextures(field, source, backendsOf(wantedBackend(backend)), layOut, from(0, DRAWN));
  }
  const handedOver = drawn ? [drawn.atlas.vertices.buffer, ...drawn.tiles.map(({ buffer }) => buffer)] : [];
  const answer = await inWorker(EXPORTER, { ...task, step: drawn }, from(drawn ? DRAWN : 0, 1), handedOver);
  const { bytes, name, type, report } = answer as ExportedFile;
  return { file: new File([bytes], name, { type }), report };
}
