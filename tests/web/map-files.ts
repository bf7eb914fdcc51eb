/** Models made by hand, and readers of maps, for the tests of both. */

import assert from 'node:assert/strict';
import { PNG } from 'pngjs';
import type { ExportOptions } from 'rock-field/export';
import { gridOf } from '../../www/export/maps/grid.ts';
import type { Grid } from '../../www/export/maps/grid.ts';
import type { Mapped } from '../../www/export/maps/rasters.ts';
import { resolveOptions } from '../../www/export/options.ts';

export const METRES_PER_PIXEL = 0.01;

export type Point = readonly [number, number, number];

/** A model of triangles, each a body of its own unless `bodies` says how many triangles each has. */
export function modelOf(
  triangles: readonly (readonly [Point, Point, Point])[],
  size: readonly [number, number],
  bodies?: readonly number[],
): Mapped {
  const corners = triangles.flat();
  const each = bodies ?? triangles.map(() => 1);
  const starts = [0, ...each].map(
    (
      (sum) => (count: number) =>
        (sum += 3 * count)
    )(0),
  );
  return {
    unit: METRES_PER_PIXEL,
    positions: Float32Array.from(corners.flat()),
    normals: Float32Array.from(corners.flatMap(() => [0, 0, 1])),
    indices: Uint32Array.from(corners.keys()),
    indexStarts: Uint32Array.from(starts),
    vertexStarts: Uint32Array.from(starts),
    groupOf: new Uint8Array(each.length),
    groups: [{ name: 'layer-1', noun: 'rock', extras: {} }],
    materialOf: new Uint8Array(each.length),
    materials: [{ name: 'stone', color: [1, 1, 1] }],
    origins: new Float64Array(3 * each.length),
    centre: [size[0] / 2, size[1] / 2, 0],
    ground: { size, gravel: [false] },
  };
}

export const gridFor = (size: readonly [number, number], options: ExportOptions = {}): Grid => gridOf(size, resolveOptions(options));
export const told = { title: 'test-1', scene: { link: 'v=1' }, body: () => ({}) };

/** Samples of 16 bits as they are, or of 8, with as many channels as pngjs gives: four. */
export function read(png: Uint8Array): PNG & { data: Buffer | Uint16Array } {
  return PNG.sync.read(Buffer.from(png), { skipRescale: true });
}

export const first = (png: PNG, channels = 4): number[] =>
  Array.from({ length: png.width * png.height }, (_, at) => png.data[channels * at]!);

/** The number of the file's only channel at each pixel. */
export function readExr(bytes: Uint8Array): { width: number; height: number; values: Float32Array; header: string } {
  const view = new DataView(bytes.buffer, bytes.byteOffset);
  const header = new TextDecoder('latin1').decode(bytes.subarray(0, 2000));
  const window = header.indexOf('dataWindow\0box2i\0') + 'dataWindow\0box2i\0'.length + 4;
  const [width, height] = [view.getInt32(window + 8, true) + 1, view.getInt32(window + 12, true) + 1];
  // The last row ends the file, and every row has its number and length before it.
  const rows = bytes.length - height * (8 + 4 * width);
  const values = new Float32Array(width * height);
  for (let y = 0; y < height; y++) {
    const offset = Number(view.getBigUint64(rows - 8 * (height - y), true));
    assert.deepEqual([view.getInt32(offset, true), view.getInt32(offset + 4, true)], [y, 4 * width]);
    for (let x = 0; x < width; x++) values[y * width + x] = view.getFloat32(offset + 8 + 4 * x, true);
  }
  return { width, height, values, header };
}

/** A pyramid whose four faces look east, north, west and south, on a rim that lies `depth` below the ground. */
export function pyramid(depth: number): Mapped {
  const [a, b, c, d, top] = [
    [0, 0],
    [16, 0],
    [16, 16],
    [0, 16],
    [8, 8],
  ].map(([x, y], k) => [x!, y!, k === 4 ? 8 - depth : -depth] as Point) as [Point, Point, Point, Point, Point];
  const model = modelOf(
    [
      [b, c, top],
      [c, d, top],
      [d, a, top],
      [a, b, top],
    ],
    [16, 16],
    [4],
  );
  const normals = [
    [1, 0, 1],
    [0, 1, 1],
    [-1, 0, 1],
    [0, -1, 1],
  ].flatMap((face) => [face, face, face].flat().map((part) => part / Math.sqrt(2)));
  return { ...model, normals: Float32Array.from(normals) };
}
