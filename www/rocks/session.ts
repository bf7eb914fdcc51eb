/** Sessions of rocks: the buffers of the wasm as a `Field`. */

import { RockFieldError } from '../base/errors.ts';
import type { Field, FieldLayer, StageTimes } from '../data/field.ts';
import type { LoopCraft } from '../generator/loop.ts';
import { STAGES } from '../generator/protocol.ts';
import type { FlatRequest, StageName } from '../generator/protocol.ts';
import { Session } from '../generator/session.ts';
import type { Craft, RawSteps } from '../generator/session.ts';
import type { Glue } from '../generator/wasm.ts';
import { needsFull } from './needs-full.ts';

/** The class of the same name in pkg/generator.d.ts, as far as it is used. */
export interface RawGenerator extends RawSteps {
  /** Six numbers for each triangle, px; acts from the next start. */
  set_footprint(triangles: Float64Array): void;
  start(params: Float64Array, maxBytes: number): void;
  positions(): Float32Array;
  normals(): Float32Array;
  indices(): Uint32Array;
  rock_starts(): Uint32Array;
  vertex_starts(): Uint32Array;
  rock_layer(): Uint8Array;
  layer_sites(k: number): Float32Array;
  layer_cell_starts(k: number): Uint32Array;
  layer_cell_vertices(k: number): Float32Array;
  layer_selected(k: number): Uint32Array;
  /** `[id, radius px, targetSites, sitesSaturated, areaFraction, areaReached, saturated]` */
  layer_summary(k: number): Float64Array;
  /** `[rocks, triangles, coveredFraction, layers]` */
  summary(): Float64Array;
}

/** What pkg/generator.js exports, as far as it is used. */
export interface GeneratorModule {
  Generator: new () => RawGenerator;
  fresh_seed(): number;
  memory_estimate(params: Float64Array): number;
}

export type GeneratorGlue = Glue<GeneratorModule>;

const NOTHING: Float64Array = new Float64Array();

export type FieldSession = Session<RawGenerator, FlatRequest, Field, StageName>;

export function fieldSession(generator: RawGenerator): FieldSession {
  return new Session(generator, new Fields());
}

/** What is copied out of the wasm, and how a run of the plain generator begins. */
export class Fields<Raw extends RawGenerator> implements Craft<Raw, FlatRequest, Field, StageName> {
  readonly stages = STAGES;
  readonly collect = collect;
  /** The footprint that the generator has. */
  #footprint: Float64Array = NOTHING;

  start(generator: Raw, request: FlatRequest): void {
    // Whoever asks has chosen the generator.
    if (needsFull(request)) throw new RockFieldError({ name: 'Internal', message: 'this artefact cannot do it' });
    this.begin(generator, request);
  }

  protected begin(generator: Raw, { params, maxBytes, footprint = NOTHING }: FlatRequest): void {
    if (!isSame(footprint, this.#footprint)) generator.set_footprint(footprint);
    this.#footprint = footprint;
    generator.start(params, maxBytes);
  }
}

export function isSame(one: Float64Array | Uint8Array, other: Float64Array | Uint8Array): boolean {
  return one === other || (one.length === other.length && one.every((value, k) => value === other[k]));
}

/** The buffers of a finished run; each is a copy that belongs to JavaScript. */
function collect(generator: RawGenerator, { imageWidth, imageHeight }: FlatRequest, ms: StageTimes): Field {
  const [rocks = 0, triangles = 0, coveredFraction = 0, layerCount = 0] = generator.summary();
  return {
    imageWidth,
    imageHeight,
    layers: Array.from({ length: layerCount }, (_, k) => collectLayer(generator, k)),
    positions: generator.positions(),
    normals: generator.normals(),
    indices: generator.indices(),
    rockStarts: generator.rock_starts(),
    vertexStarts: generator.vertex_starts(),
    rockLayer: generator.rock_layer(),
    stats: { rocks, triangles, coveredFraction, ms },
  };
}

function collectLayer(generator: RawGenerator, k: number): FieldLayer {
  const [id = 0, radius = 0, targetSites = 0, sitesSaturated, areaFraction = 0, areaReached = 0, saturated] = generator.layer_summary(k);
  return {
    id,
    radius,
    targetSites,
    sites: generator.layer_sites(k),
    sitesSaturated: sitesSaturated === 1,
    cellStarts: generator.layer_cell_starts(k),
    cellVertices: generator.layer_cell_vertices(k),
    selected: generator.layer_selected(k),
    areaFraction,
    areaReached,
    saturated: saturated === 1,
  };
}

/** The buffers of a field, each once: a transfer list. */
export function buffersOf(field: Field): ArrayBuffer[] {
  const arrays = [
    field.positions,
    field.normals,
    field.indices,
    field.rockStarts,
    field.vertexStarts,
    field.rockLayer,
    ...field.layers.flatMap((layer) => [layer.sites, layer.cellStarts, layer.cellVertices, layer.selected]),
  ];
  return [...new Set(arrays.map((array) => array.buffer as ArrayBuffer))];
}

/** For the worker's loops. */
export const FIELD_LOOPS: LoopCraft<GeneratorModule, FlatRequest, Field, StageName> = {
  open: ({ Generator }) => fieldSession(new Generator()),
  pack: (field) => ({ result: field, transfer: buffersOf(field) }),
};
