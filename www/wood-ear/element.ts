/** `<wood-ear-log>`: parameters in, a live colony of wood ears on a fallen log out. The class alone; `entries/wood-ear-log.ts` registers it. */

import { BaseHandles } from './base-handles.ts';
import type { HandlesOwner } from './base-handles.ts';
import type { Box, Subject } from '../scene/camera/camera.ts';
import { subjectOf } from '../scene/camera/subject.ts';
import type { WoodEarColony, WoodEarLog, WoodEarStats } from '../data/colony.ts';
import { abortError, errorInfo, isAbort, RockFieldError } from '../base/errors.ts';
import type { Field } from '../data/field.ts';
import type { Progress } from '../generator/protocol.ts';
import type { WoodEarStage } from './session.ts';
import { observedAttributes } from '../element/attributes-element.ts';
import { GeneratorElement } from '../element/generator-element.ts';
import type { Definition } from '../element/definition.ts';
import type { ElementEventMap } from '../element/generator-element.ts';
import { lazily } from '../base/lazy.ts';
import { loadWoodEarPanel } from './load-panel.ts';
import { besideNotice, listenToDrops, logAmong, nothingDropped } from './log-drop.ts';
import type { LogSource } from './log-file/client.ts';
import { RowProperties } from '../element/parameter-properties.ts';
import { firstHit } from '../scene/camera/pick.ts';
import { defineReflectedProperties, writeAttribute } from '../element/reflected-properties.ts';
import type { ReflectedProperties } from '../element/reflected-properties.ts';
import type { Wood } from '../renderer/renderer.ts';
import { Runs } from '../generator/runs.ts';
import { readWoodEarAttributes, WOOD_EAR_ATTRIBUTES } from './attributes.ts';
import type { WoodEarBase, WoodEarPresetName, WoodEarProperties } from './request.ts';
import { decodeWoodEarLink, encodeWoodEarLink } from './link.ts';
import { woodEarLook } from './look.ts';
import { WoodEarSceneClient } from './runs.ts';
import { isSlowThesis, timeLeft } from './patience.ts';
import { describeColony, sayOfLog, saySlow, sceneLabel } from './words.ts';
import { groundSide, WOOD_EARS } from './table.ts';
import type { WoodEars, WoodEarScene, WoodEarSceneParams } from './table.ts';

type Vector = [number, number, number];

export interface WoodEarLogEventMap extends ElementEventMap<WoodEarStage> {
  /** A colony is on screen. `superseded`: a newer one is on its way; `isPreview`: the same follows when its wood ears have made room for each other. */
  generate: CustomEvent<{ stats: WoodEarStats; colony: WoodEarColony; field: Field; superseded: boolean; isPreview: boolean }>;
  /** The user placed, moved or removed a base, or brought another log; `held`: the hand has not let go. */
  change: CustomEvent<{ params: WoodEarSceneParams; held: boolean }>;
}

const DEFINITION: Definition<WoodEars, GeneratorElement<WoodEars>> = {
  table: WOOD_EARS,
  properties: new RowProperties(WOOD_EARS, WOOD_EARS.rows),
  rowAttributes: WOOD_EAR_ATTRIBUTES,
  itemAttributes: ['bases'],
  ownAttributes: { ground: 'ground' },
  list: 'bases',
  readAttributes: readWoodEarAttributes,
  newRuns: (host) => new Runs(host, (options) => new WoodEarSceneClient(options)),
  lookOf: woodEarLook,
  groundSize: (params) => [groundSide(params), groundSide(params)],
  encode: encodeWoodEarLink,
  decode: decodeWoodEarLink,
  hash: async ({ colony }) => (await lazily(() => import('./hash.ts'))).colonyHash(colony),
  describe: async ({ colony }, metresPerPixel, language) => describeColony(colony, metresPerPixel, language),
  random: async (params, draw) => (await lazily(() => import('./controls/randomise.ts'))).randomWoodEars(params, draw),
  loadPanel: loadWoodEarPanel,
  loadExporter: async () => (await import('./export-client.ts')).exportInWorker,
};

export interface LoadLogOptions {
  /** Ends the reading; the old log stays. */
  signal?: AbortSignal | undefined;
  /** Called while a file is read that takes longer than a moment, with 0 … 1. */
  onProgress?: ((fraction: number) => void) | undefined;
}

type EventMap = Omit<HTMLElementEventMap, keyof WoodEarLogEventMap> & WoodEarLogEventMap;

/** The accessors are made from lists: of the parameter table, and of attributes. */
export interface WoodEarLogElement extends WoodEarProperties, ReflectedProperties<WoodEarPresetName> {
  addEventListener<Type extends keyof EventMap>(
    type: Type,
    listener: (this: WoodEarLogElement, event: EventMap[Type]) => void,
    options?: boolean | AddEventListenerOptions,
  ): void;
  addEventListener(type: string, listener: EventListenerOrEventListenerObject, options?: boolean | AddEventListenerOptions): void;
  removeEventListener<Type extends keyof EventMap>(
    type: Type,
    listener: (this: WoodEarLogElement, event: EventMap[Type]) => void,
    options?: boolean | EventListenerOptions,
  ): void;
  removeEventListener(type: string, listener: EventListenerOrEventListenerObject, options?: boolean | EventListenerOptions): void;
}

/** How far a colony reaches beyond the range of its base, as a share of it, and how high wood ears stand off the log, cm. */
const AROUND = { share: 0.15, cm: 6 };

/**
 * @attribute preset - Name of a preset; default `thesis-default`.
 * @attribute seed - Whole number of 32 bits. Like every other parameter of the table in kebab case, `log-length` too, it replaces what `src` or the preset says.
 * @attribute bases - Where the colonies spread from, cm: `x y z` or `x y z range` for each, with commas between them.
 * @attribute ground - What the log lies on: a preset of rocks, a link to a field of them, or `none`; natural presets lie on `forest-floor`.
 * @attribute view - `3d` or `wireframe`.
 * @attribute color - `plain` or `natural`; when absent, `natural` for natural presets and `plain` for the thesis's.
 * @attribute editable - Bases can be placed, moved and removed on the picture, and logs dropped on it as GLB, glTF or OBJ files.
 * @csspart handles - What marks the bases, where they can be edited.
 * @csspart drop - Covers the picture while files are dragged over it.
 * @fires generate - A colony is on screen; `detail` has its statistics.
 * @fires change - The user placed, moved or removed a base, or brought a log.
 */
export class WoodEarLogElement extends GeneratorElement<WoodEars> {
  static readonly observedAttributes: readonly string[] = [...observedAttributes(DEFINITION), 'editable'];

  #shown: WoodEarScene | null = null;
  #wood: Wood | null = null;
  #subject: Subject | null = null;
  /** What the subject was made for. */
  #framed: readonly unknown[] = [];
  #handles: BaseHandles | undefined;
  #listening: AbortController | undefined;
  /** What was said of the present run, which is slow. */
  #slow = '';
  /** A base is being dragged. */
  #isHeld = false;
  /** The file that is being read or tried. */
  #loading: AbortController | undefined;

  constructor() {
    super(DEFINITION);
  }

  /** Where the colonies spread from, as objects. */
  get bases(): WoodEarBase[] {
    return this.params.bases;
  }

  set bases(bases: readonly Partial<WoodEarBase>[]) {
    this.params = { ...this.params, bases: bases as WoodEarBase[] };
  }

  /** A link to the rocks that the log lies on; empty for bare soil. Assigning takes what the attribute takes. */
  get ground(): string {
    return this.params.ground;
  }

  set ground(ground: string | null) {
    writeAttribute(this, 'ground', ground === '' ? 'none' : ground);
  }

  /** Whether bases can be edited, and logs dropped, on the picture. */
  get editable(): boolean {
    return this.hasAttribute('editable');
  }

  set editable(editable: boolean) {
    this.toggleAttribute('editable', Boolean(editable));
  }

  /** All that is shown: the colony, the rocks around it, and where the log lies on them. Not to be changed. */
  get scene(): WoodEarScene | null {
    return this.#shown;
  }

  /** What is shown, the newest finished result. Not to be changed. */
  get colony(): WoodEarColony | null {
    return this.#shown?.colony ?? null;
  }

  /** The colony of the present parameters, as soon as it is finished; of newer ones where they change meanwhile. Not to be changed. */
  async getColony(): Promise<WoodEarColony> {
    return (await this.newest()).colony;
  }

  /**
   * Shows the log of a GLB, glTF or OBJ file in place of the one that is made. Resolves when it is on screen; a later call takes its place.
   *
   * @param source - A `File`, a `Blob` or its bytes. Fetch addresses first: `loadLog(await (await fetch(address)).blob())`.
   * @throws {RockFieldError} saying what is wrong with the file, or why no colony can be grown on it; the old log stays.
   * @throws {DOMException} `AbortError` when `signal` says so, `cancel()` was called, or another file took its place.
   */
  async loadLog(source: LogSource, { signal, onProgress }: LoadLogOptions = {}): Promise<void> {
    this.#loading?.abort(abortError('superseded by a newer file'));
    this.dropCandidate();
    const loading = new AbortController();
    this.#loading = loading;
    const onAbort = () => loading.abort(signal?.reason);
    if (signal?.aborted) onAbort();
    signal?.addEventListener('abort', onAbort, { once: true });
    try {
      const { readLogInWorker } = await lazily(() => import('./log-file/client.ts'));
      const tell = (fraction: number): void => {
        this.tellProgress({ stage: 'log', fraction });
        onProgress?.(fraction);
      };
      const { mesh, notices } = await readLogInWorker(source, { signal: loading.signal, onProgress: tell });
      let isShown = false;
      const taken = (): void => {
        isShown = true;
        for (const notice of notices) this.notify(notice[this.language]);
        this.emit('change', { params: this.params, held: false });
        this.invalidate();
      };
      for (let isTried = false; !isTried; isTried = await this.tryOut({ ...this.params, mesh }, taken)) loading.signal.throwIfAborted();
      if (!isShown) throw new RockFieldError({ name: 'RendererFailed', message: 'the log could not be shown' });
    } finally {
      signal?.removeEventListener('abort', onAbort);
      if (this.#loading === loading) {
        this.#loading = undefined;
        this.tellProgress(null);
      }
    }
  }

  /** Gives the running run up, and a log file that is being read; what is shown stays. */
  override cancel(): void {
    this.#loading?.abort(abortError('cancelled'));
    super.cancel();
  }

  /** Of files that were dropped or chosen together, the log; or a scene that was made here. */
  #open(files: readonly File[]): void {
    const file = logAmong(files);
    if (!file) {
      this.say(nothingDropped(this.language));
      return;
    }
    const notice = besideNotice(files, this.language);
    if (notice) this.notify(notice);
    this.#openFile(file).catch((thrown: unknown) => {
      if (isAbort(thrown)) return;
      const error = errorInfo(thrown);
      if (this.emit('error', { error, shown: false })) this.say(error.words?.[this.language] ?? error.message);
    });
  }

  async #openFile(file: File): Promise<void> {
    const { isSceneFile } = await lazily(() => import('../element/import-file.ts'));
    await ((await isSceneFile(file)) ? this.importFile(file) : this.loadLog(file));
  }

  /** Says once for each run that it is slow. */
  protected override tellProgress(progress: Progress<WoodEarStage> | null): void {
    super.tellProgress(progress);
    if (this.#slow !== '' && progress?.stage !== 'collide') {
      this.unsay(this.#slow);
      this.#slow = '';
    }
    if (!progress || this.#slow !== '' || !isSlowThesis(progress, this.params)) return;
    this.#slow = saySlow(this.language, timeLeft(progress, this.language));
    this.notify(this.#slow);
  }

  protected override present(scene: WoodEarScene): boolean {
    const { colony, ground, place } = scene;
    const wood: Wood = { colony, rings: scene.rings, meridians: scene.meridians, place };
    if (!this.showField(ground, wood)) return false;
    if (colony.log !== this.#shown?.colony.log) this.#tellOfLog(colony.log);
    this.#shown = scene;
    this.#wood = wood;
    return true;
  }

  /** What was changed in a log of one's own. */
  #tellOfLog({ turned }: WoodEarLog): void {
    const { scale = 1 } = this.params.mesh ?? {};
    if (turned) this.notify(sayOfLog(this.language, 'turned'));
    if (scale !== 1) this.notify(sayOfLog(this.language, 'scaled'));
  }

  protected override detailOf(
    { colony, ground }: WoodEarScene,
    superseded: boolean,
    isPreview: boolean,
  ): WoodEarLogEventMap['generate']['detail'] {
    return { stats: colony.stats, colony, field: ground, superseded, isPreview };
  }

  protected override get label(): string {
    return sceneLabel(this.language);
  }

  /** It stays while bases are edited: the picture must not jump from under the hand. */
  protected override get subject(): Subject {
    const { params, preset } = this.onScreen;
    const framed = [preset, params.log.length, params.mesh];
    if (!this.#subject || framed.some((value, k) => value !== this.#framed[k])) this.#subject = subjectOf(shownOf(params));
    this.#framed = framed;
    return this.#subject;
  }

  override frameAll(animate = true): void {
    this.#subject = null;
    super.frameAll(animate);
  }

  override attributeChangedCallback(name: string, before: string | null, after: string | null): void {
    if (name !== 'editable') super.attributeChangedCallback(name, before, after);
    else this.invalidate();
  }

  protected override opened(): void {
    super.opened();
    this.#listening = new AbortController();
    const { signal } = this.#listening;
    this.#handles = new BaseHandles(this.shadowRoot as ShadowRoot, this.#handlesOwner(), signal);
    const root = this.shadowRoot as ShadowRoot;
    listenToDrops(
      this,
      {
        root,
        language: () => this.language,
        isOpen: () => this.editable && !this.hasAttribute('disabled'),
        open: (files) => this.#open(files),
      },
      signal,
    );
  }

  protected override closed(): void {
    this.#listening?.abort();
    this.#loading?.abort(abortError('the element was taken out of the document'));
    this.#handles = undefined;
    super.closed();
  }

  protected override drawn(): void {
    this.#handles?.update();
  }

  /** The user's doing: whoever keeps the parameters is told. */
  #change(params: WoodEarSceneParams): void {
    this.params = params;
    this.emit('change', { params: this.params, held: this.#isHeld });
    this.invalidate();
  }

  #handlesOwner(): HandlesOwner {
    const at = ([x, y, z]: Vector): Vector => {
      const [px, py, pz, scale] = this.#wood?.place ?? [0, 0, 0, 1];
      return [(x - px) / scale, (y - py) / scale, (z - pz) / scale];
    };
    const withBases = (change: (bases: WoodEarBase[]) => WoodEarBase[]): void => {
      const { params } = this;
      const bases = change(params.bases);
      const { min, max } = WOOD_EARS.itemCount;
      if (bases.length >= min && bases.length <= max) this.#change({ ...params, bases });
    };
    return {
      stage: this.stage,
      camera: () => this.camera,
      aspect: () => this.aspect,
      language: () => this.language,
      isEditable: () => this.editable && !this.hasAttribute('disabled') && this.#wood !== null,
      bases: () => {
        const [px, py, pz, scale] = this.#wood?.place ?? [0, 0, 0, 1];
        // Where they are on the log; those that have just been moved are not there yet.
        const snapped = this.#shown?.colony.bases ?? [];
        return this.params.bases.map(({ position }, k) => {
          const [x, y, z] =
            this.#isHeld || snapped.length !== 3 * this.params.bases.length
              ? position
              : (Array.from(snapped.slice(3 * k, 3 * k + 3)) as Vector);
          return [px + scale * x, py + scale * y, pz + scale * z];
        });
      },
      surface: (ray) => {
        const { colony } = this.#shown ?? {};
        if (!colony) return null;
        const scale = this.#wood?.place[3] ?? 1;
        const hit = firstHit(
          { from: at(ray.from), along: ray.along.map((value) => value / scale) as Vector },
          colony.log.positions,
          colony.log.indices,
        );
        return hit && (hit.map((value) => Math.round(10 * value) / 10) as Vector);
      },
      place: (position) => withBases((bases) => [...bases, { position, range: null }]),
      move: (index, position) => withBases((bases) => bases.map((base, k) => (k === index ? { ...base, position } : base))),
      remove: (index) => withBases((bases) => bases.filter((_, k) => k !== index)),
      hold: (isHeld) => {
        this.#isHeld = isHeld;
        this.hold(isHeld);
        if (!isHeld) this.emit('change', { params: this.params, held: false });
        this.invalidate();
      },
    };
  }
}

/** The colonies with what of the log lies between them, px. */
function shownOf(params: WoodEarSceneParams): Box {
  const middle = groundSide(params) / 2;
  const half = params.log.length / 2;
  const { radius } = params.log;
  const [low, high] = [-1, 1].map((side) => {
    const reach = params.bases.map(({ position: [x], range }) => side * x + (range ?? params.range) * (1 + AROUND.share));
    return side * Math.min(half, Math.max(...reach));
  }) as [number, number];
  const height = 1.4 * radius;
  return { low: [middle + low, middle - radius - AROUND.cm, 0], high: [middle + high, middle + radius + AROUND.cm, height + AROUND.cm] };
}

DEFINITION.properties.define(WoodEarLogElement.prototype);
defineReflectedProperties(WoodEarLogElement.prototype);
