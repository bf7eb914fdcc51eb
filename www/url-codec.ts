/**
 * Links: `v=1&preset=journal-fig1&seed=42&r=90,30,10&…`, after `#` or `?`. Whatever is not in the link is the preset's.
 *
 * A link says only what differs from its preset. A layer's key lists all layers, so its length is their number (`r=` means none); layers
 * past the preset's have the table's defaults. Numbers are the shortest decimals that read back as the same f64.
 * Reading never throws and never guesses: what is wrong is clamped or left out, each with one notice that names it.
 */

import { MAX_LAYERS, PRESETS } from './params.ts';
import { presetColor } from './look.ts';
import { FIELD_ROWS, LAYER_ROWS, boundsOf, defaultLayer, presetParams, readValue, writeValue } from './params-flat.ts';
import { noticeText } from './notices.ts';
import type { Layer, Notation, Params, ParamSpec, PresetName } from './params.ts';
import type { CameraState, ColorMode, View } from './renderer/renderer.ts';

/** Grows when an old link would otherwise mean another picture. */
export const LINK_VERSION = '1';
/** Characters read. The longest honest link, eight layers with every digit of every number, has about 2,000. */
export const MAX_LINK_LENGTH = 16_384;

export const VIEWS = ['3d', 'wireframe', 'diagrams', 'selection'] as const satisfies readonly View[];
export const COLORS = ['layer', 'rock', 'plain', 'natural'] as const satisfies readonly ColorMode[];

/** How much of a wrong key or value is repeated in a notice. */
const MAX_QUOTE_LENGTH = 32;
/** A missing count in a list: `n=-,40,-`. */
const NONE = '-';
const NUMBER = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;
/** Angles to 1e-4 rad and lengths to 0.1 px: below what a screen shows, and the link stays short. */
const CAMERA_DIGITS = [4, 4, 1, 1, 1, 1] as const;
/** px; beyond it nothing of the largest field (8192 px) is to be seen. */
const CAMERA_REACH = 1e5;

export type NoticeCode =
  | 'too-long'
  | 'unknown-key'
  | 'unknown-version'
  | 'unknown-preset'
  | 'unknown-choice'
  | 'not-a-number'
  | 'clamped'
  | 'repeated'
  | 'unequal-lists'
  | 'too-many-layers'
  | 'bad-ids'
  | 'bad-camera';

/** One thing in a link that could not be taken as it stood. Its strings come from the link: show them as text only. */
export interface Notice {
  code: NoticeCode;
  /** The key at fault, or several. */
  key: string;
  /** What stood there, shortened. */
  given: string;
  /** What is used instead. */
  used: string;
  min?: number;
  max?: number;
  /** In English, for the console and for embedders. */
  text: string;
}

export interface LinkState {
  params: Params;
  /** What the link is written against. */
  preset: PresetName;
  view: View;
  /** `null`: the preset's own. */
  color: ColorMode | null;
  /** `null`: the whole field in view. */
  camera: CameraState | null;
}

export interface DecodedLink extends LinkState {
  notices: Notice[];
}

export function encodeLink(state: Pick<LinkState, 'params'> & Partial<LinkState> & { defaultCamera?: CameraState | null }): string {
  const { params, preset = PRESETS[0].name, view = VIEWS[0], color = null, camera = null, defaultCamera = null } = state;
  const base = presetParams(preset);
  const pairs = [`v=${LINK_VERSION}`, `preset=${preset}`];
  for (const spec of FIELD_ROWS) {
    const value = readValue(params, spec);
    if (value !== readValue(base, spec)) pairs.push(`${spec.url}=${written(value)}`);
  }
  const baseLayers = params.layers.map((_, index) => baseLayer(base, index, params.notation));
  const moreOrFewer = params.layers.length !== base.layers.length;
  for (const [row, spec] of LAYER_ROWS.entries()) {
    const differs = params.layers.some((layer, index) => readValue(layer, spec) !== readValue(baseLayers[index] ?? layer, spec));
    // One list has to tell the number of layers.
    if (differs || (moreOrFewer && row === 0)) pairs.push(`${spec.url}=${params.layers.map((layer) => written(readValue(layer, spec))).join(',')}`);
  }
  if (params.layers.some((layer, index) => layer.id !== index)) pairs.push(`id=${params.layers.map((layer) => layer.id).join(',')}`);
  if (view !== VIEWS[0]) pairs.push(`view=${view}`);
  if (color !== null && color !== presetColor(preset)) pairs.push(`color=${color}`);
  const eye = camera && cameraText(camera);
  if (eye && eye !== (defaultCamera && cameraText(defaultCamera))) pairs.push(`camera=${eye}`);
  return pairs.join('&');
}

/** Reads `#…`, `?…`, a whole address or what `encodeLink` returns. */
export function decodeLink(text: string): DecodedLink {
  const reader = new Reader(text);
  const preset = reader.choice('preset', PRESETS.map(({ name }) => name), PRESETS[0].name, 'unknown-preset');
  const params = readParams(reader, presetParams(preset));
  const view = reader.choice('view', VIEWS, VIEWS[0]);
  const own = presetColor(preset);
  const color = reader.choice('color', COLORS, own);
  const camera = readCamera(reader);
  reader.finish();
  return { params, preset, view, color: color === own ? null : color, camera, notices: reader.notices };
}

function readParams(reader: Reader, preset: Params): Params {
  const params = { ...preset };
  // Choices first: the notation decides the bounds of the numbers.
  for (const spec of [...FIELD_ROWS.filter(({ kind }) => kind === 'choice'), ...FIELD_ROWS.filter(({ kind }) => kind !== 'choice')]) {
    const given = reader.take(spec.url);
    if (given !== undefined) writeValue(params, spec, reader.value(spec, params.notation, given, readValue(preset, spec)));
  }
  params.layers = readLayers(reader, preset, params.notation);
  return params;
}

function readLayers(reader: Reader, preset: Params, notation: Notation): Layer[] {
  const lists = new Map<string, string[]>();
  for (const key of [...LAYER_ROWS.map(({ url }) => url), 'id']) {
    const given = reader.take(key);
    if (given !== undefined) lists.set(key, given === '' ? [] : given.split(','));
  }
  const lengths = new Set([...lists.values()].map((list) => list.length));
  if (lengths.size > 1) {
    reader.note('unequal-lists', [...lists.keys()].join(', '), [...lists].map(([key, list]) => `${key}: ${list.length}`).join(', '), '');
    lists.clear();
  }
  let [count = preset.layers.length] = lists.size > 0 ? lengths : [];
  if (count > MAX_LAYERS) {
    reader.note('too-many-layers', [...lists.keys()].join(', '), String(count), String(MAX_LAYERS), { min: 0, max: MAX_LAYERS });
    count = MAX_LAYERS;
  }
  const ids = readIds(reader, lists.get('id')?.slice(0, count));
  return Array.from({ length: count }, (_, index) => {
    const layer = { ...baseLayer(preset, index, notation), id: ids?.[index] ?? index };
    for (const spec of LAYER_ROWS) {
      const given = lists.get(spec.url)?.[index];
      if (given !== undefined) writeValue(layer, spec, reader.value(spec, notation, given, readValue(layer, spec)));
    }
    return layer;
  });
}

/** What layer `index` is when the link says nothing about it. */
function baseLayer(preset: Params, index: number, notation: Notation): Layer {
  return preset.layers[index] ?? defaultLayer(index, notation);
}

function readIds(reader: Reader, given: string[] | undefined): number[] | null {
  if (!given) return null;
  const ids = given.map((item) => (/^\d{1,10}$/.test(item) ? Number(item) : NaN));
  const isGood = new Set(ids).size === ids.length && ids.every((id) => id <= 0xffff_ffff);
  if (!isGood) reader.note('bad-ids', 'id', given.join(','), given.map((_, index) => index).join(','));
  return isGood ? ids : null;
}

function readCamera(reader: Reader): CameraState | null {
  const given = reader.take('camera');
  if (given === undefined) return null;
  const numbers = given.split(',').map((item) => (NUMBER.test(item.trim()) ? Number(item) : NaN));
  const [azimuth = NaN, elevation = NaN, distance = NaN, x = NaN, y = NaN, z = NaN] = numbers;
  const isGood =
    numbers.length === CAMERA_DIGITS.length &&
    numbers.every((value) => Math.abs(value) <= CAMERA_REACH) &&
    distance > 0 &&
    Math.abs(elevation) <= Math.PI;
  if (isGood) return { azimuth, elevation, distance, target: [x, y, z] };
  reader.note('bad-camera', 'camera', given, '');
  return null;
}

function cameraText({ azimuth, elevation, distance, target }: CameraState): string {
  return [azimuth, elevation, distance, ...target].map((value, index) => String(Number(value.toFixed(CAMERA_DIGITS[index])) + 0)).join(',');
}

function written(value: unknown): string {
  return value === null ? NONE : String(value);
}

/** The link's pairs, taken one by one, and what was wrong with them. */
class Reader {
  readonly notices: Notice[] = [];
  readonly #pairs = new Map<string, string>();
  readonly #repeated = new Set<string>();

  constructor(text: string) {
    for (const [key, value] of this.#split(text)) {
      if (this.#pairs.has(key)) this.#repeated.add(key);
      else this.#pairs.set(key, value);
    }
    const version = this.take('v');
    if (version !== undefined && version !== LINK_VERSION) this.note('unknown-version', 'v', version, LINK_VERSION);
  }

  take(key: string): string | undefined {
    const value = this.#pairs.get(key);
    this.#pairs.delete(key);
    if (this.#repeated.delete(key)) this.note('repeated', key, '', value ?? '');
    return value;
  }

  choice<T extends string>(key: string, choices: readonly T[], fallback: T, code: NoticeCode = 'unknown-choice'): T {
    const given = this.take(key);
    if (given === undefined) return fallback;
    const found = choices.find((choice) => choice === given);
    if (found === undefined) this.note(code, key, given, fallback);
    return found ?? fallback;
  }

  /** What stands in one place of a row: a word, a number, or a hyphen for none. */
  value(spec: ParamSpec, notation: Notation, given: string, fallback: unknown): unknown {
    const item = given.trim();
    if (spec.kind === 'choice') {
      if (spec.choices.some(({ value }) => value === item)) return item;
      this.note('unknown-choice', spec.url, given, String(fallback));
      return fallback;
    }
    if (spec.kind === 'optional-integer' && item === NONE) return null;
    if (!NUMBER.test(item)) {
      this.note('not-a-number', spec.url, given, fallback === null ? '' : String(fallback));
      return fallback;
    }
    const value = Number(item);
    const { min, max } = boundsOf(spec, notation);
    const inside = Math.min(max, Math.max(min, value));
    const legal = spec.kind === 'real' ? inside : Math.round(inside);
    if (legal !== value) this.note('clamped', spec.url, item, String(legal), { min, max });
    // Never −0: it would be another number in the next link.
    return legal + 0;
  }

  /** Notes what is wrong, once for each key. */
  note(code: NoticeCode, key: string, given: string, used: string, bounds: { min?: number; max?: number } = {}): void {
    if (this.notices.some((notice) => notice.key === key && notice.code === code)) return;
    const notice = { code, key, given: quoted(given), used: quoted(used), ...bounds };
    this.notices.push({ ...notice, text: noticeText(notice) });
  }

  /** Everything nobody asked for, in one notice. */
  finish(): void {
    const keys = [...this.#pairs.keys()];
    if (keys.length === 0) return;
    const named = keys.slice(0, 3).map(quoted).join(', ');
    this.note('unknown-key', keys.length > 3 ? `${named}, … (${keys.length})` : named, '', '');
  }

  #split(text: string): [string, string][] {
    let body = bodyOf(text.trim());
    if (body.length > MAX_LINK_LENGTH) {
      this.note('too-long', '', String(body.length), String(MAX_LINK_LENGTH));
      // Not through the middle of a number.
      const cut = body.lastIndexOf('&', MAX_LINK_LENGTH);
      body = cut < 0 ? '' : body.slice(0, cut);
    }
    // `&amp;` stands in links copied out of HTML.
    const pairs = body.split(/&(?:amp;)?/).filter((pair) => pair !== '');
    return pairs.map((pair) => {
      const [key = ''] = pair.split('=', 1);
      return [decoded(key), decoded(pair.slice(key.length + 1))];
    });
  }
}

/** The pairs of `?…` and of `#…`, joined; of plain text, all of it. */
function bodyOf(text: string): string {
  if (text.startsWith('#')) return text.slice(1);
  if (!text.startsWith('?') && !/^([a-z][a-z\d+.-]*:|\.{0,2}\/)/i.test(text)) return text;
  const [before = '', ...after] = text.split('#');
  const query = before.includes('?') ? before.slice(before.indexOf('?') + 1) : '';
  return [after.join('#'), query].filter((part) => part !== '').join('&');
}

function decoded(text: string): string {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}

/** Short, and in one line: it is going to stand in a sentence. */
function quoted(text: string): string {
  const line = text.replace(/[\p{Cc}\p{Cf}\s]+/gu, ' ');
  return line.length > MAX_QUOTE_LENGTH ? `${line.slice(0, MAX_QUOTE_LENGTH)}…` : line;
}
