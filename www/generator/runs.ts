/** The runs of one element: the latest wins, and whoever waits for a result gets that of the newest parameters. */

import { errorInfo, isAbort, notConnected } from '../base/errors.ts';
import type { ErrorInfo } from '../base/errors.ts';
import type { Progress } from './protocol.ts';

/** How a result came about: `superseded`, a newer one is on its way; a preview is followed by the same with all its stages. */
export interface Arrival {
  superseded: boolean;
  isPreview: boolean;
}

export type OnResult<Request, Result> = (result: Result, arrival: Arrival, request: Request) => void;

/** Whoever generates, wherever. */
export interface RunClient<Request, Result, Stage extends string> {
  readonly busy: boolean;
  generate(request: Request, options: { onProgress: (progress: Progress<Stage>) => void }): Promise<Result>;
  freshSeed(): Promise<number>;
  cancel(): void;
  dispose(): void;
}

export interface RunsHost<Request, Result, Stage extends string> {
  onResult: OnResult<Request, Result>;
  /** Of a run that takes longer; null when there is none. */
  onProgress(progress: Progress<Stage> | null): void;
  /** A run of `request` failed, and not because a newer one took its place. */
  onError(error: ErrorInfo, request: Request): void;
}

export class Runs<Request, Result, Stage extends string> {
  /** What is shown, or on its way, is not what the parameters say. */
  stale = true;

  #host: RunsHost<Request, Result, Stage>;
  #newClient: (options: { onResult: OnResult<Request, Result> }) => RunClient<Request, Result, Stage>;
  #isOpen = false;
  #client: RunClient<Request, Result, Stage> | undefined;
  /** The newest run; settles with its result. */
  #run: Promise<Result> | undefined;
  #givenUp: Promise<Result> | undefined;
  /** Runs of parameters that are not taken yet: their failure is nobody's but the caller's. */
  readonly #attempts = new WeakSet<Promise<Result>>();

  constructor(
    host: RunsHost<Request, Result, Stage>,
    newClient: (options: { onResult: OnResult<Request, Result> }) => RunClient<Request, Result, Stage>,
  ) {
    this.#host = host;
    this.#newClient = newClient;
  }

  get isOpen(): boolean {
    return this.#isOpen;
  }

  /** Nothing is under way, nor has to be. */
  get isSettled(): boolean {
    return !this.stale && !this.#client?.busy;
  }

  open(): void {
    this.#isOpen = true;
  }

  /** Gives everything up; what was under way is stale. */
  close(): void {
    this.#isOpen = false;
    if (this.#client?.busy) this.stale = true;
    this.#client?.dispose();
    this.#client = undefined;
    this.#run = undefined;
  }

  /** Resolves with the result; rejects with an AbortError when a newer run supersedes it, else with a RockFieldError. */
  start(request: Request): Promise<Result> {
    if (!this.#isOpen) return Promise.reject(notConnected());
    this.stale = false;
    const run = this.#generator().generate(request, { onProgress: (progress) => this.#host.onProgress(progress) });
    this.#run = run;
    run.then(
      () => this.#ended(run),
      (thrown: unknown) => {
        this.#ended(run);
        if (!isAbort(thrown)) this.#host.onError(errorInfo(thrown), request);
      },
    );
    return run;
  }

  /**
   * A run of parameters that are taken only when they have given a result. Its errors are the caller's alone, and leave things as they
   * were: what was under way before is stale, so that it is begun again.
   */
  async attempt(request: Request): Promise<Result> {
    if (!this.#isOpen) throw notConnected();
    const before = this.isSettled ? this.#run : undefined;
    const wasStale = !this.isSettled;
    this.stale = false;
    const run = this.#generator().generate(request, { onProgress: (progress) => this.#host.onProgress(progress) });
    this.#attempts.add(run);
    this.#run = run;
    try {
      return await run;
    } catch (thrown) {
      if (this.#run === run) {
        this.#run = before;
        this.stale ||= wasStale;
        this.#host.onProgress(null);
      }
      throw thrown;
    } finally {
      this.#ended(run);
    }
  }

  #ended(run: Promise<Result>): void {
    if (this.#run === run) this.#host.onProgress(null);
  }

  /** Ends the run that is under way, since something else is wanted; what is shown stays. */
  cancel(): void {
    this.stale = false;
    this.#client?.cancel();
  }

  /** Ends it because nobody wants it any more: who waits for its result is told so by an AbortError. */
  giveUp(): void {
    this.#givenUp = this.#run;
    this.cancel();
  }

  /** What is wanted is `result` again, which is shown. */
  settle(result: Result): void {
    this.stale = false;
    this.#run = Promise.resolve(result);
  }

  async freshSeed(): Promise<number> {
    if (!this.#isOpen) throw notConnected();
    return this.#generator().freshSeed();
  }

  /**
   * The result of the present parameters, as soon as it is finished; of newer ones where they change meanwhile. `look` marks what has
   * changed as stale, `begin` starts a run.
   */
  async newest(look: () => void, begin: () => Promise<Result>): Promise<Result> {
    for (;;) {
      look();
      const run = this.stale || !this.#run ? begin() : this.#run;
      try {
        return await run;
      } catch (thrown) {
        const isSuperseded = (isAbort(thrown) || this.#attempts.has(run)) && (this.stale || this.#run !== run);
        if (!isSuperseded || run === this.#givenUp) throw thrown;
      }
    }
  }

  #generator(): RunClient<Request, Result, Stage> {
    this.#client ??= this.#newClient({ onResult: this.#host.onResult });
    return this.#client;
  }
}
