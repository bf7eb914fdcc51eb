/**
 * An element's parameters: those that are wanted, their steps of undo, the run of the newest, and what is on screen.
 *
 * A step is *settled* once a run has made it. One that a run refuses is taken back, with everything that came with it.
 */

import { isAbort, UNAVAILABLE } from '../base/errors.ts';
import { CODE, History } from '../base/history.ts';
import type { Progress } from '../generator/protocol.ts';
import type { Runs } from '../generator/runs.ts';
import { SceneElement } from '../scene/scene-element.ts';
import { isLook, isMade } from '../table/row.ts';
import { same } from '../table/table.ts';
import type { Edition, Kind } from '../table/table.ts';
import type { ParamsDefinition } from './definition.ts';

/** Begins the steps of undo of an element, for a store that shares them; `onEdit` is called when the element has changed something. */
export let historyOf: <K extends Kind>(element: ParamsElement<K>, onEdit: () => void) => History<Edition<K>>;

export abstract class ParamsElement<K extends Kind> extends SceneElement {
  readonly #definition: ParamsDefinition<K>;
  readonly #runs: Runs<K['params'], K['result'], K['stage']>;
  /** Null before the attributes have been read. */
  #params: K['params'] | null = null;
  #scheduled = false;
  /** Steps of `undo`, of the panel and of code alike; edits that follow each other closely are one. */
  #history: History<Edition<K>> | undefined;
  /** Tells a store that shares the history of what it has not done itself. */
  #onEdit: (() => void) | undefined;
  /** What is on screen, and what it was made from. */
  #result: K['result'] | null = null;
  #shown: K['params'] | null = null;
  /** Parameters whose run has come to its end: `#shown`, unless that is a preview. */
  #made: K['params'] | null = null;
  /** What runs under way were written against. */
  #presets = new WeakMap<K['params'], K['preset']>();
  /** Parameters that are taken when the generator has made them, and what is then to be done. */
  #candidate: { params: K['params']; taken: () => void } | null = null;
  /** All that ever were one. */
  #candidates = new WeakSet<K['params']>();

  constructor(definition: ParamsDefinition<K>) {
    super();
    this.#definition = definition;
    this.#runs = definition.newRuns(
      {
        onResult: (result, { superseded, isPreview }, params) => this.#show(result, superseded, isPreview, params),
        onProgress: (progress) => this.tellProgress(progress),
        onError: (error, params) => {
          // What cannot be made now says nothing of the edits before it.
          if (!UNAVAILABLE.test(error.name)) this.#refuse(params);
          else if (this.#history?.giveUp()) this.#goBack();
          this.report(error);
        },
      },
      this,
    );
  }

  static {
    historyOf = (element, onEdit) => {
      const history = new History(element.history.present);
      element.#history = history;
      element.#onEdit = onEdit;
      return history;
    };
  }

  // What the layers above add.

  /** Takes over what has changed in the attributes. To be called before anything looks at the parameters. */
  protected abstract readAttributes(): void;
  /** Gives the picture the look and the colour of `params`, which were written against `preset`. */
  protected abstract putOn(params: K['params'], preset: K['preset']): void;
  /** The present step is settled. */
  protected abstract settled(): void;
  /** A step has been refused; when the present one `isSettled`, the picture is that of before. */
  protected abstract wentBack(isSettled: boolean): void;
  /** Something has changed that a panel shows. */
  protected abstract changed(): void;
  /** Shows what a run gave. False when the renderer refused it. */
  protected abstract present(result: K['result']): boolean;
  /** Says what is shown now to those who cannot see it. */
  protected abstract describeResult(result: K['result']): Promise<void>;
  /** The detail of the event `generate`. */
  protected abstract detailOf(result: K['result'], superseded: boolean, isPreview: boolean): unknown;

  /**
   * All parameters; a copy, both ways. Assigning starts a run, the latest wins; several assignments in one task are one run. What
   * is only seen, like `sunAzimuth`, starts none. When a run fails or is cancelled, these are the parameters of the picture again.
   *
   * @throws {RockFieldError} naming key, value and bounds; nothing has changed.
   */
  get params(): K['params'] {
    this.readAttributes();
    return this.#definition.table.resolve(this.#params ?? this.#default);
  }

  set params(params: K['params'] & { preset?: K['preset'] | undefined }) {
    const resolved = this.#definition.table.resolve(params);
    this.readAttributes();
    this.#takeParams(resolved);
    this.record(params.preset);
    this.dress();
    this.schedule();
  }

  get #default(): K['params'] {
    const { table } = this.#definition;
    return table.presetParams(table.presets[0]?.name ?? '');
  }

  /** What the attributes have been read into; null before. */
  protected get wanted(): K['params'] | null {
    return this.#params;
  }

  /** Wants `params` from now on; `record` makes them a step, `schedule` a run. */
  protected want(params: K['params']): void {
    const isDressed =
      this.#params !== null && this.#sameMade(this.#params, params) && !same(this.#definition.table, this.#params, params, isLook);
    const isShown = this.#shown === this.#made && this.#sameMade(params, this.#made);
    this.#params = params;
    if (isDressed) return;
    // Taken back before it was seen: what is under way is not wanted any more, and nothing else is to be made.
    if (isShown && this.#result && !this.#candidate && !this.#runs.isSettled) {
      this.#runs.cancel();
      this.#runs.settle(this.#result);
    } else this.#runs.stale = true;
  }

  #takeParams(params: K['params']): void {
    this.#definition.properties.forget(this);
    this.want(params);
  }

  #sameMade(one: K['params'] | null, other: K['params'] | null): boolean {
    return one !== null && other !== null && same(this.#definition.table, one, other, isMade);
  }

  // What is on screen.

  /** What is on screen was made from these; before the first picture, what is to be made. */
  protected get onScreen(): Edition<K> {
    const params = this.#shown ?? this.params;
    return { params, preset: this.#presets.get(params) ?? this.presetInUse };
  }

  /** The result that is on screen. */
  protected get result(): K['result'] | null {
    return this.#result;
  }

  /** Whether what is on screen is what the parameters say. */
  protected get isUpToDate(): boolean {
    return this.#runs.isSettled;
  }

  protected override groundSize(): [number, number] {
    return this.#definition.groundSize(this.#params ?? this.#default);
  }

  /** Shows the parameters' look, unless what they make is still to come: this then brings it. */
  protected dress(): void {
    const params = this.#params;
    const isPending = this.#result !== null && !this.#runs.isSettled && !this.#sameMade(params, this.#shown);
    if (params && !isPending) this.putOn(params, this.presetInUse);
  }

  #show(result: K['result'], superseded: boolean, isPreview: boolean, params: K['params']): void {
    const candidate = this.#candidate?.params === params && !superseded && !isPreview ? this.#candidate : null;
    if (candidate) {
      this.#definition.properties.forget(this);
      this.#params = params;
      this.record(this.presetInUse, '');
    }
    // One that is not taken is not shown.
    else if (this.#candidates.has(params) && params !== this.#params) return;
    if (!this.present(result)) {
      this.#refuse(params);
      return;
    }
    this.#candidate = candidate ? null : this.#candidate;
    this.#result = result;
    this.#shown = params;
    // Its look may have been edited since it was asked for.
    if (this.#params && this.#sameMade(this.#params, params)) this.putOn(this.#params, this.presetInUse);
    else this.putOn(params, this.#presets.get(params) ?? this.presetInUse);
    if (!isPreview) {
      this.#made = params;
      this.#settle();
    }
    candidate?.taken();
    void this.describeResult(result);
    this.emit('generate', this.detailOf(result, superseded, isPreview));
  }

  // Steps of undo.

  /** Goes back one step of the parameters. False where there is none. */
  undo(): boolean {
    return this.#travel(this.#history?.undo());
  }

  /** Goes forward again to what `undo` left. False where there is nothing. */
  redo(): boolean {
    return this.#travel(this.#history?.redo());
  }

  #travel(moved = false): boolean {
    if (moved && this.#history) {
      this.#takeParams(this.#history.present.params);
      this.#settle();
      this.dress();
      this.schedule();
      this.#tellEdit();
    }
    return moved;
  }

  protected get history(): History<Edition<K>> {
    this.readAttributes();
    this.#history ??= new History<Edition<K>>({ params: this.params, preset: this.presetInUse });
    return this.#history;
  }

  /** What the parameters were written against. */
  protected get presetInUse(): K['preset'] {
    return this.#history?.present.preset ?? this.#definition.table.presets[0]?.name ?? '';
  }

  /** Whether a run has made the present step; true where there is none. */
  protected get isSettled(): boolean {
    return this.#history?.settled === this.#history?.present;
  }

  /** Until it is released, edits are one step of undo. */
  protected hold(isHeld: boolean): void {
    if (isHeld) this.#history?.hold();
    else this.#history?.release();
  }

  /**
   * Makes the wanted parameters a step. Those that say the same as the present one are none: the panel's edits come here when they
   * are in the history already.
   */
  protected record(preset: K['preset'] = this.presetInUse, label = CODE): void {
    if (!this.#params) return;
    const edition: Edition<K> = { params: this.#params, preset };
    const present = this.#history?.present;
    if (!present) this.#history = new History(edition);
    else if (preset !== present.preset || !same(this.#definition.table, edition.params, present.params))
      this.#history?.record(edition, label, performance.now());
    this.#settle();
    this.#tellEdit();
  }

  #tellEdit(): void {
    this.changed();
    this.#onEdit?.();
  }

  /** What was made last is what may be shared, and gone back to. */
  #settle(): void {
    const history = this.#history;
    if (!history || !this.#made) return;
    const { preset } = history.settled;
    history.settle(({ params }) => this.#sameMade(params, this.#made));
    if (this.isSettled) this.settled();
    if (history.settled.preset !== preset) this.releaseCamera();
  }

  /** A run of `params` has failed. Edits before it that have not been run yet are tried next. */
  #refuse(params: K['params']): void {
    const history = this.#history;
    let isRefused = false;
    while (history && this.#sameMade(history.present.params, params) && history.refuse()) isRefused = true;
    if (isRefused) this.#goBack();
  }

  /** The history has gone back: so does everything else. */
  #goBack(): void {
    const { params } = this.history.present;
    this.#definition.properties.keepTrue(this, params);
    this.#params = params;
    if (this.#result && this.#sameMade(params, this.#shown)) this.#runs.settle(this.#result);
    else this.#runs.stale = true;
    this.wentBack(this.isSettled);
    this.dress();
    this.schedule();
    this.#tellEdit();
  }

  // Runs.

  /** Whether the element has begun to load: before, nothing runs. */
  protected get canRun(): boolean {
    return this.#runs.isOpen;
  }

  /** Runs now. Resolves with the result; rejects with an AbortError when a newer run supersedes it, else with a RockFieldError. */
  generate(): Promise<K['result']> {
    this.start();
    this.forgetFailure();
    const { params } = this;
    this.#presets.set(params, this.presetInUse);
    this.#history?.begin();
    return this.#runs.start(params);
  }

  /** Gives the running run up, with the parameters that it was to show. */
  cancel(): void {
    this.#runs.giveUp();
    if (this.#history?.giveUp()) this.#goBack();
  }

  /** A fresh random seed, which the caller may put into `params`. */
  freshSeed(): Promise<number> {
    return this.#runs.freshSeed();
  }

  /** What the present parameters make, as soon as it is finished; of newer ones where they change meanwhile. */
  protected newest(): Promise<K['result']> {
    return this.#runs.newest(
      () => this.readAttributes(),
      () => this.generate(),
    );
  }

  /** Reads and runs at the end of this task, once, however many attributes and properties are set in it. */
  protected schedule(): void {
    if (this.#scheduled || !this.#runs.isOpen) return;
    this.#scheduled = true;
    queueMicrotask(() => {
      this.#scheduled = false;
      if (!this.#runs.isOpen) return;
      this.readAttributes();
      if (this.#runs.stale) this.regrow();
    });
  }

  protected override regrow(): void {
    this.generate().catch(() => undefined); // reported there
  }

  protected override opened(): void {
    super.opened();
    this.#runs.open();
    // After a pause what was shown is still there.
    if (!this.#result) this.#runs.stale = true;
    this.schedule();
  }

  protected override closed(): void {
    this.#runs.close();
  }

  /** Of what takes longer; null when it has ended. */
  protected tellProgress(progress: Progress<K['stage']> | null): void {
    this.showProgress(progress?.fraction ?? null);
    if (progress) this.emit('progress', progress);
  }

  // Parameters on trial.

  /**
   * Takes `params` once the generator has made them and the renderer shows them, and calls `taken`. Where one of the two refuses them,
   * everything stays as it was, and the picture is that of the old parameters. Resolves with false when edits came meanwhile, which are
   * kept: the caller may change these and try again.
   *
   * @throws {RockFieldError} by the generator; `AbortError` when the run is cancelled.
   */
  protected async tryOut(params: K['params'], taken: () => void): Promise<boolean> {
    const candidate = { params: this.#definition.table.resolve(params), taken };
    this.#candidate = candidate;
    this.#candidates.add(candidate.params);
    this.#presets.set(candidate.params, this.presetInUse);
    try {
      await this.#runs.attempt(candidate.params);
      return true;
    } catch (thrown) {
      const isSuperseded = isAbort(thrown) && this.#candidate === candidate && this.#runs.isOpen && !this.#runs.isSettled;
      if (!isSuperseded) throw thrown;
      return false;
    } finally {
      if (this.#candidate === candidate) this.#candidate = null;
      if (this.#runs.stale) this.schedule();
    }
  }

  /** No candidate is taken any more. */
  protected dropCandidate(): void {
    this.#candidate = null;
  }
}
