/** Levels of detail: the same bodies of ever fewer triangles, by meshoptimizer's simplifier, whose wasm gives the same everywhere. */

import { lazily } from '../../base/lazy.ts';
import type { Model } from '../model.ts';
import type { Pace } from '../pace.ts';
import { ATLAS_STRIDE } from '../textures/atlas.ts';
import { raise } from './raised.ts';
import { rimOf } from './solid.ts';

/** Each level has about this share of the triangles of the one before. */
export const SHARE = 1 / 3;

type Simplifier = typeof import('meshoptimizer/simplifier').MeshoptSimplifier;

/**
 * The model itself and its coarser levels.
 *
 * The rim of a body stays as it is, so that all levels stand on the ground alike, and so does what closes it from below. The coarsest that a
 * body becomes is a pyramid over its rim; no level has more triangles than the one before.
 *
 * @param model with or without bottoms.
 * @param open the same without bottoms: those come last in each body.
 * @param wanted whether a body is needed; others are left empty.
 */
export async function levelsOf(
  model: Model,
  open: Pick<Model, 'indexStarts' | 'vertexStarts'>,
  count: number,
  wanted: (k: number) => boolean,
  pace: Pace,
): Promise<Model[]> {
  const levels = [model];
  if (count === 1) return levels;
  const simplifier = await loaded();
  const bodies = model.groupOf.length;
  /** Of each body, what belongs to its bottom. */
  const bottoms = { vertices: new Uint32Array(bodies), indices: new Uint32Array(bodies) };
  for (let k = 0; k < bodies; k++) {
    bottoms.vertices[k] = sizeOf(model.vertexStarts, k) - sizeOf(open.vertexStarts, k);
    bottoms.indices[k] = sizeOf(model.indexStarts, k) - sizeOf(open.indexStarts, k);
  }
  while (levels.length < count) {
    const done = levels.length - 1;
    const level = new Level(levels[done]!);
    for (let k = 0; k < bodies; k++) {
      level.add(k, bottoms.vertices[k]!, bottoms.indices[k]!, wanted(k) ? simplifier : undefined);
      if (pace.isDue()) await pace.rest((done + (k + 1) / bodies) / (count - 1));
    }
    levels.push(level.finished());
  }
  return levels;
}

function sizeOf(starts: Uint32Array, k: number): number {
  return starts[k + 1]! - starts[k]!;
}

async function loaded(): Promise<Simplifier> {
  const { MeshoptSimplifier } = await lazily(() => import('meshoptimizer/simplifier'));
  await MeshoptSimplifier.ready;
  return MeshoptSimplifier;
}

/** A level that is being made of the one before, body by body. */
class Level {
  #finer: Model;
  #positions: Float32Array;
  #normals: Float32Array;
  #indices: Uint32Array;
  #vertexStarts: Uint32Array;
  #indexStarts: Uint32Array;
  #unchanged: Uint8Array;
  /** What textures say of vertices, where there are any. */
  #textured: Float32Array;

  constructor(finer: Model) {
    this.#finer = finer;
    this.#positions = new Float32Array(finer.positions.length);
    this.#normals = new Float32Array(finer.normals.length);
    this.#indices = new Uint32Array(finer.indices.length);
    this.#vertexStarts = new Uint32Array(finer.vertexStarts.length);
    this.#indexStarts = new Uint32Array(finer.indexStarts.length);
    this.#unchanged = new Uint8Array(finer.groupOf.length);
    this.#textured = new Float32Array(finer.textures?.vertices.length ?? 0);
  }

  /** Bodies are added in order. Without a simplifier nothing is. */
  add(k: number, bottomVertices: number, bottomIndices: number, simplifier: Simplifier | undefined): void {
    const { positions, normals, indices, vertexStarts, indexStarts, textures, groups, groupOf } = this.#finer;
    const [first, last, end] = [vertexStarts[k]!, vertexStarts[k + 1]!, indexStarts[k + 1]!];
    let vertex = this.#vertexStarts[k]!;
    let index = this.#indexStarts[k]!;
    if (simplifier) {
      const own = indices.slice(indexStarts[k], end - bottomIndices).map((v) => v - first);
      const span = [3 * first, 3 * (last - bottomVertices)] as const;
      const rim = groups[groupOf[k]!]!.isOpenBelow ? rimOf(last - bottomVertices - first, own.length / 3) : 0;
      const kept = simplified(simplifier, own, positions.subarray(...span), normals.subarray(...span), rim);
      this.#unchanged[k] = Number(kept === own);
      // Each vertex that is used, in the order in which they were: those of the rim stay the first ones.
      const isUsed = new Uint8Array(last - first).fill(1, last - first - bottomVertices);
      for (const v of kept) isUsed[v] = 1;
      const numbers = new Uint32Array(last - first);
      for (let v = 0; v < last - first; v++) {
        if (!isUsed[v]) continue;
        numbers[v] = vertex;
        for (let axis = 0; axis < 3; axis++) {
          this.#positions[3 * vertex + axis] = positions[3 * (first + v) + axis]!;
          this.#normals[3 * vertex + axis] = normals[3 * (first + v) + axis]!;
        }
        if (textures) {
          const own = textures.vertices.subarray(ATLAS_STRIDE * (first + v), ATLAS_STRIDE * (first + v + 1));
          this.#textured.set(own, ATLAS_STRIDE * vertex);
        }
        vertex += 1;
      }
      for (const v of kept) this.#indices[index++] = numbers[v]!;
      for (let i = end - bottomIndices; i < end; i++) this.#indices[index++] = numbers[indices[i]! - first]!;
    }
    this.#vertexStarts[k + 1] = vertex;
    this.#indexStarts[k + 1] = index;
  }

  finished(): Model {
    const [vertices, indices] = [this.#vertexStarts.at(-1)!, this.#indexStarts.at(-1)!];
    const { textures } = this.#finer;
    return {
      ...this.#finer,
      textures: textures && { ...textures, vertices: this.#textured.slice(0, ATLAS_STRIDE * vertices) },
      positions: this.#positions.slice(0, 3 * vertices),
      normals: this.#normals.slice(0, 3 * vertices),
      indices: this.#indices.slice(0, indices),
      vertexStarts: this.#vertexStarts,
      indexStarts: this.#indexStarts,
      unchanged: this.#unchanged,
    };
  }
}

/**
 * Fewer triangles with the same border, or those that were given where that does not work out.
 *
 * @param rim how many vertices the rim of a body that stands on the ground has; 0 of another.
 */
function simplified(
  simplifier: Simplifier,
  indices: Uint32Array,
  positions: Float32Array,
  normals: Float32Array,
  rim: number,
): Uint32Array {
  const border = borderOf(indices);
  if (!border) return indices;
  // A rim with fewer triangles would be flat, with as many a pyramid.
  const triangles = Math.max(Math.ceil((SHARE * indices.length) / 3), border.size, LEAST);
  if (3 * triangles >= indices.length) return indices;
  // However much it differs: how many triangles a level has is what a caller can rely on.
  const [fewer] = simplifier.simplifyWithAttributes(
    indices,
    positions,
    3,
    normals,
    3,
    NORMAL_WEIGHTS,
    lockOf(positions),
    3 * triangles,
    1,
    ['LockBorder'],
  );
  raise(fewer, rim, positions);
  const isSame = fewer.length < indices.length && fewer.length >= 3 * Math.max(border.size, LEAST) && isEqual(border, borderOf(fewer));
  return isSame ? fewer : indices;
}

/** Keeps the highest vertex, so that no level is lower than another. */
function lockOf(positions: Float32Array): Uint8Array {
  const lock = new Uint8Array(positions.length / 3);
  let highest = 0;
  for (let v = 1; v < lock.length; v++) if (positions[3 * v + 2]! > positions[3 * highest + 2]!) highest = v;
  lock[highest] = 1;
  return lock;
}

function isEqual(one: Set<number>, other: Set<number> | undefined): boolean {
  if (!other || one.size !== other.size) return false;
  for (const edge of one) if (!other.has(edge)) return false;
  return true;
}

/** How much a normal that turns counts beside a surface that moves. */
const NORMAL_WEIGHTS = [0.5, 0.5, 0.5];

/** Of what has no border: a tetrahedron. */
export const LEAST = 4;
/** More than any vertex of a body has as its number. */
const MANY = 2 ** 26;

/** The directed edges that have a triangle on one side alone; undefined where an edge has two on one side. */
function borderOf(indices: Uint32Array): Set<number> | undefined {
  const edges = new Set<number>();
  for (let i = 0; i < indices.length; i++) {
    const edge = indices[i]! * MANY + indices[i % 3 === 2 ? i - 2 : i + 1]!;
    if (edges.has(edge)) return undefined;
    edges.add(edge);
  }
  const border = new Set<number>();
  for (const edge of edges) if (!edges.has((edge % MANY) * MANY + Math.floor(edge / MANY))) border.add(edge);
  return border;
}
