/** The page's side of a worker that writes files: the same for every generator. */

import type { ColorMode } from '../base/view.ts';
import type { ExportedFile, ExportReport } from '../export/file.ts';
import type { ExportOptions, ResolvedOptions } from '../export/options.ts';
import { inWorker } from '../generator/one-task.ts';
import type { TaskKind, TaskOptions } from '../generator/one-task.ts';
import type { Kind } from '../table/table.ts';

/** What is written, and where it comes from. */
export interface ExportedScene<K extends Kind> {
  result: K['result'];
  params: K['params'];
  /** The preset that the parameters began with, if any: the file is named after it. */
  preset: K['preset'] | undefined;
}

/** What is on the screen. */
export interface Shown {
  color: ColorMode;
  /** Of the attribute: what is to draw textures, where there are any. */
  backend: string | null;
}

/** What is asked of a worker that writes files. */
export interface ExportTask<K extends Kind> extends ExportedScene<K> {
  options: ResolvedOptions;
}

/**
 * A scene as a file, written in a worker of its own.
 *
 * @param newest resolves with the scene. It is called once the options are known to be good.
 * @param options has the colours that are shown, unless it says others.
 * @throws {RockFieldError} about an option; `ExportTooLarge`; `WorkerUnavailable`; what `newest` throws.
 * @throws {DOMException} `AbortError` when `signal` says so.
 */
export type ExportInWorker<K extends Kind> = (
  newest: () => Promise<ExportedScene<K>>,
  options: ExportOptions,
  run: TaskOptions,
  shown: Shown,
) => Promise<{ file: File; report: ExportReport }>;

/**
 * What writes the files of a generator that has no textures.
 *
 * @param resolve as `resolveOptions`, to which a generator may add.
 */
export function exporter<K extends Kind>(
  worker: TaskKind<ExportTask<K>, ExportedFile>,
  resolve: (options: ExportOptions) => ResolvedOptions,
): ExportInWorker<K> {
  return async (newest, options, run, { color }) => {
    const resolved = resolve({ color: color === 'natural' ? 'natural' : 'layer', ...options });
    return asFile(await inWorker(worker, { ...(await newest()), options: resolved }, run));
  };
}

/** What a worker has written. */
export function asFile({ bytes, name, type, report }: ExportedFile): { file: File; report: ExportReport } {
  return { file: new File([bytes], name, { type }), report };
}
