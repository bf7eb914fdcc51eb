/** Requests for colonies of wood ears: checked, completed, and flat. Everything is derived from the table. */

import { RockFieldError } from './errors.ts';
import { checkValue, objectOf, rejectUnknown, unknownPreset, wrongType } from './param-checks.ts';
import type { Loose, Place } from './param-checks.ts';
import type { WoodEarPreset, WoodEarSpec } from './wood-ear-params.ts';
import { MAX_BASES, WOOD_EAR_PARAMS, WOOD_EAR_PRESETS } from './wood-ear.gen.ts';

type Row = (typeof WOOD_EAR_PARAMS)[number];
type FieldRow = Extract<Row, { scope: 'field' }>;
type ValueOf<R extends Row> = R extends { kind: 'choice' } ? R['choices'][number]['value'] : R extends { kind: 'optional-real' } ? number | null : number;

export type WoodEarPresetName = (typeof WOOD_EAR_PRESETS)[number]['name'];

/** `logLength` of the table is `length` here. */
export type WoodEarLogShape = { [R in FieldRow as R['key'] extends `log${infer Name}` ? Uncapitalize<Name> : never]: ValueOf<R> };

/** A log of one's own: cm, z up, triangles counter-clockwise from outside. */
export interface WoodEarLogMesh {
  positions: ArrayLike<number>;
  indices: ArrayLike<number>;
}

/** Where a colony spreads from; the nearest vertex of the log is taken. */
export interface WoodEarBase {
  /** cm */
  position: [number, number, number];
  /** cm; null: the colony's. */
  range: number | null;
}

export type WoodEarParams = { [R in FieldRow as R['key'] extends `log${string}` ? never : R['key']]: ValueOf<R> } & { log: WoodEarLogShape; bases: WoodEarBase[] };

type Some<T> = { [K in keyof T]?: T[K] | undefined };

/** A preset fills everything, each key given then replaces it; `base` is a single one of `bases`, which replace the whole list. */
export type WoodEarRequest = { preset?: WoodEarPresetName | undefined } & Some<Omit<WoodEarParams, 'log' | 'bases'>> & {
  log?: Some<WoodEarLogShape> | WoodEarLogMesh | undefined;
  base?: Some<WoodEarBase> | undefined;
  bases?: readonly Some<WoodEarBase>[] | undefined;
};

export interface LogMesh {
  positions: Float32Array;
  indices: Uint32Array;
}

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

/**
 * The request, checked and flat; it shares nothing with the request.
 *
 * @throws {RockFieldError} naming the key as the table has it, the value and the bounds; `layer` is the index of the base.
 */
export function flatColony(request: WoodEarRequest = {}, maxBytes: number): FlatColony {
  const given = objectOf(request, 'params');
  const keys = new Set(['preset', 'log', 'base', 'bases', ...COLONY_ROWS.map(({ key }) => key)]);
  rejectUnknown(given, (key) => keys.has(key));
  const preset = given['preset'] ?? WOOD_EAR_PRESETS[0].name;
  if (typeof preset !== 'string') throw wrongType('preset', preset, 'the name of a preset');
  const { log: presetLog, bases: presetBases, ...presetFields } = woodEarPreset(preset);
  const flat: number[] = [];
  const put = (spec: WoodEarSpec, value: unknown, fallback: unknown, at?: Place, name?: string) => {
    flat.push(encode(spec, checkValue(spec, spec, value === undefined ? fallback : value, at, name)));
  };
  const isMesh = typeof given['log'] === 'object' && given['log'] !== null && ('positions' in given['log'] || 'indices' in given['log']);
  const log = given['log'] === undefined ? {} : objectOf(given['log'], 'log');
  const names = isMesh ? ['positions', 'indices'] : LOG_ROWS.map(({ key }) => logName(key));
  rejectUnknown(log, (key) => names.includes(key), LOG);
  for (const spec of rows.filter(({ scope }) => scope === 'field')) {
    if (!LOG_ROWS.includes(spec)) put(spec, given[spec.key], (presetFields as Loose)[spec.key]);
    else put(spec, log[logName(spec.key)], (presetLog as Loose)[logName(spec.key)], LOG, logName(spec.key));
  }
  const bases = basesOf(given) ?? presetBases;
  flat.push(bases.length);
  bases.forEach((entry, index) => {
    const at = { index, name: `base ${index}` };
    const base = objectOf(entry, 'bases', at);
    rejectUnknown(base, (key) => key === 'position' || key === 'range', at);
    const position = base['position'] ?? BASE_ROWS.slice(0, 3).map((spec) => spec.default);
    if (!Array.isArray(position) || position.length !== 3) throw wrongType('position', position, 'a list of three numbers', at);
    // A hole in the list is a missing number.
    [...position, base['range'] ?? null].forEach((value: unknown, k) => put(BASE_ROWS[k]!, value, NaN, at, k < 3 ? `position[${k}]` : undefined));
  });
  return { params: Float64Array.from(flat), log: isMesh ? meshOf(log) : null, maxBytes };
}

function basesOf({ base, bases }: Loose): readonly unknown[] | undefined {
  if (base !== undefined && bases !== undefined) {
    throw new RockFieldError({ name: 'MalformedRequest', key: 'base', value: base, message: 'the request has both base and bases; it has to have one of them' });
  }
  if (base !== undefined) return [base];
  if (bases === undefined) return undefined;
  if (!Array.isArray(bases)) throw wrongType('bases', bases, 'a list of bases');
  if (bases.length < 1 || bases.length > MAX_BASES) {
    const message = `there are ${bases.length} bases; it has to be 1 to ${MAX_BASES}`;
    throw new RockFieldError({ name: 'OutOfRange', key: 'bases', value: bases.length, min: 1, max: MAX_BASES, message });
  }
  return bases;
}

function encode(spec: WoodEarSpec, value: number | string | null): number {
  return spec.kind === 'choice' ? spec.choices.findIndex((choice) => choice.value === value) : typeof value === 'number' ? value : NaN;
}

function meshOf(log: Loose): LogMesh {
  const positions = numbersOf('positions', log['positions']);
  const indices = numbersOf('indices', log['indices']);
  // As unsigned numbers they would be others.
  const wrong = indices.findIndex((index) => !Number.isInteger(index) || index < 0 || index > 0xffff_ffff);
  if (wrong >= 0) {
    throw new RockFieldError({ name: 'LogBadIndex', key: 'log', value: indices[wrong], message: `indices[${wrong}] of the log is ${indices[wrong]}; it has to be the number of a vertex` });
  }
  return { positions: Float32Array.from(positions), indices: Uint32Array.from(indices) };
}

function numbersOf(key: string, value: unknown): number[] {
  const isList = Array.isArray(value) || (ArrayBuffer.isView(value) && !(value instanceof DataView));
  const numbers = isList ? Array.from(value as ArrayLike<unknown>) : [];
  if (!isList || numbers.some((number) => typeof number !== 'number')) throw wrongType(key, value, 'a list of numbers', LOG);
  return numbers as number[];
}
