/**
 * One worker of the pool, whose clients share its life: a worker that is gone is replaced, once for all of them.
 *
 * A worker can vanish without a word (memory, `self.close()`), so silence counts: when somebody has waited for an answer longer
 * than `SILENCE_MS`, it is asked, and replaced when there is no answer to that either. Nothing is timed while nobody waits.
 */

import { RockFieldError } from '../errors.ts';
import type { Addressed, FromLoop, FromWorker, ToLoop, ToWorker } from './protocol.ts';

/** A busy worker reports every 50 ms; the copies of the largest field take a few hundred. */
export const SILENCE_MS = 1000;

/** From the question to the verdict. A page that was frozen wakes with its timers due before its messages. */
export const GRACE_MS = 1500;

/** The part of `Worker` that is used, for tests. */
export interface WorkerLike {
  onmessage: ((event: MessageEvent<FromWorker>) => void) | null;
  onerror: ((event: ErrorEvent) => void) | null;
  onmessageerror: ((event: MessageEvent) => void) | null;
  postMessage(message: ToWorker): void;
  terminate(): void;
}

/** Whom a worker works for. Whatever it had been asked is forgotten when one of the last three is called. */
export interface PoolClient {
  /** Whether it waits for an answer of the worker. */
  isWaiting(): boolean;
  receive(message: FromLoop): void;
  /** The worker is gone, and this client is not the reason: ask again what still matters. */
  moved(): void;
  /** The worker is gone, and any client may be the reason: perhaps it was killed for memory. */
  lost(): void;
  /** The worker could not be started. */
  failed(error: RockFieldError): void;
}

export class PoolWorker {
  #spawn: () => WorkerLike;
  #clients = new Map<number, PoolClient>();
  /** None before it is needed, and from a death until it is needed again. */
  #worker: WorkerLike | undefined;
  #ready = false;
  #watchdog: ReturnType<typeof setTimeout> | undefined;
  #asked = false;

  constructor(spawn: () => WorkerLike) {
    this.#spawn = spawn;
  }

  /** How many clients share it. */
  get load(): number {
    return this.#clients.size;
  }

  /** The worker has compiled its wasm: from then on it can be expected to answer. */
  get ready(): boolean {
    return this.#ready;
  }

  join(number: number, client: PoolClient): void {
    this.#clients.set(number, client);
  }

  leave(number: number): void {
    this.#clients.delete(number);
    this.#worker?.postMessage({ type: 'close', client: number });
    if (!this.#isAwaited()) this.#watch();
  }

  post(message: Addressed<ToLoop>): void {
    if (!this.#worker && !this.#start(message.client)) return;
    this.#worker?.postMessage(message);
    // A wait that has begun goes on: a drag must not put the question off for ever.
    if (this.#watchdog === undefined) this.#watch();
  }

  /**
   * A client's cancel was not answered in time. Its own worker is replaced for that; one that is shared is not, which would cost
   * the others their runs and caches: if it is dead, its silence will tell.
   */
  overdue(): void {
    if (this.#clients.size === 1) this.#replace();
  }

  /** Ends the worker; the next message to it makes a new one. */
  discard(): void {
    this.#worker?.terminate();
    this.#worker = undefined;
    this.#ready = false;
    this.#watch();
  }

  #start(number: number): boolean {
    let worker: WorkerLike;
    try {
      worker = this.#spawn();
    } catch (cause) {
      this.#clients.get(number)?.failed(workerUnavailable(cause instanceof Error ? cause.message : String(cause)));
      return false;
    }
    this.#worker = worker;
    worker.onmessage = (event) => {
      if (this.#worker === worker) this.#receive(event.data);
    };
    worker.onerror = (event) => {
      event.preventDefault?.();
      if (this.#worker !== worker) return;
      if (this.#ready) this.#lost();
      else this.#failed(workerUnavailable(event.message));
    };
    worker.onmessageerror = () => {
      if (this.#worker === worker) this.#lost();
    };
    return true;
  }

  #receive(message: FromWorker): void {
    switch (message.type) {
      case 'ready':
        this.#ready = true;
        break;
      case 'failed':
        this.#failed(new RockFieldError(message.error));
        break;
      case 'crashed':
        this.#clients.get(message.client)?.receive(message);
        this.#replace();
        break;
      case 'pong':
        break;
      default:
        this.#clients.get(message.client)?.receive(message);
    }
    this.#watch();
  }

  #replace(): void {
    this.discard();
    for (const client of this.#clients.values()) client.moved();
  }

  #lost(): void {
    this.discard();
    for (const client of this.#clients.values()) client.lost();
  }

  #failed(error: RockFieldError): void {
    this.discard();
    for (const client of this.#clients.values()) client.failed(error);
  }

  #isAwaited(): boolean {
    return [...this.#clients.values()].some((client) => client.isWaiting());
  }

  /** Called at every sign of life: starts the wait anew if there is anything to wait for. */
  #watch(): void {
    clearTimeout(this.#watchdog);
    this.#watchdog = undefined;
    this.#asked = false;
    if (!this.#worker || !this.#ready || !this.#isAwaited()) return;
    this.#watchdog = setTimeout(() => this.#ask(), SILENCE_MS);
  }

  #ask(): void {
    if (this.#asked) {
      this.#lost();
      return;
    }
    this.#asked = true;
    this.#worker?.postMessage({ type: 'ping' });
    this.#watchdog = setTimeout(() => this.#ask(), GRACE_MS);
  }
}

function workerUnavailable(detail: string | undefined): RockFieldError {
  // Browsers tell pages no more of a script than that it could not be had.
  const reason = detail ? `: ${detail}` : '; its file is missing, or blocked by a Content-Security-Policy or by Cross-Origin-Embedder-Policy, which it has to be served with too';
  return new RockFieldError({ name: 'WorkerUnavailable', message: `the generator's worker could not be started${reason}` });
}
