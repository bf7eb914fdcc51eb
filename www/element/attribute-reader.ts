/**
 * What the attributes of an element say. One contract: absent → default; malformed → default and exactly one notice that names the
 * attribute; nothing throws.
 *
 * There is an attribute for every row of the parameter table, under the row's name in kebab case: `image-width="800"`; what has three
 * parts has an attribute for each, `taper-rock="6 6 2"`.
 */

import { attributeNoticeText } from './attribute-notices.ts';
import type { AttributeNoticeCode } from './attribute-notices.ts';
import { METRES_PER_PIXEL, parseOrbit } from '../scene/camera/orbit.ts';
import type { Orbit } from '../scene/camera/orbit.ts';
import { FOV, FOV_BOUNDS } from '../base/fov.ts';
import { INTERACTIONS, LOADINGS, NAVIGATIONS, QUALITY_CHOICES, THEMES } from '../base/view.ts';
import type { ColorMode, Interaction, Loading, Navigation, Theme, WantedQuality } from '../base/view.ts';
import { REST_SAMPLES, SAMPLES_BOUNDS } from '../renderer/limits.ts';
import { errorInfo, RockFieldError } from '../base/errors.ts';
import type { Slots } from '../base/filled.ts';
import type { Link } from '../table/link.ts';
import { shown } from '../table/param-checks.ts';
import type { Bounds, Row } from '../table/row.ts';
import { presetColor } from '../table/table.ts';
import type { Kind, Table } from '../table/table.ts';

/** @throws {RockFieldError} naming the value and the choices. */
export function checkChoice<T extends string>(key: string, value: T, choices: readonly T[]): T {
  if (choices.includes(value)) return value;
  const message = `${key} is ${shown(value)}; it must be one of ${choices.join(', ')}`;
  throw new RockFieldError({ name: 'OutOfRange', key, value, message });
}

/** How much of a wrong value is repeated in a notice. */
const MAX_QUOTE_LENGTH = 32;
const NUMBER = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;
/** A missing count in a list: `cell-count="- 40 -"`. */
const NONE = '-';

/** Attributes of every element that are no parameters. */
export const COMMON_ATTRIBUTES = [
  'src',
  'preset',
  'view',
  'color',
  'quality',
  'samples',
  'camera-orbit',
  'fov',
  'interaction',
  'navigation',
  'theme',
  'loading',
  'metres-per-pixel',
] as const;

export interface ElementAttributes<K extends Kind> extends Link<K> {
  /** Where the camera is while everything is framed; null: as it is framed by itself. */
  orbit: Orbit | null;
  /** Vertical, degrees. */
  fov: number;
  quality: WantedQuality;
  samples: number;
  theme: Theme;
  interaction: Interaction;
  navigation: Navigation;
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
export function propertyOf({ key, component }: Row): string {
  return component === null ? key : `${key}${['Base', 'Rock', 'Vertex'][component] ?? ''}`;
}

/** The attribute of a row: `image-width`, `radius`, `taper-rock`. */
export function attributeOf(spec: Row): string {
  return propertyOf(spec).replace(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`);
}

export function attributesOf(rows: readonly Row[]): ReadonlyMap<string, Row> {
  return new Map(rows.map((row) => [attributeOf(row), row]));
}

/** How a `src` of parameters or of a link is read. */
export interface SourceReader<K extends Kind> {
  /** @throws a RockFieldError for a request that is wrong. */
  ofRequest(request: unknown): Pick<Link<K>, 'params' | 'preset'>;
  ofLink(text: string): Link<K> & { notices: readonly { text: string }[] };
}

export class AttributeReader<K extends Kind> {
  readonly notices: AttributeNotice[] = [];
  readonly #table: Table<K>;
  readonly #get: (name: string) => string | null;

  constructor(table: Table<K>, get: (name: string) => string | null) {
    this.#table = table;
    this.#get = get;
  }

  get(name: string): string | null {
    return this.#get(name);
  }

  /** What is wrong with an attribute; only the first of several is kept. */
  note(attribute: string, code: AttributeNoticeCode, slots: Slots): void {
    this.say(attribute, attributeNoticeText(code, slots));
  }

  /** The same in a sentence that stands already. */
  say(attribute: string, message: string): void {
    if (this.notices.every((notice) => notice.attribute !== attribute || attribute === 'src'))
      this.notices.push({ attribute, message: `${attribute}: ${message}` });
  }

  /** `src` fills everything, and `preset` is then not looked at. */
  source(reader: SourceReader<K>): Link<K> {
    const src = this.get('src');
    const { presets, views } = this.#table;
    const first = presets[0]?.name ?? '';
    const blank: Link<K> = { params: this.#table.presetParams(first), preset: first, view: views[0] ?? '3d', color: null, camera: null };
    if (src === null) return { ...blank, ...this.#preset(first) };
    if (src.trim().startsWith('{')) {
      return { ...blank, ...this.#request(src, first, reader) };
    }
    const link = reader.ofLink(src);
    for (const { text } of link.notices) this.say('src', text);
    return link;
  }

  /** Parameters as JSON; the preset that they name is there for what cannot be read. */
  #request(src: string, first: K['preset'], reader: SourceReader<K>): Pick<Link<K>, 'params' | 'preset'> {
    let request: { preset?: unknown } = {};
    try {
      request = JSON.parse(src) as object;
      return reader.ofRequest(request);
    } catch (thrown) {
      const preset = this.#table.presets.find(({ name }) => name === request.preset)?.name ?? first;
      if (thrown instanceof SyntaxError) this.note('src', 'not-json', { used: preset });
      else this.note('src', 'bad-request', { reason: errorInfo(thrown).message, used: preset });
      return { params: this.#table.presetParams(preset), preset };
    }
  }

  #preset(first: K['preset']): Pick<Link<K>, 'params' | 'preset'> {
    const given = this.get('preset');
    const found = given === null ? undefined : this.#table.presets.find(({ name }) => name === given.trim());
    if (given !== null && !found) this.note('preset', 'no-preset', { given: quote(given), used: first });
    const preset = found?.name ?? first;
    return { params: this.#table.presetParams(preset), preset };
  }

  /** `params` with what the attributes of rows of the whole say. */
  rows(attributes: ReadonlyMap<string, Row>, params: K['params']): K['params'] {
    let read = params;
    // Choices first: the notation decides the bounds of the numbers.
    for (const kind of ['choice', 'number']) {
      for (const [name, row] of attributes) {
        const given = this.get(name);
        if (given === null || (row.kind === 'choice') !== (kind === 'choice')) continue;
        read = this.#table.written(
          read,
          row,
          this.one(name, given.trim(), row, this.#table.boundsOf(row, read), this.#table.read(read, row)),
        );
      }
    }
    return read;
  }

  /** What is said beside parameters. */
  common(source: Link<K>, params: K['params']): ElementAttributes<K> {
    const { views } = this.#table;
    return {
      params,
      preset: source.preset,
      view: this.choice('view', views, source.view),
      color: this.#color(source),
      camera: source.camera,
      orbit: this.#orbit(),
      fov: this.#numberOr('fov', true, FOV_BOUNDS, FOV),
      quality: this.choice('quality', QUALITY_CHOICES, QUALITY_CHOICES[0]),
      samples: this.#numberOr('samples', false, SAMPLES_BOUNDS, REST_SAMPLES),
      theme: this.choice('theme', THEMES, THEMES[0]),
      interaction: this.choice('interaction', INTERACTIONS, INTERACTIONS[0]),
      navigation: this.choice('navigation', NAVIGATIONS, NAVIGATIONS[0]),
      loading: this.choice('loading', LOADINGS, LOADINGS[0]),
      metresPerPixel: this.#scale(),
      notices: this.notices,
    };
  }

  /** One value of a row; `fallback` where it is none. */
  one(name: string, given: string, row: Row, { min, max }: Bounds, fallback: unknown): unknown {
    if (row.kind === 'choice') {
      const words = row.choices.map(({ value }) => value);
      if (words.includes(given)) return given;
      this.note(name, 'no-choice', { given: quote(given), choices: words.join(', '), used: String(fallback) });
      return fallback;
    }
    if (row.kind.startsWith('optional') && given === NONE) return null;
    return this.#number(name, given, row.kind.endsWith('real'), { min, max }, fallback);
  }

  #number(name: string, given: string, isReal: boolean, { min, max }: Pick<Bounds, 'min' | 'max'>, fallback: unknown): unknown {
    const isNumber = NUMBER.test(given) && (isReal || Number.isInteger(Number(given)));
    const value = isNumber ? Math.min(max, Math.max(min, Number(given))) : fallback;
    if (!isNumber || value !== Number(given)) {
      this.note(name, 'no-number', {
        given: quote(given),
        kind: isReal ? 'number' : 'whole number',
        min,
        max,
        used: value === null ? 'none' : String(value),
      });
    }
    // Never −0.
    return typeof value === 'number' ? value + 0 : value;
  }

  choice<T extends string>(name: string, choices: readonly T[], fallback: T): T {
    const given = this.get(name);
    if (given === null) return fallback;
    const found = choices.find((choice) => choice === given.trim());
    if (found === undefined) this.note(name, 'no-choice', { given: quote(given), choices: choices.join(', '), used: fallback });
    return found ?? fallback;
  }

  #color({ color, preset }: Link<K>): ColorMode | null {
    const given = this.get('color');
    const wanted = this.choice('color', this.#table.colors, color ?? presetColor(this.#table, preset));
    // What is malformed is as good as absent: of another preset it would be another colour.
    return given !== null && given.trim() === wanted ? wanted : color;
  }

  #orbit(): Orbit | null {
    const given = this.get('camera-orbit');
    const orbit = given === null ? null : parseOrbit(given);
    if (given !== null && !orbit) this.note('camera-orbit', 'no-orbit', { given: quote(given) });
    return orbit;
  }

  #numberOr(name: string, isReal: boolean, bounds: Pick<Bounds, 'min' | 'max'>, fallback: number): number {
    const given = this.get(name);
    return given === null ? fallback : (this.#number(name, given.trim(), isReal, bounds, fallback) as number);
  }

  #scale(): number {
    const given = this.get('metres-per-pixel');
    if (given === null) return METRES_PER_PIXEL;
    const value = NUMBER.test(given.trim()) ? Number(given) : NaN;
    if (value > 0 && value <= 1000) return value;
    this.note('metres-per-pixel', 'no-scale', { given: quote(given), used: METRES_PER_PIXEL });
    return METRES_PER_PIXEL;
  }
}

/** Short, and in one line. */
export function quote(text: string): string {
  const line = text.replace(/[\p{Cc}\p{Cf}\s]+/gu, ' ');
  return JSON.stringify(line.length > MAX_QUOTE_LENGTH ? `${line.slice(0, MAX_QUOTE_LENGTH)}…` : line);
}
