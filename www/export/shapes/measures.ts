/** What is measured of a body, in metres: for whoever reads the file. */

import type { Model } from '../model.ts';
import { rimOf } from './solid.ts';

export interface Measures {
  /** Of the footprint, m². */
  area: number;
  /** Inside the closed body, m³. */
  volume: number;
  /** Of the box around it, m: x, y (up) and z of glTF. */
  size: [number, number, number];
}

/** @param k the body, which is open below. */
export function measuresOf(model: Model, k: number): Measures {
  const { positions, indexStarts, vertexStarts, origins, unit } = model;
  const first = vertexStarts[k]!;
  const last = vertexStarts[k + 1]!;
  const rim = rimOf(last - first, (indexStarts[k + 1]! - indexStarts[k]!) / 3);
  const x = origins[3 * k]!;
  const y = origins[3 * k + 1]!;
  let z = 0;
  let twiceArea = 0;
  for (let v = 0; v < rim; v++) {
    const a = 3 * (first + v);
    const b = v + 1 < rim ? a + 3 : 3 * first;
    z += positions[a + 2]! / rim;
    twiceArea += (positions[a]! - x) * (positions[b + 1]! - y) - (positions[b]! - x) * (positions[a + 1]! - y);
  }
  return {
    area: (unit * unit * twiceArea) / 2,
    volume: (unit * unit * unit * sixfoldVolume(model, k, x, y, z)) / 6,
    size: sizeOf(positions, first, last, unit),
  };
}

/** Seen from the middle of the rim, from which the bottom is a fan without volume. */
function sixfoldVolume({ positions, indices, indexStarts }: Model, k: number, x: number, y: number, z: number): number {
  const end = indexStarts[k + 1]!;
  let sum = 0;
  for (let i = indexStarts[k]!; i < end; i += 3) {
    const a = 3 * indices[i]!;
    const b = 3 * indices[i + 1]!;
    const c = 3 * indices[i + 2]!;
    const ax = positions[a]! - x;
    const ay = positions[a + 1]! - y;
    const az = positions[a + 2]! - z;
    const bx = positions[b]! - x;
    const by = positions[b + 1]! - y;
    const bz = positions[b + 2]! - z;
    const cx = positions[c]! - x;
    const cy = positions[c + 1]! - y;
    const cz = positions[c + 2]! - z;
    sum += ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
  }
  return sum;
}

/** Of the box around the vertices from `first` to before `last`. */
export function sizeOf(positions: Float32Array, first: number, last: number, unit: number): Measures['size'] {
  return [unit * span(positions, first, last, 0), unit * span(positions, first, last, 2), unit * span(positions, first, last, 1)];
}

/** How far vertices reach along an axis. */
function span(positions: Float32Array, first: number, last: number, axis: number): number {
  let least = Infinity;
  let most = -Infinity;
  for (let v = 3 * first + axis; v < 3 * last; v += 3) {
    const value = positions[v]!;
    if (value < least) least = value;
    if (value > most) most = value;
  }
  return most - least;
}
