/** The page's side of the export worker. */

import type { Field } from '../data/field.ts';
import type { ExportedFile, ExportReport } from '../export/file.ts';
import { resolveOptions } from '../export/options.ts';
import type { ExportOptions, ResolvedOptions } from '../export/options.ts';
import { inWorker, taskWorker } from '../generator/one-task.ts';
import type { TaskKind, TaskOptions } from '../generator/one-task.ts';
import type { FieldSource } from './export.ts';

/** What the page asks for. */
export interface ExportTask {
  field: Field;
  source: FieldSource;
  options: ResolvedOptions;
}

const EXPORTER: TaskKind<ExportTask, ExportedFile> = {
  what: 'that writes files',
  file: 'export-worker.js',
  // This literal form is the one that bundlers recognise.
  spawn: () => taskWorker(() => new Worker(new URL('./export-worker.js', import.meta.url), { type: 'module' })),
};

/**
 * A field as a file, written in a worker of its own.
 *
 * @param newest resolves with the field, and where it comes from. It is called once the options are known to be good.
 * @throws {RockFieldError} about an option; `ExportTooLarge`; `WorkerUnavailable`; what `newest` throws.
 * @throws {DOMException} `AbortError` when `signal` says so.
 */
export async function exportInWorker(
  newest: () => Promise<{ field: Field; source: FieldSource }>,
  options: ExportOptions,
  run: TaskOptions,
): Promise<{ file: File; report: ExportReport }> {
  const resolved = resolveOptions(options);
  const { field, source } = await newest();
  const { bytes, name, type, report } = await inWorker(EXPORTER, { field, source, options: resolved }, run);
  return { file: new File([bytes], name, { type }), report };
}
