/** Long work in slices, between which others have their turn: a caller hears how far it is, and can say that it is no longer wanted. */

import { nextTask } from '../base/next-task.ts';

/** Of making the file or the scene of a field: the share of the work that is done when the field is there. */
export const GENERATED = 0.6;

/** After this much work others have their turn, ms. */
const SLICE_MS = 16;
/** So many small things are done before the time is looked at. */
const MANY = 1024;

/** Whoever waits for a file. */
export interface Waiting {
  /** Aborting rejects with the signal's reason. */
  signal?: AbortSignal | undefined;
  /** Called between slices with the share of the work that is done, 0 … 1. */
  onProgress?: ((fraction: number) => void) | undefined;
}

/** Called now and then by work of which `fraction` is done, 0 … 1, and awaited: others have their turn where it is time. */
export type Turn = (fraction: number) => Promise<void> | undefined;

export class Pace {
  #waiting: Waiting;
  #share: readonly [number, number];
  #begin = performance.now();

  /** @param share from which share of the work to which this one's goes. */
  constructor(waiting: Waiting = {}, share: readonly [number, number] = [0, 1]) {
    this.#waiting = waiting;
    this.#share = share;
  }

  /** That of a part of this one's work. */
  within(begin: number, end: number): Pace {
    return new Pace(this.#waiting, [this.#of(begin), this.#of(end)]);
  }

  #of(fraction: number): number {
    const [begin, end] = this.#share;
    return begin + fraction * (end - begin);
  }

  /** The turns of a part of the work, which is done from the share `begin` to `end` of the whole. */
  turns(begin: number, end: number): Turn {
    return (fraction) => (this.isDue() ? this.rest(begin + fraction * (end - begin)) : undefined);
  }

  /** Whether the slice is over: call `rest` then. */
  isDue(): boolean {
    return performance.now() - this.#begin >= SLICE_MS;
  }

  /** Does something with `count` small things, from `begin` to `end` of them at a time; all of it is this pace's work. */
  async each(count: number, work: (begin: number, end: number) => void): Promise<void> {
    for (let begin = 0; begin < count; begin += MANY) {
      const end = Math.min(begin + MANY, count);
      work(begin, end);
      if (this.isDue()) await this.rest(end / count);
    }
  }

  /**
   * Ends a slice.
   *
   * @param fraction how much of this work is done, 0 … 1.
   * @throws the signal's reason when it was aborted.
   */
  async rest(fraction: number): Promise<void> {
    this.#waiting.onProgress?.(this.#of(fraction));
    await nextTask();
    this.#waiting.signal?.throwIfAborted();
    this.#begin = performance.now();
  }
}
