/**
 * Parameters between people and the generator: presets, requests from code, clamping for the page, and the flat list of
 * numbers that crosses into wasm. Everything is derived from the table; no key of a parameter is written here but `layers`,
 * `preset` and `id`, which are no rows of it.
 */

import { RockFieldError } from '../base/errors.ts';
import type { FlatRequest } from '../generator/protocol.ts';
import { checkNumber, checkValue, isList, objectOf, rejectUnknown, unknownPreset, wrongType } from '../table/param-checks.ts';
import type { Loose, Place } from '../table/param-checks.ts';
import { MAX_LAYERS, PARAMS, PRESETS } from './params.ts';
import type { Bounds, Notation, Row } from '../table/row.ts';
import type { ParamSpec, Preset } from './spec.ts';
import type { Layer, Params, PresetName } from './params.ts';
import { checkStrokes } from './stroke-text.ts';
import type { Stroke } from './strokes.ts';

/** What code may ask for: a preset fills everything, each key given then replaces it, `layers` replaces the whole list. */
export type FieldRequest = { preset?: PresetName | undefined } & {
  [K in Exclude<keyof Params, 'layers' | 'strokes'>]?: Params[K] | undefined;
} & {
  /** Fields missing in an entry take the table's defaults in the notation in force; a missing id is the entry's index. */
  layers?: readonly LayerRequest[] | undefined;
  /** Painted on the ground: where rocks are added, erased, kept off a path, or as if nothing had been painted. */
  strokes?: string | readonly Stroke[] | undefined;
};

export type LayerRequest = { [K in keyof Layer]?: Layer[K] | undefined };

export const FIELD_ROWS: readonly ParamSpec[] = PARAMS.filter((spec) => spec.scope === 'field');
export const LAYER_ROWS: readonly ParamSpec[] = PARAMS.filter((spec) => spec.scope === 'layer');

const KEYS = new Set(['preset', 'layers', 'strokes', ...FIELD_ROWS.map((spec) => spec.key)]);
const LAYER_KEYS = new Set(['id', ...LAYER_ROWS.map((spec) => spec.key)]);
export const MAX_ID = 0xffff_ffff;

/** The row's bounds in a notation. */
export function boundsOf(spec: Row, notation: Notation): Bounds {
  return notation === 'relative' && spec.relative ? spec.relative : spec;
}

/** The value of a row in `owner` (the params for a field row, a layer for a layer row). */
export function readValue(owner: Params | Layer, spec: Row): unknown {
  const value = (owner as unknown as Loose)[spec.key];
  return spec.component === null ? value : Array.isArray(value) ? value[spec.component] : undefined;
}

/** Puts the value of a row into `owner`, unchecked; a triple is created when it is not there yet. */
export function writeValue(owner: Params | Layer, spec: Row, value: unknown): void {
  const record = owner as unknown as Loose;
  if (spec.component === null) record[spec.key] = value;
  else {
    record[spec.key] ??= [0, 0, 0];
    (record[spec.key] as unknown[])[spec.component] = value;
  }
}

/** The table's default of a row in a notation: a number, a choice's word, or null. */
export function defaultOf(spec: Row, notation: Notation): number | string | null {
  const value = boundsOf(spec, notation).default;
  return spec.kind === 'choice' ? (spec.choices[value ?? 0]?.value ?? null) : value;
}

export function defaultLayer(id: number, notation: Notation): Layer {
  const layer = { id } as Layer;
  for (const spec of LAYER_ROWS) writeValue(layer, spec, defaultOf(spec, notation));
  return layer;
}

/** A preset of the papers with the table's defaults for the rest, seed 0. */
export function presetParams(name: string): Params {
  const preset = PRESETS.find((candidate) => candidate.name === name);
  if (!preset) throw unknownPreset(name);
  const params = {} as Params;
  const fields: Preset['fields'] = 'fields' in preset ? preset.fields : {};
  for (const spec of FIELD_ROWS) writeValue(params, spec, fields[spec.key] ?? defaultOf(spec, preset.notation));
  params.notation = preset.notation;
  // There is no column for the count.
  const columns = LAYER_ROWS.filter((spec) => spec.kind !== 'optional-integer');
  params.layers = preset.layers.map((row, id) => {
    const layer = defaultLayer(id, preset.notation);
    columns.forEach((spec, column) => {
      const value = row[column];
      if (value !== undefined) writeValue(layer, spec, spec.kind === 'choice' ? spec.choices[value]?.value : value);
    });
    return layer;
  });
  return params;
}

/** Fig. 1 of the journal, seed 0. */
export function defaultParams(): Params {
  return presetParams(PRESETS[0].name);
}

/** A copy that shares nothing with the original. */
export function copyParams(params: Params): Params {
  return structuredClone(params);
}

/**
 * `[field rows…, number of layers, per layer: id, layer rows…]`, rows in table order: what `Generator.start` takes.
 *
 * A choice is the index of its word, an optional number is NaN for null. Nothing is checked: Rust does that.
 */
export function encodeParams(params: Params): Float64Array {
  const flat = FIELD_ROWS.map((spec) => encodeValue(spec, readValue(params, spec)));
  flat.push(params.layers.length);
  for (const layer of params.layers) {
    flat.push(layer.id, ...LAYER_ROWS.map((spec) => encodeValue(spec, readValue(layer, spec))));
  }
  return Float64Array.from(flat);
}

function encodeValue(spec: Row, value: unknown): number {
  if (spec.kind === 'choice') return spec.choices.findIndex((choice) => choice.value === value);
  return typeof value === 'number' ? value : NaN;
}

/** What the generator is asked: `params` with a memory budget in bytes. */
export function flatRequest(params: Params, maxBytes: number): FlatRequest {
  const { imageWidth, imageHeight, strokes } = params;
  return { params: encodeParams(params), imageWidth, imageHeight, maxBytes, strokes };
}

/**
 * The full parameters a request from code stands for. The result shares nothing with the request.
 *
 * @throws {RockFieldError} naming the key, the value and the bounds; nothing is corrected silently.
 */
export function resolveParams(request: FieldRequest = {}): Params {
  const given = objectOf(request, 'params');
  rejectUnknown(given, (key) => KEYS.has(key));
  const preset = given.preset ?? PRESETS[0].name;
  if (typeof preset !== 'string') throw wrongType('preset', preset, 'the name of a preset');
  const params = presetParams(preset);
  for (const spec of FIELD_ROWS) {
    const value = given[spec.key];
    if (value !== undefined) writeValue(params, spec, checkValue(spec, spec, value));
  }
  if (given.layers !== undefined) params.layers = resolveLayers(given.layers, params.notation);
  else checkLayers(params);
  if (given.strokes) params.strokes = checkStrokes(given.strokes);
  return params;
}

function resolveLayers(given: unknown, notation: Notation): Layer[] {
  if (!Array.isArray(given)) throw wrongType('layers', given, 'a list of layers');
  if (given.length > MAX_LAYERS) {
    throw new RockFieldError({
      name: 'TooManyLayers',
      key: 'layers',
      value: given.length,
      min: 0,
      max: MAX_LAYERS,
      message: `there are ${given.length} layers; there may be at most ${MAX_LAYERS}`,
    });
  }
  const ids = new Set<number>();
  // Not `map`: it passes over holes.
  return Array.from(given, (entry: unknown, index) => {
    const at = layerAt(index);
    const fields = objectOf(entry, 'layers', at);
    rejectUnknown(fields, (key) => LAYER_KEYS.has(key), at);
    const id = fields.id === undefined ? index : checkNumber('id', fields.id, { min: 0, max: MAX_ID }, true, at);
    if (ids.has(id)) {
      throw new RockFieldError({ name: 'DuplicateLayerId', key: 'id', layer: index, value: id, message: `two layers have the id ${id}` });
    }
    ids.add(id);
    const layer = defaultLayer(id, notation);
    for (const spec of LAYER_ROWS) {
      const value = fields[spec.key];
      if (value === undefined) continue;
      if (spec.component !== null && !(isList(value) && value.length === 3)) {
        throw wrongType(spec.key, value, 'a list of three numbers', at);
      }
      const part: unknown = spec.component === null ? value : (value as ArrayLike<unknown>)[spec.component];
      writeValue(layer, spec, checkValue(spec, boundsOf(spec, notation), part, at));
    }
    return layer;
  });
}

function layerAt(index: number): Place {
  return { index, name: `layer ${index}` };
}

/** A preset's own layers under another notation: its numbers stay, so they may leave that notation's bounds. */
function checkLayers(params: Params): void {
  params.layers.forEach((layer, index) => {
    for (const spec of LAYER_ROWS) checkValue(spec, boundsOf(spec, params.notation), readValue(layer, spec), layerAt(index));
  });
}
