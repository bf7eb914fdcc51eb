/** How much longer a run takes, by how far its present stage has come in the time it has had. */

import type { Progress } from './protocol.ts';

/** Before a stage has run for so long and come so far, nothing can be told. */
const AFTER = { ms: 500, fraction: 0.005 };

export class Estimate<Stage extends string> {
  #stage: Stage | undefined;
  #began = 0;
  #from = 0;

  /** The report with the seconds left, once they can be told. */
  added(progress: Progress<Stage>, now: number): Progress<Stage> {
    const { stage, fraction } = progress;
    if (stage !== this.#stage) [this.#stage, this.#began, this.#from] = [stage, now, fraction];
    const [ms, share] = [now - this.#began, fraction - this.#from];
    if (ms < AFTER.ms || share < AFTER.fraction) return progress;
    return { ...progress, secondsLeft: ((1 - fraction) * ms) / share / 1000 };
  }
}
