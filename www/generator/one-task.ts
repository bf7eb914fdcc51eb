/** A worker for one task, which ends with it: the page's side. `task-scope.ts` is the worker's. */

import { abortError, RockFieldError } from '../base/errors.ts';
import type { ErrorInfo } from '../base/errors.ts';
import { startWorker } from './start-worker.ts';

/** What such a worker says. */
export type FromTask<Result> =
  | { type: 'ready' }
  | { type: 'progress'; fraction: number }
  | { type: 'done'; result: Result }
  | { type: 'failed'; error: ErrorInfo };

/** The part of `Worker` that is used, for tests. */
export interface TaskWorkerLike<Task, Result> {
  onmessage: ((event: MessageEvent<FromTask<Result>>) => void) | null;
  onerror: ((event: ErrorEvent) => void) | null;
  onmessageerror: ((event: MessageEvent) => void) | null;
  postMessage(task: Task, transfer?: Transferable[]): void;
  terminate(): void;
}

export interface TaskOptions {
  signal?: AbortSignal | undefined;
  /** 0 … 1, of tasks that take longer than a moment. */
  onProgress?: ((fraction: number) => void) | undefined;
}

/** How a kind of worker is started, and what is said when it cannot be. */
export interface TaskKind<Task, Result> {
  /** For people: `that reads log files`. */
  what: string;
  /** The script's name, for whoever has to look for it. */
  file: string;
  spawn: () => TaskWorkerLike<Task, Result>;
}

/** Tasks that end within this, ms, show no progress. */
const QUIET_MS = 200;
/** From the start of a worker to its first word, ms: its script may have to be fetched over a slow network. */
const PATIENCE_MS = 30_000;

/** The worker that `make` makes by nothing but the literal `new Worker(…)` that bundlers recognise. */
export function taskWorker<Task, Result>(make: () => Worker): TaskWorkerLike<Task, Result> {
  return startWorker(make) as unknown as TaskWorkerLike<Task, Result>;
}

/**
 * What a new worker makes of `task`, which is copied.
 *
 * @param transfer buffers in the task that are handed over instead.
 * @throws {RockFieldError} What the worker says; `WorkerUnavailable`.
 * @throws {DOMException} `AbortError` when `signal` says so.
 */
export function inWorker<Task, Result>(
  { what, file, spawn }: TaskKind<Task, Result>,
  task: Task,
  { signal, onProgress }: TaskOptions,
  transfer: Transferable[] = [],
): Promise<Result> {
  if (signal?.aborted) return Promise.reject(signal.reason as unknown);
  const unavailable = (reason: string | undefined): RockFieldError => {
    const ending = reason ? `: ${reason}` : ` (${file} is missing or blocked)`;
    return new RockFieldError({ name: 'WorkerUnavailable', message: `the worker ${what} could not be started${ending}` });
  };
  const begun = performance.now();
  return new Promise((resolve, reject) => {
    let worker: TaskWorkerLike<Task, Result>;
    const end = (settle: () => void): void => {
      clearTimeout(patience);
      signal?.removeEventListener('abort', onAbort);
      worker.onmessage = worker.onerror = worker.onmessageerror = null;
      worker.terminate();
      settle();
    };
    const onAbort = (): void => end(() => reject((signal?.reason as unknown) ?? abortError('cancelled')));
    const lost = (detail: string): void => end(() => reject(unavailable(detail)));
    let patience: ReturnType<typeof setTimeout> | undefined;
    try {
      worker = spawn();
    } catch (cause) {
      reject(unavailable(cause instanceof Error ? cause.message : String(cause)));
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
      else if (data.type === 'done') end(() => resolve(data.result));
      else if (data.type === 'failed') end(() => reject(new RockFieldError(data.error)));
    };
    worker.postMessage(task, transfer);
  });
}
