/** Draws the samples of a still, each in parts that take a device about as long as a page may wait. */

import type { Stills } from '../renderer/renderer.ts';

/** The device is given as much at a time as takes it so long, ms. */
const PART_MS = 30;
/**
 * Where a piece of the picture takes longer alone it gets smaller, to the least, since every piece also costs the triangles that cross it; where all
 * takes less, more is given. Pixels.
 */
const [FIRST_PIECE, LEAST_PIECE, LARGEST_PIECE] = [24_576, 16_384, 262_144];
const MOST_PARTS = 64;

export interface Sampled {
  stills: Stills;
  /** Readies the renderer: what else is drawn with it may come between parts. */
  prepare(): void;
  /** Whether nobody wants the still any more; it may throw. */
  isOver(): boolean;
}

export class Samples {
  readonly #still: Sampled;
  /** Of a piece of the picture. */
  #pixels = FIRST_PIECE;
  /** How many parts are given at a time. */
  #parts = 1;
  /** How long all samples took, ms, but for what is made for the first. */
  spent = 0;

  constructor(still: Sampled) {
    this.#still = still;
  }

  /** Makes what samples need, in tasks of their own; when the device is done with that a still can begin. False when it is over. */
  async ready(): Promise<boolean> {
    const { stills, prepare, isOver } = this.#still;
    for (;;) {
      if (isOver()) return false;
      prepare();
      if (!stills.make()) break;
      await new Promise((resolve) => setTimeout(resolve));
    }
    await stills.done();
    return !isOver();
  }

  /** Draws one more sample of the still that is begun. False when it is over. */
  async draw(): Promise<boolean> {
    const { stills, prepare, isOver } = this.#still;
    for (let goesOn = true; goesOn; ) {
      const start = performance.now();
      prepare();
      for (let part = 0; goesOn && part < this.#parts; part += 1) goesOn = stills.draw(this.#pixels);
      await stills.done();
      if (isOver()) return false;
      const ms = performance.now() - start;
      this.spent += ms;
      this.#took(ms);
    }
    return true;
  }

  #took(ms: number): void {
    if (ms < PART_MS / 2 && this.#pixels < LARGEST_PIECE) this.#pixels *= 2;
    else if (ms < PART_MS / 2) this.#parts = Math.min(MOST_PARTS, 2 * this.#parts);
    else if (ms > 1.5 * PART_MS && this.#parts > 1) this.#parts >>= 1;
    else if (ms > 1.5 * PART_MS) this.#pixels = Math.max(LEAST_PIECE, this.#pixels >> 1);
  }
}
