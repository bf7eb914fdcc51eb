/**
 * Tasks on several threads. Each worker takes the next task when it is done with the last; a task that fails fails alone; a worker that dies
 * fails its task, and another takes its place.
 */

import type { Worker } from 'node:worker_threads';
import type { Failure } from './failures.ts';

/** What a worker is sent. */
export interface Call<Task> {
  task: Task;
}

/** What a worker answers: progress any number of times, then one of the others. */
export type Answer<Result> = { fraction: number } | { result: Result } | { failure: Failure };

export interface JobsOptions<Task, Result> {
  /** Taken one by one, as workers become free: there may be any number of them. */
  tasks: Iterable<Task>;
  /** How many at a time. */
  jobs: number;
  startWorker: () => Worker;
  onProgress?: ((task: Task, fraction: number) => void) | undefined;
  onResult: (task: Task, result: Result) => void;
  /** What failed; where it returns true, no other task is begun. */
  onFailure: (task: Task, failure: Failure) => boolean;
}

interface Busy<Task> {
  task: Task;
  end: () => void;
}

export class Jobs<Task, Result> {
  readonly #options: JobsOptions<Task, Result>;
  readonly #tasks: Iterator<Task>;
  readonly #workers = new Map<Worker, Busy<Task> | null>();
  #isStopping = false;

  constructor(options: JobsOptions<Task, Result>) {
    this.#options = options;
    this.#tasks = options.tasks[Symbol.iterator]();
  }

  /** Does all of them. Rejects only where one of the callbacks throws. */
  async run(): Promise<void> {
    const { jobs } = this.#options;
    try {
      await Promise.all(Array.from({ length: jobs }, () => this.#lane()));
    } finally {
      await this.stop();
    }
  }

  /** Ends all workers now. Returns the tasks that they were at, once nothing runs any more. */
  async stop(): Promise<Task[]> {
    this.#isStopping = true;
    const workers = [...this.#workers];
    this.#workers.clear();
    // First, since a worker that ends because it is told to has not failed.
    for (const [, busy] of workers) busy?.end();
    await Promise.all(workers.map(([worker]) => worker.terminate()));
    return workers.flatMap(([, busy]) => (busy ? [busy.task] : []));
  }

  /** One task after the other, with one worker while it lives. */
  async #lane(): Promise<void> {
    let worker: Worker | undefined;
    while (!this.#isStopping) {
      const { done, value: task } = this.#tasks.next();
      if (done) break;
      worker ??= this.#begun();
      if (!(await this.#does(worker, task))) worker = undefined;
    }
  }

  #begun(): Worker {
    const worker = this.#options.startWorker();
    // One that dies between two tasks fails the next one, by its exit; without a listener it would end the process.
    worker.on('error', () => undefined);
    return worker;
  }

  /** Whether the worker can do another one. */
  #does(worker: Worker, task: Task): Promise<boolean> {
    return new Promise((resolve, reject) => {
      const settle = (isAlive: boolean, tell?: () => void): void => {
        for (const [event, listener] of Object.entries(listeners)) worker.off(event, listener);
        if (isAlive) this.#workers.set(worker, null);
        else this.#workers.delete(worker);
        try {
          tell?.();
          resolve(isAlive);
        } catch (thrown) {
          reject(thrown);
        }
      };
      const failed = (failure: Failure, isAlive: boolean): void =>
        settle(isAlive, () => {
          if (this.#options.onFailure(task, failure)) this.#isStopping = true;
        });
      const listeners = {
        message: (answer: Answer<Result>): void => {
          if ('fraction' in answer) this.#options.onProgress?.(task, answer.fraction);
          else if ('failure' in answer) failed(answer.failure, true);
          else settle(true, () => this.#options.onResult(task, answer.result));
        },
        error: (thrown: unknown): void => failed(lost(thrown instanceof Error ? thrown.message : String(thrown)), false),
        exit: (code: number): void => failed(lost(`exit code ${code}`), false),
      };
      this.#workers.set(worker, { task, end: () => settle(false) });
      for (const [event, listener] of Object.entries(listeners)) worker.on(event, listener);
      worker.postMessage({ task } satisfies Call<Task>);
    });
  }
}

function lost(reason: string): Failure {
  return { name: 'WorkerLost', message: `the thread that made it ended (${reason}); try smaller settings or fewer jobs`, isStorage: false };
}
