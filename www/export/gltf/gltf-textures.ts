/** The textures of a glTF file, and what of its vertices and materials belongs to them. */

import { floatsOf, IMAGES } from './gltf-buffers.ts';
import type { Layout } from './gltf-buffers.ts';
import type { Mesh, Part } from './gltf-parts.ts';
import type { Images } from '../model.ts';
import { ATLAS_STRIDE } from '../textures/atlas.ts';

/** Writes the tangents of all vertices but those of hulls, their places in the textures, and the textures. Tangents are turned like normals. */
export function fillTextures(images: Images, meshes: readonly Mesh[], { places, views }: Layout, bytes: Uint8Array<ArrayBuffer>): void {
  const [tangents, coordinates] = [floatsOf(bytes, views.tangents), floatsOf(bytes, views.coordinates)];
  meshes
    .flatMap(({ parts }) => parts)
    .forEach((part, p) => {
      if (part.material === undefined || part.sameAs) return;
      fillPart(part, tangents.subarray(4 * places[p]!.vertex), coordinates.subarray(2 * places[p]!.vertex));
    });
  for (const name of IMAGES) bytes.set(images[name], views[name]!.offset);
}

function fillPart({ model, bodies, turn }: Part, tangents: Float32Array, coordinates: Float32Array): void {
  const { vertexStarts } = model;
  const { side, vertices } = model.textures!;
  const { cos, sin } = turn ?? { cos: 1, sin: 0 };
  let v = 0;
  for (const k of bodies) {
    const end = ATLAS_STRIDE * vertexStarts[k + 1]!;
    for (let from = ATLAS_STRIDE * vertexStarts[k]!; from < end; from += ATLAS_STRIDE, v += 1) {
      const [x, y, z] = [vertices[from + 2]!, vertices[from + 3]!, vertices[from + 4]!];
      tangents[4 * v] = cos * x + sin * y;
      tangents[4 * v + 1] = z;
      tangents[4 * v + 2] = sin * x - cos * y;
      // No patch is a mirror image.
      tangents[4 * v + 3] = 1;
      // What is not in the textures is left of them.
      coordinates[2 * v] = Math.max(0, vertices[from]! / side);
      coordinates[2 * v + 1] = Math.max(0, vertices[from + 1]! / side);
    }
  }
}

/** What a material says that has textures. */
export const TEXTURED = {
  pbrMetallicRoughness: { baseColorTexture: { index: 0 }, metallicRoughnessTexture: { index: 2 } },
  normalTexture: { index: 1 },
  occlusionTexture: { index: 2 },
};

/** The parts of the JSON about textures. They are not repeated, and smaller copies of them are used where they are far away. */
export function texturesOf({ views }: Layout): Record<string, object[]> {
  const [LINEAR, LINEAR_MIPMAP_LINEAR, CLAMP] = [9729, 9987, 33071];
  return {
    textures: IMAGES.map((_, source) => ({ sampler: 0, source })),
    images: IMAGES.map((name) => ({ name, mimeType: 'image/png', bufferView: views[name]!.index })),
    samplers: [{ magFilter: LINEAR, minFilter: LINEAR_MIPMAP_LINEAR, wrapS: CLAMP, wrapT: CLAMP }],
  };
}
