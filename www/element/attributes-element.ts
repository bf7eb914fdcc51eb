/** An element's attributes, and the properties beside the parameters: view, colour, camera, and the manner of the picture. */

import { errorInfo } from '../base/errors.ts';
import { FOV, FOV_BOUNDS } from '../base/fov.ts';
import { INTERACTIONS, NAVIGATIONS, QUALITY_CHOICES, THEMES } from '../base/view.ts';
import type { Backend, CameraState, ColorMode, Interaction, Navigation, Theme, View, WantedQuality } from '../base/view.ts';
import { METRES_PER_PIXEL } from '../scene/camera/orbit.ts';
import { checkCamera } from '../table/camera-bounds.ts';
import { checkNumber } from '../table/param-checks.ts';
import type { Link } from '../table/link.ts';
import { presetColor } from '../table/table.ts';
import type { Kind } from '../table/table.ts';
import { REST_SAMPLES, SAMPLES_BOUNDS } from '../renderer/limits.ts';
import { checkChoice, COMMON_ATTRIBUTES } from './attribute-reader.ts';
import type { ElementAttributes } from './attribute-reader.ts';
import type { AttributesDefinition } from './definition.ts';
import { ParamsElement } from './params-element.ts';
import { REFLECTED_PROPERTIES, writeAttribute } from './reflected-properties.ts';

/** Attributes that are no parameters and change nothing but manners. */
const MANNERS = ['poster', 'disabled', 'auto-rotate', 'controls'];

/** Where a definition says what its attributes are called. */
interface AttributeNames {
  rowAttributes: ReadonlyMap<string, unknown>;
  itemAttributes: readonly string[];
  ownAttributes: object;
}

export function observedAttributes(definition: AttributeNames): readonly string[] {
  return [...COMMON_ATTRIBUTES, ...parameterAttributes(definition), ...MANNERS];
}

function parameterAttributes({ rowAttributes, itemAttributes, ownAttributes }: AttributeNames): string[] {
  return [...rowAttributes.keys(), ...itemAttributes, ...Object.keys(ownAttributes)];
}

/** Assigned before the element was defined, these would hide the accessors. */
const PROPERTIES = [
  'params',
  'view',
  'color',
  'quality',
  'samples',
  'camera',
  'fov',
  'theme',
  'cameraOrbit',
  'interaction',
  'navigation',
  'metresPerPixel',
  'backend',
  'controls',
];

/** How things are seen, which a link tells beside the parameters. */
type Seen<K extends Kind> = Pick<Link<K>, 'view' | 'color' | 'camera'>;

export abstract class AttributesElement<K extends Kind> extends ParamsElement<K> {
  readonly #definition: AttributesDefinition<K>;
  /** Attributes that have not been read since they changed. */
  #unread: Set<string>;
  /** Null: nobody chose one, it is the preset's own. */
  #color: ColorMode | null = null;
  /** How things were seen before a link was opened whose run is still to come. */
  #beforeLink: Seen<K> | null = null;
  #interaction: Interaction = INTERACTIONS[0];
  #navigation: Navigation = NAVIGATIONS[0];
  #metresPerPixel = METRES_PER_PIXEL;

  constructor(definition: AttributesDefinition<K>) {
    super(definition);
    this.#definition = definition;
    this.#unread = new Set([...COMMON_ATTRIBUTES, ...parameterAttributes(definition)]);
  }

  // Reading.

  attributeChangedCallback(name: string, before: string | null, after: string | null): void {
    if (before === after) return;
    if (MANNERS.includes(name)) {
      this.readManners();
      return;
    }
    this.#unread.add(name);
    if (name === 'loading' && this.isConnected) this.loadUnlessLazy();
    this.schedule();
  }

  /**
   * Takes over what changed in the attributes, and nothing that was assigned and whose attribute did not change. Every getter calls it:
   * what has been set in this task counts, though it is not run yet.
   */
  protected override readAttributes(): void {
    const unread = this.#unread;
    if (unread.size === 0) return;
    this.#unread = new Set();
    const read = this.#definition.readAttributes((name) => this.getAttribute(name));
    const has = (...names: string[]) => names.some((name) => unread.has(name));
    // The parameters first: their preset decides on the colour, and whether a link is still to be run on what is kept of the time before it.
    this.#readParams(read, unread);
    this.#readSeen(read, has);
    this.sceneQuality = read.quality;
    this.sceneSamples = read.samples;
    this.sceneTheme = read.theme;
    this.#interaction = read.interaction;
    this.#navigation = read.navigation;
    this.#metresPerPixel = read.metresPerPixel;
    if (has('interaction', 'navigation')) this.readManners();
    this.changed();
    for (const { attribute, message } of read.notices) if (unread.has(attribute)) this.notify(message);
  }

  #readParams({ params, preset }: ElementAttributes<K>, unread: ReadonlySet<string>): void {
    const { table, properties, rowAttributes, itemAttributes, ownAttributes } = this.#definition;
    const isAnew = unread.has('src') || unread.has('preset');
    properties.forget(this, unread);
    if (!isAnew && parameterAttributes(this.#definition).every((name) => !unread.has(name))) return;
    let own = params;
    if (this.wanted && !isAnew) {
      own = { ...this.wanted };
      for (const [name, row] of rowAttributes) if (unread.has(name)) own = table.written(own, row, table.read(params, row));
      if (itemAttributes.some((name) => unread.has(name))) own = table.withItems(own, table.items(params));
      for (const [name, key] of Object.entries(ownAttributes)) if (unread.has(name)) own[key] = params[key];
    }
    this.want(this.#withAssigned(own));
    this.record(isAnew ? preset : undefined);
  }

  /** The colour before the look, which brings it; the camera last, since what frames the ground depends on both. */
  #readSeen(read: ElementAttributes<K>, has: (...names: string[]) => boolean): void {
    if (has('src') && !this.isSettled) this.#beforeLink ??= this.#seen;
    if (has('src', 'view')) this.sceneView = read.view;
    if (has('src', 'color')) this.#chooseColor(read.color);
    this.dress();
    if (has('camera-orbit', 'metres-per-pixel')) this.setFraming(read.orbit, read.metresPerPixel);
    if (has('fov')) this.sceneFov = read.fov;
    if (has('src', 'camera-orbit')) super.camera = read.camera;
  }

  /** Shows what a link says, as one step of undo. */
  protected showLink({ params, preset, view, color, camera }: Link<K>): void {
    this.readAttributes();
    const before = this.seenSettled;
    this.params = { ...params, preset };
    if (!this.isSettled) this.#beforeLink = before;
    this.sceneView = view;
    this.#chooseColor(color);
    this.dress();
    super.camera = camera;
    this.changed();
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

  override connectedCallback(): void {
    const { properties, list } = this.#definition;
    for (const name of [...REFLECTED_PROPERTIES, list, ...properties.names, ...PROPERTIES]) this.#upgrade(name);
    super.connectedCallback();
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

  // What a link tells beside the parameters.

  get view(): View {
    this.readAttributes();
    return this.sceneView;
  }

  set view(view: View) {
    const { views } = this.#definition.table;
    const checked = checkChoice('view', view ?? views[0], views);
    this.readAttributes();
    this.sceneView = checked;
    this.changed();
  }

  /** As the attribute; assigning `null` lets it follow the preset again. */
  get color(): ColorMode {
    this.readAttributes();
    return this.#color ?? presetColor(this.#definition.table, this.presetInUse);
  }

  set color(color: ColorMode | null) {
    const checked = color === null || color === undefined ? null : checkChoice('color', color, this.#definition.table.colors);
    this.readAttributes();
    if (checked !== this.#color) this.recolor(() => this.#chooseColor(checked));
    this.changed();
  }

  /** Null while the colour is the preset's. */
  protected get chosenColor(): ColorMode | null {
    return this.#color;
  }

  #chooseColor(color: ColorMode | null): void {
    if (color) this.sceneColor = color;
    // The renderer may have refused it.
    if (color && this.sceneColor !== color) return;
    this.#color = color;
    if (!color) this.dress();
  }

  protected override putOn(params: K['params'], preset: K['preset']): void {
    this.setSceneLook(this.#definition.lookOf(params));
    this.sceneColor = this.#color ?? presetColor(this.#definition.table, preset);
  }

  override get camera(): CameraState {
    this.readAttributes();
    return super.camera;
  }

  /** @throws {RockFieldError} naming key, value and bounds; nothing has changed. */
  override set camera(camera: CameraState | null) {
    const checked = checkCamera(camera);
    this.readAttributes();
    super.camera = checked;
  }

  /** The vertical field of view that is seen through, degrees: see the attribute. */
  get fov(): number {
    this.readAttributes();
    return this.sceneFov;
  }

  /** @throws {RockFieldError} naming key, value and bounds; nothing has changed. */
  set fov(degrees: number | `${number}` | null) {
    // Frameworks assign what is written as text, and nothing to take it away.
    const checked = checkNumber('fov', Number(degrees ?? FOV), FOV_BOUNDS, false);
    writeAttribute(this, 'fov', degrees);
    this.readAttributes();
    // The camera may have had another, of its own.
    this.sceneFov = checked;
  }

  get #seen(): Seen<K> {
    return { view: this.sceneView, color: this.#color, camera: this.hasDefaultCamera ? null : super.camera };
  }

  /** How what is settled is seen: as it was before a link whose run is still to come. */
  protected get seenSettled(): Seen<K> {
    return this.#beforeLink ?? this.#seen;
  }

  protected override settled(): void {
    this.#beforeLink = null;
  }

  protected override wentBack(isSettled: boolean): void {
    if (!this.#beforeLink || !isSettled) return;
    const { view, color, camera } = this.#beforeLink;
    this.#beforeLink = null;
    this.sceneView = view;
    this.#color = color;
    super.camera = camera;
  }

  // Manners of the picture.

  /** How much work natural colours are worth: see the attribute. */
  get quality(): WantedQuality {
    this.readAttributes();
    return this.sceneQuality;
  }

  set quality(quality: WantedQuality) {
    this.setAttribute('quality', checkChoice('quality', quality ?? QUALITY_CHOICES[0], QUALITY_CHOICES));
  }

  /** How many samples a picture at rest is refined with: see the attribute. */
  get samples(): number {
    this.readAttributes();
    return this.sceneSamples;
  }

  set samples(samples: number | `${number}` | null) {
    checkNumber('samples', typeof samples === 'string' ? Number(samples) : (samples ?? REST_SAMPLES), SAMPLES_BOUNDS, true);
    writeAttribute(this, 'samples', samples);
  }

  /** Of the picture and the panel: see the attribute. */
  get theme(): Theme {
    this.readAttributes();
    return this.sceneTheme;
  }

  set theme(theme: Theme) {
    this.setAttribute('theme', checkChoice('theme', theme ?? THEMES[0], THEMES));
    this.readAttributes();
  }

  /** What moves the camera: see the attribute. */
  get interaction(): Interaction {
    this.readAttributes();
    return this.#interaction;
  }

  set interaction(interaction: Interaction) {
    this.setAttribute('interaction', checkChoice('interaction', interaction ?? INTERACTIONS[0], INTERACTIONS));
  }

  /** How hands move the camera: see the attribute. */
  override get navigation(): Navigation {
    this.readAttributes();
    return this.#navigation;
  }

  override set navigation(navigation: Navigation) {
    this.setAttribute('navigation', checkChoice('navigation', navigation ?? NAVIGATIONS[0], NAVIGATIONS));
  }

  protected override get interactionMode(): Interaction {
    return this.#interaction;
  }

  /** As the attribute: `45deg 55deg 120%`; empty for the framing of its own. */
  get cameraOrbit(): string {
    return this.getAttribute('camera-orbit') ?? '';
  }

  set cameraOrbit(orbit: string) {
    writeAttribute(this, 'camera-orbit', orbit);
  }

  get metresPerPixel(): number {
    this.readAttributes();
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
}
