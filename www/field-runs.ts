/** The runs of one element: the latest wins, and whoever waits for a field gets that of the newest parameters. */

import { errorInfo, isAbort, RockFieldError } from './errors.ts';
import type { ErrorInfo } from './errors.ts';
import type { Field } from './field.ts';
import { GeneratorClient } from './generator/client.ts';
import type { ClientOptions } from './generator/client.ts';
import type { Progress } from './generator/protocol.ts';
import type { Params } from './params.ts';

export interface RunsHost {
  /** Every finished field; see `ClientOptions`. */
  onField: NonNullable<ClientOptions['onField']>;
  /** Of a run that takes longer; null when there is none. */
  onProgress(progress: Progress | null): void;
  /** A run failed, and not because a newer one took its place. */
  onError(error: ErrorInfo): void;
}

export class FieldRuns {
  /** What is shown, or on its way, is not what the parameters say. */
  stale = true;

  #host: RunsHost;
  #isOpen = false;
  #client: GeneratorClient | undefined;
  /** The newest run; settles with its field. */
  #run: Promise<Field> | undefined;

  constructor(host: RunsHost) {
    this.#host = host;
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

  /** Resolves with the field; rejects with an AbortError when a newer run supersedes it, else with a RockFieldError. */
  start(params: Params): Promise<Field> {
    if (!this.#isOpen) return Promise.reject(notConnected());
    this.stale = false;
    const run = this.#generator().generate(params, { onProgress: (progress) => this.#host.onProgress(progress) });
    this.#run = run;
    run.then(
      () => this.#ended(run),
      (thrown: unknown) => {
        this.#ended(run);
        if (!isAbort(thrown)) this.#host.onError(errorInfo(thrown));
      },
    );
    return run;
  }

  #ended(run: Promise<Field>): void {
    if (this.#run === run) this.#host.onProgress(null);
  }

  /** Gives the running run up; what is shown stays. */
  cancel(): void {
    this.stale = false;
    this.#client?.cancel();
  }

  async freshSeed(): Promise<number> {
    if (!this.#isOpen) throw notConnected();
    return this.#generator().freshSeed();
  }

  /**
   * The field of the present parameters, as soon as it is finished; of newer ones where they change meanwhile. `look` marks what has
   * changed as stale, `begin` starts a run.
   */
  async newest(look: () => void, begin: () => Promise<Field>): Promise<Field> {
    for (;;) {
      look();
      const run = this.stale || !this.#run ? begin() : this.#run;
      try {
        return await run;
      } catch (thrown) {
        const isSuperseded = isAbort(thrown) && (this.stale || this.#run !== run);
        if (!isSuperseded) throw thrown;
      }
    }
  }

  #generator(): GeneratorClient {
    this.#client ??= new GeneratorClient({ onField: this.#host.onField });
    return this.#client;
  }
}

function notConnected(): RockFieldError {
  return new RockFieldError({ name: 'NotConnected', message: 'put the element into the document first' });
}
