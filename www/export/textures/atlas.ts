/** Where every vertex of a model is in a texture: each rock is laid flat for itself, and all lie side by side. */

import { RockFieldError } from '../../base/errors.ts';
import type { Model } from '../model.ts';
import { rimOf } from '../shapes/solid.ts';
import { packed } from './pack.ts';
import { tangentsOf } from './tangents.ts';
import { unwrapped } from './unwrap.ts';
import type { Patch } from './unwrap.ts';

export interface Atlas {
  /** Texels. */
  side: number;
  /** Texels in a unit of the model. */
  density: number;
  /** For each vertex x and y in texels, from the upper left corner, and its tangent, which points to the right in the atlas. */
  vertices: Float32Array;
  /** For each body 1 if it is in the atlas. */
  holds: Uint8Array;
}

/** Numbers for each vertex. */
export const ATLAS_STRIDE = 5;

/** Undersides are hardly ever seen: they have this share of the texels along each side. */
const UNDERSIDE = 0.25;

/** Texels around every patch in an atlas of 1024, and in proportion in larger ones: smaller copies of the texture do not mix neighbours. */
const MARGIN = 1 / 1024;
const LEAST_MARGIN = 2;

/** Where a vertex is that is in no atlas: nothing is drawn there. */
const NOWHERE = -1e6;

/**
 * An atlas of these bodies, the others are left out; so is what is not open below, and no disc.
 *
 * @param open the model without undersides.
 * @param model the same with them, or `open` itself.
 * @param onProgress is told the share of the work that is done, 0 … 1.
 * @throws {RockFieldError} `ExportTooLarge`, before any work, where the atlas would have no room for so many bodies.
 */
export function atlasOf(
  open: Model,
  model: Model,
  bodies: readonly number[],
  side: number,
  onProgress?: (fraction: number) => void,
): Atlas {
  const held = bodies.filter((k) => open.groups[open.groupOf[k]!]!.isOpenBelow);
  const margin = Math.max(LEAST_MARGIN, side * MARGIN);
  const patchesPerBody = model === open ? 1 : 2;
  const most = Math.floor((side / (2 * margin + 2)) ** 2 / patchesPerBody / 2);
  if (held.length > most) throw tooMany(held.length, most, side);
  const patches: Placed[] = [];
  held.forEach((k, done) => {
    patches.push(...patchesOf(open, model, k));
    onProgress?.(done / held.length);
  });
  const packing = packed(patches, side, margin);
  if (!packing) throw tooMany(held.length, most, side);
  const { density, corners } = packing;
  const places = new Float32Array((2 * model.positions.length) / 3).fill(NOWHERE);
  patches.forEach(({ places: own, first, height, scale }, p) => {
    for (let v = 0; v < own.length; v += 2) {
      places[2 * first + v] = corners[2 * p]! + density * scale * own[v]!;
      places[2 * first + v + 1] = corners[2 * p + 1]! + density * (height - scale * own[v + 1]!);
    }
  });
  const holds = new Uint8Array(model.groupOf.length);
  for (const k of held) holds[k] = 1;
  return { side, density, vertices: withTangents(model, places), holds };
}

/** A patch, the first vertex of the model that it is of, and how large it is drawn; `width` and `height` are as it is drawn. */
interface Placed extends Patch {
  first: number;
  scale: number;
}

function patchesOf(open: Model, model: Model, k: number): Placed[] {
  const [first, last] = [open.vertexStarts[k]!, open.vertexStarts[k + 1]!];
  const triangles = open.indices.slice(open.indexStarts[k]!, open.indexStarts[k + 1]!).map((vertex) => vertex - first);
  const rim = rimOf(last - first, triangles.length / 3);
  const points = Float64Array.from(open.positions.subarray(3 * first, 3 * last));
  const begin = model.vertexStarts[k]!;
  const placed: Placed[] = [{ ...unwrapped({ points, triangles, rim }), first: begin, scale: 1 }];
  const bottom = begin + last - first;
  if (bottom < model.vertexStarts[k + 1]!) placed.push(underside(model, bottom, model.vertexStarts[k + 1]!));
  return placed;
}

/** As it is seen from below. */
function underside({ positions }: Model, first: number, last: number): Placed {
  const [xs, ys] = [0, 1].map((axis) => Array.from({ length: last - first }, (_, v) => positions[3 * (first + v) + axis]!));
  const [left, right, low, high] = [Math.min(...xs!), Math.max(...xs!), Math.min(...ys!), Math.max(...ys!)];
  const places = Float64Array.from({ length: 2 * xs!.length }, (_, n) => (n % 2 === 0 ? right - xs![n >> 1]! : ys![n >> 1]! - low));
  return { places, first, scale: UNDERSIDE, width: UNDERSIDE * (right - left), height: UNDERSIDE * (high - low) };
}

function withTangents({ positions, normals, indices }: Model, places: Float32Array): Float32Array {
  const upright = places.map((value, n) => (n % 2 === 0 ? value : -value));
  const tangents = tangentsOf(positions, normals, indices, upright);
  const vertices = new Float32Array((ATLAS_STRIDE * places.length) / 2);
  for (let v = 0; 2 * v < places.length; v++) {
    vertices.set(places.subarray(2 * v, 2 * v + 2), ATLAS_STRIDE * v);
    vertices.set(tangents.subarray(3 * v, 3 * v + 3), ATLAS_STRIDE * v + 2);
  }
  return vertices;
}

function tooMany(bodies: number, most: number, side: number): RockFieldError {
  return new RockFieldError({
    name: 'ExportTooLarge',
    key: 'textures',
    value: bodies,
    max: most,
    message: `${bodies} rocks do not fit into textures of ${side} × ${side}, which have room for ${most}: choose larger textures, mesh "kit", or larger rocks`,
    words: {
      en: `${bodies} rocks do not fit into textures of ${side} × ${side}, which have room for ${most}. Choose larger textures, copies of a few, or larger rocks.`,
      ja: `岩が ${bodies} 個あり、${side} × ${side} のテクスチャに入る ${most} 個を超えます。大きなテクスチャ、少数の複製、または大きな岩を選んでください。`,
    },
  });
}
