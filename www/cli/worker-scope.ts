/** The worker's side of `jobs.ts`. */

import { parentPort } from 'node:worker_threads';
import { failureOf } from './failures.ts';
import type { Answer, Call } from './jobs.ts';

/** Does the tasks that arrive; what is thrown is the answer too. `transfer` is moved to the main thread, not copied. */
export function onTasks<Task, Result>(
  work: (task: Task, onProgress: (fraction: number) => void) => Promise<{ result: Result; transfer?: ArrayBuffer[] }>,
): void {
  const post = (answer: Answer<Result>, transfer: ArrayBuffer[] = []): void => parentPort?.postMessage(answer, transfer);
  parentPort?.on('message', ({ task }: Call<Task>) => {
    work(task, (fraction) => post({ fraction })).then(
      ({ result, transfer }) => post({ result }, transfer),
      (thrown: unknown) => post({ failure: failureOf(thrown) }),
    );
  });
}
