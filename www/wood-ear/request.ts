/** Requests for colonies of wood ears: checked, completed, and flat. Everything is derived from the table. */

import { RockFieldError } from '../base/errors.ts';
import { meshOf } from './log-mesh.ts';
import type { LogMesh } from './log-mesh.ts';
import { checkValue, isList, objectOf, rejectUnknown, unknownPreset, wrongType } from '../table/param-checks.ts';
import type { Loose, Place } from '../table/param-checks.ts';
import type { WoodEarPreset, WoodEarSpec } from './spec.ts';
import { MAX_BASES, WOOD_EAR_PARAMS, WOOD_EAR_PRESETS } from './params.gen.ts';

type Row = (typeof WOOD_EAR_PARAMS)[number];
type FieldRow = Extract<Row, { scope: 'field' }>;
type ValueOf<R extends Row> = R extends { kind: 'choice' }
  ? R['choices'][number]['value']
  : R extends { kind: 'optional-real' }
    ? number | null
    : number;

export type WoodEarPresetName = (typeof WOOD_EAR_PRESETS)[number]['name'];

/** `logLength` of the table is `length` here. */
export type WoodEarLogShape = { [R in FieldRow as R['key'] extends `log${infer Name}` ? Uncapitalize<Name> : never]: ValueOf<R> };

/** Numbers in an array, or in a typed one. */
export type Numbers =
  | readonly number[]
  | Float32Array
  | Float64Array
  | Int8Array
  | Uint8Array
  | Int16Array
  | Uint16Array
  | Int32Array
  | Uint32Array;

/**
 * A log of one's own: cm, z up, triangles counter-clockwise from outside.
 *
 * One whose longest level side is below 20 cm or above 10 m has been made in other units: it is scaled about the origin to 2 m. A closed one that
 * is inside out is turned. `colony.log` tells both.
 */
export interface WoodEarLogMesh {
  positions: Numbers;
  indices: Numbers;
  /** cm between the places where a wood ear can stand, as of a log that is made; the mesh's own vertices have no say. */
  spacing?: number | undefined;
}

/** Where a colony spreads from; the nearest vertex of the log is taken. */
export interface WoodEarBase {
  /** cm */
  position: [number, number, number];
  /** cm; null: the colony's. */
  range: number | null;
}

export type WoodEarParams = { [R in FieldRow as R['key'] extends `log${string}` ? never : R['key']]: ValueOf<R> } & {
  log: WoodEarLogShape;
  bases: WoodEarBase[];
};

/** The rows as properties of an element: `logLength` too. */
export type WoodEarProperties = { [R in FieldRow as R['key']]: ValueOf<R> };

type Some<T> = { [K in keyof T]?: T[K] | undefined };

/** A preset fills everything, each key given then replaces it; `base` is a single one of `bases`, which replace the whole list. */
export type WoodEarRequest = { preset?: WoodEarPresetName | undefined } & Some<Omit<WoodEarParams, 'log' | 'bases'>> & {
    log?: Some<WoodEarLogShape> | WoodEarLogMesh | undefined;
    base?: Some<WoodEarBase> | undefined;
    bases?: readonly Some<WoodEarBase>[] | undefined;
  };

/** A colony to grow, in the form that crosses every boundary. */
export interface FlatColony {
  /** `[field rows…, number of bases, per base: x, y, z, range]`; a choice is the index of its word, null is NaN. */
  params: Float64Array;
  log: LogMesh | null;
  maxBytes: number;
}

const rows: readonly WoodEarSpec[] = WOOD_EAR_PARAMS;
export const LOG_ROWS = /* @__PURE__ */ rows.filter(({ scope, key }) => scope === 'field' && /^log[A-Z]/.test(key));
export const COLONY_ROWS = /* @__PURE__ */ rows.filter(({ scope, key }) => scope === 'field' && !/^log[A-Z]/.test(key));
/** x, y, z, range */
export const BASE_ROWS = /* @__PURE__ */ rows.filter(({ scope }) => scope === 'base');
const LOG: Place = { name: 'the log' };

/** What a request calls a row of the log. */
export function logName(key: string): string {
  return key.charAt(3).toLowerCase() + key.slice(4);
}

export function woodEarDefault(spec: WoodEarSpec): number | string | null {
  return spec.kind === 'choice' ? (spec.choices[spec.default ?? 0]?.value ?? null) : spec.default;
}

/** A preset with the table's defaults for the rest, seed 0. */
export function woodEarPreset(name: string): WoodEarParams {
  const preset = (WOOD_EAR_PRESETS as readonly WoodEarPreset[]).find((candidate) => candidate.name === name);
  if (!preset) throw unknownPreset(name);
  const value = (spec: WoodEarSpec) => preset.fields?.[spec.key] ?? woodEarDefault(spec);
  const bases = preset.bases ?? [BASE_ROWS.map((spec) => spec.default)];
  return {
    ...Object.fromEntries(COLONY_ROWS.map((spec) => [spec.key, value(spec)])),
    log: Object.fromEntries(LOG_ROWS.map((spec) => [logName(spec.key), value(spec)])),
    bases: bases.map(([x, y, z, range]) => ({ position: [x, y, z], range: range ?? null })),
  } as WoodEarParams;
}

/** A request, checked and completed; `mesh` is a log of one's own, and of `params.log` the spacing alone counts then. */
export interface ResolvedColony {
  params: WoodEarParams;
  mesh: LogMesh | null;
}

/**
 * The full parameters that a request stands for; they share nothing with it.
 *
 * @throws {RockFieldError} naming the key as the table has it, the value and the bounds; `layer` is the index of the base.
 */
export function resolveColony(request: WoodEarRequest = {}): ResolvedColony {
  const given = objectOf(request, 'params');
  const keys = new Set(['preset', 'log', 'base', 'bases', ...COLONY_ROWS.map(({ key }) => key)]);
  rejectUnknown(given, (key) => keys.has(key));
  const preset = given['preset'] ?? WOOD_EAR_PRESETS[0].name;
  if (typeof preset !== 'string') throw wrongType('preset', preset, 'the name of a preset');
  const params = woodEarPreset(preset);
  for (const spec of COLONY_ROWS) {
    const value = given[spec.key];
    if (value !== undefined) (params as unknown as Loose)[spec.key] = checkValue(spec, spec, value);
  }
  const log = given['log'] === undefined ? {} : objectOf(given['log'], 'log');
  const isMesh = 'positions' in log || 'indices' in log;
  const names = isMesh ? ['positions', 'indices', 'spacing'] : LOG_ROWS.map(({ key }) => logName(key));
  rejectUnknown(log, (key) => names.includes(key), LOG);
  for (const spec of LOG_ROWS) {
    const name = logName(spec.key);
    const value = log[name];
    if (value !== undefined) (params.log as unknown as Loose)[name] = checkValue(spec, spec, value, LOG, name);
  }
  const bases = basesOf(given);
  // Not `map`: it passes over holes.
  if (bases) params.bases = Array.from(bases, baseOf);
  return { params, mesh: isMesh ? meshOf(log) : null };
}

function baseOf(entry: unknown, index: number): WoodEarBase {
  const at = { index, name: `base ${index}` };
  const base = objectOf(entry, 'bases', at);
  rejectUnknown(base, (key) => key === 'position' || key === 'range', at);
  const [x, y, z, range] = BASE_ROWS as [WoodEarSpec, WoodEarSpec, WoodEarSpec, WoodEarSpec];
  const position = base['position'] ?? [x, y, z].map((spec) => spec.default);
  if (!isList(position) || position.length !== 3) throw wrongType('position', position, 'a list of three numbers', at);
  const place = [x, y, z].map((spec, k) => checkValue(spec, spec, position[k], at, `position[${k}]`));
  return { position: place as WoodEarBase['position'], range: checkValue(range, range, base['range'] ?? null, at) as number | null };
}

/** Nothing is checked: Rust does that. */
export function encodeColony({ bases, log, ...params }: WoodEarParams): Float64Array {
  const value = ({ key }: WoodEarSpec): unknown =>
    key in params ? (params as unknown as Loose)[key] : (log as unknown as Loose)[logName(key)];
  const flat = rows.filter(({ scope }) => scope === 'field').map((spec) => encode(spec, value(spec)));
  const [x, y, z, range] = BASE_ROWS as [WoodEarSpec, WoodEarSpec, WoodEarSpec, WoodEarSpec];
  flat.push(bases.length);
  for (const base of bases) flat.push(...[x, y, z].map((spec, k) => encode(spec, base.position[k])), encode(range, base.range));
  return Float64Array.from(flat);
}

/** The request, checked and flat. Errors as of `resolveColony`. */
export function flatColony(request: WoodEarRequest | undefined, maxBytes: number): FlatColony {
  const { params, mesh } = resolveColony(request);
  return { params: encodeColony(params), log: mesh, maxBytes };
}

function basesOf({ base, bases }: Loose): readonly unknown[] | undefined {
  if (base !== undefined && bases !== undefined) {
    throw new RockFieldError({
      name: 'MalformedRequest',
      key: 'base',
      value: base,
      message: 'the request has both base and bases; it must have one of them',
    });
  }
  if (base !== undefined) return [base];
  if (bases === undefined) return undefined;
  if (!Array.isArray(bases)) throw wrongType('bases', bases, 'a list of bases');
  if (bases.length < 1 || bases.length > MAX_BASES) {
    const message = `there are ${bases.length} bases; their number must be between 1 and ${MAX_BASES}`;
    throw new RockFieldError({ name: 'OutOfRange', key: 'bases', value: bases.length, min: 1, max: MAX_BASES, message });
  }
  return bases;
}

function encode(spec: WoodEarSpec, value: unknown): number {
  return spec.kind === 'choice' ? spec.choices.findIndex((choice) => choice.value === value) : typeof value === 'number' ? value : NaN;
}
