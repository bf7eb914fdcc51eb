// What maps see from above: which triangle, how high, and where they are sampled.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { generate } from 'rock-field/core';
import type { Field } from 'rock-field/core';
import type { ExportOptions } from 'rock-field/export';
import type { Grid } from '../../www/export/maps/grid.ts';
import { Rasters } from '../../www/export/maps/rasters.ts';
import { GROUND, reliefOf } from '../../www/export/maps/relief.ts';
import { gridFor, modelOf, pyramid } from './map-files.ts';
import type { Point } from './map-files.ts';

const SMALL = { imageWidth: 64, imageHeight: 48 };

/** Whole numbers from 0 on, below what is asked for: the same ones for a seed. */
function randoms(seed: number): (below: number) => number {
  let state = seed;
  return (below) => {
    state = (state * 48_271) % 2_147_483_647;
    return state % below;
  };
}

/** 2⁻⁶⁰ is 1: enough for every 32-bit float that is a coordinate here. */
const exact = (value: number): bigint => BigInt(value * 2 ** 60);

/** For each pixel all triangles that cover its middle by the rule of graphics devices, with their heights there. Slow, and without rounding. */
function covering({ positions, indices }: Pick<Field, 'positions' | 'indices'>, { width, height, perX, perY, depth }: Grid) {
  const found = Array.from({ length: width * height }, () => [] as { triangle: number; z: number; isOnEdge: boolean }[]);
  for (let t = 0; t < indices.length / 3; t++) {
    let corners = [0, 1, 2].map((corner) => {
      const [x, y, z] = positions.subarray(3 * indices[3 * t + corner]!, 3 * indices[3 * t + corner]! + 3) as unknown as Point;
      return { x: exact(x) * exact(perX), y: (exact(depth) - exact(y)) * exact(perY), z };
    });
    const edge = (a: { x: bigint; y: bigint }, b: { x: bigint; y: bigint }, p: { x: bigint; y: bigint }): bigint =>
      (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    const area = edge(corners[0]!, corners[1]!, corners[2]!);
    if (area === 0n) continue;
    if (area < 0n) corners = corners.reverse();
    const [left, right, top, bottom] = [corners.map(({ x }) => x), corners.map(({ y }) => y)].flatMap((values) => {
      const sorted = values.map((value) => Number(value) / 2 ** 120).sort((a, b) => a - b);
      return [Math.max(0, Math.floor(sorted[0]!) - 1), Math.ceil(sorted[2]!) + 1];
    }) as [number, number, number, number];
    for (let row = top; row < Math.min(height, bottom); row++) {
      for (let column = left; column < Math.min(width, right); column++) {
        const p = { x: exact(column + 0.5) * exact(1), y: exact(row + 0.5) * exact(1) };
        const weights = corners.map((_, k) => {
          const [a, b] = [corners[(k + 1) % 3]!, corners[(k + 2) % 3]!];
          const weight = edge(a, b, p);
          const isLeftOrTop = b.y < a.y || (b.y === a.y && b.x > a.x);
          return weight > 0n || (weight === 0n && isLeftOrTop) ? weight : null;
        });
        if (weights.includes(null)) continue;
        const z = corners.reduce((sum, corner, k) => sum + (corner.z * Number(weights[k])) / Math.abs(Number(area)), 0);
        if (z >= -1e-9) found[row * width + column]!.push({ triangle: t + 1, z, isOnEdge: weights.includes(0n) });
      }
    }
  }
  return found;
}

test('every pixel shows the highest of the triangles over its middle, as arithmetic without rounding has it', async () => {
  for (const preset of ['journal-fig1', 'riverbed', 'scree'] as const) {
    const field = await generate({ preset, seed: 3, ...SMALL });
    for (const side of [0, 2 * SMALL.imageWidth]) {
      const grid = gridFor([field.imageWidth, field.imageHeight], { side });
      const { heights, triangles } = await reliefOf(field, grid, true);
      covering(field, grid).forEach((over, at) => {
        const highest = Math.max(GROUND, ...over.map(({ z }) => z));
        const where = `${preset}, pixel ${at}`;
        assert.ok(Math.abs(heights[at]! - highest) < 1e-5 * Math.max(1, highest), `${where}: ${heights[at]} instead of ${highest}`);
        const own = over.find(({ triangle }) => triangle === triangles[at]);
        assert.ok(highest === GROUND ? triangles[at] === 0 : own && own.z > highest - 1e-4, `${where}: triangle ${triangles[at]}`);
      });
    }
  }
});

test('a middle on an edge or a corner belongs to the triangle on its right or below, as arithmetic without rounding has it', async () => {
  const random = randoms(7);
  // Corners on middles of pixels: edges go through many of them.
  const corner = (): Point => [random(32) + 0.5, random(32) + 0.5, random(9)];
  // Seven rows along the edge that is 58 columns wide and 14 rows high, 58 / 14 * 7 is more than 29.
  const hard: Point[] = [
    [0.5, 63.5, 1],
    [58.5, 49.5, 1],
    [60.5, 62.5, 1],
  ];
  let onEdges = 0;
  for (let k = 0; k < 300; k++) {
    const size = k === 0 ? ([64, 64] as const) : ([32, 32] as const);
    const grid = gridFor(size);
    const model = modelOf([k === 0 ? (hard as [Point, Point, Point]) : [corner(), corner(), corner()]], size);
    const { heights, triangles } = await reliefOf(model, grid, true);
    const over = covering(model, grid);
    assert.deepEqual(
      [...triangles],
      over.map((found) => found.length),
    );
    over.forEach((found, at) => assert.ok(found.length === 0 || Math.abs(heights[at]! - found[0]!.z) < 1e-5));
    onEdges += over.filter((found) => found[0]?.isOnEdge).length;
  }
  assert.ok(onEdges > 500, `${onEdges} middles on edges`);
});

test('triangles that meet leave no gap and share no pixel, wherever their corners are', async () => {
  const size = [24, 24] as const;
  const grid = gridFor(size);
  const random = randoms(1);
  for (const step of [0.5, 0.25, 1 / 3]) {
    const drawn = new Uint8Array(grid.width * grid.height);
    // Corners of a grid of squares, moved about, many of them onto the middles of pixels.
    const corner = Array.from({ length: 49 }, (_, k): Point => {
      const [column, row] = [k % 7, Math.floor(k / 7)];
      const isOnBorder = column % 6 === 0 || row % 6 === 0;
      const steps = Math.floor(0.75 / step);
      const move = (): number => (isOnBorder ? 0 : step * (random(2 * steps + 1) - steps));
      return [4 * column + move(), 4 * row + move(), 1];
    });
    for (let k = 0; k < 42; k++) {
      if (k % 7 === 6) continue;
      const [a, b, c, d] = [corner[k]!, corner[k + 1]!, corner[k + 8]!, corner[k + 7]!];
      const pair =
        random(2) === 0
          ? ([
              [a, b, c],
              [a, c, d],
            ] as const)
          : ([
              [a, b, d],
              [b, c, d],
            ] as const);
      for (const triangle of pair) {
        const { heights } = await reliefOf(
          modelOf([random(2) === 0 ? triangle : [triangle[2], triangle[1], triangle[0]]], size),
          grid,
          false,
        );
        heights.forEach((height, at) => (drawn[at]! += height === GROUND ? 0 : 1));
      }
    }
    assert.deepEqual([...new Set(drawn)], [1], `steps of ${step}`);
  }
});

test('of what lies below the ground nothing is seen, but for the part that is above it', async () => {
  const rasters = await Rasters.of(pyramid(4), gridFor([16, 16]), { contact: 0.02, green: 'up' }, true);
  const cover = [...rasters.cover().samples];
  const expected = cover.map((_, at) => (Math.max(Math.abs((at % 16) - 7.5), Math.abs(Math.floor(at / 16) - 7.5)) <= 4 ? 255 : 0));
  assert.deepEqual(cover, expected);
  assert.equal(rasters.highest, 4);
  assert.deepEqual(
    [...(await Rasters.of(pyramid(9), gridFor([16, 16]), { contact: 1, green: 'up' }, true)).cover().samples],
    new Array(256).fill(0),
  );
});

test('samples lie in the middles of pixels, or from border to border for landscapes', async () => {
  // A plane that rises with x and falls with y, larger than the ground.
  const at = (x: number, y: number): Point => [x, y, 20 + x - y / 2];
  const model = modelOf([[at(-40, -40), at(200, -40), at(-40, 200)]], [40, 20]);
  const heights = async (options: ExportOptions): Promise<number[][]> => {
    const grid = gridFor([40, 20], options);
    const all = [...(await reliefOf(model, grid, false)).heights];
    return Array.from({ length: grid.height }, (_, row) => all.slice(row * grid.width, (row + 1) * grid.width));
  };
  const near = (found: number | undefined, expected: number): void =>
    assert.ok(Math.abs(found! - expected) < 1e-4, `${found}, not ${expected}`);
  const textures = await heights({ side: 8 });
  assert.deepEqual([textures.length, textures[0]!.length], [4, 8]);
  near(textures[0]![0], at(2.5, 17.5)[2]);
  near(textures[3]![7], at(37.5, 2.5)[2]);
  const landscape = await heights({ side: 9, square: true, samples: 'corners' });
  assert.deepEqual([landscape.length, landscape[0]!.length], [9, 9]);
  near(landscape[0]![0], at(0, 20)[2]);
  near(landscape[8]![8], at(40, 0)[2]);
  near(landscape[4]![4], at(20, 10)[2]);
});
