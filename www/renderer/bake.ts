/** Draws the surface of rocks as textures, with a renderer of its own that has no canvas: whatever the page shows, and whether it shows anything. */

import { RockFieldError } from '../base/errors.ts';
import { nextTask } from '../base/next-task.ts';
import type { GpuBackend } from '../base/view.ts';
import type { Field } from '../data/field.ts';
import type { Look } from '../data/look.ts';
import type { RawRenderer } from './artefact.ts';
import { joinDevice } from './device.ts';
import type { SharedDevice } from './device.ts';
import { giveLook, rockKeys } from './gpu.ts';
import { COLORS, VIEWS } from './order.gen.ts';

/** What is drawn: the rocks of `field`, with a mesh that may be more than the field's. */
export interface BakedScene {
  field: Field;
  /** Bodies + 1 offsets into the vertices and into the indices. */
  mesh: Pick<Field, 'positions' | 'normals' | 'indices' | 'vertexStarts'> & { indexStarts: Uint32Array };
  look: Look;
  /** For each vertex x and y in texels, from the upper left corner, and its tangent. */
  atlas: Float32Array;
  /** Of the textures, texels; a multiple of 1024. */
  side: number;
}

export interface BakeRun {
  signal?: AbortSignal | undefined;
  onProgress?: ((fraction: number) => void) | undefined;
}

/** Side of a tile, texels, as in `src/render/bake.rs`. */
const TILE = 1024;
/** Between questions whether a tile is there, ms. */
const ASK_EVERY_MS = 4;

/**
 * The tiles of the textures, row by row; of each texel eight bytes, as `src/shading/shaders/bake.wgsl` writes them. Undefined where there is no
 * device of this kind.
 *
 * @throws {RockFieldError} `DeviceLost`; `FieldTooLarge` and the like, which the renderer says of itself.
 * @throws the signal's reason when it was aborted.
 */
export async function bakeTiles(backend: GpuBackend, scene: BakedScene, run: BakeRun): Promise<Uint8Array<ArrayBuffer>[] | undefined> {
  let lost = '';
  const onLost = (reason: string): void => {
    lost = reason;
  };
  const device = await joinDevice(backend, onLost).catch(() => undefined);
  if (!device) return undefined;
  const calls = (call: () => void): void => {
    if (!device.dead) device.attempt(call);
    if (device.dead) throw new RockFieldError({ name: 'DeviceLost', message: `the graphics device was lost: ${lost}` });
  };
  let raw: RawRenderer | undefined;
  try {
    for (const step of steps(device, scene)) {
      run.signal?.throwIfAborted();
      calls(() => (raw = step(raw)));
      // The page has its turn after each upload.
      await nextTask();
    }
    return await draw(raw!, scene.side, calls, run);
  } finally {
    if (!device.dead) {
      device.attempt(() => {
        raw?.close();
        raw?.free();
      });
    }
    device.leave(onLost);
  }
}

/** What is done before the first tile, one after the other: each takes the renderer, which the first one makes. */
function steps({ module, raw: device }: SharedDevice, { field, mesh, look, atlas }: BakedScene): ((raw?: RawRenderer) => RawRenderer)[] {
  const { layers, sites } = rockKeys(field);
  const { positions, normals, indices, vertexStarts, indexStarts } = mesh;
  return [
    () => new module.Renderer(device),
    (raw) => {
      raw!.setStyle(VIEWS.indexOf('3d'), COLORS.indexOf('natural'), false);
      giveLook(raw!, look);
      raw!.setField(field.imageWidth, field.imageHeight, positions, normals, indices, vertexStarts, indexStarts, layers, sites);
      return raw!;
    },
    (raw) => {
      raw!.setAtlas(atlas);
      return raw!;
    },
  ];
}

async function draw(
  raw: RawRenderer,
  side: number,
  calls: (call: () => void) => void,
  { signal, onProgress }: BakeRun,
): Promise<Uint8Array<ArrayBuffer>[]> {
  const tiles: Uint8Array<ArrayBuffer>[] = [];
  const count = (side / TILE) ** 2;
  while (tiles.length < count) {
    const [x, y] = [(tiles.length * TILE) % side, TILE * Math.floor((tiles.length * TILE) / side)];
    calls(() => raw.bakeTile(x, y));
    let tile: Uint8Array<ArrayBuffer> | undefined;
    while (!tile) {
      await new Promise((resolve) => setTimeout(resolve, ASK_EVERY_MS));
      signal?.throwIfAborted();
      calls(() => (tile = raw.takeTile()));
    }
    tiles.push(tile);
    onProgress?.(tiles.length / count);
  }
  return tiles;
}
