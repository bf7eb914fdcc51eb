/** The page's side of the file worker: one worker for each file, which is ended when the file is read or given up. */

import { abortError, RockFieldError } from '../../base/errors.ts';
import { startWorker } from '../../generator/start-worker.ts';
import { wrongType } from '../../table/param-checks.ts';
import type { LogFile } from './mesh.ts';
import type { FromFileWorker, ToFileWorker } from './protocol.ts';

/** What a log is read from. */
export type LogSource = (Blob & { name?: string }) | ArrayBuffer | ArrayBufferView;

/** The part of `Worker` that is used, for tests. */
export interface FileWorkerLike {
  onmessage: ((event: MessageEvent<FromFileWorker>) => void) | null;
  onerror: ((event: ErrorEvent) => void) | null;
  onmessageerror: ((event: MessageEvent) => void) | null;
  postMessage(message: ToFileWorker): void;
  terminate(): void;
}

export interface ReadFileOptions {
  signal?: AbortSignal | undefined;
  /** 0 … 1, of files that take longer than a moment. */
  onProgress?: ((fraction: number) => void) | undefined;
  /** Makes the worker. Default: the page's. */
  spawn?: () => FileWorkerLike;
}

/** Files that are read within this, ms, show no progress. */
const QUIET_MS = 200;
/** From the start of a worker to its first word, ms: its script may have to be fetched over a slow network. */
const PATIENCE_MS = 30_000;

/**
 * The log in a file.
 *
 * @throws {RockFieldError} What `readLogFile` of `read.ts` throws; `WrongType` for anything that is no file; `WorkerUnavailable`.
 * @throws {DOMException} `AbortError` when `signal` says so.
 */
export function readLogInWorker(source: LogSource, { signal, onProgress, spawn = spawnWorker }: ReadFileOptions = {}): Promise<LogFile> {
  const { file, name } = asFile(source);
  if (signal?.aborted) return Promise.reject(signal.reason as unknown);
  const begun = performance.now();
  return new Promise((resolve, reject) => {
    let worker: FileWorkerLike;
    const end = (settle: () => void): void => {
      clearTimeout(patience);
      signal?.removeEventListener('abort', onAbort);
      worker.onmessage = worker.onerror = worker.onmessageerror = null;
      worker.terminate();
      settle();
    };
    const onAbort = (): void => end(() => reject((signal?.reason as unknown) ?? abortError('cancelled')));
    const lost = (detail: string): void => end(() => reject(workerUnavailable(detail)));
    let patience: ReturnType<typeof setTimeout> | undefined;
    try {
      worker = spawn();
    } catch (cause) {
      reject(workerUnavailable(cause instanceof Error ? cause.message : String(cause)));
      return;
    }
    patience = setTimeout(() => lost('its script does not arrive'), PATIENCE_MS);
    signal?.addEventListener('abort', onAbort, { once: true });
    worker.onerror = (event) => {
      event.preventDefault?.();
      lost(event.message);
    };
    worker.onmessageerror = () => lost('its answer could not be read');
    worker.onmessage = ({ data }) => {
      clearTimeout(patience);
      if (data.type === 'progress' && performance.now() - begun > QUIET_MS) onProgress?.(data.fraction);
      else if (data.type === 'read') end(() => resolve({ mesh: data.mesh, notices: data.notices }));
      else if (data.type === 'failed') end(() => reject(new RockFieldError(data.error)));
    };
    worker.postMessage({ file, name });
  });
}

function asFile(source: unknown): ToFileWorker {
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

function workerUnavailable(detail: string | undefined): RockFieldError {
  const reason = detail ? `: ${detail}` : ' (wood-ear-file-worker.js is missing or blocked)';
  return new RockFieldError({ name: 'WorkerUnavailable', message: `the worker that reads log files could not be started${reason}` });
}

function spawnWorker(): FileWorkerLike {
  // This literal form is the one that bundlers recognise.
  return startWorker(
    () => new Worker(new URL('./wood-ear-file-worker.js', import.meta.url), { type: 'module' }),
  ) as unknown as FileWorkerLike;
}
