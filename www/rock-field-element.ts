/** `<rock-field>`: parameters in, a live field of rocks out. The class alone; `rock-field.ts` registers it. */

import type { Edition } from './controls/store.ts';
import type { ControlsButton } from './controls-button.ts';
import { ATTRIBUTES, checkChoice, COLORS, FIELD_ATTRIBUTES, INTERACTIONS, LAYER_ATTRIBUTES, METRES_PER_PIXEL, QUALITY_CHOICES, readAttributes, VIEWS } from './element-attributes.ts';
import type { Interaction } from './element-attributes.ts';
import { errorInfo, RockFieldError } from './errors.ts';
import type { ErrorInfo } from './errors.ts';
import type { Field, FieldStats } from './field.ts';
import { FieldRuns } from './field-runs.ts';
import type { Progress } from './generator/protocol.ts';
import { History } from './history.ts';
import { lookOf, presetColor, sameLook, sameRocks } from './look.ts';
import { PRESETS } from './params.ts';
import type { Layer, Params, PresetName } from './params.ts';
import type { FieldRequest, LayerRequest } from './params-flat.ts';
import { copyParams, defaultParams, readValue, resolveParams, writeValue } from './params-flat.ts';
import { defineParameterProperties, forgetAssigned, keepLocked, PARAMETER_PROPERTIES, withAssigned } from './parameter-properties.ts';
import type { ParameterProperties } from './parameter-properties.ts';
import { defineReflectedProperties, REFLECTED_PROPERTIES, writeAttribute } from './reflected-properties.ts';
import type { ReflectedProperties } from './reflected-properties.ts';
import type { WantedQuality } from './renderer/quality.ts';
import type { Backend, CameraState, ColorMode, View } from './renderer/renderer.ts';
import { SceneElement } from './scene-element.ts';
import type { Theme } from './scene-element.ts';
import { encodeLink } from './url-codec.ts';

/** The events, by name, with their details. None bubbles; all are composed. */
export interface RockFieldEventMap {
  /** The first picture of a cycle has been painted. */
  load: CustomEvent<null>;
  /** A run of more than 200 ms is under way. */
  progress: CustomEvent<Progress>;
  /** A field is finished and on screen. `superseded`: a newer one is on its way. */
  generate: CustomEvent<{ stats: FieldStats; field: Field; superseded: boolean }>;
  error: CustomEvent<{ error: ErrorInfo }>;
  /** The user moved the camera, or asked for the whole field. */
  'camera-change': CustomEvent<{ camera: CameraState; framed: boolean }>;
  /** The picture is back after a loss of the device. */
  restored: CustomEvent<null>;
  /** An attribute could not be taken as it stood. */
  notice: CustomEvent<{ message: string }>;
}

/** Assigned before the element was defined, these would hide the accessors. */
const PROPERTIES: readonly string[] = [
  ...REFLECTED_PROPERTIES, 'params', 'layers', ...PARAMETER_PROPERTIES,
  'view', 'color', 'quality', 'camera', 'theme', 'cameraOrbit', 'interaction', 'metresPerPixel', 'backend', 'controls',
];

/** Attributes that are no parameters and change nothing but manners. */
const MANNERS = ['poster', 'disabled', 'auto-rotate', 'controls'];

/** The accessors are made from lists: of the parameter table, and of attributes. */
export interface RockFieldElement extends ParameterProperties, ReflectedProperties {
  addEventListener<Type extends keyof EventMap>(type: Type, listener: (this: RockFieldElement, event: EventMap[Type]) => void, options?: boolean | AddEventListenerOptions): void;
  addEventListener(type: string, listener: EventListenerOrEventListenerObject, options?: boolean | AddEventListenerOptions): void;
  removeEventListener<Type extends keyof EventMap>(type: Type, listener: (this: RockFieldElement, event: EventMap[Type]) => void, options?: boolean | EventListenerOptions): void;
  removeEventListener(type: string, listener: EventListenerOrEventListenerObject, options?: boolean | EventListenerOptions): void;
}

type EventMap = Omit<HTMLElementEventMap, keyof RockFieldEventMap> & RockFieldEventMap;

/**
 * @attribute preset - Name of a preset; default `journal-fig1`.
 * @attribute src - A share link or its fragment, or parameters as JSON; fills everything.
 * @attribute seed - Whole number of 32 bits. Like every other parameter of the table in kebab case it replaces what `src` or the preset says.
 * @attribute radius - Disc radii, one per layer: `90 30 10`. Every other parameter of a layer is such a list too.
 * @attribute view - `3d`, `wireframe`, `diagrams` or `selection`.
 * @attribute color - `layer`, `rock`, `plain` or `natural`; when absent, `natural` for natural presets and `layer` for the papers'.
 * @attribute quality - `low`, `medium` or `high`, of natural colours; `auto`: as well as motion flows, and `high` at rest.
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
 * @fires generate - A field is finished and on screen; `detail` has its statistics.
 * @fires error - What went wrong, as data.
 * @fires camera-change - The user moved the camera, or asked for the whole field.
 * @fires restored - The picture is back after a loss of the device.
 * @fires notice - An attribute could not be taken as it stood.
 */
export class RockFieldElement extends SceneElement {
  static readonly observedAttributes: readonly string[] = [...ATTRIBUTES, ...MANNERS];

  #runs = new FieldRuns({
    onField: (field, superseded, params) => this.#show(field, superseded, params),
    onProgress: (progress) => this.#tellProgress(progress),
    onError: (error) => this.report(error),
  });
  /** Null before the attributes have been read. */
  #params: Params | null = null;
  /** Attributes that have not been read since they changed. */
  #unread = new Set<string>(ATTRIBUTES);
  #scheduled = false;
  /** Steps of `undo`, of the panel and of code alike; edits that follow each other closely are one. */
  #history: History<Edition> | undefined;
  #controls: ControlsButton | undefined;
  /** Null: nobody chose one, it is the preset's own. */
  #color: ColorMode | null = null;
  /** What the field on screen was made from. */
  #shown: Params | null = null;
  /** What runs under way were written against. */
  #presets = new WeakMap<Params, PresetName>();
  #interaction: Interaction = INTERACTIONS[0];
  #metresPerPixel = METRES_PER_PIXEL;

  /**
   * All parameters; a copy, both ways. Assigning starts a run, the latest wins; several assignments in one task are one run. What
   * is only seen, like `dust` or `sunAzimuth`, starts none.
   *
   * @throws {RockFieldError} naming key, value and bounds; nothing has changed.
   */
  get params(): Params {
    this.#readAttributes();
    return copyParams(this.#params ?? defaultParams());
  }

  set params(params: Params & Pick<FieldRequest, 'preset'>) {
    const resolved = resolveParams(params);
    this.#readAttributes();
    this.#takeParams(resolved);
    this.#record(params.preset);
    this.#dress();
    this.#schedule();
  }

  #setParams(params: Params): void {
    const isDressed = this.#params !== null && sameRocks(this.#params, params) && !sameLook(this.#params, params);
    if (!isDressed) this.#runs.stale = true;
    this.#params = params;
  }

  get #preset(): PresetName {
    return this.#history?.present.preset ?? PRESETS[0].name;
  }

  /** Shows the parameters' look, unless their rocks are still to come: these then bring it. */
  #dress(): void {
    const params = this.#params;
    const isPending = this.field !== null && !this.#runs.isSettled && !(params && this.#shown && sameRocks(this.#shown, params));
    if (params && !isPending) this.#putOn(params, this.#preset);
  }

  #putOn(params: Params, preset: PresetName): void {
    this.setSceneLook(lookOf(params));
    this.sceneColor = this.#color ?? presetColor(preset);
  }

  #takeParams(params: Params): void {
    forgetAssigned(this);
    this.#setParams(params);
  }

  /** What says the same as the present is no step: the panel's edits come here when they are in the history already. */
  #record(preset: PresetName = this.#preset): void {
    if (!this.#params) return;
    const edition: Edition = { params: this.#params, preset };
    if (!this.#history) this.#history = new History(edition);
    else if (JSON.stringify(edition) !== JSON.stringify(this.#history.present)) this.#history.record(edition, 'edit', performance.now());
    this.#controls?.sync();
  }

  /** The layers as objects; what an entry leaves out has the table's default. */
  get layers(): Layer[] {
    return this.params.layers;
  }

  set layers(layers: readonly LayerRequest[]) {
    this.params = { ...this.params, layers: layers as Layer[] };
  }

  get view(): View {
    this.#readAttributes();
    return this.sceneView;
  }

  set view(view: View) {
    const checked = checkChoice('view', view ?? VIEWS[0], VIEWS);
    this.#readAttributes();
    this.sceneView = checked;
    this.#controls?.sync();
  }

  /** As the attribute; assigning `null` lets it follow the preset again. */
  get color(): ColorMode {
    this.#readAttributes();
    return this.#color ?? presetColor(this.#preset);
  }

  set color(color: ColorMode | null) {
    const checked = color === null || color === undefined ? null : checkChoice('color', color, COLORS);
    this.#readAttributes();
    this.#chooseColor(checked);
    this.#controls?.sync();
  }

  #chooseColor(color: ColorMode | null): void {
    this.#color = color;
    if (color) this.sceneColor = color;
    else this.#dress();
  }

  /** How much work natural colours are worth: see the attribute. */
  get quality(): WantedQuality {
    this.#readAttributes();
    return this.sceneQuality;
  }

  set quality(quality: WantedQuality) {
    this.setAttribute('quality', checkChoice('quality', quality ?? QUALITY_CHOICES[0], QUALITY_CHOICES));
  }

  override get theme(): Theme {
    return super.theme;
  }

  override set theme(theme: Theme) {
    super.theme = theme;
    this.#controls?.sync();
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

  override set camera(camera: CameraState | null) {
    this.#readAttributes();
    super.camera = camera;
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

  /** A link that shows this field: `base`, the page's own address by default, with the parameters as its fragment. */
  shareURL(base: string = document.baseURI): string {
    const url = new URL(base, document.baseURI);
    const { params, view, color, framed, camera } = this;
    url.hash = encodeLink({ params, preset: this.#preset, view, color, camera: framed ? null : camera });
    return url.href;
  }

  /**
   * Other rocks by lot, of parameters by lot. Properties named in `lock` keep their values.
   *
   * @throws {RockFieldError} `UnknownKey` for a name in `lock` that is no parameter.
   */
  async randomize({ lock = [] }: { lock?: readonly string[] } = {}): Promise<void> {
    const stranger = lock.find((name) => name !== 'layers' && !PARAMETER_PROPERTIES.includes(name));
    if (stranger !== undefined) throw new RockFieldError({ name: 'UnknownKey', key: stranger, message: `there is no parameter called ${JSON.stringify(stranger)}` });
    const [seed, { randomParams }] = await Promise.all([this.freshSeed(), import('./controls/randomise.ts')]);
    const params = keepLocked(randomParams(this.params, seed), this.params, lock);
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
      this.#dress();
      this.#schedule();
      this.#controls?.sync();
    }
    return moved;
  }

  /** Runs now. Resolves with the field; rejects with an AbortError when a newer run supersedes it, else with a RockFieldError. */
  generate(): Promise<Field> {
    this.start();
    const { params } = this;
    this.#presets.set(params, this.#preset);
    return this.#runs.start(params);
  }

  #tellProgress(progress: Progress | null): void {
    this.showProgress(progress?.fraction ?? null);
    if (progress) this.emit('progress', progress);
  }

  /** Gives the running run up; what is shown stays. */
  cancel(): void {
    this.#runs.cancel();
  }

  /** A fresh random seed, which the caller may put into `params`. */
  freshSeed(): Promise<number> {
    return this.#runs.freshSeed();
  }

  /** The field of the present parameters, as soon as it is finished; of newer ones where they change meanwhile. Not to be changed. */
  getField(): Promise<Field> {
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
    this.#schedule();
  }

  override connectedCallback(): void {
    for (const name of PROPERTIES) this.#upgrade(name);
    super.connectedCallback();
  }

  protected override opened(): void {
    this.#runs.open();
    // After a pause the field is still there.
    if (!this.field) this.#runs.stale = true;
    this.#schedule();
    this.#controls?.begin();
  }

  protected override closed(): void {
    this.#controls?.close();
    this.#runs.close();
  }

  protected override readManners(): void {
    super.readManners();
    if (this.controls && !this.#controls) void this.#loadControls();
    this.#controls?.update();
  }

  /** Few elements have a panel: for the others nothing of it is fetched. */
  async #loadControls(): Promise<void> {
    try {
      const { ControlsButton } = await import('./controls-button.ts');
      this.#controls ??= this.#newControls(ControlsButton);
      this.#controls.update();
    } catch (thrown) {
      this.report(errorInfo(thrown));
    }
  }

  #newControls(Button: typeof ControlsButton): ControlsButton {
    return new Button({
      element: this,
      root: this.shadowRoot as ShadowRoot,
      language: () => this.language,
      isOpen: () => this.#runs.isOpen,
      isSettled: () => this.#runs.isSettled,
      chosenColor: () => this.#color,
      history: () => {
        this.#readAttributes();
        return (this.#history ??= new History<Edition>({ params: this.params, preset: PRESETS[0].name }));
      },
      say: (text) => this.notify(text),
    });
  }

  protected override groundSize(): [number, number] {
    const { imageWidth, imageHeight } = this.#params ?? defaultParams();
    return [imageWidth, imageHeight];
  }

  #show(field: Field, superseded: boolean, params: Params): void {
    if (!this.showField(field)) return;
    this.#shown = params;
    // Its look may have been edited since it was asked for.
    if (this.#params && sameRocks(this.#params, params)) this.#putOn(this.#params, this.#preset);
    else this.#putOn(params, this.#presets.get(params) ?? this.#preset);
    // Without these words the picture is still a picture.
    this.#describe(field).catch((thrown: unknown) => console.warn(thrown));
    this.emit('generate', { stats: field.stats, field, superseded });
  }

  async #describe(field: Field): Promise<void> {
    const { describeField } = await import('./field-description.ts');
    if (this.field === field) this.describe(describeField(field, this.#metresPerPixel, this.language));
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
    const read = readAttributes((name) => this.getAttribute(name));
    const { params } = read;
    const has = (...names: string[]) => names.some((name) => unread.has(name));
    forgetAssigned(this, unread);
    if (!this.#params || has('src', 'preset')) {
      this.#setParams(this.#withAssigned(params));
    } else {
      const own = { ...this.#params };
      for (const [name, spec] of FIELD_ATTRIBUTES) if (has(name)) writeValue(own, spec, readValue(params, spec));
      if (has(...LAYER_ATTRIBUTES.keys())) own.layers = params.layers;
      if (has(...FIELD_ATTRIBUTES.keys(), ...LAYER_ATTRIBUTES.keys())) this.#setParams(this.#withAssigned(own));
    }
    if (has('src', 'preset', ...FIELD_ATTRIBUTES.keys(), ...LAYER_ATTRIBUTES.keys())) this.#record(has('src', 'preset') ? read.preset : undefined);
    if (has('src', 'view')) this.sceneView = read.view;
    if (has('src', 'color')) this.#chooseColor(read.color);
    this.#dress();
    if (has('src')) super.camera = read.camera;
    if (has('camera-orbit', 'metres-per-pixel')) this.setFraming(read.orbit, read.metresPerPixel);
    if (has('camera-orbit')) super.camera = read.camera;
    this.sceneQuality = read.quality;
    this.#interaction = read.interaction;
    this.#metresPerPixel = read.metresPerPixel;
    if (has('interaction')) this.readManners();
    this.#controls?.sync();
    for (const { attribute, message } of read.notices) if (unread.has(attribute)) this.notify(message);
  }

  #withAssigned(params: Params): Params {
    try {
      return withAssigned(this, params);
    } catch (thrown) {
      // Of a layer that is no more, or in a notation with other bounds. Nothing may be thrown out of a lifecycle callback.
      forgetAssigned(this);
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

defineParameterProperties(RockFieldElement.prototype);
defineReflectedProperties(RockFieldElement.prototype);
