import type { BatchedMesh, Object3D } from 'three';

/** What every scene tells of the field in it. */
export interface Report {
  /** Metres, y up. */
  min: number[];
  max: number[];
  /** Triangles of the levels of detail in which the rocks are from near, and from afar. */
  triangles: { near: number; far: number };
  /** What the engine holds before there is a field, with it, and after it was disposed of. */
  held: { before: number[]; with: number[]; after: number[] };
  /** From above, and from below, where there is nothing to see of rocks that are open there. */
  pictures: { above: string; below: string };
  /** Of a build that was under way when the field was disposed of. */
  aborted?: string;
  rock?: unknown;
}

export const SIZE = { width: 240, height: 160 };

/** Of all rocks in a group that has a `BatchedMesh`, at the levels that they have. */
export function trianglesOf(group: Object3D): number {
  const batch = group.children.find((child) => (child as BatchedMesh).isBatchedMesh) as BatchedMesh;
  let triangles = 0;
  for (let rock = 0; rock < batch.instanceCount; rock++)
    triangles += (batch.getGeometryRangeAt(batch.getGeometryIdAt(rock))?.count ?? 0) / 3;
  return triangles;
}
