/** Tells errors no faster than anyone can read them: whatever fails, and however often, there is at most one a second. */

import type { ErrorInfo } from './errors.ts';

const PACE_MS = 1000;

/** What an `error` event tells. `shown` is true if the element's own message said the error when it happened. */
export interface ErrorDetail {
  error: ErrorInfo;
  shown: boolean;
}

export class ErrorPace {
  readonly #tell: (detail: ErrorDetail) => void;
  /** What is still to be told. Of several that say the same of the same, the last. */
  readonly #waiting = new Map<string, ErrorDetail>();
  #timer: ReturnType<typeof setTimeout> | undefined;

  constructor(tell: (detail: ErrorDetail) => void) {
    this.#tell = tell;
  }

  push(detail: ErrorDetail): void {
    const { name, key, layer } = detail.error;
    this.#waiting.set(`${name} ${key} ${layer}`, detail);
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
