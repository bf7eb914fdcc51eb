/**
 * Links: `v=1&preset=journal-fig1&seed=42&r=90,30,10&…`, after `#` or `?`. Whatever is not in the link is the preset's.
 *
 * A link says only what differs from its preset. The key of a layer (of a base) lists all of them, so its length is their number (`r=`
 * means none); those past the preset's have the table's defaults. Numbers are the shortest decimals that read back as the same f64.
 * Reading never throws and never guesses: what is wrong is clamped or left out, each with one notice that names it.
 */

import { noticeText } from './notices.ts';
import type { Notice, NoticeCode } from './notices.ts';
import { FOV, FOV_BOUNDS } from '../base/fov.ts';
import { CAMERA_BOUNDS } from './camera-bounds.ts';
import type { Bounds, Row } from './row.ts';
import type { CameraState, ColorMode, View } from '../base/view.ts';
import { presetColor } from './table.ts';
import type { Kind, Table } from './table.ts';

/** Grows when an old link would otherwise mean another picture. */
export const LINK_VERSION = '1';
/** Characters read. The longest honest link, eight layers with every digit of every number, has about 2,000. */
export const MAX_LINK_LENGTH = 16_384;

/** How much of a wrong key or value is repeated in a notice. */
const MAX_QUOTE_LENGTH = 32;
/** A missing count in a list: `n=-,40,-`. */
const NONE = '-';
const NUMBER = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;
/** Angles to 1e-4 rad and lengths to 0.1 px: below what a screen shows, and the link stays short. */
const CAMERA_DIGITS = [4, 4, 1, 1, 1, 1] as const;
/** Keys whose presence makes a text a link. `v` and `id` are none of them: pages use these for their own ends, and alone they show nothing. */
const COMMON_KEYS = ['preset', 'view', 'color', 'camera', 'ground'];
/** What analytics and mail programs add to addresses. */
const FOREIGN = /^(utm_|mc_|_)|clid$/;
/** What sentences, brackets and chat programs leave at the ends of an address, and characters that cannot be seen. No value begins or ends so. */
const HEAD = /^[\s\p{Cf}"'“‘<(*`]+/u;
const TAIL = /[\s\p{Cf}"'”’>)\]}*_~`|.,:;!?…、。」』]/u;

/** What a link holds. */
export interface Link<K extends Kind> {
  params: K['params'];
  /** What the link is written against. */
  preset: K['preset'];
  view: View;
  /** `null`: the preset's own. */
  color: ColorMode | null;
  /** `null`: everything in view. */
  camera: CameraState | null;
}

export interface DecodedLink<K extends Kind> extends Link<K> {
  notices: Notice[];
}

/** `own` are pairs that no row of the table tells. */
export function encode<K extends Kind>(
  table: Table<K>,
  state: Link<K> & { defaultCamera?: CameraState | null },
  own: readonly string[],
): string {
  const { params, preset, view, color, camera, defaultCamera = null } = state;
  const pairs = [`v=${LINK_VERSION}`, `preset=${preset}`, ...parameterPairs(table, params, table.presetParams(preset)), ...own];
  if (view !== table.views[0]) pairs.push(`view=${view}`);
  if (color !== null && color !== presetColor(table, preset)) pairs.push(`color=${color}`);
  const eye = camera && cameraText(camera);
  if (eye && eye !== (defaultCamera && cameraText(defaultCamera))) pairs.push(`camera=${eye}`);
  return pairs.join('&');
}

function parameterPairs<K extends Kind>(table: Table<K>, params: K['params'], preset: K['params']): string[] {
  const pairs: string[] = [];
  for (const row of table.rows) {
    const value = table.read(params, row);
    if (value !== table.read(preset, row)) pairs.push(`${row.url}=${written(value)}`);
  }
  const items = table.items(params);
  const base = table.items(preset);
  const moreOrFewer = items.length !== base.length;
  for (const [index, row] of table.itemRows.entries()) {
    const differs = items.some((item, k) => table.read(item, row) !== table.read(base[k] ?? table.newItem(k, params), row));
    // One list has to tell the number of items.
    if (differs || (moreOrFewer && index === 0)) pairs.push(`${row.url}=${items.map((item) => written(table.read(item, row))).join(',')}`);
  }
  return pairs;
}

/** Whether there is anything in `text` that a link says. An address may have keys of others, and a fragment that is a place on the page. */
export function isLink<K extends Kind>(table: Table<K>, text: string): boolean {
  return has(bodyOf(text, keysOf(table)), keysOf(table));
}

function keysOf<K extends Kind>({ rows, itemRows }: Table<K>): string[] {
  return [...COMMON_KEYS, ...[...rows, ...itemRows].map(({ url }) => url)];
}

/** `readOwn` reads what no row of the table tells, from the lists of the keys `ownLists` and from the reader. */
export function decode<K extends Kind>(
  table: Table<K>,
  text: string,
  ownLists: readonly string[],
  readOwn: (params: K['params'], lists: ReadonlyMap<string, string[]>, reader: LinkReader) => K['params'],
): DecodedLink<K> {
  const reader = new LinkReader(text, keysOf(table));
  const fallback = table.presets[0]?.name ?? '';
  const preset = reader.choice(
    'preset',
    table.presets.map(({ name }) => name),
    fallback,
    'unknown-preset',
  );
  const base = table.presetParams(preset);
  let params = base;
  // Choices first: the notation decides the bounds of the numbers.
  const rows = [...table.rows].sort((a, b) => Number(b.kind === 'choice') - Number(a.kind === 'choice'));
  for (const row of rows) {
    const given = reader.take(row.url);
    if (given !== undefined)
      params = table.written(params, row, reader.value(row, table.boundsOf(row, params), given, table.read(base, row)));
  }
  const lists = readLists(table, reader, table.items(base), ownLists);
  params = readOwn(table.withItems(params, readItems(table, reader, base, params, lists)), lists, reader);
  const view = reader.choice('view', table.views, table.views[0] ?? '3d');
  const own = presetColor(table, preset);
  const color = reader.choice('color', table.colors, own);
  const camera = readCamera(reader);
  reader.finish();
  return { params, preset, view, color: color === own ? null : color, camera, notices: reader.notices };
}

/** The lists of items, all of one length that is allowed; empty where there is nothing that can be used. */
function readLists<K extends Kind>(
  table: Table<K>,
  reader: LinkReader,
  base: readonly K['item'][],
  others: readonly string[],
): Map<string, string[]> {
  const {
    itemRows,
    itemCount: { min, max },
  } = table;
  const lists = new Map<string, string[]>();
  for (const row of itemRows) {
    const given = reader.take(row.url);
    const list = given === '' ? [] : given?.split(',');
    if (list && isReadable(row, list)) lists.set(row.url, list);
    // This says so.
    else if (list) reader.value(row, row, list[0]!, table.read(base[0]!, row));
  }
  for (const key of others) {
    const given = reader.take(key);
    if (given !== undefined) lists.set(key, given.split(','));
  }
  const lengths = [...lists.values()].map((list) => list.length);
  const keys = [...lists.keys()].join(', ');
  const [length = base.length] = lengths;
  if (lengths.some((other) => other !== length) || length < min) {
    reader.note('unequal-lists', keys, [...lists].map(([key, list]) => `${key}: ${list.length}`).join(', '), '');
    lists.clear();
  } else if (length > max) {
    reader.note(itemRows[0]?.scope === 'base' ? 'too-many-bases' : 'too-many-layers', keys, String(length), String(max), { min, max });
    for (const [key, list] of lists) lists.set(key, list.slice(0, max));
  }
  return lists;
}

/** Whether a list tells anything: one of which no value can be read does not even tell how many items there are. */
export function isReadable(row: Row, list: readonly string[]): boolean {
  const isValue = (item: string) =>
    row.kind === 'choice'
      ? row.choices.some(({ value }) => value === item)
      : NUMBER.test(item) || (item === NONE && row.kind.startsWith('optional'));
  return list.length === 0 || list.some((item) => isValue(item.trim()));
}

function readItems<K extends Kind>(
  table: Table<K>,
  reader: LinkReader,
  base: K['params'],
  params: K['params'],
  lists: ReadonlyMap<string, string[]>,
): K['item'][] {
  const items = table.items(base);
  const [list = items] = lists.values();
  return Array.from({ length: list.length }, (_, index) => {
    let item = items[index] ?? table.newItem(index, params);
    for (const row of table.itemRows) {
      const given = lists.get(row.url)?.[index];
      if (given !== undefined)
        item = table.written(item, row, reader.value(row, table.boundsOf(row, params), given, table.read(item, row)));
    }
    return item;
  });
}

function readCamera(reader: LinkReader): CameraState | null {
  const given = reader.take('camera');
  if (given === undefined) return null;
  const numbers = given.split(',').map((item) => (NUMBER.test(item.trim()) ? Number(item) : NaN));
  const [azimuth = NaN, elevation = NaN, distance = NaN, x = NaN, y = NaN, z = NaN, fov] = numbers;
  const bounds = fov === undefined ? CAMERA_BOUNDS : [...CAMERA_BOUNDS, FOV_BOUNDS];
  if (numbers.length === bounds.length && bounds.every(({ min, max }, k) => numbers[k]! >= min && numbers[k]! <= max))
    return { azimuth, elevation, distance, target: [x, y, z], ...(fov !== undefined && { fov }) };
  reader.note('bad-camera', 'camera', given, '');
  return null;
}

/** The field of view stands at its end where it is not the usual one. */
function cameraText({ azimuth, elevation, distance, target, fov = FOV }: CameraState): string {
  const text = (value: number, k: number): string => {
    const { min, max } = CAMERA_BOUNDS[k]!;
    return String(Number(Math.min(max, Math.max(min, value)).toFixed(CAMERA_DIGITS[k])) + 0);
  };
  const place = [azimuth, elevation, distance, ...target].map(text);
  return [...place, ...(fov === FOV ? [] : [Number(fov.toFixed(2))])].join(',');
}

function written(value: unknown): string {
  return value === null ? NONE : String(value);
}

/** The link's pairs, taken one by one, and what was wrong with them. */
export class LinkReader {
  readonly notices: Notice[] = [];
  readonly #pairs = new Map<string, string>();
  readonly #repeated = new Set<string>();

  constructor(text: string, keys: readonly string[]) {
    for (const [key, value] of pairsOf(this.#cut(bodyOf(text, keys)))) {
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
  value(spec: Row, { min, max }: Bounds, given: string, fallback: unknown): unknown {
    const item = given.trim();
    if (spec.kind === 'choice') {
      if (spec.choices.some(({ value }) => value === item)) return item;
      this.note('unknown-choice', spec.url, given, String(fallback));
      return fallback;
    }
    if (spec.kind.startsWith('optional') && item === NONE) return null;
    if (!NUMBER.test(item)) {
      this.note('not-a-number', spec.url, given, fallback === null ? '' : String(fallback));
      return fallback;
    }
    const value = Number(item);
    const inside = Math.min(max, Math.max(min, value));
    const legal = spec.kind.endsWith('real') ? inside : Math.round(inside);
    if (legal !== value) this.note(inside === value ? 'not-whole' : 'clamped', spec.url, item, String(legal), { min, max });
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
    const keys = [...this.#pairs.keys()].filter((key) => !FOREIGN.test(key));
    if (keys.length === 0) return;
    const named = keys.slice(0, 3).map(quoted).join(', ');
    this.note('unknown-key', keys.length > 3 ? `${named}, … (${keys.length})` : named, '', '');
  }

  #cut(body: string): string {
    if (body.length <= MAX_LINK_LENGTH) return body;
    this.note('too-long', '', String(body.length), String(MAX_LINK_LENGTH));
    // Not through the middle of a number.
    const cut = body.lastIndexOf('&', MAX_LINK_LENGTH);
    return cut < 0 ? '' : body.slice(0, cut);
  }
}

/** Of an address the fragment, or the query where the fragment is no link; of plain text, all of it. */
function bodyOf(text: string, keys: readonly string[]): string {
  const address = trimmed(text);
  if (!/^([a-z][a-z\d+.-]*:|[?#]|\.{0,2}\/)/i.test(address)) return address;
  const [before = '', ...after] = address.split('#');
  const fragment = after.join('#');
  const query = before.includes('?') ? before.slice(before.indexOf('?') + 1) : '';
  return has(fragment, keys) || (fragment !== '' && !has(query, keys)) ? fragment : query;
}

function has(body: string, keys: readonly string[]): boolean {
  return pairsOf(body.slice(0, MAX_LINK_LENGTH)).some(([key]) => keys.includes(key));
}

/** Keys and values of `…=…&…`, also where a program has escaped all of it, or has undone the escapes of the link in it. */
function pairsOf(body: string): [string, string][] {
  let text = body;
  for (let k = 0; k < 3 && !text.includes('&') && /%(25)*(26|3d)/i.test(text); k += 1) text = decoded(text);
  // `&amp;` stands in links copied out of HTML.
  let nested = -1;
  const read: [string, string][] = [];
  for (const pair of text.split(/&(?:amp;)*/)) {
    if (pair === '') continue;
    const [key = ''] = pair.split('=', 1);
    // A link in a link says no more than its parameters; what follows it says how the whole is seen.
    if (nested >= 0 && !/^(view|color|camera)$/.test(key)) read[nested]![1] += `&${pair}`;
    else {
      read.push([key, pair.slice(key.length + 1)]);
      if (/=(v|preset)=/.test(pair)) nested = read.length - 1;
    }
  }
  return read.map(([key, value]) => [plain(key), plain(value)]);
}

/** What a person means: without escapes, and without what was not meant to be in it; full-width digits are digits. */
function plain(text: string): string {
  return trimmed(
    decoded(text)
      .normalize('NFKC')
      .replace(/\p{Cf}/gu, ''),
  );
}

function trimmed(text: string): string {
  let end = text.length;
  while (end > 0 && TAIL.test(text.charAt(end - 1))) end -= 1;
  return text.slice(0, end).replace(HEAD, '');
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
