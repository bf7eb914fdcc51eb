/**
 * Binary glTF 2.0 (Khronos, 2021).
 *
 * Written by hand, since a general library makes an object of every accessor, and a field has three for each of thousands of rocks:
 * @gltf-transform took ten times the time of generating the field. Tests read the files back with it, and with Khronos' validator.
 */

import { GltfJson } from './gltf-json.ts';
import type { Counts, Told } from './gltf-json.ts';
import { buffersOf, meshesOf } from './gltf-parts.ts';
import type { Kit } from './kit.ts';
import { isOneThing } from './model.ts';
import type { Model } from './model.ts';
import type { ResolvedOptions } from './options.ts';

const [GLTF, JSON_CHUNK, BIN_CHUNK] = [0x46546c67, 0x4e4f534a, 0x004e4942];

export interface Written {
  bytes: Uint8Array<ArrayBuffer>;
  counts: Counts;
}

/** The file. `kit` where `mesh` is so. */
export function writeGlb(model: Model, { mesh, instancing }: ResolvedOptions, told: Told, kit?: Kit): Written {
  const meshes = meshesOf(model, mesh, kit);
  const buffers = buffersOf(model, meshes, mesh === 'one', kit && instancing ? instancesOf(model) : 0);
  const json = new GltfJson(model, buffers);
  for (const one of meshes) json.addMesh(one);
  if (kit) json.addKit(kit, meshes, told, instancing);
  else if (mesh === 'one') json.addWholes(meshes);
  else json.addSingles(meshes, told);
  return { bytes: container(json.text(told), buffers.bytes), counts: json.counts };
}

function instancesOf(model: Model): number {
  return model.groupOf.filter((group) => !isOneThing(model, group)).length;
}

function container(json: string, bin: Uint8Array): Uint8Array<ArrayBuffer> {
  const text = new TextEncoder().encode(json);
  const textLength = Math.ceil(text.length / 4) * 4;
  const binLength = bin.length > 0 ? 8 + bin.length : 0;
  const bytes = new Uint8Array(20 + textLength + binLength);
  const view = new DataView(bytes.buffer);
  [GLTF, 2, bytes.length, textLength, JSON_CHUNK].forEach((word, k) => view.setUint32(4 * k, word, true));
  bytes.fill(0x20, 20 + text.length, 20 + textLength);
  bytes.set(text, 20);
  if (binLength > 0) {
    view.setUint32(20 + textLength, bin.length, true);
    view.setUint32(24 + textLength, BIN_CHUNK, true);
    bytes.set(bin, 28 + textLength);
  }
  return bytes;
}
