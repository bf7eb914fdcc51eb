/** What is measured of a body, in metres: for whoever reads the file. */

import type { Model } from './model.ts';
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
export function measuresOf({ positions, indices, indexStarts, vertexStarts, origins, unit }: Model, k: number): Measures {
  const [first, last] = [vertexStarts[k]!, vertexStarts[k + 1]!];
  const [begin, end] = [indexStarts[k]!, indexStarts[k + 1]!];
  const rim = rimOf(last - first, (end - begin) / 3);
  const [x, y] = [origins[3 * k]!, origins[3 * k + 1]!];
  let [z, twiceArea] = [0, 0];
  for (let v = 0; v < rim; v++) {
    const [a, b] = [3 * (first + v), 3 * (first + ((v + 1) % rim))];
    z += positions[a + 2]! / rim;
    twiceArea += (positions[a]! - x) * (positions[b + 1]! - y) - (positions[b]! - x) * (positions[a + 1]! - y);
  }
  // Seen from the middle of the rim, from which the bottom is a fan without volume.
  let sixfold = 0;
  for (let i = begin; i < end; i += 3) {
    const [a, b, c] = [3 * indices[i]!, 3 * indices[i + 1]!, 3 * indices[i + 2]!];
    const [ax, ay, az] = [positions[a]! - x, positions[a + 1]! - y, positions[a + 2]! - z];
    const [bx, by, bz] = [positions[b]! - x, positions[b + 1]! - y, positions[b + 2]! - z];
    const [cx, cy, cz] = [positions[c]! - x, positions[c + 1]! - y, positions[c + 2]! - z];
    sixfold += ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
  }
  const spans = [0, 2, 1].map((axis) => {
    let [least, most] = [Infinity, -Infinity];
    for (let v = 3 * first + axis; v < 3 * last; v += 3) {
      least = Math.min(least, positions[v]!);
      most = Math.max(most, positions[v]!);
    }
    return rounded(unit * (most - least));
  });
  return {
    area: rounded((unit * unit * twiceArea) / 2),
    volume: rounded((unit * unit * unit * sixfold) / 6),
    size: spans as Measures['size'],
  };
}

/** Four digits: nobody measures a stone more closely. */
function rounded(value: number): number {
  return Number(value.toPrecision(4));
}
