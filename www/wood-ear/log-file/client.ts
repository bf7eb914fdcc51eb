/** The page's side of the file worker: one worker for each file, which is ended when the file is read or given up. */

import { inWorker, taskWorker } from '../../generator/one-task.ts';
import type { TaskKind, TaskOptions } from '../../generator/one-task.ts';
import { wrongType } from '../../table/param-checks.ts';
import type { LogFile } from './mesh.ts';
import type { FileTask } from './protocol.ts';

/** What a log is read from. */
export type LogSource = (Blob & { name?: string }) | ArrayBuffer | ArrayBufferView;

const FILE_READER: TaskKind<FileTask, LogFile> = {
  what: 'that reads log files',
  file: 'wood-ear-file-worker.js',
  // This literal form is the one that bundlers recognise.
  spawn: () => taskWorker(() => new Worker(new URL('./wood-ear-file-worker.js', import.meta.url), { type: 'module' })),
};

/**
 * The log in a file.
 *
 * @throws {RockFieldError} What `readLogFile` of `read.ts` throws; `WrongType` for anything that is no file; `WorkerUnavailable`.
 * @throws {DOMException} `AbortError` when `signal` says so.
 */
export function readLogInWorker(source: LogSource, options: TaskOptions = {}): Promise<LogFile> {
  return inWorker(FILE_READER, asFile(source), options);
}

function asFile(source: unknown): FileTask {
  // By what it can do: a file of another frame is no `Blob` of this one.
  const isFile =
    typeof source === 'object' &&
    source !== null &&
    typeof (source as Blob).arrayBuffer === 'function' &&
    typeof (source as Blob).slice === 'function' &&
    typeof (source as Blob).size === 'number';
  if (isFile) return { file: source as Blob, name: String((source as File).name ?? '') };
  const isBytes = ArrayBuffer.isView(source) || Object.prototype.toString.call(source) === '[object ArrayBuffer]';
  try {
    if (isBytes) return { file: new Blob([source as ArrayBuffer]), name: '' };
  } catch {
    // Shared with a worker, or transferred to one.
  }
  throw wrongType('log', source, 'a file, a Blob or an ArrayBuffer; fetch an address first: loadLog(await (await fetch(address)).blob())');
}
