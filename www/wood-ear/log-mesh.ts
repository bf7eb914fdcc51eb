/** A log of one's own from code: checked before it takes the place of another, in the order in which Rust checks it again, and scaled to cm. */

import { RockFieldError } from '../base/errors.ts';
import { FARTHEST, MOST_TRIANGLES, MOST_VERTICES } from './log-file/limits.ts';
import { LOG_LENGTH, scaleOfLog } from './log-units.ts';
import { isList, wrongType } from '../table/param-checks.ts';
import type { Loose } from '../table/param-checks.ts';

export interface LogMesh {
  positions: Float32Array;
  indices: Uint32Array;
  /** What its coordinates have been multiplied by, where they have been. */
  scale?: number | undefined;
}

/**
 * In cm: a mesh that was made in other units is scaled about the origin.
 *
 * @throws {RockFieldError} `WrongType`, `LogNotInThrees`, `LogTooLarge`, `LogBadPosition`, `LogBadIndex` or `LogNoArea`, with value and bounds.
 */
export function meshOf(log: Loose): LogMesh {
  const positions = numbersOf('positions', log['positions']);
  const given = numbersOf('indices', log['indices']);
  for (const { length: value } of [positions, given]) {
    if (value % 3 !== 0)
      throw refused('LogNotInThrees', `the log's positions and its indices must come in threes; there are ${value}`, { value });
  }
  for (const [value, max] of [
    [positions.length / 3, MOST_VERTICES],
    [given.length / 3, MOST_TRIANGLES],
  ] as const) {
    if (value > max)
      throw refused('LogTooLarge', `the log has ${value} vertices or triangles; it may have at most ${max}`, { value, min: 0, max });
  }
  const indices = new Uint32Array(given);
  const isNear = farAway(positions, LOG_LENGTH.max / 2) < 0;
  const scale = scaleOfLog(extent(positions, indices, isNear));
  const scaled = new Float32Array(positions);
  if (scale !== 1) for (let i = 0; i < scaled.length; i += 1) scaled[i] = positions[i]! * scale;
  const far = isNear && scale === 1 ? -1 : farAway(scaled, FARTHEST);
  if (far >= 0) {
    const value = positions[far]! * scale;
    throw refused(
      'LogBadPosition',
      `vertex ${Math.floor(far / 3)} of the log has the coordinate ${value}, not within 100 m of the origin`,
      { value, min: -FARTHEST, max: FARTHEST },
    );
  }
  const max = positions.length / 3 - 1;
  const missing = notAmong(indices, given, max);
  if (missing >= 0) {
    const value = given[missing]!;
    throw refused('LogBadIndex', `triangle ${Math.floor(missing / 3)} of the log names vertex ${value}, which is not there`, {
      value,
      min: 0,
      max,
    });
  }
  if (!hasArea(scaled, indices)) throw refused('LogNoArea', 'no triangle of the log has an area');
  return { positions: scaled, indices, scale };
}

/** The place of the first coordinate that is not a number or farther than `most` from the origin; −1 if there is none. */
function farAway(coordinates: ArrayLike<number>, most: number): number {
  for (let i = 0; i < coordinates.length; i += 1) {
    // Written so that NaN is found too.
    if (!(Math.abs(coordinates[i]!) <= most)) return i;
  }
  return -1;
}

/** The place of an index that is larger than `max`, or was given as a negative number or a fraction; −1 if there is none. */
function notAmong(indices: Uint32Array, given: ArrayLike<number>, max: number): number {
  for (let i = 0; i < indices.length; i += 1) if (indices[i]! > max) return i;
  // An array of unsigned integers holds neither fractions nor negative numbers.
  if (given instanceof Uint32Array || given instanceof Uint16Array) return -1;
  for (let i = 0; i < indices.length; i += 1) if (indices[i] !== given[i]) return i;
  return -1;
}

type LogErrorName = 'LogNotInThrees' | 'LogTooLarge' | 'LogBadPosition' | 'LogBadIndex' | 'LogNoArea';

function refused(name: LogErrorName, message: string, numbers: { value?: number; min?: number; max?: number } = {}): RockFieldError {
  return new RockFieldError({ name, key: 'log', message, ...numbers });
}

/**
 * The longer level side of the box around the vertices that triangles use, in the mesh's own units. Where no vertex reaches beyond a log's greatest
 * length and some triangles already span the smallest, the scale is 1 whatever the rest span: their length is returned, and the rest is not read.
 * `isNear`: no coordinate is farther from the origin than half that length.
 */
function extent(positions: ArrayLike<number>, indices: Uint32Array, isNear: boolean): number {
  const all = new Box();
  for (let i = 0; !isNear && i + 1 < positions.length; i += 3) all.add(positions[i]!, positions[i + 1]!);
  const used = new Box();
  for (let i = 0; i < indices.length; i += 1) {
    const at = 3 * indices[i]!;
    if (at < positions.length) used.add(positions[at]!, positions[at + 1]!);
    if (i % 1024 === 0 && all.length <= LOG_LENGTH.max && used.length >= LOG_LENGTH.min) break;
  }
  return used.length;
}

/** A level box that grows around points; NaN is passed over. */
class Box {
  #left = Infinity;
  #right = -Infinity;
  #front = Infinity;
  #back = -Infinity;

  /** The longer side. */
  get length(): number {
    return Math.max(this.#right - this.#left, this.#back - this.#front);
  }

  add(x: number, y: number): void {
    if (x < this.#left) this.#left = x;
    if (x > this.#right) this.#right = x;
    if (y < this.#front) this.#front = y;
    if (y > this.#back) this.#back = y;
  }
}

/** Whether any triangle has an area. The first one nearly always has, so that this seldom looks further. */
function hasArea(positions: Float32Array, indices: Uint32Array): boolean {
  for (let i = 0; i < indices.length; i += 3) {
    const [a, b, c] = [3 * indices[i]!, 3 * indices[i + 1]!, 3 * indices[i + 2]!];
    const [ux, uy, uz] = [positions[b]! - positions[a]!, positions[b + 1]! - positions[a + 1]!, positions[b + 2]! - positions[a + 2]!];
    const [vx, vy, vz] = [positions[c]! - positions[a]!, positions[c + 1]! - positions[a + 1]!, positions[c + 2]! - positions[a + 2]!];
    if (uy * vz !== uz * vy || uz * vx !== ux * vz || ux * vy !== uy * vx) return true;
  }
  return false;
}

function numbersOf(key: string, value: unknown): ArrayLike<number> {
  const list = isList(value) ? value : undefined;
  let isRight = list !== undefined;
  // A typed array holds numbers and nothing else, so that its entries need not be looked at.
  const isTyped =
    list instanceof Float32Array || list instanceof Float64Array || list instanceof Uint32Array || list instanceof Uint16Array;
  for (let i = 0; !isTyped && isRight && i < list!.length; i += 1) isRight = typeof list![i] === 'number';
  if (!isRight) throw wrongType(key, value, 'a list of numbers', { name: 'the log' });
  return list as ArrayLike<number>;
}
