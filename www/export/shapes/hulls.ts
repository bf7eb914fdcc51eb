/** Hulls of bodies for physics: convex, with few vertices. */

import { hullOf } from './hull.ts';
import { thingsOf } from '../model.ts';
import type { Model } from '../model.ts';
import type { ResolvedOptions } from '../options.ts';
import type { Pace } from '../pace.ts';

/** As many vertices as physics engines like; a hull is closer to its body than this share of its extent where fewer do. */
export const [MOST_VERTICES, MARGIN] = [32, 0.01];

/** What a hull is called by which programs know it, of the object with this name. */
export const HULL_NAMES = {
  unreal: (object: string) => `UCX_${object}_00`,
  godot: (object: string) => `${object}-convcolonly`,
} as const satisfies Record<Exclude<ResolvedOptions['hulls'], 'none'>, (object: string) => string>;

/**
 * The model with the hull of each thing in the place of its first body; it has no normals.
 *
 * @param wanted whether the thing that begins with a body needs one; of others, and of those that are flat, there is none.
 */
export async function hullsOf(model: Model, wanted: (k: number) => boolean, pace: Pace): Promise<Model> {
  const bodies = model.groupOf.length;
  const positions: number[] = [];
  const indices: number[] = [];
  const [vertexStarts, indexStarts] = [new Uint32Array(bodies + 1), new Uint32Array(bodies + 1)];
  /** For the first body of a thing, the one after its last. */
  const ends = new Uint32Array(bodies);
  for (const { bodies: own } of thingsOf(model)) ends[own[0]!] = own.at(-1)! + 1;
  for (let k = 0; k < bodies; k++) {
    if (ends[k]! > 0 && wanted(k)) addHull(model, k, ends[k]!, positions, indices);
    vertexStarts[k + 1] = positions.length / 3;
    indexStarts[k + 1] = indices.length;
    if (pace.isDue()) await pace.rest((k + 1) / bodies);
  }
  return {
    ...model,
    positions: Float32Array.from(positions),
    normals: new Float32Array(0),
    indices: Uint32Array.from(indices),
    vertexStarts,
    indexStarts,
  };
}

function addHull({ positions, vertexStarts, origins }: Model, k: number, end: number, toPositions: number[], toIndices: number[]): void {
  const points = Float64Array.from(
    positions.subarray(3 * vertexStarts[k]!, 3 * vertexStarts[end]!),
    (value, i) => value - origins[3 * k + (i % 3)]!,
  );
  const hull = hullOf(points, MOST_VERTICES, MARGIN);
  if (!hull) return;
  const first = toPositions.length / 3;
  for (const corner of hull.corners) {
    for (let axis = 0; axis < 3; axis++) toPositions.push(positions[3 * (vertexStarts[k]! + corner) + axis]!);
  }
  for (const corner of hull.triangles) toIndices.push(first + corner);
}
