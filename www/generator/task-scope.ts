/** A worker for one task, which ends with it: the worker's side. `one-task.ts` is the page's. */

import { errorInfo } from '../base/errors.ts';
import type { FromTask } from './one-task.ts';

/** A page shows no more, ms. */
const REPORT_EVERY_MS = 50;

/**
 * Does what the page asks for.
 *
 * @param work what makes the result, with the buffers of it that are handed over.
 */
export function onTask<Task, Result>(
  work: (
    task: Task,
    onProgress: (fraction: number) => void,
  ) => Promise<{ result: Result; transfer: Transferable[] }> | { result: Result; transfer: Transferable[] },
): void {
  const scope = globalThis as unknown as {
    postMessage(message: FromTask<Result>, transfer?: Transferable[]): void;
    onmessage: ((event: MessageEvent<Task>) => void) | null;
  };
  scope.onmessage = async ({ data }) => {
    let told = performance.now();
    const onProgress = (fraction: number): void => {
      if (performance.now() - told < REPORT_EVERY_MS) return;
      told = performance.now();
      scope.postMessage({ type: 'progress', fraction });
    };
    try {
      const { result, transfer } = await work(data, onProgress);
      scope.postMessage({ type: 'done', result }, transfer);
    } catch (thrown) {
      scope.postMessage({ type: 'failed', error: errorInfo(thrown) });
    }
  };
  scope.postMessage({ type: 'ready' });
}
