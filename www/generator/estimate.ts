/** How much longer a run takes, by the pace of its present stage. */

import type { Progress } from './protocol.ts';

/** Before a stage has run for so long and come so far, nothing can be told. */
const AFTER = { ms: 500, fraction: 0.005 };

export class Estimate<Stage extends string> {
  #stage: Stage | undefined;
  #began = 0;
  /** When the stage had come how far, from the report on that the pace is measured from. */
  #reports: [ms: number, fraction: number][] = [];

  /**
   * The report with the seconds left, once they can be told. The pace is that of the later half of the stage's time: at its beginning a
   * memory grows, and code is still compiled.
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
