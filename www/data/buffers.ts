/** The buffers of a result in the order in which they are hashed: the one that `tests/golden.rs` and `tests/wood_ear_properties.rs` describe. */

import type { WoodEarColony } from './colony.ts';
import type { Field } from './field.ts';

type Buffer = Float32Array | Uint32Array | Uint8Array;

export function fieldBuffers({ layers, positions, normals, indices, rockStarts, vertexStarts, rockLayer }: Field): Buffer[] {
  return [
    ...layers.flatMap(({ sites, cellStarts, cellVertices, selected }) => [sites, cellStarts, cellVertices, selected]),
    ...[positions, normals, indices, rockStarts, vertexStarts, rockLayer],
  ];
}

/** The wood ears and their log. What they lie on is a field by itself. */
export function colonyBuffers(colony: WoodEarColony): Buffer[] {
  const { positions, normals, indices, individualStarts, vertexStarts, foot, size, base, log } = colony;
  return [
    positions,
    normals,
    indices,
    individualStarts,
    vertexStarts,
    foot,
    size,
    base,
    log.positions,
    log.normals,
    log.indices,
    log.kinds,
  ];
}
