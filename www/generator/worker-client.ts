/** The page's side of the protocol for one generator, whatever it generates: the latest request wins, and is asked again when its worker was lost. */

import { abortError, RockFieldError } from '../base/errors.ts';
import type { ErrorInfo } from '../base/errors.ts';
import type { OnResult } from './runs.ts';
import { defaultMaxBytes } from './budget.ts';
import { poolOf } from './pool.ts';
import type { Seat } from './pool.ts';
import type { WorkerLike } from './pool-worker.ts';
import type { FromLoop, Progress, ToLoop } from './protocol.ts';

/** A cancel that is not answered by then ends the worker, unless it is shared: a slice takes 30 ms at most. */
export const CANCEL_MS = 100;

export interface ClientOptions<Request, Result> {
  /** Makes a worker; clients with the same `spawn` share theirs. Default: the page's. */
  spawn?: () => WorkerLike;
  /**
   * Every preview and every result, in the order of the requests, those of superseded requests included: a drag shows its newest finished
   * result. `superseded` tells that a newer request is on its way; `request` is what `generate` was given. Called before the promise
   * of the request settles.
   */
  onResult?: OnResult<Request, Result>;
}

export interface GenerateOptions<Stage extends string> {
  signal?: AbortSignal | undefined;
  /** Called for runs of more than 200 ms. */
  onProgress?: ((progress: Progress<Stage>) => void) | undefined;
  /** Default 1.5 GiB, 512 MiB on devices that report 4 GB or less. */
  maxBytes?: number | undefined;
}

/** One call of `generate` whose promise is open. */
interface Call<Request, Flat, Result, Stage extends string> {
  id: number;
  request: Request;
  flat: Flat;
  retried: boolean;
  onProgress: ((progress: Progress<Stage>) => void) | undefined;
  resolve: (result: Result) => void;
  reject: (error: unknown) => void;
}

interface SeedCall {
  resolve: (seed: number) => void;
  reject: (error: unknown) => void;
}

export abstract class WorkerClient<Request, Flat, Result, Stage extends string> {
  #options: ClientOptions<Request, Result>;
  /** Makes the workers that do every request that asks for no others. */
  #first: () => WorkerLike;
  /** Makes those that there are now. */
  #spawn: () => WorkerLike;
  /** Taken with the first request. */
  #seat: Seat | undefined;
  #lastId = 0;
  #call: Call<Request, Flat, Result, Stage> | undefined;
  #seeds = new Map<number, SeedCall>();
  /** Runs that the worker has not answered yet, superseded ones included. */
  #open = new Map<number, Request>();
  #shown = 0;
  #disposed = false;

  constructor(options: ClientOptions<Request, Result>, spawn: () => WorkerLike) {
    this.#options = options;
    this.#first = this.#spawn = options.spawn ?? spawn;
  }

  /** Copies all of the request that may change. */
  protected abstract encode(request: Request, maxBytes: number): Flat;

  /** Makes the workers that alone can do this request; undefined where any can. They then do all that follow. */
  protected another(_request: Flat): (() => WorkerLike) | undefined {
    return undefined;
  }

  /** What a worker packed, in the order in which it did. */
  protected unpack(packed: unknown): Result {
    return packed as Result;
  }

  /** Whether a request waits for its field. */
  get busy(): boolean {
    return this.#call !== undefined;
  }

  /**
   * The result of this request. A newer call supersedes this one, whose promise then rejects with an AbortError.
   *
   * Rejects with a RockFieldError: by the parameters (nothing has changed), `WasmUnavailable`, `WorkerUnavailable` or `WorkerLost`
   * (the next call starts a new worker), or `Internal` (the generator trapped; the next call starts a new worker).
   */
  generate(request: Request, { signal, onProgress, maxBytes = defaultMaxBytes() }: GenerateOptions<Stage> = {}): Promise<Result> {
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
        request,
        flat: this.encode(request, maxBytes),
        retried: false,
        onProgress,
        resolve: (result) => {
          settled();
          resolve(result);
        },
        reject: (error) => {
          settled();
          reject(error);
        },
      };
      superseded?.reject(abortError('superseded by a newer request'));
      const spawn = this.#options.spawn ?? this.another(this.#call.flat) ?? this.#spawn;
      if (spawn === this.#spawn) this.#start(this.#call);
      else this.#move(spawn);
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

  /** To workers of another kind, with all that waits. */
  #move(spawn: () => WorkerLike): void {
    this.#seat?.leave();
    this.#seat = undefined;
    this.#spawn = spawn;
    this.#askAgain();
  }

  #start(call: Call<Request, Flat, Result, Stage>): void {
    this.#open.set(call.id, call.request);
    this.#post({ type: 'start', id: call.id, request: call.flat });
  }

  #abandon(call: Call<Request, Flat, Result, Stage>, reason: unknown): void {
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
    this.#seat ??= poolOf(this.#spawn).join({
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
        if (this.#call?.id === message.id) this.#call.onProgress?.(message.progress as Progress<Stage>);
        break;
      case 'preview':
        this.#show(message.id, this.unpack(message.result), true, this.#call?.id === message.id);
        break;
      case 'result':
        this.#deliver(message.id, this.unpack(message.result));
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

  #deliver(id: number, result: Result): void {
    const call = this.#take(id);
    this.#show(id, result, false, call !== undefined);
    this.#open.delete(id);
    call?.resolve(result);
  }

  #show(id: number, result: Result, isPreview: boolean, isCurrent: boolean): void {
    const request = this.#open.get(id);
    // A run that was cancelled in the moment it ended is nobody's: neither current nor superseded by a newer call.
    const superseded = !isCurrent && this.#call !== undefined;
    if ((!isCurrent && !superseded) || request === undefined || id < this.#shown) return;
    this.#shown = id;
    this.#options.onResult?.(result, { superseded, isPreview }, request);
  }

  /** The current call if it has this id; it is then closed. */
  #take(id: number): Call<Request, Flat, Result, Stage> | undefined {
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
      this.#fail(
        new RockFieldError({ name: 'WorkerLost', message: 'the generator stopped without an answer, twice; try smaller settings' }),
      );
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
    // The others may not be there at all.
    if (this.#spawn !== this.#first) this.#move(this.#first);
  }
}
