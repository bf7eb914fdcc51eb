/** What every element of a generator shares: parameters by attribute, property and link, runs, undo, the panel. */

import { INTERACTIONS, QUALITY_CHOICES, THEMES } from '../base/view.ts';
import { checkChoice, COMMON_ATTRIBUTES } from './attribute-reader.ts';
import type { Backend, CameraState, ColorMode, Interaction, Theme, View, WantedQuality } from '../base/view.ts';
import { checkCamera } from '../table/camera-bounds.ts';
import { METRES_PER_PIXEL } from '../scene/camera/orbit.ts';
import type { Edition, Kind } from '../table/table.ts';
import { CAN_SHOW } from '../base/document-styles.ts';
import type { ControlsButton } from './controls-button.ts';
import type { Definition } from './definition.ts';
import { errorInfo, isAbort, RockFieldError, UNAVAILABLE } from '../base/errors.ts';
import type { ErrorDetail } from '../base/error-pace.ts';
import type { Progress } from '../generator/protocol.ts';
import { CODE, History } from '../base/history.ts';
import type { Link } from '../table/link.ts';
import { lazily } from '../base/lazy.ts';
import { REFLECTED_PROPERTIES, writeAttribute } from './reflected-properties.ts';
import type { Runs } from '../generator/runs.ts';
import { SceneElement } from '../scene/scene-element.ts';
import { isLook, isMade } from '../table/row.ts';
import { presetColor, same } from '../table/table.ts';

/** The events, by name, with their details. None bubbles; all are composed. */
export interface ElementEventMap<Stage extends string> {
  /** The first picture of a cycle has been painted. */
  load: CustomEvent<null>;
  /** A run of more than 200 ms is under way. */
  progress: CustomEvent<Progress<Stage>>;
  /** Something went wrong; at most one a second. `shown`: the element says so itself, over its picture. */
  error: CustomEvent<ErrorDetail>;
  /** The user moved the camera, or asked for everything. */
  'camera-change': CustomEvent<{ camera: CameraState; framed: boolean }>;
  /** The picture is back after a loss of the device. */
  restored: CustomEvent<null>;
  /** An attribute could not be taken as it stood. */
  notice: CustomEvent<{ message: string }>;
}

/** Attributes that are no parameters and change nothing but manners. */
const MANNERS = ['poster', 'disabled', 'auto-rotate', 'controls'];

/** Where a definition says what its attributes are called. */
interface AttributeNames {
  rowAttributes: ReadonlyMap<string, unknown>;
  itemAttributes: readonly string[];
  ownAttributes: object;
}

export function observedAttributes(definition: AttributeNames): readonly string[] {
  return [...parameterAttributes(definition), ...MANNERS];
}

function parameterAttributes({ rowAttributes, itemAttributes, ownAttributes }: AttributeNames): string[] {
  return [...COMMON_ATTRIBUTES, ...rowAttributes.keys(), ...itemAttributes, ...Object.keys(ownAttributes)];
}

/** Assigned before the element was defined, these would hide the accessors. */
const PROPERTIES = [
  'params',
  'view',
  'color',
  'quality',
  'camera',
  'theme',
  'cameraOrbit',
  'interaction',
  'metresPerPixel',
  'backend',
  'controls',
];

/** Begins the steps of undo of an element, for a store that shares them; `onEdit` is called when the element has changed something. */
export let historyOf: <K extends Kind>(element: GeneratorElement<K>, onEdit: () => void) => History<Edition<K>>;

/**
 * @attribute src - A share link or its fragment, or parameters as JSON; fills everything.
 * @attribute quality - `low`, `medium` or `high`, of natural colours; `auto`: as well as motion flows, and `high` at rest.
 * @attribute theme - `light`, `dark`, or `auto`: as the system is set.
 * @attribute camera-orbit - Azimuth, angle from above, distance: `45deg 55deg 120%`, each of them perhaps `auto`.
 * @attribute interaction - `cooperative` (the page scrolls through it), `always` or `none`.
 * @attribute loading - `eager`, or `lazy`: nothing is loaded before the element comes near the screen.
 * @attribute metres-per-pixel - Size of a pixel of the image; default 0.01.
 * @attribute controls - A button in the picture's corner opens a panel with everything that can be set; `open`: it begins open.
 * @attribute backend - `auto`, `webgpu`, `webgl`, `canvas2d` or `null` (draws nothing); read when the element is connected.
 * @csspart hint - Why a gesture did nothing, for a moment.
 * @csspart controls-button - The button that opens the panel.
 * @csspart panel - The panel, while it is open.
 * @fires load - The first picture has been painted.
 * @fires progress - A run of more than 200 ms is under way.
 * @fires error - What went wrong, as data.
 * @fires camera-change - The user moved the camera, or asked for everything.
 * @fires restored - The picture is back after a loss of the device.
 * @fires notice - An attribute could not be taken as it stood. `preventDefault()` keeps the message off the picture.
 */
export abstract class GeneratorElement<K extends Kind> extends SceneElement {
  readonly #definition: Definition<K, GeneratorElement<K>>;
  readonly #runs: Runs<K['params'], K['result'], K['stage']>;
  /** Null before the attributes have been read. */
  #params: K['params'] | null = null;
  /** Attributes that have not been read since they changed. */
  #unread: Set<string>;
  #scheduled = false;
  /** Steps of `undo`, of the panel and of code alike; edits that follow each other closely are one. */
  #history: History<Edition<K>> | undefined;
  #controls: ControlsButton<K, GeneratorElement<K>> | undefined;
  /** Null: nobody chose one, it is the preset's own. */
  #color: ColorMode | null = null;
  /** What is on screen, and what it was made from. */
  #result: K['result'] | null = null;
  #shown: K['params'] | null = null;
  /** Parameters whose run has come to its end: `#shown`, unless that is a preview. */
  #made: K['params'] | null = null;
  /** How things were seen before a link was opened whose run is still to come. */
  #beforeLink: Pick<Link<K>, 'view' | 'color' | 'camera'> | null = null;
  /** Tells a store that shares the history of what it has not done itself. */
  #onEdit: (() => void) | undefined;
  /** What runs under way were written against. */
  #presets = new WeakMap<K['params'], K['preset']>();
  /** Parameters that are taken when the generator has made them, and what is then to be done. */
  #candidate: { params: K['params']; taken: () => void } | null = null;
  /** All that ever were one. */
  #candidates = new WeakSet<K['params']>();
  #interaction: Interaction = INTERACTIONS[0];
  #metresPerPixel = METRES_PER_PIXEL;

  constructor(definition: Definition<K, GeneratorElement<K>>) {
    super();
    this.#definition = definition;
    this.#unread = new Set(parameterAttributes(definition));
    this.#runs = definition.newRuns({
      onResult: (result, { superseded, isPreview }, params) => this.#show(result, superseded, isPreview, params),
      onProgress: (progress) => this.tellProgress(progress),
      onError: (error, params) => {
        // What cannot be made now says nothing of the edits before it.
        if (!UNAVAILABLE.test(error.name)) this.#refuse(params);
        else if (this.#history?.giveUp()) this.#goBack();
        this.report(error);
      },
    });
  }

  static {
    historyOf = (element, onEdit) => {
      const history = new History(element.#ownHistory.present);
      element.#history = history;
      element.#onEdit = onEdit;
      return history;
    };
  }

  /** Shows what a run gave. False when the renderer refused it. */
  protected abstract present(result: K['result']): boolean;
  /** The detail of the event `generate`. */
  protected abstract detailOf(result: K['result'], superseded: boolean, isPreview: boolean): unknown;

  /**
   * All parameters; a copy, both ways. Assigning starts a run, the latest wins; several assignments in one task are one run. What
   * is only seen, like `sunAzimuth`, starts none. When a run fails or is cancelled, these are the parameters of the picture again.
   *
   * @throws {RockFieldError} naming key, value and bounds; nothing has changed.
   */
  get params(): K['params'] {
    this.#readAttributes();
    return this.#definition.table.resolve(this.#params ?? this.#default);
  }

  set params(params: K['params'] & { preset?: K['preset'] | undefined }) {
    const resolved = this.#definition.table.resolve(params);
    this.#readAttributes();
    this.#takeParams(resolved);
    this.#record(params.preset);
    this.#dress();
    this.#schedule();
  }

  get #default(): K['params'] {
    const { table } = this.#definition;
    return table.presetParams(table.presets[0]?.name ?? '');
  }

  #sameMade(one: K['params'] | null, other: K['params'] | null): boolean {
    return one !== null && other !== null && same(this.#definition.table, one, other, isMade);
  }

  /** Until it is released, edits are one step of undo. */
  protected hold(isHeld: boolean): void {
    if (isHeld) this.#history?.hold();
    else this.#history?.release();
  }

  #setParams(params: K['params']): void {
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

  /** What is on screen was made from these; before the first picture, what is to be made. */
  protected get onScreen(): Edition<K> {
    const params = this.#shown ?? this.params;
    return { params, preset: this.#presets.get(params) ?? this.presetInUse };
  }

  /** What the parameters were written against. */
  protected get presetInUse(): K['preset'] {
    return this.#history?.present.preset ?? this.#definition.table.presets[0]?.name ?? '';
  }

  /** Shows the parameters' look, unless what they make is still to come: this then brings it. */
  #dress(): void {
    const params = this.#params;
    const isPending = this.#result !== null && !this.#runs.isSettled && !this.#sameMade(params, this.#shown);
    if (params && !isPending) this.#putOn(params, this.presetInUse);
  }

  #putOn(params: K['params'], preset: K['preset']): void {
    this.setSceneLook(this.#definition.lookOf(params));
    this.sceneColor = this.#color ?? presetColor(this.#definition.table, preset);
  }

  #takeParams(params: K['params']): void {
    this.#definition.properties.forget(this);
    this.#setParams(params);
  }

  /** What says the same as the present is no step: the panel's edits come here when they are in the history already. */
  #record(preset: K['preset'] = this.presetInUse, label = CODE): void {
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
    this.#controls?.sync();
    this.#onEdit?.();
  }

  get #ownHistory(): History<Edition<K>> {
    this.#readAttributes();
    this.#history ??= new History<Edition<K>>({ params: this.params, preset: this.presetInUse });
    return this.#history;
  }

  /** What was made last is what may be shared, and gone back to. */
  #settle(): void {
    const history = this.#history;
    if (!history || !this.#made) return;
    const { preset } = history.settled;
    history.settle(({ params }) => this.#sameMade(params, this.#made));
    if (history.settled === history.present) this.#beforeLink = null;
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
    const history = this.#ownHistory;
    const { params } = history.present;
    this.#definition.properties.keepTrue(this, params);
    this.#params = params;
    if (this.#result && this.#sameMade(params, this.#shown)) this.#runs.settle(this.#result);
    else this.#runs.stale = true;
    if (this.#beforeLink && history.settled === history.present) {
      const { view, color, camera } = this.#beforeLink;
      this.#beforeLink = null;
      this.sceneView = view;
      this.#color = color;
      super.camera = camera;
    }
    this.#dress();
    this.#schedule();
    this.#tellEdit();
  }

  get view(): View {
    this.#readAttributes();
    return this.sceneView;
  }

  set view(view: View) {
    const { views } = this.#definition.table;
    const checked = checkChoice('view', view ?? views[0], views);
    this.#readAttributes();
    this.sceneView = checked;
    this.#controls?.sync();
  }

  /** As the attribute; assigning `null` lets it follow the preset again. */
  get color(): ColorMode {
    this.#readAttributes();
    return this.#color ?? presetColor(this.#definition.table, this.presetInUse);
  }

  set color(color: ColorMode | null) {
    const checked = color === null || color === undefined ? null : checkChoice('color', color, this.#definition.table.colors);
    this.#readAttributes();
    if (checked !== this.#color) this.recolor(() => this.#chooseColor(checked));
    this.#controls?.sync();
  }

  #chooseColor(color: ColorMode | null): void {
    if (color) this.sceneColor = color;
    // The renderer may have refused it.
    if (color && this.sceneColor !== color) return;
    this.#color = color;
    if (!color) this.#dress();
  }

  /** How much work natural colours are worth: see the attribute. */
  get quality(): WantedQuality {
    this.#readAttributes();
    return this.sceneQuality;
  }

  set quality(quality: WantedQuality) {
    this.setAttribute('quality', checkChoice('quality', quality ?? QUALITY_CHOICES[0], QUALITY_CHOICES));
  }

  /** Of the picture and the panel: see the attribute. */
  get theme(): Theme {
    this.#readAttributes();
    return this.sceneTheme;
  }

  set theme(theme: Theme) {
    this.setAttribute('theme', checkChoice('theme', theme ?? THEMES[0], THEMES));
    this.#readAttributes();
  }

  /** Whether there is a button for the panel; assigning `open` opens it. */
  get controls(): boolean {
    return this.hasAttribute('controls');
  }

  set controls(controls: boolean | 'open') {
    if (controls === 'open') this.setAttribute('controls', controls);
    else this.toggleAttribute('controls', Boolean(controls));
  }

  override get camera(): CameraState {
    this.#readAttributes();
    return super.camera;
  }

  /** @throws {RockFieldError} naming key, value and bounds; nothing has changed. */
  override set camera(camera: CameraState | null) {
    const checked = checkCamera(camera);
    this.#readAttributes();
    super.camera = checked;
  }

  /** What moves the camera: see the attribute. */
  get interaction(): Interaction {
    this.#readAttributes();
    return this.#interaction;
  }

  set interaction(interaction: Interaction) {
    this.setAttribute('interaction', checkChoice('interaction', interaction ?? INTERACTIONS[0], INTERACTIONS));
  }

  /** As the attribute: `45deg 55deg 120%`; empty for the framing of its own. */
  get cameraOrbit(): string {
    return this.getAttribute('camera-orbit') ?? '';
  }

  set cameraOrbit(orbit: string) {
    writeAttribute(this, 'camera-orbit', orbit);
  }

  get metresPerPixel(): number {
    this.#readAttributes();
    return this.#metresPerPixel;
  }

  set metresPerPixel(metres: number) {
    writeAttribute(this, 'metres-per-pixel', metres);
  }

  /** What draws the picture; null before it is known. Assigning sets the attribute, which is read when the element is connected. */
  override get backend(): Backend | null {
    return super.backend;
  }

  override set backend(wanted: 'auto' | Backend | null) {
    writeAttribute(this, 'backend', wanted);
  }

  protected override get interactionMode(): Interaction {
    return this.#interaction;
  }

  /**
   * A link to what is shown: `base`, the page's own address by default, with the parameters as its fragment. Parameters that are
   * still to be made are not in it; wait for `generate()` first if they should be.
   */
  shareURL(base: string = addressOf(this.ownerDocument)): string {
    const url = new URL(base, this.ownerDocument.baseURI);
    const { params, preset } = this.#ownHistory.settled;
    url.hash = this.#definition.encode({ params, preset, ...(this.#beforeLink ?? this.#seen) });
    return url.href;
  }

  get #seen(): Pick<Link<K>, 'view' | 'color' | 'camera'> {
    return { view: this.sceneView, color: this.#color, camera: this.hasDefaultCamera ? null : super.camera };
  }

  /**
   * Another of the kind by lot, of parameters by lot. Properties named in `lock` keep their values.
   *
   * @throws {RockFieldError} `UnknownKey` for a name in `lock` that is no parameter.
   */
  async randomize({ lock = [] }: { lock?: readonly string[] } = {}): Promise<void> {
    const { lockedDraw } = await lazily(() => import('./locked-draw.ts'));
    const params = await lockedDraw(this.#definition, this.params, () => this.freshSeed(), { preset: this.presetInUse, lock });
    this.#history?.hold();
    this.params = params;
    this.#history?.release();
  }

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
      this.#dress();
      this.#schedule();
      this.#tellEdit();
    }
    return moved;
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

  /** For what an element has to say of its runs; null: the run has ended. */
  protected heard(_progress: Progress<K['stage']> | null): void {}

  /**
   * Takes what `change` makes of the parameters once the generator has made it. Where it is refused, everything stays as it was, and
   * the picture is that of the old parameters. Edits that come meanwhile are kept: they are changed and tried again.
   *
   * @throws {RockFieldError} by the generator; `AbortError` when `signal` says so, or the run is cancelled.
   */
  protected async adopt(
    change: (params: K['params']) => K['params'],
    { signal, taken }: { signal: AbortSignal; taken: () => void },
  ): Promise<void> {
    for (;;) {
      signal.throwIfAborted();
      const candidate = { params: this.#definition.table.resolve(change(this.params)), taken };
      this.#candidate = candidate;
      this.#candidates.add(candidate.params);
      this.#presets.set(candidate.params, this.presetInUse);
      try {
        await this.#runs.attempt(candidate.params);
        // The renderer may have refused what the generator made.
        if (this.#candidate === candidate) throw new RockFieldError({ name: 'RendererFailed', message: 'the log could not be shown' });
        return;
      } catch (thrown) {
        const isSuperseded = isAbort(thrown) && this.#candidate === candidate && this.#runs.isOpen && !this.#runs.isSettled;
        if (this.#candidate === candidate) this.#candidate = null;
        if (this.#runs.stale) this.#schedule();
        if (!isSuperseded) throw thrown;
      }
    }
  }

  /** No candidate is taken any more. */
  protected dropCandidate(): void {
    this.#candidate = null;
  }

  #take(params: K['params']): void {
    this.#definition.properties.forget(this);
    this.#params = params;
    this.#record(this.presetInUse, '');
  }

  /** Of what takes longer; null when it has ended. */
  protected tellProgress(progress: Progress<K['stage']> | null): void {
    this.showProgress(progress?.fraction ?? null);
    if (progress) this.emit('progress', progress);
    this.heard(progress);
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
      () => this.#readAttributes(),
      () => this.generate(),
    );
  }

  attributeChangedCallback(name: string, before: string | null, after: string | null): void {
    if (before === after) return;
    if (MANNERS.includes(name)) {
      this.readManners();
      return;
    }
    this.#unread.add(name);
    if (name === 'loading' && this.isConnected) this.loadUnlessLazy();
    this.#schedule();
  }

  override connectedCallback(): void {
    const { properties, list } = this.#definition;
    for (const name of [...REFLECTED_PROPERTIES, list, ...properties.names, ...PROPERTIES]) this.#upgrade(name);
    super.connectedCallback();
  }

  protected override opened(): void {
    this.#runs.open();
    // After a pause what was shown is still there.
    if (!this.#result) this.#runs.stale = true;
    this.#schedule();
    this.#controls?.begin();
  }

  protected override closed(): void {
    this.#controls?.close();
    this.#runs.close();
  }

  protected override readManners(): void {
    super.readManners();
    if (this.controls && !this.#controls && CAN_SHOW) void this.#loadControls();
    this.#controls?.update();
  }

  /** Few elements have a panel: for the others nothing of it is fetched. */
  async #loadControls(): Promise<void> {
    try {
      const { ControlsButton } = await lazily(() => import('./controls-button.ts'));
      this.#controls ??= this.#newControls(ControlsButton);
      this.#controls.update();
    } catch (thrown) {
      this.report(errorInfo(thrown));
    }
  }

  #newControls(Button: typeof ControlsButton): ControlsButton<K, GeneratorElement<K>> {
    return new Button<K, GeneratorElement<K>>({
      element: this,
      root: this.shadowRoot as ShadowRoot,
      language: () => this.language,
      isOpen: () => this.#runs.isOpen,
      isSettled: () => this.#runs.isSettled,
      chosenColor: () => this.#color,
      history: () => this.#ownHistory,
      result: () => this.#result,
      random: this.#definition.random,
      loadPanel: this.#definition.loadPanel,
      say: (text) => this.notify(text),
    });
  }

  protected override regrow(): void {
    this.generate().catch(() => undefined); // reported there
  }

  protected override groundSize(): [number, number] {
    return this.#definition.groundSize(this.#params ?? this.#default);
  }

  #show(result: K['result'], superseded: boolean, isPreview: boolean, params: K['params']): void {
    const candidate = this.#candidate?.params === params && !superseded && !isPreview ? this.#candidate : null;
    if (candidate) this.#take(candidate.params);
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
    if (this.#params && this.#sameMade(this.#params, params)) this.#putOn(this.#params, this.presetInUse);
    else this.#putOn(params, this.#presets.get(params) ?? this.presetInUse);
    if (!isPreview) {
      this.#made = params;
      this.#settle();
    }
    candidate?.taken();
    // Without these words the picture is still a picture.
    this.#describe(result).catch((thrown: unknown) => console.warn(thrown));
    this.emit('generate', this.detailOf(result, superseded, isPreview));
  }

  protected override relabel(): void {
    super.relabel();
    this.#controls?.sync();
    if (this.#result) this.#describe(this.#result).catch((thrown: unknown) => console.warn(thrown));
  }

  async #describe(result: K['result']): Promise<void> {
    const words = await this.#definition.describe(result, this.#metresPerPixel, this.language);
    if (this.#result === result) this.describe(words);
  }

  /** Reads and runs at the end of this task, once, however many attributes and properties are set in it. */
  #schedule(): void {
    if (this.#scheduled || !this.#runs.isOpen) return;
    this.#scheduled = true;
    queueMicrotask(() => {
      this.#scheduled = false;
      if (!this.#runs.isOpen) return;
      this.#readAttributes();
      if (this.#runs.stale) this.generate().catch(() => undefined); // reported there
    });
  }

  /** Takes over what changed in the attributes, and nothing that was assigned and whose attribute did not change. */
  #readAttributes(): void {
    const unread = this.#unread;
    if (unread.size === 0) return;
    this.#unread = new Set();
    const { table, properties, rowAttributes, itemAttributes, ownAttributes, readAttributes } = this.#definition;
    const read = readAttributes((name) => this.getAttribute(name));
    const { params } = read;
    const has = (...names: string[]) => names.some((name) => unread.has(name));
    const isAboutParams = has('src', 'preset', ...rowAttributes.keys(), ...itemAttributes, ...Object.keys(ownAttributes));
    properties.forget(this, unread);
    if (!this.#params || has('src', 'preset')) {
      this.#setParams(this.#withAssigned(params));
    } else if (isAboutParams) {
      let own = { ...this.#params };
      for (const [name, row] of rowAttributes) if (has(name)) own = table.written(own, row, table.read(params, row));
      if (has(...itemAttributes)) own = table.withItems(own, table.items(params));
      for (const [name, key] of Object.entries(ownAttributes)) if (has(name)) own[key] = params[key];
      this.#setParams(this.#withAssigned(own));
    }
    if (isAboutParams) this.#record(has('src', 'preset') ? read.preset : undefined);
    if (has('src') && this.#history?.settled !== this.#history?.present) this.#beforeLink ??= this.#seen;
    if (has('src', 'view')) this.sceneView = read.view;
    if (has('src', 'color')) this.#chooseColor(read.color);
    this.#dress();
    if (has('src')) super.camera = read.camera;
    if (has('camera-orbit', 'metres-per-pixel')) this.setFraming(read.orbit, read.metresPerPixel);
    if (has('camera-orbit')) super.camera = read.camera;
    this.sceneQuality = read.quality;
    this.sceneTheme = read.theme;
    this.#interaction = read.interaction;
    this.#metresPerPixel = read.metresPerPixel;
    if (has('interaction')) this.readManners();
    this.#controls?.sync();
    for (const { attribute, message } of read.notices) if (unread.has(attribute)) this.notify(message);
  }

  #withAssigned(params: K['params']): K['params'] {
    try {
      return this.#definition.properties.withAssigned(this, params);
    } catch (thrown) {
      // Of a layer that is no more, or in a notation with other bounds. Nothing may be thrown out of a lifecycle callback.
      this.#definition.properties.forget(this);
      this.report(errorInfo(thrown));
      return params;
    }
  }

  #upgrade(name: string): void {
    if (!Object.hasOwn(this, name)) return;
    const value: unknown = Reflect.get(this, name);
    Reflect.deleteProperty(this, name);
    try {
      Reflect.set(this, name, value);
    } catch (thrown) {
      // Nothing may be thrown out of a lifecycle callback.
      this.report(errorInfo(thrown));
    }
  }
}

/** A document's own address, whatever its `<base>` says; one that was written into a frame has that of the page around it. */
function addressOf({ URL: address, baseURI }: Document): string {
  return address.startsWith('about:') ? baseURI : address;
}
