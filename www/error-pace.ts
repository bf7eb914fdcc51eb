/** Tells errors no faster than anyone can read them: whatever fails, and however often, there is at most one a second. */

import type { ErrorInfo } from './errors.ts';

const PACE_MS = 1000;

export class ErrorPace {
  readonly #tell: (error: ErrorInfo) => void;
  /** What is still to be told. Of several that say the same of the same, the last. */
  readonly #waiting = new Map<string, ErrorInfo>();
  #timer: ReturnType<typeof setTimeout> | undefined;

  constructor(tell: (error: ErrorInfo) => void) {
    this.#tell = tell;
  }

  push(error: ErrorInfo): void {
    this.#waiting.set(`${error.name} ${error.key} ${error.layer}`, error);
    if (this.#timer === undefined) this.#next();
  }

  #next(): void {
    const [first] = this.#waiting;
    this.#timer = first && setTimeout(() => this.#next(), PACE_MS);
    if (!first) return;
    this.#waiting.delete(first[0]);
    this.#tell(first[1]);
  }
}
