/**
 * Binary glTF 2.0 (Khronos, 2021).
 *
 * Written by hand, since a general library makes an object of every accessor, and a field has three for each of thousands of rocks:
 * @gltf-transform took ten times the time of generating the field. Tests read the files back with it, and with Khronos' validator.
 */

import type { ByteWriter } from '../formats/byte-writer.ts';
import { fillInstances, fillMeshes, layoutOf } from './gltf-buffers.ts';
import type { Layout } from './gltf-buffers.ts';
import { GltfJson } from './gltf-json.ts';
import type { Counts, Told } from './gltf-json.ts';
import { allMeshes } from './gltf-parts.ts';
import type { Meshes, Shapes } from './gltf-parts.ts';
import { fillTextures } from './gltf-textures.ts';
import type { Kit } from '../shapes/kit.ts';
import { isOneThing } from '../model.ts';
import type { Model } from '../model.ts';
import type { ResolvedOptions } from '../options.ts';
import { packed } from './packed.ts';
import type { Pace } from '../pace.ts';

const [GLTF, JSON_CHUNK, BIN_CHUNK] = [0x46546c67, 0x4e4f534a, 0x004e4942];

export interface Written {
  bytes: Uint8Array<ArrayBuffer>;
  counts: Counts;
}

/** The share of the work that is done when the JSON part is written. */
const JSON_SHARE = 0.7;
/** And that when the binary part is filled which is to be compressed. */
const PACKED_SHARE = 0.85;

/** The file. `kit` where `mesh` is so. */
export async function writeGlb(shapes: Shapes, options: ResolvedOptions, told: Told, pace: Pace, kit?: Kit): Promise<Written> {
  const model = shapes.levels[0]!;
  const { json, steps, layout, meshes } = describe(shapes, options, told, kit);
  const expected = meshes.all.length + (kit ? model.groupOf.length : meshes.own.length);
  let done = 0;
  for (const _ of steps) {
    done += 1;
    if (pace.isDue()) await pace.rest((JSON_SHARE * done) / expected);
  }
  const { instancing, compress } = options;
  const fill = async (bin: Uint8Array<ArrayBuffer>, share: Pace): Promise<void> => {
    await fillMeshes(model, meshes.all, layout, bin, share);
    if (kit && instancing) fillInstances(model, kit, layout, bin);
    if (model.textures) fillTextures(model.textures.images, meshes.all, layout, bin);
  };
  if (compress && layout.length > 0) {
    const whole = new Uint8Array(layout.length);
    await fill(whole, pace.within(JSON_SHARE, PACKED_SHARE));
    const packing = await packed(layout, whole, pace.within(PACKED_SHARE, 1));
    const { bytes, bin } = container(json.pieces(packing), packing.length);
    for (const { offset, bytes: own } of Object.values(packing.views)) bin.set(own, offset);
    return { bytes, counts: json.counts };
  }
  // Filled where it is, so that it is in memory once.
  const { bytes, bin } = container(json.pieces(), layout.length);
  await fill(bin, pace.within(JSON_SHARE, 1));
  return { bytes, counts: json.counts };
}

/** Where everything is going to lie, and the JSON part, which is written by going through `steps`. */
export function describe(
  shapes: Shapes,
  { mesh, instancing, vertexColors }: ResolvedOptions,
  told: Told,
  kit: Kit | undefined,
): { json: GltfJson; steps: Iterable<void>; layout: Layout; meshes: Meshes } {
  const model = shapes.levels[0]!;
  const meshes = allMeshes(shapes, mesh, kit);
  const instances = kit && instancing ? instancesOf(model) : 0;
  const layout = layoutOf(meshes.all, { withIds: mesh === 'one', withColors: vertexColors, instances, images: model.textures?.images });
  const json = new GltfJson(model, layout, meshes, shapes.hullName, told);
  const steps = function* (): Generator<void> {
    yield* json.addMeshes();
    yield* kit ? json.addKit(kit, instancing) : mesh === 'one' ? json.addWholes() : json.addSingles();
  };
  return { json, steps: steps(), layout, meshes };
}

export function instancesOf(model: Model): number {
  return model.groupOf.filter((group) => !isOneThing(model, group)).length;
}

/** The file with its JSON part, which is moved there; the binary part is still empty. */
function container(json: readonly ByteWriter[], binLength: number): { bytes: Uint8Array<ArrayBuffer>; bin: Uint8Array<ArrayBuffer> } {
  const textLength = json.reduce((sum, piece) => sum + piece.length, 0);
  const begin = 20 + Math.ceil(textLength / 4) * 4;
  const bytes = new Uint8Array(begin + (binLength > 0 ? 8 + binLength : 0));
  const view = new DataView(bytes.buffer);
  [GLTF, 2, bytes.length, begin - 20, JSON_CHUNK].forEach((word, k) => view.setUint32(4 * k, word, true));
  let end = 20;
  for (const piece of json) end = piece.moveTo(bytes, end);
  bytes.fill(0x20, end, begin);
  if (binLength > 0) [binLength, BIN_CHUNK].forEach((word, k) => view.setUint32(begin + 4 * k, word, true));
  return { bytes, bin: bytes.subarray(Math.min(begin + 8, bytes.length)) };
}
