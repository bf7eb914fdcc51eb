/** Makes files on several threads, and ends well whatever happens. */

import { availableParallelism, totalmem } from 'node:os';
import path from 'node:path';
import type { Worker } from 'node:worker_threads';
import { Ending, type EXITS, misuse, outputLost } from './failures.ts';
import type { Exit, Failure } from './failures.ts';
import { Jobs } from './jobs.ts';
import { Reporter } from './reporter.ts';
import type { Item, Streams } from './reporter.ts';
import { clearOwn, placeOf } from './whole-file.ts';
import type { Made, Task } from './work.ts';

/** What the command line has from its surroundings. */
export interface Surroundings extends Streams {
  startWorker: () => Worker;
}

export interface Plan {
  tasks: readonly Task[];
  /** As it was typed. */
  jobs: string | undefined;
  isJson: boolean;
  isQuiet: boolean;
  /** How the same command goes on with what is missing; empty where it cannot. */
  goOn: string;
}

/** What one field may take, and Node beside it. */
const MEMORY_OF_ONE = 2 * 2 ** 30;
const MOST_JOBS = 256;

/** How many at a time: as many as were asked for; or one more than there are cores, since one of them waits for the disk, as far as there is memory. */
export function jobsOf(typed: string | undefined, tasks: number): number {
  // Of a container the share that it has; 0 where nothing limits it.
  const memory = Math.min(totalmem(), process.constrainedMemory() || Infinity);
  const wanted = typed === undefined ? Math.min(availableParallelism() + 1, Math.floor(memory / MEMORY_OF_ONE)) : Number(typed);
  if (typed !== undefined && !(/^\d+$/.test(typed) && wanted >= 1 && wanted <= MOST_JOBS))
    throw misuse(`--jobs ${typed}: it must be a whole number from 1 to ${MOST_JOBS}`);
  return Math.max(1, Math.min(wanted, tasks));
}

/**
 * Does all tasks, and tells how it went.
 *
 * @throws {Ending} when it was stopped; what is there by then is whole, and there is nothing else.
 */
export async function make(plan: Plan, { startWorker, ...streams }: Surroundings): Promise<Exit> {
  const { tasks, isQuiet } = plan;
  const isFile = tasks.some(({ file }) => file === null);
  if (isFile && streams.out.isTTY && !tasks.every(isText))
    throw misuse('--out -: a terminal cannot show this file; pipe it to another program, or redirect it to a file with >');
  const isJson = plan.isJson || !streams.out.isTTY;
  const reporter = new Reporter(streams, { total: tasks.length, isJson, isQuiet, isFile });
  let isStorage = false;
  const jobs = new Jobs<Item, Made>({
    tasks: tasks.map((task, index) => ({ ...task, item: index + 1, isWatched: reporter.isWatched })),
    jobs: jobsOf(plan.jobs, tasks.length),
    startWorker,
    onProgress: (task, fraction) => reporter.progress(task, fraction),
    onResult: (task, made) => {
      if (made.data) streams.out.write(made.data);
      reporter.made(task, made);
    },
    onFailure: (task, failure: Failure) => {
      reporter.wentWrong(task, failure);
      isStorage ||= failure.isStorage;
      return failure.isStorage;
    },
  });
  const stopped = whenStopped(streams);
  try {
    await Promise.race([jobs.run().then(() => flushed(streams)), stopped.promise]);
  } catch (thrown) {
    const begun = await jobs.stop();
    clearOwn(begun.flatMap(({ file }) => (file === null ? [] : [path.dirname(placeOf(file))])));
    reporter.end(true);
    if (thrown instanceof Ending) throw new Ending(thrown.exit, left(thrown.message, reporter.done, plan), { cause: thrown });
    throw thrown;
  } finally {
    stopped.forget();
  }
  reporter.end();
  if (isStorage) throw new Ending('storage', left('files cannot be written', reporter.done, plan));
  if (reporter.failed > 0 && tasks.length > 1)
    reporter.say(`rock-field: ${reporter.failed} of ${tasks.length} could not be made; the others are there`);
  return reporter.failed > 0 ? 'failed' : 'done';
}

/** Whether people can read what is made. */
function isText({ wanted }: Task): boolean {
  return wanted.as === 'export'
    ? /^(obj|csv)$/.test(wanted.options.format ?? '') && (wanted.options.parts ?? 1) === 1
    : wanted.as === 'json';
}

/** Does one task whose bytes nobody sees, and says nothing of it. */
export async function makeOne(task: Task, { startWorker, ...streams }: Surroundings): Promise<Made> {
  let outcome: { made: Made } | { failure: Failure } | undefined;
  const jobs = new Jobs<Task, Made>({
    tasks: [task],
    jobs: 1,
    startWorker,
    onResult: (_, made) => {
      outcome = { made };
    },
    onFailure: (_, failure) => {
      outcome = { failure };
      return true;
    },
  });
  const stopped = whenStopped(streams);
  try {
    await Promise.race([jobs.run(), stopped.promise]);
  } finally {
    await jobs.stop();
    stopped.forget();
  }
  if (outcome && 'made' in outcome) return outcome.made;
  throw new Ending('failed', outcome?.failure.message ?? 'it was not made');
}

/** Once all that was written has been taken; a closed pipe is heard of by then. */
export function flushed({ out }: Pick<Streams, 'out'>): Promise<void> {
  return new Promise((resolve) => out.write('', (error) => (error ? undefined : resolve())));
}

function left(reason: string, done: number, { tasks, goOn }: Plan): string {
  if (tasks.some(({ file }) => file === null)) return reason;
  if (tasks.length === 1 && done === 0) return `${reason}; nothing was written`;
  const rest = done < tasks.length && goOn !== '' ? `; ${goOn}` : '';
  return `${reason}: ${done} of ${tasks.length} files are there, each of them whole${rest}`;
}

const SIGNALS = {
  SIGINT: { exit: 'interrupted', message: 'stopped' },
  SIGTERM: { exit: 'terminated', message: 'stopped by SIGTERM' },
  SIGHUP: { exit: 'hangup', message: 'the terminal was closed' },
} as const satisfies Partial<Record<NodeJS.Signals, { exit: keyof typeof EXITS; message: string }>>;

/** Rejects when the process is told to end, or when nobody reads its output any more. */
export function whenStopped({ out }: Pick<Streams, 'out'>): { promise: Promise<never>; forget: () => void } {
  const undo: (() => void)[] = [];
  const promise = new Promise<never>((_, reject) => {
    for (const [signal, { exit, message }] of Object.entries(SIGNALS)) {
      const handler = (): void => reject(new Ending(exit, message));
      process.on(signal, handler);
      undo.push(() => process.off(signal, handler));
    }
    const onError = (error: NodeJS.ErrnoException): void => reject(outputLost(error));
    out.on('error', onError);
    undo.push(() => out.off('error', onError));
  });
  promise.catch(() => undefined);
  return { promise, forget: () => undo.forEach((step) => step()) };
}
