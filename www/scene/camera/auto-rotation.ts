/** A slow turn round the field while nobody moves the camera. */

/** Once round in a minute. */
const RADIANS_PER_MS = (2 * Math.PI) / 60_000;
/** After a move of the user's. */
const PAUSE_MS = 3000;
/** A tab that was hidden goes on where it was. */
const LONGEST_STEP_MS = 100;

export class AutoRotation {
  /** How far it has turned since the camera was set, radians. */
  angle = 0;
  #last: number | undefined;
  #from = -Infinity;

  /** The user has the camera: not before a while. */
  pause(now: number): void {
    this.#from = now + PAUSE_MS;
  }

  /** No frame follows this one. */
  rest(): void {
    this.#last = undefined;
  }

  advance(now: number): void {
    const step = this.#last === undefined ? 0 : Math.min(LONGEST_STEP_MS, now - this.#last);
    this.#last = now;
    if (now >= this.#from) this.angle += step * RADIANS_PER_MS;
  }
}
