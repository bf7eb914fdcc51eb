/** What wood ears are made of in files: the inner side and the rest, each of which is of another material. */

import type { WoodEarColony } from '../data/colony.ts';
import type { WoodEarParams } from './request.ts';

type Layout = Pick<WoodEarParams, 'rings' | 'meridians' | 'thickness'>;

/** Wood ears that are all alike but for where their vertices are. */
export interface Ears {
  count: number;
  /** All ears' vertices, cm, one ear after the other. */
  positions: Float32Array;
  normals: Float32Array;
  /** How many vertices an ear has. */
  vertices: number;
  /** The triangles of an ear, of its own vertices. */
  triangles: Uint32Array;
  /** How many of the triangles, from the first on, are of the inner side. */
  inner: number;
  /** Whether they have two sides. Otherwise they are sheets, of which both are seen. */
  isThick: boolean;
}

/** The ears of a colony as they have been grown. */
export function earsOf({ positions, normals, indices, individualStarts, vertexStarts, foot }: WoodEarColony, layout: Layout): Ears {
  const { rings, meridians, thickness } = layout;
  return {
    count: foot.length,
    positions,
    normals,
    vertices: vertexStarts[1] ?? 0,
    triangles: indices.slice(0, individualStarts[1] ?? 0),
    inner: 2 * meridians * (rings - 1),
    isThick: thickness > 0,
  };
}

/** Sheets with an outer side at a distance, and a band between both along every edge. What is thick already is returned as it is. */
export function thickened(ears: Ears, distance: number): Ears {
  if (ears.isThick) return ears;
  const { count, positions, normals, vertices, triangles } = ears;
  const doubled = { positions: new Float32Array(2 * positions.length), normals: new Float32Array(2 * normals.length) };
  const length = 3 * vertices;
  for (let ear = 0; ear < count; ear++) {
    const [from, to] = [length * ear, 2 * length * ear];
    doubled.positions.set(positions.subarray(from, from + length), to);
    doubled.normals.set(normals.subarray(from, from + length), to);
    for (let k = 0; k < length; k++) {
      const normal = normals[from + k]!;
      doubled.positions[to + length + k] = positions[from + k]! - distance * normal;
      doubled.normals[to + length + k] = -normal;
    }
  }
  const outer = triangles.map((_, i) => vertices + triangles[i - (i % 3) + 2 - (i % 3)]!);
  const band = edgesOf(triangles, vertices).flatMap(([a, b]) => [b, a, vertices + a, b, vertices + a, vertices + b]);
  return {
    count,
    ...doubled,
    vertices: 2 * vertices,
    triangles: Uint32Array.of(...triangles, ...outer, ...band),
    inner: triangles.length / 3,
    isThick: true,
  };
}

/** The edges that have one triangle, as it runs along them. */
function edgesOf(triangles: Uint32Array, vertices: number): [number, number][] {
  const edges: [number, number][] = Array.from(triangles, (a, i) => [a, triangles[i % 3 === 2 ? i - 2 : i + 1]!]);
  const all = new Set(edges.map(([a, b]) => a * vertices + b));
  return edges.filter(([a, b]) => !all.has(b * vertices + a));
}

/** A part of each ear: vertices by their numbers in the ear, and triangles of them. */
export interface Part {
  vertices: Uint32Array;
  triangles: Uint32Array;
}

/** The inner side and the rest; of sheets all of it. */
export function partsOf({ triangles, inner, isThick }: Ears): Part[] {
  const lists = isThick ? [triangles.subarray(0, 3 * inner), triangles.subarray(3 * inner)] : [triangles];
  return lists.map(compact);
}

/** With the vertices that are used alone, in their order. */
export function compact(triangles: Uint32Array): Part {
  const vertices = Uint32Array.from(new Set(triangles)).sort();
  const numbers = new Map(Array.from(vertices, (vertex, number) => [vertex, number]));
  return { vertices, triangles: triangles.map((vertex) => numbers.get(vertex)!) };
}
