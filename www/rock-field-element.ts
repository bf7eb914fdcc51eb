/** `<rock-field>`: parameters in, a live field of rocks out. The class alone; `rock-field.ts` registers it. */

import { ATTRIBUTES, COLORS, readAttributes, VIEWS } from './element-attributes.ts';
import { errorInfo, RockFieldError } from './errors.ts';
import type { ErrorInfo } from './errors.ts';
import type { Field, FieldStats } from './field.ts';
import { GeneratorClient } from './generator/client.ts';
import type { Progress } from './generator/protocol.ts';
import type { Params } from './params.ts';
import { copyParams, defaultParams, resolveParams } from './params-flat.ts';
import type { CameraState, ColorMode, View } from './renderer/renderer.ts';
import { SceneElement } from './scene-element.ts';

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

const WORDS = { waiting: { en: 'Field of rocks', ja: '岩の地面' } } as const;

/** Assigned before the element was defined, these would hide the accessors. */
const PROPERTIES = ['params', 'view', 'color', 'camera', 'theme'] as const;

/**
 * @attribute preset - Name of a preset; default `journal-fig1`.
 * @attribute seed - Whole number; replaces the seed of `src` or of the preset.
 * @attribute src - A share link, or its fragment; fills everything.
 * @attribute view - `3d`, `wireframe`, `diagrams` or `selection`.
 * @attribute color - `layer`, `rock` or `plain`.
 * @attribute backend - `auto`, `webgpu`, `webgl`, `canvas2d` or `null` (draws nothing); read when the element is connected.
 * @fires load
 * @fires progress
 * @fires generate
 * @fires error
 * @fires camera-change
 * @fires restored
 * @fires notice
 */
export class RockFieldElement extends SceneElement {
  static readonly observedAttributes: readonly string[] = ATTRIBUTES;

  #client: GeneratorClient | undefined;
  /** Null before the attributes have been read. */
  #params: Params | null = null;
  /** Attributes that have not been read since they changed. */
  #unread = new Set<string>(ATTRIBUTES);
  /** What is shown, or on its way, is not what the parameters say. */
  #stale = true;
  #scheduled = false;
  /** The newest run; settles with its field. */
  #run: Promise<Field> | undefined;
  #isOpen = false;

  /**
   * All parameters; a copy, both ways. Assigning starts a run, the latest wins; several assignments in one task are one run.
   *
   * @throws {RockFieldError} naming key, value and bounds; nothing has changed.
   */
  get params(): Params {
    this.#readAttributes();
    return copyParams(this.#params ?? defaultParams());
  }

  set params(params: Params) {
    const resolved = resolveParams(params);
    this.#readAttributes();
    this.#params = resolved;
    this.#stale = true;
    this.#schedule();
  }

  get view(): View {
    this.#readAttributes();
    return this.sceneView;
  }

  set view(view: View) {
    const checked = checkChoice('view', view, VIEWS);
    this.#readAttributes();
    this.sceneView = checked;
  }

  get color(): ColorMode {
    this.#readAttributes();
    return this.sceneColor;
  }

  set color(color: ColorMode) {
    const checked = checkChoice('color', color, COLORS);
    this.#readAttributes();
    this.sceneColor = checked;
  }

  override get camera(): CameraState {
    return super.camera;
  }

  override set camera(camera: CameraState | null) {
    this.#readAttributes();
    super.camera = camera;
  }

  /** Runs now. Resolves with the field; rejects with an AbortError when a newer run supersedes it, else with a RockFieldError. */
  generate(): Promise<Field> {
    if (!this.#isOpen) {
      return Promise.reject(new RockFieldError({ name: 'NotConnected', message: 'put the element into the document first' }));
    }
    this.#stale = false;
    const run = this.#generator().generate(this.params, { onProgress: (progress) => this.emit('progress', progress) });
    this.#run = run;
    run.catch((thrown: unknown) => {
      if (!isAbort(thrown)) this.report(errorInfo(thrown));
    });
    return run;
  }

  /** Gives the running run up; what is shown stays. */
  cancel(): void {
    this.#stale = false;
    this.#client?.cancel();
  }

  /** A fresh random seed, which the caller may put into `params`. */
  async freshSeed(): Promise<number> {
    if (!this.#isOpen) throw new RockFieldError({ name: 'NotConnected', message: 'put the element into the document first' });
    return this.#generator().freshSeed();
  }

  /** The field of the present parameters, as soon as it is finished. Not to be changed. */
  getField(): Promise<Field> {
    return this.#stale || !this.#run ? this.generate() : this.#run;
  }

  attributeChangedCallback(name: string, before: string | null, after: string | null): void {
    if (before === after) return;
    this.#unread.add(name);
    this.#schedule();
  }

  override connectedCallback(): void {
    for (const name of PROPERTIES) this.#upgrade(name);
    super.connectedCallback();
  }

  protected override opened(): void {
    this.#isOpen = true;
    // After a pause the field is still there.
    if (!this.field) {
      this.#stale = true;
      this.describe(WORDS.waiting[this.language]);
    }
    this.#schedule();
  }

  protected override closed(): void {
    this.#isOpen = false;
    if (this.#client?.busy) this.#stale = true;
    this.#client?.dispose();
    this.#client = undefined;
    this.#run = undefined;
  }

  protected override groundSize(): [number, number] {
    const { imageWidth, imageHeight } = this.#params ?? defaultParams();
    return [imageWidth, imageHeight];
  }

  #generator(): GeneratorClient {
    this.#client ??= new GeneratorClient({ onField: (field, superseded) => this.#show(field, superseded) });
    return this.#client;
  }

  #show(field: Field, superseded: boolean): void {
    if (!this.showField(field)) return;
    this.describe(describe(field, this.language));
    this.emit('generate', { stats: field.stats, field, superseded });
  }

  /** Reads and runs at the end of this task, once, however many attributes and properties are set in it. */
  #schedule(): void {
    if (this.#scheduled || !this.#isOpen) return;
    this.#scheduled = true;
    queueMicrotask(() => {
      this.#scheduled = false;
      if (!this.#isOpen) return;
      this.#readAttributes();
      if (this.#stale) this.generate().catch(() => undefined); // reported there
    });
  }

  /** Takes over what changed in the attributes, and nothing that was assigned and whose attribute did not change. */
  #readAttributes(): void {
    const unread = this.#unread;
    if (unread.size === 0) return;
    this.#unread = new Set();
    const { params, view, color, camera, notices } = readAttributes((name) => this.getAttribute(name));
    if (!this.#params || unread.has('src') || unread.has('preset')) this.#params = params;
    else if (unread.has('seed')) this.#params = { ...this.#params, seed: params.seed };
    if (unread.has('src') || unread.has('preset') || unread.has('seed')) this.#stale = true;
    if (unread.has('src') || unread.has('view')) this.sceneView = view;
    if (unread.has('src') || unread.has('color')) this.sceneColor = color;
    if (unread.has('src')) super.camera = camera;
    for (const { attribute, message } of notices) if (unread.has(attribute)) this.notify(message);
  }

  #upgrade(name: (typeof PROPERTIES)[number]): void {
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

function checkChoice<T extends string>(key: string, value: T, choices: readonly T[]): T {
  if (choices.includes(value)) return value;
  const message = `${key} is ${JSON.stringify(value)}; it has to be one of ${choices.join(', ')}`;
  throw new RockFieldError({ name: 'OutOfRange', key, value, message });
}

function isAbort(thrown: unknown): boolean {
  return thrown instanceof DOMException && thrown.name === 'AbortError';
}

function describe({ stats, layers }: Field, language: 'en' | 'ja'): string {
  const rocks = new Intl.NumberFormat(language).format(stats.rocks);
  const covered = new Intl.NumberFormat(language, { style: 'percent' }).format(stats.coveredFraction);
  if (language === 'ja') return `${layers.length}種類の大きさの岩${rocks}個、被覆率${covered}`;
  const sizes = layers.length === 1 ? 'one size' : `${layers.length} sizes`;
  return `${rocks} ${stats.rocks === 1 ? 'rock' : 'rocks'} in ${sizes}, ${covered} covered`;
}
