/** Whether a surface passes through itself, or has an edge. Only + − × ÷, so that all engines find the same. */

import type { Model } from './model.ts';

type Surface = Pick<Model, 'positions' | 'indices'>;

/** Whether two triangles that share no vertex pass through each other. Those that only touch do not. */
export function crossesItself({ positions, indices }: Surface): boolean {
  const count = indices.length / 3;
  const boxes = boxesOf(positions, indices);
  const order = Uint32Array.from({ length: count }, (_, t) => t).sort((s, t) => boxes[6 * s]! - boxes[6 * t]! || s - t);
  for (let i = 0; i < count; i++) {
    const t = order[i]!;
    for (let j = i + 1; j < count && boxes[6 * order[j]!]! <= boxes[6 * t + 3]!; j++) {
      const s = order[j]!;
      if (overlap(boxes, s, t) && !shareVertex(indices, s, t) && crossing(positions, indices, s, t)) return true;
    }
  }
  return false;
}

/** Whether each edge has two triangles, which run along it in opposite directions. Vertices at one place count as one. */
export function isClosed({ positions, indices }: Surface): boolean {
  const places = new Map<string, number>();
  const placeOf = Uint32Array.from({ length: positions.length / 3 }, (_, v) => {
    // −0 is where 0 is.
    const key = `${positions[3 * v]! + 0},${positions[3 * v + 1]! + 0},${positions[3 * v + 2]! + 0}`;
    if (!places.has(key)) places.set(key, places.size);
    return places.get(key)!;
  });
  const size = places.size;
  const edges = new Set<number>();
  for (let i = 0; i < indices.length; i++) {
    const [from, to] = [placeOf[indices[i]!]!, placeOf[indices[i % 3 === 2 ? i - 2 : i + 1]!]!];
    if (from === to) continue;
    const edge = from * size + to;
    if (edges.has(edge)) return false;
    edges.add(edge);
  }
  for (const edge of edges) if (!edges.has((edge % size) * size + Math.floor(edge / size))) return false;
  return edges.size > 0;
}

/** For each triangle the least and the greatest coordinates. */
function boxesOf(positions: Float32Array, indices: Uint32Array): Float32Array {
  const boxes = new Float32Array(2 * indices.length);
  for (let t = 0; t < indices.length; t += 3) {
    for (let axis = 0; axis < 3; axis++) {
      const [a, b, c] = [
        positions[3 * indices[t]! + axis]!,
        positions[3 * indices[t + 1]! + axis]!,
        positions[3 * indices[t + 2]! + axis]!,
      ];
      boxes[2 * t + axis] = Math.min(a, b, c);
      boxes[2 * t + 3 + axis] = Math.max(a, b, c);
    }
  }
  return boxes;
}

function overlap(boxes: Float32Array, s: number, t: number): boolean {
  for (let axis = 0; axis < 3; axis++) {
    if (boxes[6 * s + axis]! > boxes[6 * t + 3 + axis]! || boxes[6 * t + axis]! > boxes[6 * s + 3 + axis]!) return false;
  }
  return true;
}

function shareVertex(indices: Uint32Array, s: number, t: number): boolean {
  for (let i = 3 * s; i < 3 * s + 3; i++) for (let j = 3 * t; j < 3 * t + 3; j++) if (indices[i] === indices[j]) return true;
  return false;
}

/** Whether an edge of one passes through the other. */
function crossing(positions: Float32Array, indices: Uint32Array, s: number, t: number): boolean {
  for (const [one, other] of [
    [3 * s, 3 * t],
    [3 * t, 3 * s],
  ] as const) {
    const [a, b, c] = [3 * indices[other]!, 3 * indices[other + 1]!, 3 * indices[other + 2]!];
    for (let k = 0; k < 3; k++) {
      const [p, q] = [3 * indices[one + k]!, 3 * indices[one + ((k + 1) % 3)]!];
      if (side(positions, a, b, c, p) * side(positions, a, b, c, q) >= 0) continue;
      const [ab, bc, ca] = [side(positions, p, q, a, b), side(positions, p, q, b, c), side(positions, p, q, c, a)];
      if ((ab > 0 && bc > 0 && ca > 0) || (ab < 0 && bc < 0 && ca < 0)) return true;
    }
  }
  return false;
}

/** Six times the volume of the tetrahedron whose corners begin at these places. */
function side(x: Float32Array, a: number, b: number, c: number, d: number): number {
  const [ux, uy, uz] = [x[b]! - x[a]!, x[b + 1]! - x[a + 1]!, x[b + 2]! - x[a + 2]!];
  const [vx, vy, vz] = [x[c]! - x[a]!, x[c + 1]! - x[a + 1]!, x[c + 2]! - x[a + 2]!];
  const [wx, wy, wz] = [x[d]! - x[a]!, x[d + 1]! - x[a + 1]!, x[d + 2]! - x[a + 2]!];
  return ux * (vy * wz - vz * wy) + uy * (vz * wx - vx * wz) + uz * (vx * wy - vy * wx);
}
