/**
 * How well natural colours are drawn where nobody says: as well as motion flows, and stills at their best.
 *
 * Nothing here draws or has a clock. What a GPU spends on a frame cannot be asked from JavaScript; but a browser gives out no new frame
 * while too many are under way, so the time between frames tells when there is too much to do. It never tells how much less there could be.
 */

import { QUALITIES } from '../base/view.ts';
import type { Quality } from '../base/view.ts';

const BEST = QUALITIES.length - 1;
/** Before anything is known of the device. */
const FIRST = QUALITIES.indexOf('medium');

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

/** A still that takes longer is a page that hangs. Twice in a row, since with the first of a level its pipelines are made. */
const SLOW_STILL_MS = 1200;
const SLOW_STILLS = 2;

interface Trial {
  /** Not before this. */
  retryAt: number;
  wait: number;
}

export class AutoQuality {
  #moving = FIRST;
  #still = BEST;
  /** When the frame before was presented; undefined at the beginning of a motion, or of a level. */
  #last: number | undefined;
  /** The newest ones at this level, ms. */
  #intervals: number[] = [];
  /** When the first frame of this level was presented. */
  #since: number | undefined;
  #trials = QUALITIES.map((): Trial => ({ retryAt: -Infinity, wait: FIRST_WAIT_MS }));
  #slowStills = 0;

  /** Of a frame that others follow. */
  get moving(): Quality {
    return QUALITIES[this.#moving] ?? 'high';
  }

  /** Of the one frame that stays; never worse than what was in motion. */
  get still(): Quality {
    return QUALITIES[Math.max(this.#moving, this.#still)] ?? 'high';
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

  /** The still was on the screen after so many ms. */
  stillTook(ms: number): void {
    this.#slowStills = ms > SLOW_STILL_MS ? this.#slowStills + 1 : 0;
    if (this.#slowStills < SLOW_STILLS || this.#still === 0) return;
    this.#still -= 1;
    this.#slowStills = 0;
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
