/** Where wood ears stand on their log. */

import type { WoodEarColony } from '../data/colony.ts';
import type { WoodEarSceneParams } from './table.ts';

type Vector = [number, number, number];

/**
 * For each ear x, y, z, cm: the place on the log's surface that is nearest to its foot. On a log that is made that is a vertex, on one of your own a
 * point of the triangle that the ear stands on.
 */
export function placesOnLog(colony: WoodEarColony, { mesh, meridians }: Pick<WoodEarSceneParams, 'mesh' | 'meridians'>): Float64Array {
  const { foot, vertexStarts, positions, log } = colony;
  const places = new Float64Array(3 * foot.length);
  const nearest = mesh ? undefined : nearestOf(log.positions);
  foot.forEach((triangle, ear) => {
    const middle = middleOf(positions, vertexStarts[ear]!, meridians);
    const place = nearest?.(middle) ?? onTriangle(mesh!.positions, mesh!.indices, triangle, middle);
    places.set(place, 3 * ear);
  });
  return places;
}

/** Of the innermost ring, which is the first. */
function middleOf(positions: Float32Array, first: number, count: number): Vector {
  return [0, 1, 2].map((axis) => {
    let sum = 0;
    for (let v = first; v < first + count; v++) sum += positions[3 * v + axis]!;
    return sum / count;
  }) as Vector;
}

/** What finds the nearest of these points. They are sorted along x, in which logs are long. */
function nearestOf(points: Float32Array): (to: Vector) => Vector {
  const count = points.length / 3;
  const order = Uint32Array.from({ length: count }, (_, v) => v).sort((a, b) => points[3 * a]! - points[3 * b]! || a - b);
  return (to) => {
    let [low, high] = [0, count];
    while (low < high) {
      const half = (low + high) >> 1;
      if (points[3 * order[half]!]! < to[0]) low = half + 1;
      else high = half;
    }
    let [best, least] = [-1, Infinity];
    // Outward, on each side until x alone is too far.
    for (const [from, step] of [
      [low, 1],
      [low - 1, -1],
    ] as const) {
      for (let k = from; k >= 0 && k < count; k += step) {
        const v = 3 * order[k]!;
        const [dx, dy, dz] = [points[v]! - to[0], points[v + 1]! - to[1], points[v + 2]! - to[2]];
        if (dx * dx >= least) break;
        const far = dx * dx + dy * dy + dz * dz;
        if (far < least) [best, least] = [v, far];
      }
    }
    return [points[best]!, points[best + 1]!, points[best + 2]!];
  };
}

/** The point of a triangle that is nearest to another. */
function onTriangle(positions: Float32Array, indices: Uint32Array, triangle: number, p: Vector): Vector {
  const [a, b, c] = [0, 1, 2].map((corner) => {
    const at = 3 * indices[3 * triangle + corner]!;
    return [positions[at]!, positions[at + 1]!, positions[at + 2]!] as Vector;
  }) as [Vector, Vector, Vector];
  const [ab, ac, ap] = [minus(b, a), minus(c, a), minus(p, a)];
  const [d00, d01, d11, d20, d21] = [dot(ab, ab), dot(ab, ac), dot(ac, ac), dot(ap, ab), dot(ap, ac)];
  const area = d00 * d11 - d01 * d01;
  const [v, w] = area > 0 ? [(d11 * d20 - d01 * d21) / area, (d00 * d21 - d01 * d20) / area] : [-1, -1];
  if (v >= 0 && w >= 0 && v + w <= 1) return [0, 1, 2].map((axis) => a[axis]! + v * ab[axis]! + w * ac[axis]!) as Vector;
  const sides = [onSegment(a, b, p), onSegment(b, c, p), onSegment(c, a, p)];
  const far = sides.map((side) => dot(minus(side, p), minus(side, p)));
  return sides[far.indexOf(Math.min(...far))]!;
}

function onSegment(a: Vector, b: Vector, p: Vector): Vector {
  const along = minus(b, a);
  const length = dot(along, along);
  const share = length > 0 ? Math.min(1, Math.max(0, dot(minus(p, a), along) / length)) : 0;
  return [0, 1, 2].map((axis) => a[axis]! + share * along[axis]!) as Vector;
}

function minus(a: Vector, b: Vector): Vector {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

function dot(a: Vector, b: Vector): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
