/**
 * One worker of the pool, whose clients share its life: a worker that is gone is replaced, once for all of them.
 *
 * A worker can end without a word (memory, `self.close()`, a script that does nothing), so silence counts, but only while a client
 * waits for an answer. Its states, and what happens in each when nothing is heard:
 *
 * | state    | entered by                        | silence means                                                                     |
 * |----------|-----------------------------------|-----------------------------------------------------------------------------------|
 * | none     | nothing asked yet, or a death     | nothing; the next message makes a new worker                                      |
 * | starting | the first message                 | after `START_MS` the script is fetched here too: while its bytes come in, the     |
 * |          |                                   | network is slow. `GRACE_MS` after the last one every client fails                 |
 * | loading  | `started`, said by the script     | as in `ready`: it answers pings while its wasm arrives (how long that may take    |
 * |          |                                   | is the worker's own matter, see `base/wasm-file.ts`)                              |
 * | ready    | `ready`, said once wasm is there  | after `SILENCE_MS` it is pinged; no answer within `GRACE_MS` means it is lost     |
 *
 * A lost worker's clients ask a new one, once; a second loss during the same request is reported (`worker-client.ts`). An answer that
 * counts fewer messages than were sent means that a message got lost, which is the same as a lost worker.
 */

import { RockFieldError } from '../base/errors.ts';
import type { Addressed, FromLoop, FromWorker, ToLoop, ToWorker } from './protocol.ts';

/** A busy worker reports every 50 ms; the copies of the largest field take a few hundred. */
export const SILENCE_MS = 1000;

/** From the question to the verdict. A page that was frozen wakes with its timers due before its messages. */
export const GRACE_MS = 1500;

/** How long a script may take to run for the first time before its network is looked at. */
export const START_MS = 8000;

/** The part of `Worker` that is used, for tests. */
export interface WorkerLike {
  /** Fetches the worker's script, calling back at every piece of it. Asked when the worker says nothing at all. */
  probe?: ((heard: () => void) => Promise<void>) | undefined;
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
  #state: 'starting' | 'loading' | 'ready' = 'starting';
  /** Messages sent to this worker. */
  #sent = 0;
  #watchdog: ReturnType<typeof setTimeout> | undefined;
  #asked = false;
  /** Messages sent up to the last ping, which the answer has to account for. */
  #sentBeforePing = 0;

  constructor(spawn: () => WorkerLike) {
    this.#spawn = spawn;
  }

  /** How many clients share it. */
  get load(): number {
    return this.#clients.size;
  }

  /** The worker has compiled its wasm: from then on it can be expected to answer. */
  get ready(): boolean {
    return this.#state === 'ready';
  }

  join(number: number, client: PoolClient): void {
    this.#clients.set(number, client);
  }

  leave(number: number): void {
    this.#clients.delete(number);
    this.#send({ type: 'close', client: number });
    if (!this.#isAwaited()) this.#watch();
  }

  post(message: Addressed<ToLoop>): void {
    if (!this.#worker && !this.#start(message.client)) return;
    this.#send(message);
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
    this.#state = 'starting';
    this.#sent = this.#sentBeforePing = 0;
    this.#watch();
  }

  #send(message: ToWorker): void {
    if (!this.#worker) return;
    this.#sent += 1;
    this.#worker.postMessage(message);
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
      if (this.#state !== 'starting') this.#lost();
      else this.#failed(workerUnavailable(event.message));
    };
    worker.onmessageerror = () => {
      if (this.#worker === worker) this.#lost();
    };
    return true;
  }

  #receive(message: FromWorker): void {
    switch (message.type) {
      case 'started':
        this.#state = 'loading';
        break;
      case 'ready':
        this.#state = 'ready';
        break;
      case 'failed':
        this.#failed(new RockFieldError(message.error));
        break;
      case 'crashed':
        this.#clients.get(message.client)?.receive(message);
        this.#replace();
        break;
      case 'pong':
        if (message.heard < this.#sentBeforePing) this.#lost();
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
    if (!this.#worker || !this.#isAwaited()) return;
    if (this.#state === 'starting') this.#watchdog = setTimeout(() => void this.#probe(), START_MS);
    else this.#watchdog = setTimeout(() => this.#ask(), SILENCE_MS);
  }

  #ask(): void {
    if (this.#asked) {
      this.#lost();
      return;
    }
    this.#asked = true;
    this.#send({ type: 'ping' });
    this.#sentBeforePing = this.#sent;
    this.#watchdog = setTimeout(() => this.#ask(), GRACE_MS);
  }

  /** The script has not run yet: gives it up when its file has arrived and it still does not, or when no more of the file arrives. */
  async #probe(): Promise<void> {
    const worker = this.#worker;
    const giveUpAfter = (ms: number, reason: string): void => {
      if (this.#worker !== worker || this.#state !== 'starting') return;
      clearTimeout(this.#watchdog);
      this.#watchdog = setTimeout(() => (this.#isAwaited() ? this.#failed(workerUnavailable(reason)) : this.#watch()), ms);
    };
    const stalled = () => giveUpAfter(START_MS, 'its script does not arrive; check the connection');
    stalled();
    try {
      await worker?.probe?.(stalled);
      giveUpAfter(GRACE_MS, 'its script says nothing; is it the right file?');
    } catch (cause) {
      giveUpAfter(0, cause instanceof Error ? cause.message : String(cause));
    }
  }
}

function workerUnavailable(detail: string | undefined): RockFieldError {
  // Browsers tell pages no more of a script than that it could not be had.
  const reason = detail
    ? `: ${detail}`
    : '; its file is missing, or blocked by a Content-Security-Policy or by Cross-Origin-Embedder-Policy, which it must be served with too';
  return new RockFieldError({ name: 'WorkerUnavailable', message: `the generator's worker could not be started${reason}` });
}
