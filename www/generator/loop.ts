/**
 * The worker's side of the protocol for one client: which run goes on, which is dropped, what is answered.
 *
 * The newest request wins, but a run that has begun is left alone for a while. Otherwise a drag that sends a request every
 * 16 ms would drop every run before its end and show nothing until the hand rests. The patience doubles with each run that is
 * dropped, so that whatever a field costs, some run of a drag ends; it falls back to its first value when one has ended.
 * A cancelled run has no such protection.
 */

import { abortError, errorInfo, isCoded } from '../errors.ts';
import { buffersOf, fieldSession } from './field-session.ts';
import type { FieldSession } from './field-session.ts';
import type { FromLoop, Progress, StartMessage, ToLoop } from './protocol.ts';
import type { GeneratorModule } from './wasm.ts';

/** A superseded run younger than this may end: at 150 ms a drag still feels answered. Chosen by eye. */
export const PATIENCE_MS = 150;

/** Runs shorter than this need no progress bar. */
export const PROGRESS_AFTER_MS = 200;

/** Between two reports of one run. */
const PROGRESS_EVERY_MS = 50;

interface Run {
  id: number;
  begin: number;
  reported: number;
  controller: AbortController;
}

export class RunLoop {
  #post: (message: FromLoop, transfer?: Transferable[]) => void;
  #module: Promise<GeneratorModule>;
  #session: FieldSession | undefined;
  #running: Run | undefined;
  #next: StartMessage | undefined;
  #patience = PATIENCE_MS;
  #closed = false;

  constructor(module: Promise<GeneratorModule>, post: (message: FromLoop, transfer?: Transferable[]) => void) {
    this.#module = module;
    this.#post = post;
  }

  receive(message: ToLoop): void {
    switch (message.type) {
      case 'start':
        if (this.#next) this.#post({ type: 'dropped', id: this.#next.id });
        this.#next = message;
        if (this.#running) this.#losePatience(this.#running);
        else void this.#work();
        break;
      case 'cancel':
        if (this.#next?.id === message.id) {
          this.#next = undefined;
          this.#post({ type: 'dropped', id: message.id });
        }
        if (this.#running?.id === message.id) this.#running.controller.abort(abortError('cancelled'));
        break;
      case 'seed':
        this.#module.then(
          (module) => this.#drawSeed(module, message.id),
          () => undefined, // 'failed' has been sent
        );
        break;
      default:
        message satisfies never;
    }
  }

  /** Gives everything up and frees the cache; a run under way keeps it until its slice is over. */
  close(): void {
    this.#closed = true;
    this.#next = undefined;
    if (this.#running) this.#running.controller.abort(abortError('closed'));
    else this.#session?.free();
  }

  /** Runs what is next until nothing is. */
  async #work(): Promise<void> {
    while (this.#next) {
      const { id, request } = this.#next;
      this.#next = undefined;
      const run: Run = { id, begin: performance.now(), reported: 0, controller: new AbortController() };
      this.#running = run;
      try {
        const module = await this.#module;
        this.#session ??= fieldSession(new module.Generator());
        // The time the wasm took to load is not the run's fault.
        run.begin = performance.now();
        const field = await this.#session.run(request, {
          signal: run.controller.signal,
          onProgress: (progress) => {
            this.#report(run, progress);
            if (this.#next) this.#losePatience(run);
          },
        });
        this.#patience = PATIENCE_MS;
        this.#post({ type: 'field', id, field }, buffersOf(field));
      } catch (thrown) {
        this.#answerFailure(run, thrown);
      } finally {
        this.#running = undefined;
      }
    }
    if (this.#closed) this.#session?.free();
  }

  #losePatience(run: Run): void {
    if (performance.now() - run.begin < this.#patience || run.controller.signal.aborted) return;
    this.#patience *= 2;
    run.controller.abort(abortError('superseded'));
  }

  #report(run: Run, progress: Progress): void {
    const now = performance.now();
    if (now - run.begin < PROGRESS_AFTER_MS || now - run.reported < PROGRESS_EVERY_MS) return;
    run.reported = now;
    this.#post({ type: 'progress', id: run.id, progress });
  }

  #drawSeed(module: GeneratorModule, id: number): void {
    try {
      this.#post({ type: 'seed', id, seed: module.fresh_seed() });
    } catch (thrown) {
      this.#post({ type: 'crashed', id, error: errorInfo(thrown) });
    }
  }

  #answerFailure({ id, controller }: Run, thrown: unknown): void {
    if (thrown === controller.signal.reason) this.#post({ type: 'dropped', id });
    else if (isCoded(thrown) && !this.#session?.broken) this.#post({ type: 'rejected', id, error: errorInfo(thrown) });
    else this.#post({ type: 'crashed', id, error: errorInfo(thrown) });
  }
}
