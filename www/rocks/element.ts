/** `<rock-field>`: parameters in, a live field of rocks out. The class alone; `entries/rock-field.ts` registers it. */

import { FIELD_ATTRIBUTES, LAYER_ATTRIBUTES, readAttributes } from './attributes.ts';
import type { Field, FieldStats } from '../data/field.ts';
import { GeneratorClient } from './client.ts';
import type { StageName } from '../generator/protocol.ts';
import { observedAttributes } from '../element/attributes-element.ts';
import { GeneratorElement } from '../element/generator-element.ts';
import type { Definition } from '../element/definition.ts';
import type { ElementEventMap } from '../element/generator-element.ts';
import { lazily } from '../base/lazy.ts';
import { loadPanel } from './load-panel.ts';
import { lookOf } from './look.ts';
import type { Mask, MaskRows } from './mask.ts';
import type { Layer, ParameterProperties, PresetName } from './params.ts';
import type { LayerRequest } from './request.ts';
import { RowProperties } from '../element/parameter-properties.ts';
import { defineReflectedProperties } from '../element/reflected-properties.ts';
import type { ReflectedProperties } from '../element/reflected-properties.ts';
import { ROCKS } from './table.ts';
import type { Rocks } from './table.ts';
import { Runs } from '../generator/runs.ts';
import { decodeLink, encodeLink } from './link.ts';

export interface RockFieldEventMap extends ElementEventMap<StageName> {
  /** A field is finished and on screen. `superseded`: a newer one is on its way. */
  generate: CustomEvent<{ stats: FieldStats; field: Field; superseded: boolean }>;
}

/** What says how dense the rocks of an element stand where. */
const masks = new WeakMap<HTMLElement, MaskRows | undefined>();

const DEFINITION: Definition<Rocks, GeneratorElement<Rocks>> = {
  table: ROCKS,
  properties: new RowProperties(ROCKS, [...ROCKS.rows, ...ROCKS.itemRows]),
  rowAttributes: FIELD_ATTRIBUTES,
  itemAttributes: [...LAYER_ATTRIBUTES.keys()],
  ownAttributes: { strokes: 'strokes' },
  list: 'layers',
  readAttributes,
  newRuns: (host, element) => new Runs(host, (options) => new GeneratorClient(options, () => masks.get(element))),
  lookOf,
  groundSize: ({ imageWidth, imageHeight }) => [imageWidth, imageHeight],
  encode: encodeLink,
  decode: decodeLink,
  hash: async (field) => (await lazily(() => import('./hash.ts'))).fieldHash(field),
  describe: async (field, metresPerPixel, language) =>
    (await lazily(() => import('./description.ts'))).describeField(field, metresPerPixel, language),
  random: async (params, draw) => (await lazily(() => import('./controls/randomise.ts'))).randomParams(params, draw),
  loadPanel,
  loadExporter: async () => (await import('./export-client.ts')).exportInWorker,
};

/** The accessors are made from lists: of the parameter table, and of attributes. */
export interface RockFieldElement extends ParameterProperties, ReflectedProperties<PresetName> {
  addEventListener<Type extends keyof EventMap>(
    type: Type,
    listener: (this: RockFieldElement, event: EventMap[Type]) => void,
    options?: boolean | AddEventListenerOptions,
  ): void;
  addEventListener(type: string, listener: EventListenerOrEventListenerObject, options?: boolean | AddEventListenerOptions): void;
  removeEventListener<Type extends keyof EventMap>(
    type: Type,
    listener: (this: RockFieldElement, event: EventMap[Type]) => void,
    options?: boolean | EventListenerOptions,
  ): void;
  removeEventListener(type: string, listener: EventListenerOrEventListenerObject, options?: boolean | EventListenerOptions): void;
}

type EventMap = Omit<HTMLElementEventMap, keyof RockFieldEventMap> & RockFieldEventMap;

/**
 * @attribute preset - Name of a preset; default `journal-fig1`.
 * @attribute seed - Whole number of 32 bits. Like every other parameter of the table in kebab case it replaces what `src` or the preset says.
 * @attribute radius - Disc radii, one per layer: `90 30 10`. Every other parameter of a layer is such a list too.
 * @attribute strokes - Painted strokes as a link has them: where rocks are added, erased, kept off a path, or as if nothing had been painted.
 * @attribute view - `3d`, `wireframe`, `diagrams` or `selection`.
 * @attribute color - `layer`, `rock`, `plain` or `natural`; when absent, `natural` for natural presets and `layer` for the papers'.
 * @fires generate - A field is finished and on screen; `detail` has its statistics.
 */
export class RockFieldElement extends GeneratorElement<Rocks> {
  static readonly observedAttributes: readonly string[] = observedAttributes(DEFINITION);

  constructor() {
    super(DEFINITION);
  }

  /** The layers as objects; what an entry leaves out has the table's default. */
  get layers(): Layer[] {
    return this.params.layers;
  }

  set layers(layers: readonly LayerRequest[]) {
    this.params = { ...this.params, layers: layers as Layer[] };
  }

  /** Painted strokes as links have them; `strokesToText` of `rock-field/core` makes such text. Empty: none. */
  get strokes(): string {
    return this.params.strokes ?? '';
  }

  set strokes(strokes: string | null) {
    this.params = { ...this.params, strokes: strokes ?? undefined };
  }

  /**
   * A picture over the whole ground says how dense the rocks stand where: white as the layers ask, black not at all. `null` takes it away. Resolves
   * when what it makes, or what is newer, is on screen. It is no parameter: no link has it, and no step of `undo()`.
   *
   * @param mask pixels as in `ImageData`, a picture file, or its address; of an animated one, the first picture.
   * @throws {RockFieldError} `MaskUnreadable`; about its size; what `generate()` rejects with. Then the mask is the one of before.
   */
  async setMask(mask: Mask | Blob | URL | string | null): Promise<void> {
    await (await lazily(() => import('./mask-image.ts'))).setMask(this, masks, mask);
  }

  /** Whether a mask is set. */
  get hasMask(): boolean {
    return masks.get(this) !== undefined;
  }

  /** The field of the present parameters, as soon as it is finished; of newer ones where they change meanwhile. Not to be changed. */
  getField(): Promise<Field> {
    return this.newest();
  }

  protected override present(field: Field): boolean {
    return this.showField(field);
  }

  protected override detailOf(field: Field, superseded: boolean): RockFieldEventMap['generate']['detail'] {
    return { stats: field.stats, field, superseded };
  }
}

DEFINITION.properties.define(RockFieldElement.prototype);
defineReflectedProperties(RockFieldElement.prototype);
