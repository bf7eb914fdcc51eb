/** Whether a surface passes through itself, or has an edge. Only + − × ÷, so that all engines find the same. */

import type { Model } from '../model.ts';

type Surface = Pick<Model, 'positions' | 'indices'>;

/** Whether two triangles that share no vertex pass through each other. Those that only touch do not. */
export function crossesItself({ positions, indices }: Surface): boolean {
  const count = indices.length / 3;
  const boxes = boxesOf(positions, indices);
  const order = Uint32Array.from({ length: count }, (_, t) => t).sort((s, t) => boxes[6 * s]! - boxes[6 * t]! || s - t);
  const sorted = new Float32Array(boxes.length);
  order.forEach((t, i) => sorted.set(boxes.subarray(6 * t, 6 * t + 6), 6 * i));
  for (let i = 0; i < count; i++) {
    const at = 6 * i;
    const [right, front, low] = [sorted[at + 3]!, sorted[at + 1]!, sorted[at + 2]!];
    const [back, high] = [sorted[at + 4]!, sorted[at + 5]!];
    for (let j = i + 1, other = at + 6; j < count && sorted[other]! <= right; j++, other += 6) {
      if (sorted[other + 1]! > back || sorted[other + 4]! < front || sorted[other + 2]! > high || sorted[other + 5]! < low) continue;
      const [s, t] = [order[i]!, order[j]!];
      if (!shareVertex(indices, s, t) && crossing(positions, indices, s, t)) return true;
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

function shareVertex(indices: Uint32Array, s: number, t: number): boolean {
  for (let i = 3 * s; i < 3 * s + 3; i++) for (let j = 3 * t; j < 3 * t + 3; j++) if (indices[i] === indices[j]) return true;
  return false;
}

/** Whether an edge of one of two triangles passes through the other. */
function crossing(positions: Float32Array, indices: Uint32Array, s: number, t: number): boolean {
  return passes(positions, indices, 3 * s, 3 * t) || passes(positions, indices, 3 * t, 3 * s);
}

/** Whether an edge of the triangle that begins at `one` passes through the one that begins at `other`. */
function passes(positions: Float32Array, indices: Uint32Array, one: number, other: number): boolean {
  const a = 3 * indices[other]!;
  const b = 3 * indices[other + 1]!;
  const c = 3 * indices[other + 2]!;
  for (let k = 0; k < 3; k++) {
    const p = 3 * indices[one + k]!;
    const q = 3 * indices[one + (k === 2 ? 0 : k + 1)]!;
    if (side(positions, a, b, c, p) * side(positions, a, b, c, q) >= 0) continue;
    const ab = side(positions, p, q, a, b);
    const bc = side(positions, p, q, b, c);
    if (ab * bc <= 0) continue;
    const ca = side(positions, p, q, c, a);
    if (ab > 0 ? ca > 0 : ca < 0) return true;
  }
  return false;
}

/** Six times the volume of the tetrahedron whose corners begin at these places. */
function side(x: Float32Array, a: number, b: number, c: number, d: number): number {
  const ux = x[b]! - x[a]!;
  const uy = x[b + 1]! - x[a + 1]!;
  const uz = x[b + 2]! - x[a + 2]!;
  const vx = x[c]! - x[a]!;
  const vy = x[c + 1]! - x[a + 1]!;
  const vz = x[c + 2]! - x[a + 2]!;
  const wx = x[d]! - x[a]!;
  const wy = x[d + 1]! - x[a + 1]!;
  const wz = x[d + 2]! - x[a + 2]!;
  return ux * (vy * wz - vz * wy) + uy * (vz * wx - vx * wz) + uz * (vx * wy - vy * wx);
}
