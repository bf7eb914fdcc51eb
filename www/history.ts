/** Undo and redo: a list of states, where a whole gesture is one step. */

/** Keyboard edits of one control closer together than this are one step: a held arrow key repeats every 30 ms or so. */
const MERGE_MS = 700;
/** Steps kept. A state shares what it did not change, so this is a few hundred kB at most. */
const MAX_STEPS = 300;

export class History<T> {
  #past: T[] = [];
  #future: T[] = [];
  #present: T;
  #label = '';
  #at = 0;
  #held = false;
  #atHold: { past: T[]; future: T[]; present: T } | undefined;

  constructor(initial: T) {
    this.#present = initial;
  }

  get present(): T {
    return this.#present;
  }

  get canUndo(): boolean {
    return this.#past.length > 0;
  }

  get canRedo(): boolean {
    return this.#future.length > 0;
  }

  /**
   * Makes `next` the present. Edits with the same `label` are one step while `hold` is on, or when they follow each other closely;
   * without a label every edit is a step of its own. `now` in ms.
   */
  record(next: T, label = '', now = 0): void {
    const continues = label !== '' && label === this.#label && (this.#held || now - this.#at <= MERGE_MS);
    if (!continues) {
      this.#past.push(this.#present);
      if (this.#past.length > MAX_STEPS) this.#past.shift();
    }
    this.#present = next;
    this.#future = [];
    this.#label = label;
    this.#at = now;
  }

  /** A pointer went down: until `release`, edits with one label are one step, however slow. */
  hold(): void {
    this.#label = '';
    this.#held = true;
    this.#atHold = { past: [...this.#past], future: this.#future, present: this.#present };
  }

  release(): void {
    this.#label = '';
    this.#held = false;
  }

  /** Lets go of what is held as if nothing had happened since. False where nothing has. */
  abandon(): boolean {
    const before = this.#held ? this.#atHold : undefined;
    this.release();
    if (!before || before.present === this.#present) return false;
    this.#past = before.past;
    this.#future = before.future;
    this.#present = before.present;
    return true;
  }

  undo(): boolean {
    return this.#step(this.#past, this.#future);
  }

  redo(): boolean {
    return this.#step(this.#future, this.#past);
  }

  #step(from: T[], to: T[]): boolean {
    const state = from.pop();
    if (state === undefined) return false;
    to.push(this.#present);
    this.#present = state;
    this.#label = '';
    return true;
  }
}
