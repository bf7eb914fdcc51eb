/** The binary part of a glTF file, compressed without a loss: EXT_meshopt_compression (Khronos, 2021), by meshoptimizer's encoder. */

import { lazily } from '../../base/lazy.ts';
import { IMAGES } from './gltf-buffers.ts';
import type { Layout, View, ViewName } from './gltf-buffers.ts';
import type { Pace } from '../pace.ts';

export const COMPRESSION = 'EXT_meshopt_compression';

/** A stretch of the buffer as it is stored. */
export interface Packed {
  offset: number;
  bytes: Uint8Array;
  /** How its elements are encoded; images are as they are. */
  code?: { byteStride: number; count: number; mode: 'ATTRIBUTES' | 'TRIANGLES' };
}

/** All of them, in the order of the views. */
export interface Packing {
  length: number;
  views: Partial<Record<ViewName, Packed>>;
}

/** @param bin the binary part as it would be without compression. */
export async function packed(layout: Layout, bin: Uint8Array, pace: Pace): Promise<Packing> {
  const { MeshoptEncoder } = await lazily(() => import('meshoptimizer/encoder'));
  await MeshoptEncoder.ready;
  const packing: Packing = { length: 0, views: {} };
  const names = Object.keys(layout.views) as ViewName[];
  for (const [k, name] of names.entries()) {
    const view = layout.views[name]!;
    const source = bin.subarray(view.offset, view.offset + view.length);
    const code = codeOf(name, view, layout);
    const bytes = code ? MeshoptEncoder.encodeGltfBuffer(source, code.count, code.byteStride, code.mode) : source;
    packing.views[name] = { offset: packing.length, bytes, ...(code && { code }) };
    packing.length += Math.ceil(bytes.length / 4) * 4;
    if (pace.isDue()) await pace.rest((k + 1) / names.length);
  }
  return packing;
}

/** Strides of what needs none in a file without compression. */
const STRIDES: Partial<Record<ViewName, number>> = { translations: 12, rotations: 16, scales: 12 };

function codeOf(name: ViewName, { length, stride }: View, { indexBytes }: Layout): Packed['code'] {
  if ((IMAGES as readonly ViewName[]).includes(name)) return undefined;
  const byteStride = name === 'indices' ? indexBytes : (stride ?? STRIDES[name]!);
  return { byteStride, count: length / byteStride, mode: name === 'indices' ? 'TRIANGLES' : 'ATTRIBUTES' };
}

/** The list of views in the file's JSON. Readers without the extension are told that there is a second buffer, which is nowhere. */
export function packedViews({ views }: Layout, packing: Packing): object[] {
  return (Object.keys(views) as ViewName[]).map((name) => {
    const { offset, length, stride, target } = views[name]!;
    const { offset: byteOffset, bytes, code } = packing.views[name]!;
    if (!code) return { buffer: 0, byteOffset, byteLength: bytes.length };
    return {
      buffer: 1,
      byteOffset: offset,
      byteLength: length,
      ...(stride && { byteStride: stride }),
      ...(target && { target }),
      extensions: { [COMPRESSION]: { buffer: 0, byteOffset, byteLength: bytes.length, ...code } },
    };
  });
}
