/** Long work in slices, between which others have their turn: a caller hears how far it is, and can say that it is no longer wanted. */

import { nextTask } from '../base/next-task.ts';

/** After this much work others have their turn, ms. */
const SLICE_MS = 16;

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
  #begin = performance.now();

  constructor(waiting: Waiting = {}) {
    this.#waiting = waiting;
  }

  /** The turns of a part of the work, which is done from the share `begin` to `end` of the whole. */
  turns(begin: number, end: number): Turn {
    return (fraction) => (this.isDue() ? this.rest(begin + fraction * (end - begin)) : undefined);
  }

  /** Whether the slice is over: call `rest` then. */
  isDue(): boolean {
    return performance.now() - this.#begin >= SLICE_MS;
  }

  /**
   * Ends a slice.
   *
   * @param fraction how much of the work is done, 0 … 1.
   * @throws the signal's reason when it was aborted.
   */
  async rest(fraction: number): Promise<void> {
    this.#waiting.onProgress?.(fraction);
    await nextTask();
    this.#waiting.signal?.throwIfAborted();
    this.#begin = performance.now();
  }
}
