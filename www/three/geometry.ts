/** Geometries of a scene's arrays. */

import * as three from 'three';
import type { BufferGeometry } from 'three';
import type { Place } from '../export/gltf/gltf-buffers.ts';
import type { SceneParts } from '../export/scene.ts';

/**
 * What lies at these places, one after the other.
 *
 * @param isApart whether the arrays are copied, so that the geometry does not keep those of all others in memory.
 */
export function geometryOf(
  { positions, normals, colors, ids, indices }: SceneParts,
  places: readonly Place[],
  isApart = false,
): BufferGeometry {
  const cut = isApart ? 'slice' : 'subarray';
  const first = places[0]!.vertex;
  const last = places.at(-1)!;
  const end = last.vertex + last.vertices;
  const geometry = new three.BufferGeometry();
  geometry.setAttribute('position', new three.BufferAttribute(positions[cut](3 * first, 3 * end), 3));
  geometry.setAttribute('normal', new three.BufferAttribute(normals[cut](3 * first, 3 * end), 3));
  if (colors.length > 0) geometry.setAttribute('color', new three.BufferAttribute(colors[cut](4 * first, 4 * end), 4, true));
  if (ids.length > 0) geometry.setAttribute(IDS, new three.BufferAttribute(ids[cut](first, end), 1));
  geometry.setIndex(new three.BufferAttribute(joined(indices, places, cut), 1));
  geometry.computeBoundingBox();
  geometry.computeBoundingSphere();
  return geometry;
}

/** What GLTFLoader makes of `_FEATURE_ID_0` in a file. */
export const IDS = '_feature_id_0';

function joined(indices: SceneParts['indices'], places: readonly Place[], cut: 'slice' | 'subarray'): SceneParts['indices'] {
  const [{ vertex: first, index: begin, indices: count }] = places as [Place];
  if (places.length === 1) return indices[cut](begin, begin + count);
  const all = new Uint32Array(places.reduce((sum, place) => sum + place.indices, 0));
  let at = 0;
  for (const { vertex, index, indices: length } of places) {
    for (let i = index; i < index + length; i++) all[at++] = indices[i]! + vertex - first;
  }
  return all;
}
