/** What the page knows: the one place that the controls read and change. It draws nothing and talks to no element. */

import { History } from '../base/history.ts';
import { UNAVAILABLE } from '../base/errors.ts';
import { presetColor, same } from '../table/table.ts';
import { loadJapanese, translate } from './strings.ts';
import type { Deferred } from '../base/deferred.ts';
import type { ErrorInfo } from '../base/errors.ts';
import type { Progress } from '../generator/protocol.ts';
import type { Notice } from '../table/notices.ts';
import type { Link } from '../table/link.ts';
import type { Language, Words } from '../base/language.ts';
import type { Backend, CameraState, ColorMode, Theme, View } from '../base/view.ts';
import type { StringKey } from './strings.en.ts';
import type { Row } from '../table/row.ts';
import type { Draw, Edition, Kind, Table } from '../table/table.ts';
import type { Change, Circumstances, Line, Message, Offer, OpenedLink, Preferences, Problem, Remedy, Seen, Wish } from './store-types.ts';

export type * from './store-types.ts';

const MAX_SEED = 0xffff_ffff;

/** What comes later of which the store itself has need. */
export interface StoreLater {
  japaneseNotice(notice: Notice): string;
  placeError<K extends Kind>(store: Store<K>, error: ErrorInfo, circumstances: Circumstances<K>): void;
}

export abstract class Store<K extends Kind> {
  readonly table: Table<K>;
  #language: Language = 'en';
  theme: Theme;
  view: View;
  /** `null`: the preset's own. */
  chosenColor: ColorMode | null;
  /** `null`: everything is in view. */
  camera: CameraState | null;
  result: K['result'] | null = null;
  /** What was edited last and is not made yet, also where a file that is missing keeps it from being made: a reload begins with it. */
  wanted: Edition<K> | null = null;
  backend: Backend | null = null;
  /** Of the element whose panel shows this; that of a page has the default. */
  declare metresPerPixel?: () => number;
  progress: Progress<K['stage']> | null = null;
  problem: Problem | null = null;
  messages: Line[] = [];
  remedy: Remedy | null = null;

  #docs: Readonly<Record<string, Words>> = {};
  readonly #history: History<Edition<K>>;
  protected readonly later: Deferred<StoreLater>;
  /** What the last edit set, if it was that of a control. */
  #wish: Wish | null = null;
  /** How things were seen before a link was opened that is not shown yet. */
  #beforeLink: Seen<K> | null = null;
  readonly #listeners = new Set<(change: Change) => void>();

  /** `history`: an element's, whose steps are then the store's too. */
  constructor(table: Table<K>, link: OpenedLink<K>, preferences: Preferences, later: Deferred<StoreLater>, history?: History<Edition<K>>) {
    const { params, preset, view, color, camera, notices } = link;
    this.table = table;
    this.later = later;
    this.#history = history ?? new History<Edition<K>>({ params, preset });
    this.view = view;
    this.chosenColor = color;
    this.camera = camera;
    this.language = preferences.language;
    this.theme = preferences.theme;
    this.messages = this.#messagesOf(notices);
  }

  get language(): Language {
    return this.#language;
  }

  set language(language: Language) {
    this.#language = language;
    if (language === 'ja') void loadJapanese().then(() => this.notify('preferences'));
  }

  get params(): K['params'] {
    return this.#history.present.params;
  }

  get preset(): K['preset'] {
    return this.#history.present.preset;
  }

  get color(): ColorMode {
    return this.chosenColor ?? presetColor(this.table, this.preset);
  }

  get canUndo(): boolean {
    return this.#history.canUndo;
  }

  get canRedo(): boolean {
    return this.#history.canRedo;
  }

  /** What is on screen, as a link says it. It differs from `params` while a run is under way. */
  get shown(): Link<K> {
    return { ...this.#history.settled, ...(this.#beforeLink ?? this.#seen) };
  }

  /** Whether what is on screen is what the parameters say. */
  get isSettled(): boolean {
    return this.#history.settled === this.#history.present;
  }

  get #seen(): Seen<K> {
    return { view: this.view, color: this.chosenColor, camera: this.camera };
  }

  /** Calls back at once on every change; returns the way to stop it. */
  subscribe(listener: (change: Change) => void): () => void {
    this.#listeners.add(listener);
    return () => this.#listeners.delete(listener);
  }

  notify(change: Change): void {
    for (const listener of this.#listeners) listener(change);
  }

  text(key: StringKey, slots?: Record<string, string | number>): string {
    return translate(this.language, key, slots);
  }

  /** Makes `params` the present; edits with one `label` that belong together are one step of undo. `wish`: where they were set. */
  edit(params: K['params'], label = '', preset = this.preset, wish: Wish | null = null): void {
    if (preset !== this.preset || !same(this.table, params, this.params))
      this.#history.record({ params, preset }, label, performance.now());
    this.#wish = wish;
    this.wanted = this.#history.present;
    this.#moved();
  }

  /**
   * The element has changed the history: by an edit of its own, or since a run was refused or cancelled. True when the camera of a
   * link that was refused has to be taken back too.
   */
  sync(): boolean {
    const seen = this.#history.isBack && this.isSettled ? this.#beforeLink : null;
    if (!this.#history.isBack) this.#wish = this.wanted = null;
    if (seen) {
      this.#beforeLink = null;
      Object.assign(this, { view: seen.view, chosenColor: seen.color, camera: seen.camera });
      this.notify('look');
    }
    this.#moved();
    return seen !== null;
  }

  /** What was set in the control of a row and refused there. */
  refusedValue(row: Row, item: number | null): number | string | null | undefined {
    const { problem } = this;
    return problem?.key === row.key && problem.item === item && problem.component === row.component ? problem.refused : undefined;
  }

  /** What is known of the result, in a line. */
  abstract summary(): string;

  abstract stageName(stage: K['stage']): string;

  /** Keys of errors about the list of items, not about one parameter. */
  get listKeys(): readonly string[] {
    return [];
  }

  /** Of an error that names no item, the one that is to be changed. */
  itemAtFault(): number {
    return 0;
  }

  /** What links of this do not hold, in a sentence; empty where they hold everything. */
  get leftOut(): string {
    return '';
  }

  /** Edits one row of the table, of item `item` for a row of items. */
  setParam(row: Row, item: number | null, value: number | string | null): void {
    const { table, params } = this;
    const edited =
      item === null
        ? table.written(params, row, value)
        : table.withItems(
            params,
            table.items(params).map((old, index) => (index === item ? table.written(old, row, value) : old)),
          );
    this.edit(edited, `${row.url} ${item}`, this.preset, { row, item, value });
  }

  /** The value of a row, of item `item` for a row of items. */
  valueOf(row: Row, item: number | null): unknown {
    const owner = item === null ? this.params : this.table.items(this.params)[item];
    return owner && this.table.read(owner, row);
  }

  /** What a parameter does; empty until the words are there. */
  help({ url }: Row): string {
    return this.#docs[url]?.[this.language] ?? '';
  }

  async loadDocs(): Promise<void> {
    try {
      this.#docs = await this.table.docs();
      this.notify('preferences');
    } catch (thrown) {
      // Every control also says by its label what it is.
      console.warn(thrown);
    }
  }

  setSeed(seed: number): void {
    // One before 0 is the last.
    const seeds = MAX_SEED + 1;
    this.edit({ ...this.params, seed: (seed + seeds) % seeds }, 'seed');
  }

  choosePreset(preset: K['preset']): void {
    this.edit({ ...this.table.presetParams(preset), seed: this.params.seed }, '', preset);
  }

  /** What is kept when parameters are drawn by lot. */
  protected get lock(): readonly string[] {
    return [];
  }

  async randomise(random: (params: K['params'], draw: Draw) => Promise<K['params']>, seed: number): Promise<void> {
    const { params, preset, lock } = this;
    this.edit(await random(params, { seed, preset, lock }));
  }

  /** The preset as printed; the seed stays. */
  reset(): void {
    this.edit({ ...this.table.presetParams(this.preset), seed: this.params.seed });
  }

  /** Whether anything but the seed differs from the preset. */
  get isEdited(): boolean {
    return !same(this.table, { ...this.params, seed: 0 }, this.table.presetParams(this.preset));
  }

  /** No more and no fewer than are allowed. */
  setItems(items: readonly K['item'][]): void {
    const { min, max } = this.table.itemCount;
    if (items.length >= min && items.length <= max) this.edit(this.table.withItems(this.params, items));
  }

  removeItem(index: number): void {
    this.setItems(this.table.items(this.params).filter((_, other) => other !== index));
  }

  /** A pointer holds a slider: until `release`, one step of undo. */
  hold(): void {
    this.#history.hold();
  }

  release(): void {
    this.#history.release();
  }

  /** The pointer is taken away, as by a scroll: back to where it was put down. */
  abandon(): void {
    if (this.#history.abandon()) this.#moved();
  }

  undo(): void {
    if (this.#history.undo()) this.#travelled();
  }

  redo(): void {
    if (this.#history.redo()) this.#travelled();
  }

  #travelled(): void {
    this.#wish = this.wanted = null;
    this.#moved();
  }

  #moved(): void {
    this.problem = null;
    this.notify('params');
    // Back at what is shown, nothing is under way.
    if (this.isSettled && this.progress) this.setProgress(null);
  }

  /** Another link was opened: its parameters are one step of undo, its look is taken over. */
  open(link: OpenedLink<K>): void {
    const before = this.#beforeLink ?? this.#seen;
    this.view = link.view;
    this.chosenColor = link.color;
    this.camera = link.camera;
    this.messages = this.#messagesOf(link.notices);
    this.edit(link.params, '', link.preset);
    if (!this.isSettled) this.#beforeLink = before;
    this.notify('look');
    this.notify('camera');
    this.notify('messages');
  }

  /** In English at once; the words of the other language may have to be fetched. */
  #messagesOf(notices: readonly Notice[]): Line[] {
    let inJapanese: ((notice: Notice) => string) | undefined;
    const fetched = ({ japaneseNotice }: StoreLater) => {
      inJapanese = japaneseNotice;
      this.notify('messages');
    };
    if (notices.length > 0) this.later.load().then(fetched, () => undefined);
    return notices.map((notice) => ({ text: (language) => (language === 'ja' && inJapanese?.(notice)) || notice.text, isProblem: true }));
  }

  setView(view: View): void {
    this.view = view;
    this.notify('look');
  }

  /** The preset's own is no choice: with the next preset it is that one's. */
  setColor(color: ColorMode): void {
    this.chosenColor = color === presetColor(this.table, this.preset) ? null : color;
    this.notify('look');
  }

  setLanguage(language: Language): void {
    this.language = language;
    this.notify('preferences');
  }

  setTheme(theme: Theme): void {
    this.theme = theme;
    this.notify('preferences');
  }

  /** `superseded`: a newer run is under way. */
  showResult(result: K['result'], superseded: boolean): void {
    this.result = result;
    if (!superseded) this.progress = null;
    if (this.isSettled) this.#wish = this.wanted = this.#beforeLink = null;
    this.notify('result');
  }

  setBackend(backend: Backend | null): void {
    if (backend === this.backend) return;
    this.backend = backend;
    this.notify('result');
  }

  /** What to offer while the present run goes on. */
  get offer(): Offer | null {
    return null;
  }

  setProgress(progress: Progress<K['stage']> | null): void {
    this.progress = progress;
    this.notify('progress');
  }

  /** Gives the run of `element` up, which goes back to what is shown. */
  cancel(element: { cancel: () => void }): void {
    const { params } = this;
    element.cancel();
    this.setProgress(null);
    if (this.params !== params) this.say((language) => translate(language, 'cancelled'));
  }

  /** The element did not take the last edit. */
  refuse(error: ErrorInfo): void {
    if (this.#history.refuse()) this.#moved();
    void this.fail(error);
  }

  setProblem(problem: Problem | null): void {
    this.problem = problem;
    this.notify('messages');
  }

  /** An error of the element, told where it can be put right. */
  async fail(error: ErrorInfo): Promise<void> {
    const { params } = this;
    const { isBack } = this.#history;
    const wish = isBack ? this.#wish : null;
    this.#wish = null;
    if (!UNAVAILABLE.test(error.name)) this.wanted = null;
    this.setProgress(null);
    // In its own words where ours cannot be had.
    await this.later.load().then(
      ({ placeError }) => placeError(this, error, { params, isBack, wish }),
      () => this.say(() => error.message, true),
    );
  }

  /** Stands before all messages. */
  setRemedy(remedy: Remedy | null): void {
    this.remedy = remedy;
    this.notify('messages');
  }

  say(text: Message, isProblem = false): void {
    this.messages = [...this.messages, { text, isProblem }];
    this.notify('messages');
  }

  dismiss(): void {
    this.messages = this.messages.slice(1);
    this.notify('messages');
  }
}
