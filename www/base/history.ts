/** Undo and redo: a list of states, where a whole gesture is one step. It also knows which of them a run has confirmed. */

/** Keyboard edits of one control closer together than this are one step: a held arrow key repeats every 30 ms or so. */
const MERGE_MS = 700;
/** Steps kept. A state shares what it did not change, so this is a few hundred kB at most. */
const MAX_STEPS = 300;
/** Unconfirmed states kept: a drag makes some 60 a second, and a run of it ends within a few seconds. */
const MAX_OPEN = 200;

/** The label of edits by code. */
export const CODE = 'edit';

/** The whole of a history at one moment. */
interface Moment<T> {
  readonly past: readonly T[];
  readonly present: T;
  readonly future: readonly T[];
  /** Equal for the moments of one edit, which is refused as a whole. A step may have several edits. */
  readonly edit: object;
}

export class History<T> {
  #now: Moment<T>;
  #label = '';
  #at = 0;
  /** How it was when a pointer went down; undefined while none is. */
  #atHold: Moment<T> | undefined;
  /** The newest moment whose present was confirmed. */
  #settled: Moment<T> | undefined;
  #isBack = false;
  /** A run of the present has begun. */
  #hasBegun = false;
  /** The moments since, oldest first: each of these may still be refused. */
  #open: Moment<T>[];

  constructor(initial: T) {
    this.#now = { past: [], present: initial, future: [], edit: {} };
    this.#open = [this.#now];
  }

  get present(): T {
    return this.#now.present;
  }

  /** The newest confirmed state; the present one while none has been. */
  get settled(): T {
    return (this.#settled ?? this.#now).present;
  }

  /** Whether the last move was one back from what was refused or given up. */
  get isBack(): boolean {
    return this.#isBack;
  }

  get canUndo(): boolean {
    return this.#now.past.length > 0;
  }

  get canRedo(): boolean {
    return this.#now.future.length > 0;
  }

  /**
   * Makes `next` the present. Edits with the same `label` are one step while `hold` is on, or when they follow each other closely;
   * without a label every edit is a step of its own. `now` in ms.
   */
  record(next: T, label = '', now = 0): void {
    const { past, present, edit } = this.#now;
    const continues = label !== '' && label === this.#label && (this.#atHold !== undefined || now - this.#at <= MERGE_MS);
    // All of a drag is one edit, however many runs it takes.
    const isSameEdit = continues && !(label === CODE && this.#hasBegun);
    this.#go(
      { past: continues ? past : [...past, present].slice(-MAX_STEPS), present: next, future: [], edit: isSameEdit ? edit : {} },
      label,
    );
    this.#at = now;
  }

  /** A run of the present begins: what code sets from now on is another edit. */
  begin(): void {
    this.#hasBegun = true;
  }

  /** A pointer went down: until `release`, edits with one label are one step, however slow. */
  hold(): void {
    this.#label = '';
    this.#atHold = this.#now;
  }

  release(): void {
    this.#label = '';
    this.#atHold = undefined;
  }

  /** Lets go of what is held as if nothing had happened since. False where nothing has. */
  abandon(): boolean {
    const before = this.#atHold;
    this.release();
    if (!before || before.present === this.present) return false;
    this.#go(before);
    return true;
  }

  undo(): boolean {
    const { past, present, future } = this.#now;
    if (past.length === 0) return false;
    this.#go({ past: past.slice(0, -1), present: past.at(-1) as T, future: [...future, present], edit: {} });
    return true;
  }

  redo(): boolean {
    const { past, present, future } = this.#now;
    if (future.length === 0) return false;
    this.#go({ past: [...past, present], present: future.at(-1) as T, future: future.slice(0, -1), edit: {} });
    return true;
  }

  /** Confirms the newest state for which `isShown` is true: a run has made it. */
  settle(isShown: (state: T) => boolean): void {
    const index = this.#open.map(({ present }) => isShown(present)).lastIndexOf(true);
    if (index < 0) return;
    this.#settled = this.#open[index];
    this.#open = this.#open.slice(index + 1);
  }

  /** The present was refused: goes back to the edit before it that may still be possible. False where there is none. */
  refuse(): boolean {
    const refused = this.#now;
    const open = this.#open.filter(({ edit }) => edit !== refused.edit);
    return this.#back(open.at(-1) ?? this.#settled, open);
  }

  /** Goes back to what was confirmed last. False where nothing was, or that is the present. */
  giveUp(): boolean {
    return this.#back(this.#settled, []);
  }

  #back(to: Moment<T> | undefined, open: Moment<T>[]): boolean {
    const from = this.#now;
    if (!to || to === from) return false;
    // In the middle of a drag it goes on as the same step.
    if (to.past !== from.past) this.#label = '';
    if (this.#atHold === from) this.#atHold = to;
    this.#now = to;
    this.#open = open;
    this.#isBack = true;
    return true;
  }

  #go(to: Moment<T>, label = ''): void {
    this.#now = to;
    this.#label = label;
    this.#isBack = this.#hasBegun = false;
    this.#open = [...this.#open, to].slice(-MAX_OPEN);
  }
}
