/** The textures of a file of rocks: laid out in a worker, and drawn by a graphics device. */

import { lazily } from '../base/lazy.ts';
import type { Backend } from '../base/view.ts';
import type { Field } from '../data/field.ts';
import type { Atlas } from '../export/textures/atlas.ts';
import type { Laid } from '../export/textures/textured.ts';
import type { TaskOptions } from '../generator/one-task.ts';
import type { FieldSource } from './export.ts';
import { lookOf } from './look.ts';

/** What a worker makes the images of. */
export interface Drawn {
  atlas: Atlas;
  tiles: Uint8Array<ArrayBuffer>[];
}

/** The share of the work that is done when the rocks are laid out. */
const LAID_OUT = 0.4;

/**
 * @param backends to try, in this order.
 * @param layOut done in a worker.
 * @returns Undefined where there is no graphics device.
 */
export async function bakedTextures(
  field: Field,
  { params }: FieldSource,
  backends: readonly Backend[],
  layOut: (run: TaskOptions) => Promise<Laid>,
  { signal, onProgress }: TaskOptions,
): Promise<Drawn | undefined> {
  const devices = backends.filter((backend) => backend === 'webgpu' || backend === 'webgl');
  if (devices.length === 0) return undefined;
  const { bakeTiles } = await lazily(() => import('../renderer/bake.ts'));
  const { mesh, atlas } = await layOut({ signal, onProgress: onProgress && ((fraction) => onProgress(LAID_OUT * fraction)) });
  const scene = { field, mesh, look: lookOf(params), atlas: atlas.vertices, side: atlas.side };
  for (const backend of devices) {
    const tiles = await bakeTiles(backend, scene, {
      signal,
      onProgress: onProgress && ((fraction) => onProgress(LAID_OUT + (1 - LAID_OUT) * fraction)),
    });
    if (tiles) return { atlas, tiles };
  }
  return undefined;
}
