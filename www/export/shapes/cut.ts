/**
 * Rocks without what of them lies below the ground.
 *
 * A weathered rock ends in a skirt as wide as its cell, which the ground hides. Where there is none, its rocks lie on plates.
 */

import type { Model } from '../model.ts';
import type { Pace } from '../pace.ts';
import { rimOf } from './solid.ts';

/** More than any vertex of a body has as its number. */
const MANY = 2 ** 26;

/**
 * The model whose bodies that are open below end at z = 0, each with its rim there; the others, and those that lie below it as a whole, stay as
 * they are. A body stands in the middle of the box around what is left of it.
 */
export async function cutAtGround(model: Model, pace: Pace): Promise<Model> {
  const bodies = model.groupOf.length;
  const cut = new Cut(model);
  for (let k = 0; k < bodies; k++) {
    cut.add(k);
    if (pace.isDue()) await pace.rest((k + 1) / bodies);
  }
  return cut.finished();
}

/** What is left of a body. Its vertices have the numbers 0 to `size`, and new ones follow. */
interface Piece {
  first: number;
  size: number;
  /** Three corners each. */
  triangles: number[];
  /** Of each new vertex the ends of its edge: that which is kept, and that which is not. */
  ends: [number, number][];
  /** Counter-clockwise from above. */
  rim: number[];
}

/** Bodies are added in order. */
class Cut {
  #model: Model;
  #positions: Float32Array;
  #normals: Float32Array;
  #indices: Uint32Array;
  #vertexStarts: Uint32Array;
  #indexStarts: Uint32Array;
  #origins: Float64Array;

  constructor(model: Model) {
    const { positions, indices, vertexStarts, indexStarts, origins } = model;
    this.#model = model;
    // A triangle at the cut becomes two at most, with two vertices.
    let cut = 0;
    for (let i = 0; i < indices.length; i += 3) {
      let below = 0;
      for (let corner = 0; corner < 3; corner++) below += Number(positions[3 * indices[i + corner]! + 2]! < 0);
      cut += Number(below % 3 > 0);
    }
    this.#positions = new Float32Array(positions.length + 6 * cut);
    this.#normals = new Float32Array(positions.length + 6 * cut);
    this.#indices = new Uint32Array(indices.length + 3 * cut);
    this.#vertexStarts = new Uint32Array(vertexStarts.length);
    this.#indexStarts = new Uint32Array(indexStarts.length);
    this.#origins = origins.slice();
  }

  add(k: number): void {
    const { groups, groupOf } = this.#model;
    const piece = groups[groupOf[k]!]!.isOpenBelow ? cutOff(this.#model, k) : undefined;
    if (piece) {
      this.#write(k, piece);
      this.#stand(k);
    } else this.#copy(k);
  }

  #copy(k: number): void {
    const { positions, normals, indices, vertexStarts, indexStarts } = this.#model;
    const [first, last, begin] = [vertexStarts[k]!, vertexStarts[k + 1]!, this.#vertexStarts[k]!];
    this.#positions.set(positions.subarray(3 * first, 3 * last), 3 * begin);
    this.#normals.set(normals.subarray(3 * first, 3 * last), 3 * begin);
    let index = this.#indexStarts[k]!;
    for (let i = indexStarts[k]!; i < indexStarts[k + 1]!; i++) this.#indices[index++] = indices[i]! - first + begin;
    this.#vertexStarts[k + 1] = begin + last - first;
    this.#indexStarts[k + 1] = index;
  }

  /** The rim comes first, as `rimOf` has it. */
  #write(k: number, { first, triangles, size, ends, rim }: Piece): void {
    const { positions, normals } = this.#model;
    let vertex = this.#vertexStarts[k]!;
    const numbers = new Int32Array(size + ends.length).fill(-1);
    const place = (v: number): void => {
      if (numbers[v]! >= 0) return;
      numbers[v] = vertex;
      if (v < size) {
        const from = 3 * (first + v);
        this.#positions.set(positions.subarray(from, from + 3), 3 * vertex);
        this.#normals.set(normals.subarray(from, from + 3), 3 * vertex);
        // Hollows that reach below the ground end on it.
        if (positions[from + 2]! < 0) this.#positions[3 * vertex + 2] = 0;
      } else this.#between(vertex, first + ends[v - size]![0], first + ends[v - size]![1]);
      vertex += 1;
    };
    for (const v of rim) place(v);
    let index = this.#indexStarts[k]!;
    for (const v of triangles) {
      place(v);
      this.#indices[index++] = numbers[v]!;
    }
    this.#vertexStarts[k + 1] = vertex;
    this.#indexStarts[k + 1] = index;
  }

  /** The vertex where the edge from above to below goes through the ground. */
  #between(to: number, above: number, below: number): void {
    const { positions, normals } = this.#model;
    const [top, bottom] = [positions[3 * above + 2]!, positions[3 * below + 2]!];
    const share = top / (top - bottom);
    const normal: number[] = [];
    for (let axis = 0; axis < 3; axis++) {
      const place = positions[3 * above + axis]!;
      this.#positions[3 * to + axis] = axis === 2 ? 0 : place + share * (positions[3 * below + axis]! - place);
      const [one, other] = [normals[3 * above + axis]!, normals[3 * below + axis]!];
      normal.push(one + share * (other - one));
    }
    const [x, y, z] = normal as [number, number, number];
    const length = Math.sqrt(x * x + y * y + z * z);
    // Opposite ones have no mean.
    for (let axis = 0; axis < 3; axis++) this.#normals[3 * to + axis] = length > 0 ? normal[axis]! / length : normals[3 * above + axis]!;
  }

  #stand(k: number): void {
    for (let axis = 0; axis < 2; axis++) {
      let [least, most] = [Infinity, -Infinity];
      for (let v = this.#vertexStarts[k]!; v < this.#vertexStarts[k + 1]!; v++) {
        least = Math.min(least, this.#positions[3 * v + axis]!);
        most = Math.max(most, this.#positions[3 * v + axis]!);
      }
      this.#origins[3 * k + axis] = (least + most) / 2;
    }
  }

  finished(): Model {
    const [vertices, indices] = [this.#vertexStarts.at(-1)!, this.#indexStarts.at(-1)!];
    return {
      ...this.#model,
      positions: this.#positions.slice(0, 3 * vertices),
      normals: this.#normals.slice(0, 3 * vertices),
      indices: this.#indices.slice(0, indices),
      vertexStarts: this.#vertexStarts,
      indexStarts: this.#indexStarts,
      origins: this.#origins,
    };
  }
}

/** What is left of a body; undefined where nothing has to be cut, or it cannot be. */
function cutOff(model: Model, k: number): Piece | undefined {
  const { positions, indices, vertexStarts, indexStarts } = model;
  const [first, begin, end] = [vertexStarts[k]!, indexStarts[k]!, indexStarts[k + 1]!];
  const size = vertexStarts[k + 1]! - first;
  const corners = Array.from(indices.subarray(begin, end), (v) => v - first);
  const heightOf = (v: number): number => positions[3 * (first + v) + 2]!;
  const isGone = goneOf(size, corners, heightOf);
  if (!isGone) return undefined;
  const cut = new Corners(size, heightOf);
  for (let i = 0; i < corners.length; i += 3) {
    const [a, b, c] = [corners[i]!, corners[i + 1]!, corners[i + 2]!];
    const gone = isGone[a]! + isGone[b]! + isGone[c]!;
    if (gone === 0) cut.triangles.push(a, b, c);
    else if (gone < 3) {
      // The corner that is alone comes first.
      const alone = gone === 1 ? 1 : 0;
      if (isGone[a] === alone) cut.across(a, b, c, gone);
      else if (isGone[b] === alone) cut.across(b, c, a, gone);
      else cut.across(c, a, b, gone);
    }
  }
  return cut.piece(first);
}

/** For each vertex whether it is cut off: what lies below the ground, as far as that goes on from the rim. Undefined if the rim is not below. */
function goneOf(size: number, corners: readonly number[], heightOf: (v: number) => number): Uint8Array | undefined {
  const isGone = new Uint8Array(size);
  for (let v = rimOf(size, corners.length / 3) - 1; v >= 0; v--) {
    if (heightOf(v) >= 0) return undefined;
    isGone[v] = 1;
  }
  let isNew = true;
  while (isNew) {
    isNew = false;
    for (let i = 0; i < corners.length; i += 3) {
      const gone = isGone[corners[i]!]! + isGone[corners[i + 1]!]! + isGone[corners[i + 2]!]!;
      if (gone === 0 || gone === 3) continue;
      for (let corner = i; corner < i + 3; corner++) {
        const v = corners[corner]!;
        if (isGone[v] || heightOf(v) >= 0) continue;
        isGone[v] = 1;
        isNew = true;
      }
    }
  }
  return isGone;
}

/** The triangles that are left of a body, while they are collected. */
class Corners {
  readonly triangles: number[] = [];
  readonly #ends: [number, number][] = [];
  readonly #size: number;
  readonly #heightOf: (v: number) => number;
  /** By edge. */
  readonly #numbers = new Map<number, number>();
  /** Along the border. */
  readonly #next = new Map<number, number>();

  constructor(size: number, heightOf: (v: number) => number) {
    this.#size = size;
    this.#heightOf = heightOf;
  }

  /** A triangle of whose corners one or two are cut off; the one that is alone in that, or in not being so, is `a`. */
  across(a: number, b: number, c: number, gone: number): void {
    if (gone === 2) {
      const [toB, toC] = [this.#cross(a, b), this.#cross(a, c)];
      this.#add(a, toB, toC);
      if (toB !== toC) this.#next.set(toB, toC);
    } else {
      const [toB, toC] = [this.#cross(b, a), this.#cross(c, a)];
      this.#add(toB, b, c);
      this.#add(toB, c, toC);
      this.#next.set(toC, toB);
    }
  }

  #add(a: number, b: number, c: number): void {
    if (a !== b && b !== c && c !== a) this.triangles.push(a, b, c);
  }

  /** Where the ground cuts an edge: the same vertex for both of its triangles. */
  #cross(kept: number, gone: number): number {
    if (this.#heightOf(kept) === 0) return kept;
    const edge = kept * MANY + gone;
    let number = this.#numbers.get(edge);
    if (number === undefined) {
      number = this.#size + this.#ends.length;
      this.#numbers.set(edge, number);
      this.#ends.push([kept, gone]);
    }
    return number;
  }

  /** What has the longest border; what else reaches out of the ground are crumbs. Undefined of what is no disc. */
  piece(first: number): Piece | undefined {
    const seen = new Set<number>();
    let rim: number[] = [];
    for (const start of this.#next.keys()) {
      const loop: number[] = [];
      for (let v: number | undefined = start; v !== undefined && !seen.has(v); v = this.#next.get(v)) {
        seen.add(v);
        loop.push(v);
      }
      if (loop.length > rim.length) rim = loop;
    }
    const triangles = rim.length === seen.size ? this.triangles : reachedFrom(rim, this.triangles);
    const vertices = new Uint8Array(this.#size + this.#ends.length);
    for (const v of triangles) vertices[v] = 1;
    const count = vertices.reduce((sum, isUsed) => sum + isUsed, 0);
    const isDisc = rim.length > 2 && rim.length === rimOf(count, triangles.length / 3);
    return isDisc ? { first, size: this.#size, triangles, ends: this.#ends, rim } : undefined;
  }
}

/** The triangles that hang together with these vertices. */
function reachedFrom(vertices: readonly number[], triangles: readonly number[]): number[] {
  const isReached = new Set(vertices);
  for (let before = 0; before < isReached.size; ) {
    before = isReached.size;
    for (let i = 0; i < triangles.length; i += 3) {
      const corners = triangles.slice(i, i + 3);
      if (corners.some((v) => isReached.has(v))) for (const v of corners) isReached.add(v);
    }
  }
  return triangles.filter((_, i) => isReached.has(triangles[i - (i % 3)]!));
}
