/**
 * What the attributes of `<rock-field>` say. One contract: absent → default; malformed → default and exactly one notice that
 * names the attribute; nothing throws.
 *
 * There is an attribute for every row of the parameter table, under the row's name in kebab case: `image-width="800"`. Those of
 * a layer list all layers, `radius="90 30 10"`; what has three parts has an attribute for each, `taper-rock="6 6 2"`.
 */

import { METRES_PER_PIXEL, parseOrbit } from './camera-orbit.ts';
import type { Orbit } from './camera-orbit.ts';
import { errorInfo, RockFieldError } from './errors.ts';
import { presetColor } from './look.ts';
import { MAX_LAYERS, PRESETS } from './params.ts';
import type { Params, ParamSpec, PresetName } from './params.ts';
import { boundsOf, defaultLayer, defaultParams, FIELD_ROWS, LAYER_ROWS, presetParams, readValue, resolveParams, writeValue } from './params-flat.ts';
import { QUALITY_CHOICES } from './renderer/quality.ts';
import type { WantedQuality } from './renderer/quality.ts';
import type { CameraState, ColorMode, View } from './renderer/renderer.ts';
import { COLORS, decodeLink, VIEWS } from './url-codec.ts';

export { COLORS, METRES_PER_PIXEL, QUALITY_CHOICES, VIEWS };

export const INTERACTIONS = ['cooperative', 'always', 'none'] as const;
export type Interaction = (typeof INTERACTIONS)[number];
export const LOADINGS = ['eager', 'lazy'] as const;
export type Loading = (typeof LOADINGS)[number];

/** @throws {RockFieldError} naming the value and the choices. */
export function checkChoice<T extends string>(key: string, value: T, choices: readonly T[]): T {
  if (choices.includes(value)) return value;
  const message = `${key} is ${JSON.stringify(value)}; it has to be one of ${choices.join(', ')}`;
  throw new RockFieldError({ name: 'OutOfRange', key, value, message });
}

/** How much of a wrong value is repeated in a notice. */
const MAX_QUOTE_LENGTH = 32;
const NUMBER = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;
/** A missing count in a list: `cell-count="- 40 -"`. */
const NONE = '-';

export interface AttributeState {
  params: Params;
  /** What they were written against. */
  preset: PresetName;
  view: View;
  /** Null: nobody chose one, it is the preset's own. */
  color: ColorMode | null;
  /** From a link in `src`; null: the whole field. */
  camera: CameraState | null;
  /** Where the camera is while the whole field is framed; null: as the field is framed by itself. */
  orbit: Orbit | null;
  quality: WantedQuality;
  interaction: Interaction;
  loading: Loading;
  metresPerPixel: number;
  /** One sentence for each attribute, or part of a link, that could not be taken as it stood. */
  notices: AttributeNotice[];
}

export interface AttributeNotice {
  attribute: string;
  message: string;
}

/** The property of a row: `imageWidth`, `radius`, `taperRock`. */
export function propertyOf({ key, component }: ParamSpec): string {
  return component === null ? key : `${key}${['Base', 'Rock', 'Vertex'][component] ?? ''}`;
}

/** The attribute of a row: `image-width`, `radius`, `taper-rock`. */
export function attributeOf(spec: ParamSpec): string {
  return propertyOf(spec).replace(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`);
}

export const FIELD_ATTRIBUTES: ReadonlyMap<string, ParamSpec> = new Map(FIELD_ROWS.map((spec) => [attributeOf(spec), spec]));
export const LAYER_ATTRIBUTES: ReadonlyMap<string, ParamSpec> = new Map(LAYER_ROWS.map((spec) => [attributeOf(spec), spec]));

export const ATTRIBUTES: readonly string[] = [
  'src', 'preset', ...FIELD_ATTRIBUTES.keys(), ...LAYER_ATTRIBUTES.keys(),
  'view', 'color', 'quality', 'camera-orbit', 'interaction', 'loading', 'metres-per-pixel',
];

type Get = (name: string) => string | null;
/** What is wrong with an attribute; only the first of several is kept. */
type Note = (attribute: string, message: string) => void;

/** `src` fills everything and `preset` is then not looked at; the other attributes replace what `src` says. */
export function readAttributes(get: Get): AttributeState {
  const notices: AttributeNotice[] = [];
  const note: Note = (attribute, message) => {
    if (notices.every((notice) => notice.attribute !== attribute || attribute === 'src')) notices.push({ attribute, message: `${attribute}: ${message}` });
  };
  const source = readSource(get, note);
  const params = { ...source.params };
  // Choices first: the notation decides the bounds of the numbers.
  for (const kind of ['choice', 'number']) {
    for (const [name, spec] of FIELD_ATTRIBUTES) {
      const given = get(name);
      if (given === null || (spec.kind === 'choice') !== (kind === 'choice')) continue;
      writeValue(params, spec, readOne(name, given.trim(), spec, params, readValue(params, spec), note));
    }
  }
  params.layers = readLayers(get, params, note);
  return {
    params,
    preset: source.preset,
    view: readChoice('view', get('view'), VIEWS, source.view, note),
    color: readColor(get('color'), source, note),
    camera: source.camera,
    orbit: readOrbit(get('camera-orbit'), note),
    quality: readChoice('quality', get('quality'), QUALITY_CHOICES, QUALITY_CHOICES[0], note),
    interaction: readChoice('interaction', get('interaction'), INTERACTIONS, INTERACTIONS[0], note),
    loading: readChoice('loading', get('loading'), LOADINGS, LOADINGS[0], note),
    metresPerPixel: readScale(get('metres-per-pixel'), note),
    notices,
  };
}

interface Source {
  params: Params;
  preset: PresetName;
  view: View;
  color: ColorMode | null;
  camera: CameraState | null;
}

function readSource(get: Get, note: Note): Source {
  const src = get('src');
  const blank: Source = { params: defaultParams(), preset: PRESETS[0].name, view: VIEWS[0], color: null, camera: null };
  if (src === null) return { ...blank, ...readPreset(get('preset'), note) };
  if (src.trim().startsWith('{')) {
    try {
      const request = JSON.parse(src);
      const params = resolveParams(request);
      return { ...blank, params, preset: request.preset ?? blank.preset };
    } catch (thrown) {
      note('src', `${errorInfo(thrown).message}; ${PRESETS[0].name} is shown`);
      return blank;
    }
  }
  const link = decodeLink(src);
  for (const { text } of link.notices) note('src', text);
  return link;
}

function readPreset(given: string | null, note: Note): Pick<Source, 'params' | 'preset'> {
  const found = given === null ? undefined : PRESETS.find(({ name }) => name === given.trim());
  if (given !== null && !found) note('preset', `there is no preset called ${quote(given)}; ${PRESETS[0].name} is shown`);
  const preset = found?.name ?? PRESETS[0].name;
  return { params: presetParams(preset), preset };
}

/** One value of a row; `fallback` where it is none. */
function readOne(name: string, given: string, spec: ParamSpec, params: Params, fallback: unknown, note: Note): unknown {
  if (spec.kind === 'choice') {
    const words = spec.choices.map(({ value }) => value);
    if (words.includes(given)) return given;
    note(name, `${quote(given)} is none of ${words.join(', ')}; ${String(fallback)} is used`);
    return fallback;
  }
  if (spec.kind === 'optional-integer' && given === NONE) return null;
  const { min, max } = boundsOf(spec, params.notation);
  const isNumber = NUMBER.test(given) && (spec.kind === 'real' || Number.isInteger(Number(given)));
  const value = isNumber ? Math.min(max, Math.max(min, Number(given))) : fallback;
  if (!isNumber || value !== Number(given)) {
    const wanted = spec.kind === 'real' ? 'number' : 'whole number';
    note(name, `${quote(given)} is no ${wanted} in ${min} to ${max}; ${value === null ? 'none' : String(value)} is used`);
  }
  // Never −0.
  return typeof value === 'number' ? value + 0 : value;
}

/** The first list in the order of the table tells the number of layers; one of another length is malformed. */
function readLayers(get: Get, params: Params, note: Note): Params['layers'] {
  const lists = [...LAYER_ATTRIBUTES].flatMap(([name, spec]) => {
    const given = get(name);
    return given === null ? [] : [{ name, spec, items: given.split(/[\s,]+/).filter((item) => item !== '') }];
  });
  const [first] = lists;
  if (!first) return params.layers;
  if (first.items.length > MAX_LAYERS) note(first.name, `${first.items.length} layers; the first ${MAX_LAYERS} are used`);
  const count = Math.min(MAX_LAYERS, first.items.length);
  const layers = Array.from({ length: count }, (_, id) => structuredClone(params.layers[id]) ?? defaultLayer(id, params.notation));
  for (const { name, spec, items } of lists) {
    if (items.length !== first.items.length) {
      note(name, `${items.length} values for ${count} layers; they are left out`);
      continue;
    }
    layers.forEach((layer, index) => writeValue(layer, spec, readOne(name, items[index] ?? '', spec, params, readValue(layer, spec), note)));
  }
  return layers;
}

function readChoice<T extends string>(name: string, given: string | null, choices: readonly T[], fallback: T, note: Note): T {
  if (given === null) return fallback;
  const found = choices.find((choice) => choice === given.trim());
  if (found === undefined) note(name, `${quote(given)} is none of ${choices.join(', ')}; ${fallback} is used`);
  return found ?? fallback;
}

function readColor(given: string | null, { color, preset }: Source, note: Note): ColorMode | null {
  const wanted = readChoice('color', given, COLORS, color ?? presetColor(preset), note);
  // What is malformed is as good as absent: of another preset it would be another colour.
  return given !== null && given.trim() === wanted ? wanted : color;
}

function readOrbit(given: string | null, note: Note): Orbit | null {
  if (given === null) return null;
  const orbit = parseOrbit(given);
  if (!orbit) note('camera-orbit', `${quote(given)} is no orbit like 45deg 55deg 120%; the whole field is framed`);
  return orbit;
}

function readScale(given: string | null, note: Note): number {
  if (given === null) return METRES_PER_PIXEL;
  const value = NUMBER.test(given.trim()) ? Number(given) : NaN;
  if (value > 0 && value <= 1000) return value;
  note('metres-per-pixel', `${quote(given)} is no number above 0 and up to 1000; ${METRES_PER_PIXEL} is used`);
  return METRES_PER_PIXEL;
}

/** Short, and in one line. */
function quote(text: string): string {
  const line = text.replace(/[\p{Cc}\p{Cf}\s]+/gu, ' ');
  return JSON.stringify(line.length > MAX_QUOTE_LENGTH ? `${line.slice(0, MAX_QUOTE_LENGTH)}…` : line);
}
