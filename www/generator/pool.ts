/**
 * The workers of a page, which all its generators share: a few, however many fields there are.
 *
 * A client stays with its worker, where its cache lies. Workers are made when there is a first request for them, and end when
 * they have had no client for a while.
 */

import { PoolWorker } from './pool-worker.ts';
import type { PoolClient, WorkerLike } from './pool-worker.ts';
import type { ToLoop } from './protocol.ts';

/** The memory of each grows to its largest field and never shrinks. */
const MAX_WORKERS = 4;

/** How long a worker without clients lives: from one view of a page to the next, without loading the wasm again. */
export const IDLE_MS = 1000;

/** A client's place at its worker. */
export interface Seat {
  /** Whether the worker can be expected to answer. */
  readonly ready: boolean;
  post(message: ToLoop): void;
  /** A cancel has not been answered in time. */
  overdue(): void;
  /** To be called once; the worker forgets the client, who hears nothing any more. */
  leave(): void;
}

export class WorkerPool {
  #spawn: () => WorkerLike;
  /** Each with the timer that ends it, if it has no client. */
  #workers = new Map<PoolWorker, ReturnType<typeof setTimeout> | undefined>();
  #lastClient = 0;

  constructor(spawn: () => WorkerLike) {
    this.#spawn = spawn;
  }

  /** A place at the worker with the fewest clients. */
  join(client: PoolClient): Seat {
    const number = ++this.#lastClient;
    const worker = this.#leastUsed();
    clearTimeout(this.#workers.get(worker));
    this.#workers.set(worker, undefined);
    worker.join(number, client);
    return {
      get ready() {
        return worker.ready;
      },
      post: (message) => worker.post({ ...message, client: number }),
      overdue: () => worker.overdue(),
      leave: () => this.#leave(worker, number),
    };
  }

  #leastUsed(): PoolWorker {
    const [best] = [...this.#workers.keys()].sort((a, b) => a.load - b.load);
    if (best && (best.load === 0 || this.#workers.size >= maxWorkers())) return best;
    return new PoolWorker(this.#spawn);
  }

  #leave(worker: PoolWorker, number: number): void {
    worker.leave(number);
    if (worker.load > 0) return;
    const timer = setTimeout(() => {
      this.#workers.delete(worker);
      worker.discard();
    }, IDLE_MS);
    this.#workers.set(worker, timer);
  }
}

/** One core is left to the page. */
function maxWorkers(): number {
  const cores = (globalThis.navigator as { hardwareConcurrency?: number } | undefined)?.hardwareConcurrency ?? 1;
  return Math.min(MAX_WORKERS, Math.max(1, cores - 1));
}

const pools = new WeakMap<() => WorkerLike, WorkerPool>();

/** The pool of the workers that `spawn` makes. */
export function poolOf(spawn: () => WorkerLike): WorkerPool {
  let pool = pools.get(spawn);
  if (!pool) {
    pool = new WorkerPool(spawn);
    pools.set(spawn, pool);
  }
  return pool;
}
