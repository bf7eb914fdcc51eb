/** Values of a request from code, checked against the rows of a table. Nothing is corrected silently: an error names key, value and bounds. */

import { RockFieldError } from '../base/errors.ts';
import type { ErrorName } from '../base/errors.ts';

/** What a parameter is before it is checked. */
export type Loose = Record<string, unknown>;

/** What a value belongs to, where that is not the request itself: a layer, a base. */
export interface Place {
  /** In the list it stands in. */
  index?: number;
  /** For people. */
  name: string;
}

interface Range {
  min: number;
  max: number;
}

/** A row, as far as its values are checked. */
interface Spec extends Range {
  key: string;
  component: number | null;
  kind: 'real' | 'integer' | 'optional-real' | 'optional-integer' | 'choice';
  choices: readonly { value: string }[];
}

/** A value of a row, checked. `name` is how the request calls it, where that is not the key. */
export function checkValue(
  spec: Spec,
  bounds: Range,
  value: unknown,
  at?: Place,
  name: string = spec.component === null ? spec.key : `${spec.key}[${spec.component}]`,
): number | string | null {
  if (spec.kind === 'choice') {
    if (spec.choices.some((choice) => choice.value === value)) return value as string;
    const words = spec.choices.map((choice) => choice.value).join(' or ');
    if (typeof value !== 'string') throw wrongType(spec.key, value, words, at, name);
    throw badValue('OutOfRange', spec.key, value, words, at, name, spec);
  }
  if (spec.kind.startsWith('optional') && value === null) return null;
  return checkNumber(spec.key, value, bounds, spec.kind.endsWith('integer'), at, name);
}

export function checkNumber(key: string, value: unknown, { min, max }: Range, whole: boolean, at?: Place, part: string = key): number {
  if (typeof value !== 'number') throw wrongType(key, value, 'a number', at, part);
  // Written so that NaN fails too.
  if (!(value >= min && value <= max)) throw badValue('OutOfRange', key, value, `between ${min} and ${max}`, at, part, { min, max });
  if (whole && !Number.isInteger(value)) throw badValue('NotAnInteger', key, value, 'a whole number', at, part, { min, max });
  // −0 would be another number in the link and in the flat list.
  return value === 0 ? 0 : value;
}

/** @param key `params` for the request itself. */
export function objectOf(value: unknown, key: string, at?: Place): Loose {
  // Own keys alone: nothing that a prototype adds is a request.
  if (typeof value === 'object' && value !== null && !isList(value)) return { ...value };
  if (key === 'params') {
    throw new RockFieldError({ name: 'MalformedRequest', key, value, message: `the request is ${shown(value)}; it must be an object` });
  }
  throw at ? wrongType(key, value, 'an object', { ...at, name: '' }, at.name) : wrongType(key, value, 'an object');
}

export function rejectUnknown(given: Loose, known: (key: string) => boolean, at?: Place): void {
  const key = Object.keys(given).find((candidate) => !known(candidate));
  if (key === undefined) return;
  const value = given[key];
  throw new RockFieldError({
    name: 'UnknownKey',
    key,
    layer: at?.index,
    value,
    message: `there is no parameter called ${shown(key)}${of(at)}`,
  });
}

export function wrongType(key: string, value: unknown, wanted: string, at?: Place, name: string = key): RockFieldError {
  return badValue('WrongType', key, value, wanted, at, name);
}

/** @param wanted what it must be instead. */
function badValue(
  error: ErrorName,
  key: string,
  value: unknown,
  wanted: string,
  at: Place | undefined,
  name: string,
  { min, max }: Partial<Range> = {},
): RockFieldError {
  const message = `${name}${of(at)} is ${value === undefined ? 'missing' : shown(value)}; it must be ${wanted}`;
  return new RockFieldError({ name: error, key, layer: at?.index, value, min, max, message });
}

export function unknownPreset(name: string): RockFieldError {
  return new RockFieldError({ name: 'UnknownPreset', key: 'preset', value: name, message: `there is no preset called ${shown(name)}` });
}

function of(at: Place | undefined): string {
  return at?.name ? ` of ${at.name}` : '';
}

/** Typed arrays are lists of numbers. */
export function isList(value: unknown): value is ArrayLike<unknown> {
  return Array.isArray(value) || (ArrayBuffer.isView(value) && !(value instanceof DataView));
}

/** A value for a message: short, whatever it is. Objects say nothing for themselves: they may have no way to, or throw. */
export function shown(value: unknown): string {
  const text = isList(value)
    ? 'a list'
    : typeof value === 'string'
      ? JSON.stringify(value)
      : value instanceof Function
        ? 'a function'
        : value === Object(value)
          ? 'an object'
          : String(value);
  return text.length > 60 ? `${text.slice(0, 60)}…` : text;
}
