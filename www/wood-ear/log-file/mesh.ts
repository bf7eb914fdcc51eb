/** From triangles as they stand in a file to a log: cleaned, measured, laid down, rounded, merged. In this order. */

import type { RockFieldError } from '../../base/errors.ts';
import { LOG_LENGTH, scaleOfLog } from '../log-units.ts';
import type { Words } from '../../base/language.ts';
import type { LogMesh } from '../log-mesh.ts';
import { FARTHEST, MOST_TRIANGLES, MOST_VERTICES } from './limits.ts';
import { refused } from './refusal.ts';

/** Triangles as they stand in a file: three numbers for each vertex, y up, cm. Numbers are rounded to f32 once the log is at the origin. */
export interface Soup {
  positions: Float64Array;
  indices: Uint32Array;
}

export interface LogFile {
  /** cm, z up, the longer level side along x, the middle at the origin. */
  mesh: LogMesh;
  /** What was changed, a sentence each. */
  notices: Words[];
}

/** @throws {RockFieldError} `LogFileNoMesh`, `LogNoArea`, `LogFileBroken` or `LogTooLarge`. */
export function logOf({ positions, indices: given }: Soup, name: string): LogFile {
  if (given.length === 0) throw refused('LogFileNoMesh', { en: `${name} has no triangles`, ja: `${name} に三角形がありません` });
  const indices = withArea(positions, given);
  if (indices.length === 0) throw flat(name);
  const laid = laidDown(positions, indices, name);
  const mesh = merged(laid.positions, indices);
  // Beside a side of astronomical length the others round to nothing.
  if (mesh.indices.length === 0) throw flat(name);
  checkCount(name, { en: 'vertices', ja: '頂点' }, mesh.positions.length / 3, MOST_VERTICES);
  checkCount(name, { en: 'triangles', ja: '三角形' }, mesh.indices.length / 3, MOST_TRIANGLES);
  return { mesh, notices: laid.notices };
}

function flat(name: string): RockFieldError {
  return refused('LogNoArea', { en: `no triangle of ${name} has an area`, ja: `${name} の三角形にはどれも面積がありません` });
}

export function checkCount(name: string, what: Words, value: number, max: number): void {
  if (value <= max) return;
  throw refused(
    'LogTooLarge',
    {
      en: `${name} has ${value} ${what.en}; a log may have at most ${max}. Simplify the mesh before saving it`,
      ja: `${name} の${what.ja}は ${value} 個です（上限 ${max} 個）。メッシュを簡略化してください`,
    },
    { value, max },
  );
}

/** Without the triangles that are points or lines: nothing that is not seen decides how large the log is. */
function withArea(positions: Float64Array, indices: Uint32Array): Uint32Array {
  const kept = new Uint32Array(indices.length);
  let length = 0;
  for (let i = 0; i + 2 < indices.length; i += 3) {
    const [a, b, c] = [indices[i]!, indices[i + 1]!, indices[i + 2]!];
    if (!hasArea(positions, 3 * a, 3 * b, 3 * c)) continue;
    kept[length] = a;
    kept[length + 1] = b;
    kept[length + 2] = c;
    length += 3;
  }
  return kept.subarray(0, length);
}

function hasArea(p: Float64Array, a: number, b: number, c: number): boolean {
  const [ux, uy, uz] = [p[b]! - p[a]!, p[b + 1]! - p[a + 1]!, p[b + 2]! - p[a + 2]!];
  const [vx, vy, vz] = [p[c]! - p[a]!, p[c + 1]! - p[a + 1]!, p[c + 2]! - p[a + 2]!];
  return uy * vz !== uz * vy || uz * vx !== ux * vz || ux * vy !== uy * vx;
}

/** Up is z, the log lies along x, and its middle is the origin. Vertices that no triangle uses decide nothing. */
function laidDown(given: Float64Array, indices: Uint32Array, name: string): { positions: Float32Array; notices: Words[] } {
  const [low, high] = box(given, indices);
  const sides = high.map((value, k) => value - low[k]!);
  if (!sides.every(Number.isFinite)) {
    throw refused('LogFileBroken', {
      en: `${name} has vertices that are infinitely far away, or that are not numbers`,
      ja: `${name} に位置の定まらない頂点があります`,
    });
  }
  const isAlongX = sides[0]! >= sides[2]!;
  const length = Math.max(sides[0]!, sides[2]!);
  if (length === 0)
    throw refused('LogFileNoMesh', {
      en: `${name} stands upright and has no length: x or z must be the longest side`,
      ja: `${name} には水平方向の長さがありません`,
    });
  const scale = scaleOfLog(length);
  const reach = (Math.max(...sides) * scale) / 2;
  if (!(reach <= FARTHEST)) {
    const times = Math.round(Math.max(...sides) / length);
    throw refused(
      'LogBadPosition',
      {
        en: `${name} is ${times} times as high as it is long: x or z must be the longest side`,
        ja: `${name} の高さは長さの ${times} 倍です。x か z が最も長くなければなりません`,
      },
      { value: reach, max: FARTHEST },
    );
  }
  const rounded = Number(length.toPrecision(3));
  const notices =
    scale !== 1
      ? [
          {
            en: `${name} is ${rounded} cm long; it is shown ${LOG_LENGTH.instead} cm long`,
            ja: `${name} の長さは ${rounded} cm です。${LOG_LENGTH.instead} cm にして表示します`,
          },
        ]
      : [];
  const middle = low.map((value, k) => value + sides[k]! / 2);
  const positions = new Float32Array(given.length);
  for (let i = 0; i < given.length; i += 3) {
    const [x, y, z] = [0, 1, 2].map((k) => (given[i + k]! - middle[k]!) * scale) as [number, number, number];
    positions.set(isAlongX ? [x, -z, y] : [z, x, y], i);
  }
  return { positions, notices };
}

/** Of the vertices that are used. */
function box(positions: Float64Array, indices: Uint32Array): [number[], number[]] {
  const [low, high] = [
    [Infinity, Infinity, Infinity],
    [-Infinity, -Infinity, -Infinity],
  ];
  for (const index of indices) {
    for (let k = 0; k < 3; k += 1) {
      const value = positions[3 * index + k]!;
      if (value < low[k]!) low[k] = value;
      if (value > high[k]!) high[k] = value;
      if (Number.isNaN(value)) return [[NaN], [NaN]];
    }
  }
  return [low, high];
}

/** Vertices at one place are one: on each grows a wood ear. Triangles that lose a corner so are left out, and vertices without a triangle. */
function merged(positions: Float32Array, indices: Uint32Array): LogMesh {
  const first = firstAtPlace(positions, indices);
  const numbers = new Uint32Array(positions.length / 3);
  const places = new Float32Array(positions.length);
  const corners = new Uint32Array(indices.length);
  let [count, length] = [0, 0];
  for (let i = 0; i + 2 < indices.length; i += 3) {
    const [a, b, c] = [first[indices[i]!]!, first[indices[i + 1]!]!, first[indices[i + 2]!]!];
    if (a === b || b === c || c === a) continue;
    for (const vertex of [a, b, c]) {
      // 0: not numbered yet.
      if (numbers[vertex] === 0) {
        places.set(positions.subarray(3 * vertex, 3 * vertex + 3), 3 * count);
        count += 1;
        numbers[vertex] = count;
      }
      corners[length] = numbers[vertex]! - 1;
      length += 1;
    }
  }
  return { positions: places.slice(0, 3 * count), indices: corners.slice(0, length) };
}

/** For each vertex that is used the first one at its place, through a table with open addressing. */
function firstAtPlace(positions: Float32Array, indices: Uint32Array): Uint32Array {
  const NONE = 0xffff_ffff;
  const first = new Uint32Array(positions.length / 3).fill(NONE);
  const table = new Uint32Array(2 ** Math.ceil(Math.log2(2 * Math.max(first.length, 1)))).fill(NONE);
  // −0 and 0 are one place.
  for (let i = 0; i < positions.length; i += 1) positions[i]! += 0;
  const bits = new Uint32Array(positions.buffer);
  for (const vertex of indices) {
    if (first[vertex] !== NONE) continue;
    const at = 3 * vertex;
    let slot = Math.imul(Math.imul(Math.imul(bits[at]!, 0x9e37_79b1) ^ bits[at + 1]!, 0x85eb_ca6b) ^ bits[at + 2]!, 0xc2b2_ae35);
    slot = (slot ^ (slot >>> 15)) & (table.length - 1);
    while (table[slot] !== NONE) {
      const other = 3 * table[slot]!;
      if (bits[other] === bits[at] && bits[other + 1] === bits[at + 1] && bits[other + 2] === bits[at + 2]) break;
      slot = (slot + 1) & (table.length - 1);
    }
    if (table[slot] === NONE) table[slot] = vertex;
    first[vertex] = table[slot]!;
  }
  return first;
}
