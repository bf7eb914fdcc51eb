/**
 * How well natural colours are drawn in motion where nobody says: as well as it flows.
 *
 * Nothing here draws or has a clock. What a GPU spends on a frame cannot be asked from JavaScript; but a browser gives out no new frame
 * while too many are under way, so the time between frames tells when there is too much to do. It never tells how much less there could be.
 */

import { QUALITIES } from '../base/view.ts';
import type { Quality } from '../base/view.ts';

/** A median of so many intervals above this is a motion that does not flow. */
const SLOW_MS = 25;
const SLOW_FRAMES = 7;
/** So many in a row below this, but for a few, may be worth a better level. A screen of 60 Hz gives 16.7 ms at best, with some jitter. */
const FAST_MS = 18.5;
const FAST_FRAMES = 40;
const MOST_LATE = 2;

/** A level that did not flow is not tried again for so long, and twice as long each time it fails once more. */
const FIRST_WAIT_MS = 4000;
const LONGEST_WAIT_MS = 120_000;

interface Trial {
  /** Not before this. */
  retryAt: number;
  wait: number;
}

export class AutoQuality {
  #moving: number;
  /** When the frame before was presented; undefined at the beginning of a motion, or of a level. */
  #last: number | undefined;
  /** The newest ones at this level, ms. */
  #intervals: number[] = [];
  /** When the first frame of this level was presented. */
  #since: number | undefined;
  #trials = QUALITIES.map((): Trial => ({ retryAt: -Infinity, wait: FIRST_WAIT_MS }));

  /** @param level the first. */
  constructor(level: Quality = 'medium') {
    this.#moving = QUALITIES.indexOf(level);
  }

  /** Of a frame that others follow. */
  get moving(): Quality {
    return QUALITIES[this.#moving] ?? 'high';
  }

  /** A frame of a motion is presented at `now`. */
  frame(now: number): void {
    if (this.#last !== undefined) this.#intervals = [...this.#intervals.slice(1 - FAST_FRAMES), now - this.#last];
    this.#last = now;
    this.#since ??= now;
    if (this.#isSlow()) this.#fall(now);
    else if (this.#isFast(now)) this.#change(this.#moving + 1);
  }

  /** No frame follows: what comes next is another motion. What was seen of this one still counts. */
  rest(): void {
    this.#last = undefined;
  }

  #isSlow(): boolean {
    const newest = this.#intervals.slice(-SLOW_FRAMES).sort((a, b) => a - b);
    return newest.length === SLOW_FRAMES && (newest[SLOW_FRAMES >> 1] ?? 0) > SLOW_MS && this.#moving > 0;
  }

  #isFast(now: number): boolean {
    const next = this.#trials[this.#moving + 1];
    if (!next || now < next.retryAt || this.#intervals.length < FAST_FRAMES) return false;
    return this.#intervals.filter((ms) => ms > FAST_MS).length <= MOST_LATE;
  }

  #fall(now: number): void {
    const trial = this.#trials[this.#moving];
    if (trial) {
      // One that flowed for long failed for another reason than its own.
      const wait = now - (this.#since ?? now) > trial.wait ? FIRST_WAIT_MS : trial.wait;
      trial.retryAt = now + wait;
      trial.wait = Math.min(LONGEST_WAIT_MS, 2 * wait);
    }
    this.#change(this.#moving - 1);
  }

  /** The next step takes evidence of the new level alone; its first frame also makes what the level needs. */
  #change(level: number): void {
    this.#moving = level;
    this.#since = undefined;
    this.#intervals = [];
    this.#last = undefined;
  }
}
