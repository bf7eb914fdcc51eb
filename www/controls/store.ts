/** What the page knows: the one place that the controls read and change. It draws nothing and talks to no element. */

import { History } from '../history.ts';
import { presetColor, sameRocks } from '../look.ts';
import { MAX_LAYERS, PARAMS } from '../params.ts';
import { boundsOf, defaultLayer, presetParams, writeValue } from '../params-flat.ts';
import { translate } from '../strings.ts';
import { loadLater } from './load-later.ts';
import type { Later } from './load-later.ts';
import type { ErrorInfo } from '../errors.ts';
import type { Field } from '../field.ts';
import type { Progress } from '../generator/protocol.ts';
import type { Language, Layer, Notation, Params, ParamSpec, PresetName } from '../params.ts';
import type { Backend, CameraState, ColorMode, View } from '../renderer/renderer.ts';
import type { StringKey } from '../strings.ts';
import type { LinkState, Notice } from '../url-codec.ts';

export type Theme = 'auto' | 'light' | 'dark';
export const THEMES = ['auto', 'light', 'dark'] as const satisfies readonly Theme[];

/** What undo goes back to: the rocks, not the look. */
export interface Edition {
  params: Params;
  preset: PresetName;
}

/** A message that belongs under a control. It is put into words when it is shown, in the language of that moment. */
export interface Problem {
  key: string;
  layer: number | null;
  component: number | null;
  text: (language: Language) => string;
}

/** A line for the whole page. */
export type Message = (language: Language) => string;

/** What changed, so that the wiring does no more than it must. */
export type Change = 'params' | 'look' | 'camera' | 'preferences' | 'field' | 'progress' | 'messages';

/** A layer that is added has no more than some 10,000 cells: the finest of Fig. 1 has r = 10 at 1024 px. */
const FINEST_SHARE = 100;
/** The first layer of a bare field is three times that: the middle one of Fig. 1. */
const DEFAULT_SHARE = 3;

/** Keys of errors about the list of layers, not about one parameter. */
export const LIST_KEYS: readonly string[] = ['layers', 'id'];

const SEED = row('seed');
const RADIUS = row('radius');

export class Store {
  language: Language;
  theme: Theme;
  view: View;
  /** `null`: the preset's own. */
  chosenColor: ColorMode | null;
  /** `null`: the whole field is in view. */
  camera: CameraState | null;
  field: Field | null = null;
  /** The newest parameters whose field was shown; differs from `params` while a run is under way. */
  shownParams: Params | null = null;
  backend: Backend | null = null;
  progress: Progress | null = null;
  problem: Problem | null = null;
  messages: Message[] = [];

  readonly #history: History<Edition>;
  readonly #listeners = new Set<(change: Change) => void>();

  /** `history`: an element's, whose steps are then the store's too. */
  constructor(link: LinkState & { notices: readonly Notice[] }, preferences: { language: Language; theme: Theme }, history?: History<Edition>) {
    const { params, preset, view, color, camera, notices } = link;
    this.#history = history ?? new History({ params, preset });
    this.view = view;
    this.chosenColor = color;
    this.camera = camera;
    this.language = preferences.language;
    this.theme = preferences.theme;
    this.messages = this.#messagesOf(notices);
  }

  get params(): Params {
    return this.#history.present.params;
  }

  get preset(): PresetName {
    return this.#history.present.preset;
  }

  get color(): ColorMode {
    return this.chosenColor ?? presetColor(this.preset);
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
  edit(params: Params, label = '', preset = this.preset): void {
    this.#history.record({ params, preset }, label, performance.now());
    this.#moved();
  }

  /** Edits one row of the table, in `layer` for a layer's row. */
  setParam(spec: ParamSpec, layer: number | null, value: number | string | null): void {
    const label = `${spec.url} ${layer}`;
    if (spec.key === 'notation') {
      void this.setNotation(value as Notation);
    } else if (layer === null) {
      this.edit(written(this.params, spec, value), label);
    } else {
      const layers = this.params.layers.map((old, index) => (index === layer ? written(old, spec, value) : old));
      this.edit({ ...this.params, layers }, label);
    }
  }

  async setNotation(notation: Notation): Promise<void> {
    if (notation === this.params.notation) return;
    const { inNotation, later } = await loadLater();
    const { params, clamped } = inNotation(this.params, notation);
    this.edit(params);
    if (clamped) this.say((language) => later(language, 'notationClamped'));
  }

  setSeed(seed: number): void {
    // One before 0 is the last.
    const seeds = SEED.max + 1;
    this.edit({ ...this.params, seed: (seed + seeds) % seeds }, SEED.url);
  }

  choosePreset(preset: PresetName): void {
    this.edit({ ...presetParams(preset), seed: this.params.seed }, '', preset);
  }

  /** The preset as printed, with seed 0. */
  reset(): void {
    this.edit(presetParams(this.preset));
  }

  addLayer(): void {
    const { layers } = this.params;
    this.#setLayers([...layers, nextSize(this.params, freeId(layers))]);
  }

  duplicateLayer(index: number): void {
    const { layers } = this.params;
    const original = layers[index];
    if (!original) return;
    const copy = { ...structuredClone(original), id: freeId(layers) };
    this.#setLayers([...layers.slice(0, index + 1), copy, ...layers.slice(index + 1)]);
  }

  removeLayer(index: number): void {
    this.#setLayers(this.params.layers.filter((_, other) => other !== index));
  }

  #setLayers(layers: Layer[]): void {
    if (layers.length <= MAX_LAYERS) this.edit({ ...this.params, layers });
  }

  /** A pointer holds a slider: until `release`, one step of undo. */
  hold(): void {
    this.#history.hold();
  }

  release(): void {
    this.#history.release();
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
    if (this.shownParams && sameRocks(this.shownParams, this.params)) this.shownParams = this.params;
    this.notify('params');
  }

  /** Another link was opened: its rocks are one step of undo, its look is taken over. */
  open(link: LinkState & { notices: readonly Notice[] }): void {
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
  #messagesOf(notices: readonly Notice[]): Message[] {
    let inJapanese: ((notice: Notice) => string) | undefined;
    const fetched = ({ japaneseNotice }: Later) => {
      inJapanese = japaneseNotice;
      this.notify('messages');
    };
    if (notices.length > 0) loadLater().then(fetched, () => undefined);
    return notices.map((notice) => (language) => (language === 'ja' && inJapanese?.(notice)) || notice.text);
  }

  setView(view: View): void {
    this.view = view;
    this.notify('look');
  }

  /** The preset's own is no choice: with the next preset it is that one's. */
  setColor(color: ColorMode): void {
    this.chosenColor = color === presetColor(this.preset) ? null : color;
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

  /** `params` is null while a newer run is under way: then nobody knows which of the edits `field` is of. */
  showField(field: Field, params: Params | null): void {
    this.field = field;
    if (params) {
      this.shownParams = params;
      this.progress = null;
    }
    this.notify('field');
  }

  setBackend(backend: Backend | null): void {
    if (backend === this.backend) return;
    this.backend = backend;
    this.notify('field');
  }

  setProgress(progress: Progress | null): void {
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
    const spec = PARAMS.find((candidate) => candidate.key === key);
    if (!spec && !LIST_KEYS.includes(key)) this.say(text);
    else if (this.params === params) this.setProblem({ key, layer: spec?.scope === 'layer' ? (layer ?? this.#finestLayer()) : null, component: null, text });
  }

  /** Where an error of no particular layer belongs: what is too much for the memory is too many small rocks. */
  #finestLayer(): number {
    const radii = this.params.layers.map(({ radius }) => radius);
    return radii.indexOf(Math.min(...radii));
  }

  say(message: Message): void {
    this.messages = [...this.messages, message];
    this.notify('messages');
  }

  dismiss(): void {
    this.messages = this.messages.slice(1);
    this.notify('messages');
  }
}

function written<T extends Params | Layer>(owner: T, spec: ParamSpec, value: number | string | null): T {
  const copy = { ...owner };
  if (spec.component !== null) {
    const record = copy as unknown as Record<string, number[]>;
    record[spec.key] = [...(record[spec.key] ?? [])];
  }
  writeValue(copy, spec, value);
  return copy;
}

function row(key: string): ParamSpec {
  const found = PARAMS.find((spec) => spec.key === key);
  if (!found) throw new Error(`the table has no row ${key}`);
  return found;
}

function freeId(layers: readonly Layer[]): number {
  // Past all that were ever seen here, so that a removed layer's rocks do not come back under another layer's name.
  return Math.max(-1, ...layers.map(({ id }) => id)) + 1;
}

/** The layer that an empty place asks for: a third of the smallest radius, as from size to size in the papers, and as steep as the table's defaults. */
function nextSize({ layers, notation, imageWidth, imageHeight }: Params, id: number): Layer {
  const layer = defaultLayer(id, notation);
  const side = Math.sqrt(imageWidth * imageHeight);
  const finest = notation === 'px' ? side / FINEST_SHARE : (100 * side) / imageWidth / FINEST_SHARE;
  const { min } = boundsOf(RADIUS, notation).slider;
  const smallest = Math.min(...layers.map(({ radius }) => radius));
  const radius = round(Math.max(min, layers.length > 0 ? Math.max(finest, smallest / 3) : finest * DEFAULT_SHARE));
  const scale = radius / layer.radius;
  const scaled = (triple: Layer['taper']) => triple.map((value) => round(value * scale)) as Layer['taper'];
  // In the conference's notation heights are multiples of the radius already.
  return { ...layer, radius, taper: scaled(layer.taper), height: notation === 'px' ? scaled(layer.height) : layer.height };
}

function round(value: number): number {
  return Number(value.toPrecision(2));
}
