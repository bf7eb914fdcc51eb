/**
 * The worker's side of the protocol for one client: which run goes on, which is dropped, what is answered.
 *
 * The newest request wins, but a run that has begun is left alone for a while. Otherwise a drag that sends a request every
 * 16 ms would drop every run before its end and show nothing until the hand rests. The patience doubles with each run that is
 * dropped, so that whatever a result costs, some run of a drag ends; it falls back to its first value when one has ended.
 * A run whose preview has been shown is superseded at once: what follows is nobody's any more. A cancelled run has no protection either.
 */

import { abortError, errorInfo, isCoded } from '../base/errors.ts';
import type { FromLoop, Progress, StartMessage, ToLoop } from './protocol.ts';
import type { RunOptions } from './session.ts';

/** A superseded run younger than this may end: at 150 ms a drag still feels answered. Chosen by eye. */
export const PATIENCE_MS = 150;

/** Runs shorter than this need no progress bar. */
export const PROGRESS_AFTER_MS = 200;

/** Between two reports of one run. */
const PROGRESS_EVERY_MS = 50;

/** A session, as far as it is used here. */
interface Runs<Flat, Result, Stage extends string> {
  readonly broken: boolean;
  run(request: Flat, options: RunOptions<Result, Stage>): Promise<Result>;
  free(): void;
}

/** What is generated, and how it crosses to the page. One for each loop: it may keep something between messages. */
export interface LoopCraft<Module, Flat, Result, Stage extends string> {
  open(module: Module): Runs<Flat, Result, Stage>;
  pack(result: Result): { result: unknown; transfer: Transferable[] };
}

interface Run {
  id: number;
  begin: number;
  reported: number;
  isShown: boolean;
  controller: AbortController;
}

export class RunLoop<Module extends { fresh_seed(): number }, Flat, Result, Stage extends string> {
  #post: (message: FromLoop, transfer?: Transferable[]) => void;
  #module: Promise<Module>;
  #craft: LoopCraft<Module, Flat, Result, Stage>;
  #session: Runs<Flat, Result, Stage> | undefined;
  #running: Run | undefined;
  #next: StartMessage<Flat> | undefined;
  #patience = PATIENCE_MS;
  #closed = false;

  constructor(
    module: Promise<Module>,
    craft: LoopCraft<Module, Flat, Result, Stage>,
    post: (message: FromLoop, transfer?: Transferable[]) => void,
  ) {
    this.#module = module;
    this.#craft = craft;
    this.#post = post;
  }

  receive(message: ToLoop<Flat>): void {
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
      const run: Run = { id, begin: performance.now(), reported: 0, isShown: false, controller: new AbortController() };
      this.#running = run;
      try {
        const module = await this.#module;
        this.#session ??= this.#craft.open(module);
        // The time the wasm took to load is not the run's fault.
        run.begin = performance.now();
        const result = await this.#session.run(request, {
          signal: run.controller.signal,
          onPreview: (preview) => {
            run.isShown = true;
            this.#give('preview', id, preview);
            if (this.#next) this.#losePatience(run);
          },
          onProgress: (progress) => {
            this.#report(run, progress);
            if (this.#next) this.#losePatience(run);
          },
        });
        this.#patience = PATIENCE_MS;
        this.#give('result', id, result);
      } catch (thrown) {
        this.#answerFailure(run, thrown);
      } finally {
        this.#running = undefined;
      }
    }
    if (this.#closed) this.#session?.free();
  }

  #give(type: 'preview' | 'result', id: number, made: Result): void {
    const { result, transfer } = this.#craft.pack(made);
    this.#post({ type, id, result }, transfer);
  }

  #losePatience(run: Run): void {
    if (run.controller.signal.aborted) return;
    if (!run.isShown) {
      if (performance.now() - run.begin < this.#patience) return;
      this.#patience *= 2;
    }
    run.controller.abort(abortError('superseded'));
  }

  #report(run: Run, progress: Progress<Stage>): void {
    const now = performance.now();
    if (now - run.begin < PROGRESS_AFTER_MS || now - run.reported < PROGRESS_EVERY_MS) return;
    run.reported = now;
    this.#post({ type: 'progress', id: run.id, progress });
  }

  #drawSeed(module: Module, id: number): void {
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
