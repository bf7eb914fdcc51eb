/** Drives one generator of the wasm: slices, time per stage, abort, and the buffers as what they are called here. In the worker and in Node. */

import { errorInfo, isCoded, RockFieldError } from '../base/errors.ts';
import { nextTask } from '../base/next-task.ts';
import { Estimate } from './estimate.ts';
import type { Progress } from './protocol.ts';

/** The steps of a generator of the wasm. */
export interface RawSteps {
  step(): boolean;
  stage(): number;
  progress(): number;
  /** The buffers are those of this run, before its last stages. */
  preview_ready?(): boolean;
  free(): void;
}

/** What is generated: how a run begins, and what is copied out after it. One for each session: it may keep something between runs. */
export interface Craft<Raw extends RawSteps, Flat, Result, Stage extends string> {
  /** In the order of the numbers that `stage()` gives. */
  stages: readonly Stage[];
  start(raw: Raw, request: Flat): void;
  /** `isPreview`: the run goes on. */
  collect(raw: Raw, request: Flat, ms: Times<Stage>, isPreview: boolean): Result;
}

/** Milliseconds per stage that actually ran, and from the request to the buffers in JavaScript. */
export type Times<Stage extends string> = Record<Stage | 'total', number>;

export interface RunOptions<Result, Stage extends string> {
  signal?: AbortSignal | undefined;
  /** Called between slices. */
  onProgress?: ((progress: Progress<Stage>) => void) | undefined;
  /** Called once, when there is something to show and the run goes on. */
  onPreview?: ((result: Result) => void) | undefined;
}

/** After this much work the queue is read. A step takes 1–3 ms, on a slow phone 10: a slice stays under 30 ms. */
export const SLICE_MS = 16;

export class Session<Raw extends RawSteps, Flat, Result, Stage extends string> {
  #generator: Raw;
  #craft: Craft<Raw, Flat, Result, Stage>;
  #running = false;
  #broken = false;

  constructor(generator: Raw, craft: Craft<Raw, Flat, Result, Stage>) {
    this.#generator = generator;
    this.#craft = craft;
  }

  /** The wasm trapped: the instance behind this session, memory included, must not be used again. */
  get broken(): boolean {
    return this.#broken;
  }

  /**
   * One run, from the first stage that is not in the cache. Aborting it keeps the stages it finished.
   *
   * @throws {RockFieldError} for a request that cannot be met (nothing has changed) or, with name `Internal`, after a trap.
   * @throws the signal's reason when it was aborted.
   */
  async run(request: Flat, { signal, onProgress, onPreview }: RunOptions<Result, Stage> = {}): Promise<Result> {
    if (this.#broken) throw new RockFieldError({ name: 'Internal', message: 'the generator failed before and was discarded' });
    if (this.#running) throw new RockFieldError({ name: 'Internal', message: 'the session is running already' });
    signal?.throwIfAborted();
    this.#running = true;
    try {
      const begin = performance.now();
      const { stages } = this.#craft;
      const ms = Object.fromEntries([...stages, 'total'].map((name) => [name, 0])) as Times<Stage>;
      let wantsPreview = onPreview !== undefined;
      const estimate = new Estimate<Stage>();
      this.#guard(() => this.#craft.start(this.#generator, request));
      while (!this.#guard(() => runSlice(this.#generator, stages, ms, wantsPreview))) {
        if (wantsPreview && this.#guard(() => this.#generator.preview_ready?.())) {
          wantsPreview = false;
          onPreview?.(this.#collect(request, ms, begin, true));
        }
        onProgress?.(
          estimate.added(
            this.#guard(() => progressOf(this.#generator, stages)),
            performance.now(),
          ),
        );
        await nextTask();
        signal?.throwIfAborted();
      }
      return this.#collect(request, ms, begin, false);
    } finally {
      this.#running = false;
    }
  }

  #collect(request: Flat, ms: Times<Stage>, begin: number, isPreview: boolean): Result {
    const times = { ...ms };
    const result = this.#guard(() => this.#craft.collect(this.#generator, request, times, isPreview));
    times.total = performance.now() - begin;
    return result;
  }

  free(): void {
    // A trapped instance is left to the garbage collector: its memory may be in any state.
    if (!this.#broken) this.#generator.free();
    this.#broken = true;
  }

  /** Everything that reaches into the wasm goes through here: an error without a code of ours is a trap. */
  #guard<T>(call: () => T): T {
    try {
      return call();
    } catch (thrown) {
      if (!isCoded(thrown)) this.#broken = true;
      throw new RockFieldError(errorInfo(thrown), { cause: thrown });
    }
  }
}

/** Steps until the run is finished (true), the slice is over or a preview that is wanted is ready; adds the time to the stages. */
function runSlice<Stage extends string>(generator: RawSteps, stages: readonly Stage[], ms: Times<Stage>, wantsPreview: boolean): boolean {
  const begin = performance.now();
  let before = begin;
  for (;;) {
    const stage = stageOf(generator, stages);
    const done = generator.step();
    const now = performance.now();
    ms[stage] += now - before;
    before = now;
    if (done) return true;
    if (now - begin >= SLICE_MS || (wantsPreview && generator.preview_ready?.())) return false;
  }
}

/** The last, when the number is none of a stage's: the run is about to end. */
function stageOf<Stage extends string>(generator: RawSteps, stages: readonly Stage[]): Stage {
  return stages[generator.stage()] ?? stages[stages.length - 1]!;
}

function progressOf<Stage extends string>(generator: RawSteps, stages: readonly Stage[]): Progress<Stage> {
  return { stage: stageOf(generator, stages), fraction: generator.progress() };
}
