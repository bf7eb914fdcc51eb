/** The page's side of the protocol for one generator: the latest request wins, and is asked again when its worker was lost. */

import { abortError, RockFieldError } from '../errors.ts';
import type { ErrorInfo } from '../errors.ts';
import type { Field } from '../field.ts';
import { flatRequest } from '../params-flat.ts';
import type { Params } from '../params.ts';
import type { OnResult } from '../runs.ts';
import { defaultMaxBytes } from './budget.ts';
import { poolOf } from './pool.ts';
import type { Seat } from './pool.ts';
import type { WorkerLike } from './pool-worker.ts';
import type { FlatRequest, FromLoop, Progress, ToLoop } from './protocol.ts';

/** A cancel that is not answered by then ends the worker, unless it is shared: a slice takes 30 ms at most. */
export const CANCEL_MS = 100;

export interface ClientOptions {
  /** Makes a worker; clients with the same `spawn` share theirs. Default: the workers of the page. */
  spawn?: () => WorkerLike;
  /**
   * Every finished field, in the order of the requests, those of superseded requests included: a drag shows its newest finished
   * result. `superseded` tells that a newer request is on its way; `params` is what `generate` was given. Called before the promise
   * of the request settles.
   */
  onResult?: OnResult<Params, Field>;
}

export interface GenerateOptions {
  signal?: AbortSignal | undefined;
  /** Called for runs of more than 200 ms. */
  onProgress?: ((progress: Progress) => void) | undefined;
  /** Default 1.5 GiB, 512 MiB on devices that report 4 GB or less. */
  maxBytes?: number | undefined;
}

/** One call of `generate` whose promise is open. */
interface Call {
  id: number;
  params: Params;
  request: FlatRequest;
  retried: boolean;
  onProgress: ((progress: Progress) => void) | undefined;
  resolve: (field: Field) => void;
  reject: (error: unknown) => void;
}

interface SeedCall {
  resolve: (seed: number) => void;
  reject: (error: unknown) => void;
}

export class GeneratorClient {
  #options: ClientOptions;
  /** Taken with the first request. */
  #seat: Seat | undefined;
  #lastId = 0;
  #call: Call | undefined;
  #seeds = new Map<number, SeedCall>();
  /** Runs that the worker has not answered yet, superseded ones included. */
  #open = new Map<number, Params>();
  #shown = 0;
  #disposed = false;

  constructor(options: ClientOptions = {}) {
    this.#options = options;
  }

  /** Whether a request waits for its field. */
  get busy(): boolean {
    return this.#call !== undefined;
  }

  /**
   * The field of these parameters. A newer call supersedes this one, whose promise then rejects with an AbortError.
   *
   * Rejects with a RockFieldError: by the parameters (nothing has changed), `WasmUnavailable`, `WorkerUnavailable` or `WorkerLost`
   * (the next call starts a new worker), or `Internal` (the generator trapped; the next call starts a new worker).
   */
  generate(params: Params, { signal, onProgress, maxBytes = defaultMaxBytes() }: GenerateOptions = {}): Promise<Field> {
    if (this.#disposed) return Promise.reject(abortError('the generator was disposed of'));
    if (signal?.aborted) return Promise.reject(signal.reason as unknown);
    return new Promise((resolve, reject) => {
      const id = ++this.#lastId;
      const onAbort = () => {
        if (this.#call?.id === id) this.#abandon(this.#call, signal?.reason);
      };
      signal?.addEventListener('abort', onAbort, { once: true });
      const settled = () => signal?.removeEventListener('abort', onAbort);
      const superseded = this.#call;
      this.#call = {
        id,
        params,
        request: flatRequest(params, maxBytes),
        retried: false,
        onProgress,
        resolve: (field) => (settled(), resolve(field)),
        reject: (error) => (settled(), reject(error)),
      };
      superseded?.reject(abortError('superseded by a newer request'));
      this.#start(this.#call);
    });
  }

  /** A fresh random seed, drawn by the generator's own entropy source. */
  freshSeed(): Promise<number> {
    if (this.#disposed) return Promise.reject(abortError('the generator was disposed of'));
    return new Promise((resolve, reject) => {
      const id = ++this.#lastId;
      this.#seeds.set(id, { resolve, reject });
      this.#post({ type: 'seed', id });
    });
  }

  /** Gives the running request up: its promise rejects with an AbortError, its finished stages are kept where possible. */
  cancel(): void {
    if (this.#call) this.#abandon(this.#call, abortError('cancelled'));
  }

  /** Frees the cache, and the worker if nobody else needs it soon; open promises reject with an AbortError. */
  dispose(): void {
    this.#disposed = true;
    this.#fail(abortError('the generator was disposed of'));
    this.#seat?.leave();
    this.#seat = undefined;
  }

  #start(call: Call): void {
    this.#open.set(call.id, call.params);
    this.#post({ type: 'start', id: call.id, request: call.request });
  }

  #abandon(call: Call, reason: unknown): void {
    this.#call = undefined;
    call.reject(reason);
    const seat = this.#seat;
    seat?.post({ type: 'cancel', id: call.id });
    // While it loads, a worker cannot answer and burns nothing.
    if (!seat?.ready) return;
    setTimeout(() => {
      if (this.#open.has(call.id)) seat.overdue();
    }, CANCEL_MS);
  }

  #post(message: ToLoop): void {
    this.#seat ??= poolOf(this.#options.spawn).join({
      isWaiting: () => this.#open.size > 0 || this.#seeds.size > 0,
      receive: (answer) => this.#receive(answer),
      moved: () => this.#askAgain(),
      lost: () => this.#lost(),
      failed: (error) => this.#fail(error),
    });
    this.#seat.post(message);
  }

  #receive(message: FromLoop): void {
    switch (message.type) {
      case 'progress':
        if (this.#call?.id === message.id) this.#call.onProgress?.(message.progress);
        break;
      case 'field':
        this.#deliver(message.id, message.field);
        break;
      case 'rejected':
        this.#open.delete(message.id);
        this.#take(message.id)?.reject(new RockFieldError(message.error));
        break;
      case 'dropped':
        this.#open.delete(message.id);
        // Nobody asks the worker to drop the current call; should it do so, the promise must not stay open.
        this.#take(message.id)?.reject(abortError('dropped'));
        break;
      case 'crashed':
        this.#crashed(message.id, message.error);
        break;
      case 'seed':
        this.#seeds.get(message.id)?.resolve(message.seed);
        this.#seeds.delete(message.id);
        break;
      default:
        message satisfies never;
    }
  }

  #deliver(id: number, field: Field): void {
    const call = this.#take(id);
    const params = this.#open.get(id);
    this.#open.delete(id);
    // A run that was cancelled in the moment it ended is nobody's: neither current nor superseded by a newer call.
    const superseded = call === undefined && this.#call !== undefined;
    if ((call || superseded) && params && id > this.#shown) {
      this.#shown = id;
      this.#options.onResult?.(field, { superseded, isPreview: false }, params);
    }
    call?.resolve(field);
  }

  /** The current call if it has this id; it is then closed. */
  #take(id: number): Call | undefined {
    if (this.#call?.id !== id) return undefined;
    const call = this.#call;
    this.#call = undefined;
    return call;
  }

  /** After a trap the same parameters would trap again: only a newer request, or a seed, is worth a new worker. */
  #crashed(id: number, error: ErrorInfo): void {
    const thrown = new RockFieldError(error);
    this.#take(id)?.reject(thrown);
    this.#seeds.get(id)?.reject(thrown);
    this.#seeds.delete(id);
  }

  /** The worker is gone without a trap, perhaps killed for memory: one more try, then the request is given up. */
  #lost(): void {
    const call = this.#call;
    if (call?.retried) {
      this.#fail(new RockFieldError({ name: 'WorkerLost', message: 'the generator stopped without an answer, twice; try smaller settings' }));
      return;
    }
    if (call) call.retried = true;
    this.#askAgain();
  }

  /** Asks a new worker for what still waits. */
  #askAgain(): void {
    this.#open.clear();
    for (const id of this.#seeds.keys()) this.#post({ type: 'seed', id });
    if (this.#call) this.#start(this.#call);
  }

  #fail(error: unknown): void {
    const call = this.#call;
    this.#call = undefined;
    call?.reject(error);
    for (const seed of this.#seeds.values()) seed.reject(error);
    this.#seeds.clear();
    this.#open.clear();
  }
}
