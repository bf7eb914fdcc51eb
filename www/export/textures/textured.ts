/** A model with textures: what is laid out before a renderer draws it, and what becomes of it afterwards. */

import { kitOf } from '../shapes/kit.ts';
import type { Images, Model } from '../model.ts';
import { textureSide } from '../options.ts';
import type { ResolvedOptions } from '../options.ts';
import { closed } from '../shapes/solid.ts';
import { ATLAS_STRIDE, atlasOf } from './atlas.ts';
import type { Atlas } from './atlas.ts';

/** What a renderer has drawn, and where. */
export interface Baked {
  atlas: Atlas;
  images: Images;
}

/** What is drawn: the mesh as it will be in the file, and where its vertices are in the textures. */
export interface Laid {
  mesh: Pick<Model, 'positions' | 'normals' | 'indices' | 'vertexStarts' | 'indexStarts'>;
  atlas: Atlas;
}

/**
 * Lays the rocks out whose meshes a file is going to have.
 *
 * @param model open below.
 * @throws {RockFieldError} `ExportTooLarge` where there are too many.
 */
export async function laidOut(model: Model, options: ResolvedOptions, onProgress?: (fraction: number) => void): Promise<Laid> {
  const whole = options.solid ? closed(model) : model;
  const bodies = options.mesh === 'kit' ? [...(await kitOf(whole, options.kinds)).kinds] : [...model.groupOf.keys()];
  const { positions, normals, indices, vertexStarts, indexStarts } = whole;
  const mesh = { positions, normals, indices, vertexStarts, indexStarts };
  return { mesh, atlas: atlasOf(model, whole, bodies, textureSide(options), onProgress) };
}

/** The model whose bodies in the atlas are all made of one material, which has the images. */
export function textured(model: Model, { atlas: { side, vertices, holds }, images }: Baked): Model {
  // What has been added behind the rocks is the ground, which lies in no image; the tangents of its plane are as good as any.
  const all = Float32Array.from({ length: (ATLAS_STRIDE * model.positions.length) / 3 }, (_, k) => Number(k % ATLAS_STRIDE === 2));
  all.set(vertices);
  return {
    ...model,
    textures: { side, vertices: all, images },
    materialOf: model.materialOf.map((material, k) => (holds[k]! > 0 ? model.materials.length : material)),
    materials: [...model.materials, { name: 'stone', color: [1, 1, 1], isTextured: true }],
  };
}
