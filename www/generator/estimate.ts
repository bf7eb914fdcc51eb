/** How much longer a run takes, by the pace of its present stage. */

import type { Progress } from './protocol.ts';

/** Before a stage has run for so long and come so far, nothing can be told. */
const AFTER = { ms: 1000, fraction: 0.005 };

export class Estimate<Stage extends string> {
  #stage: Stage | undefined;
  #began = 0;
  /** Reports of the present stage; the first is the one that the pace is measured from. `fraction` is of the whole run, 0 … 1. */
  #reports: [ms: number, fraction: number][] = [];

  /**
   * Takes a report that came at `now`, ms, and gives it back with `secondsLeft`, once that can be told. The pace is that of the later half
   * of the stage's time so far: at its beginning the memory still grows and the engine still compiles.
   */
  added(progress: Progress<Stage>, now: number): Progress<Stage> {
    const { stage, fraction } = progress;
    if (stage !== this.#stage) [this.#stage, this.#began, this.#reports] = [stage, now, []];
    const reports = this.#reports;
    reports.push([now, fraction]);
    while (reports[1] && reports[1][0] <= (this.#began + now) / 2) reports.shift();
    const [[then, from]] = reports as [[number, number]];
    if (now - this.#began < AFTER.ms || fraction - from < AFTER.fraction) return progress;
    return { ...progress, secondsLeft: ((1 - fraction) * (now - then)) / (fraction - from) / 1000 };
  }
}
