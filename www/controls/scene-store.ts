/** What the page knows: the one place that the controls read and change. It draws nothing and talks to no element. */

import { History } from '../history.ts';
import { isMade, presetColor, same } from '../table.ts';
import { loadJapanese, translate } from '../strings.ts';
import { loadLater } from './load-later.ts';
import type { Later } from './load-later.ts';
import type { ErrorInfo } from '../errors.ts';
import type { Progress } from '../generator/protocol.ts';
import type { Notice, SceneLink } from '../link.ts';
import type { Language, Words } from '../params.ts';
import type { Backend, CameraState, ColorMode, View } from '../renderer/renderer.ts';
import type { StringKey } from '../strings.ts';
import type { Kind, Row, Table } from '../table.ts';

export type Theme = 'auto' | 'light' | 'dark';
export const THEMES = ['auto', 'light', 'dark'] as const satisfies readonly Theme[];

/** What undo goes back to: what is made, not the look. */
export interface Edition<K extends Kind> {
  params: K['params'];
  preset: K['preset'];
}

/** A message that belongs under a control. It is put into words when it is shown, in the language of that moment. */
export interface Problem {
  key: string;
  /** Of a row of items: whose. */
  item: number | null;
  component: number | null;
  text: (language: Language) => string;
}

/** A quicker way to what a long run is after. */
export interface Offer {
  text: string;
  label: string;
  take: () => void;
}

/** A line for the whole page. */
export type Message = (language: Language) => string;

/** What helps when the page itself is not whole any more, with a button for it. */
export interface Remedy {
  text: Message;
  label: Message;
  act: () => void;
}

export interface Line {
  text: Message;
  /** Something went wrong; else something is merely said. */
  isProblem: boolean;
}

/** What changed, so that the wiring does no more than it must. */
export type Change = 'params' | 'look' | 'camera' | 'preferences' | 'result' | 'progress' | 'messages';

/** What a link says, and what was wrong with it. */
export type OpenedLink<K extends Kind> = SceneLink<K> & { notices: readonly Notice[] };

export interface Preferences {
  language: Language;
  theme: Theme;
}

const MAX_SEED = 0xffff_ffff;

export abstract class SceneStore<K extends Kind> {
  readonly table: Table<K>;
  #language: Language = 'en';
  theme: Theme;
  view: View;
  /** `null`: the preset's own. */
  chosenColor: ColorMode | null;
  /** `null`: everything is in view. */
  camera: CameraState | null;
  result: K['result'] | null = null;
  /** The newest parameters whose result was shown; differs from `params` while a run is under way. */
  shownParams: K['params'] | null = null;
  backend: Backend | null = null;
  progress: Progress<K['stage']> | null = null;
  problem: Problem | null = null;
  messages: Line[] = [];
  remedy: Remedy | null = null;

  #docs: Readonly<Record<string, Words>> = {};
  readonly #history: History<Edition<K>>;
  readonly #listeners = new Set<(change: Change) => void>();

  /** `history`: an element's, whose steps are then the store's too. */
  constructor(table: Table<K>, link: OpenedLink<K>, preferences: Preferences, history?: History<Edition<K>>) {
    const { params, preset, view, color, camera, notices } = link;
    this.table = table;
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

  /** Makes `params` the present; edits with one `label` that belong together are one step of undo. */
  edit(params: K['params'], label = '', preset = this.preset): void {
    this.#history.record({ params, preset }, label, performance.now());
    this.#moved();
  }

  /** What is known of the result, in a line. */
  abstract summary(): string;

  abstract stageName(stage: K['stage']): string;

  /** Keys of errors about the list of items, not about one parameter. */
  get listKeys(): readonly string[] {
    return [];
  }

  /** Of an error that names no item, the one that is to be changed. */
  protected itemAtFault(): number {
    return 0;
  }

  /** What links of this do not hold, in a sentence; empty where they hold everything. */
  get leftOut(): string {
    return '';
  }

  /** Edits one row of the table, of item `item` for a row of items. */
  setParam(row: Row, item: number | null, value: number | string | null): void {
    const { table, params } = this;
    const label = `${row.url} ${item}`;
    if (item === null) this.edit(table.written(params, row, value), label);
    else this.edit(table.withItems(params, table.items(params).map((old, index) => (index === item ? table.written(old, row, value) : old))), label);
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
    if (this.#history.undo()) this.#moved();
  }

  redo(): void {
    if (this.#history.redo()) this.#moved();
  }

  #moved(): void {
    this.problem = null;
    // Another look has no run to wait for.
    if (this.shownParams && same(this.table, this.shownParams, this.params, isMade)) this.shownParams = this.params;
    this.notify('params');
  }

  /** Another link was opened: its parameters are one step of undo, its look is taken over. */
  open(link: OpenedLink<K>): void {
    this.view = link.view;
    this.chosenColor = link.color;
    this.camera = link.camera;
    this.messages = this.#messagesOf(link.notices);
    this.edit(link.params, '', link.preset);
    this.notify('look');
    this.notify('camera');
    this.notify('messages');
  }

  /** In English at once; the words of the other language may have to be fetched. */
  #messagesOf(notices: readonly Notice[]): Line[] {
    let inJapanese: ((notice: Notice) => string) | undefined;
    const fetched = ({ japaneseNotice }: Later) => {
      inJapanese = japaneseNotice;
      this.notify('messages');
    };
    if (notices.length > 0) loadLater().then(fetched, () => undefined);
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

  /** `params` is null while a newer run is under way: then nobody knows which of the edits `result` is of. */
  showResult(result: K['result'], params: K['params'] | null): void {
    this.result = result;
    if (params) {
      this.shownParams = params;
      this.progress = null;
    }
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

  /** A cancelled run leaves the old picture: back to what it shows. */
  backToShown(): void {
    const { shownParams } = this;
    if (shownParams && shownParams !== this.params) {
      this.edit(shownParams);
      this.say((language) => translate(language, 'cancelled'));
    }
  }

  setProblem(problem: Problem | null): void {
    this.problem = problem;
    this.notify('messages');
  }

  /** An error of the element: under its control, or on the line for the page when it has none. */
  async fail(error: ErrorInfo): Promise<void> {
    const { params } = this;
    const { key = '', layer, message } = error;
    this.setProgress(null);
    // In its own words where ours cannot be had.
    const errorText = await loadLater().then((later) => later.errorText, () => () => message);
    const text = (language: Language) => errorText(language, error);
    const row = this.table.rows.find((candidate) => candidate.key === key && layer === undefined);
    const ofItem = row ? undefined : this.table.itemRows.find((candidate) => candidate.key === key);
    if (!row && !ofItem && !this.listKeys.includes(key)) this.say(text, true);
    else if (this.params === params) this.setProblem({ key, item: ofItem ? (layer ?? this.itemAtFault()) : null, component: null, text });
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
