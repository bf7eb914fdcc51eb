// Where rocks are in their textures: laid flat without an overlap, about as large as they are, side by side, and with the tangents that belong to it.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { generate, presets } from 'rock-field/core';
import type { Field } from 'rock-field/core';
import { OPTIONS, resolveOptions } from '../../www/export/options.ts';
import type { ExportOptions } from '../../www/export/options.ts';
import { atlasOf, ATLAS_STRIDE } from '../../www/export/textures/atlas.ts';
import { filled, TEXEL } from '../../www/export/textures/fill.ts';
import type { Laid } from '../../www/export/textures/textured.ts';
import { unwrapped } from '../../www/export/textures/unwrap.ts';
import type { Disc } from '../../www/export/textures/unwrap.ts';
import { rimOf } from '../../www/export/shapes/solid.ts';
import type { Model } from '../../www/export/model.ts';
import { layOutField } from '../../www/rocks/export.ts';
import { resolveParams } from '../../www/rocks/request.ts';

type PresetName = keyof typeof presets;
type Vector = readonly [number, number, number];

const PRESETS = Object.keys(presets) as PresetName[];
const SMALL = { imageWidth: 160, imageHeight: 120, seed: 7 };

const fieldOf = (preset: PresetName): Promise<Field> => generate({ preset, ...SMALL });

function discOf({ positions, indices, rockStarts, vertexStarts }: Field, rock: number): Disc {
  const [first, last] = [vertexStarts[rock]!, vertexStarts[rock + 1]!];
  const triangles = indices.slice(rockStarts[rock]!, rockStarts[rock + 1]!).map((vertex) => vertex - first);
  return { points: Float64Array.from(positions.subarray(3 * first, 3 * last)), triangles, rim: rimOf(last - first, triangles.length / 3) };
}

const minus = (a: Vector, b: Vector): Vector => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const dot = (a: Vector, b: Vector): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a: Vector, b: Vector): Vector => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const lengthOf = (a: Vector): number => Math.sqrt(dot(a, a));
const pointAt = (points: ArrayLike<number>, v: number): Vector => [points[3 * v]!, points[3 * v + 1]!, points[3 * v + 2]!];

/** Twice the area, above 0 counter-clockwise. */
function twiceFlat(places: ArrayLike<number>, [a, b, c]: readonly [number, number, number]): number {
  const [x, y] = [places[2 * a]!, places[2 * a + 1]!];
  return (places[2 * b]! - x) * (places[2 * c + 1]! - y) - (places[2 * c]! - x) * (places[2 * b + 1]! - y);
}

function cornersOf(triangles: Uint32Array): [number, number, number][] {
  return Array.from({ length: triangles.length / 3 }, (_, t) => [triangles[3 * t]!, triangles[3 * t + 1]!, triangles[3 * t + 2]!]);
}

test('of no rock of any preset do two triangles overlap in its patch, which is convex, as large as the rock’s surface, and nowhere much coarser than elsewhere', async () => {
  for (const preset of PRESETS) {
    const field = await fieldOf(preset);
    let [whole, starved] = [0, 0];
    for (let rock = 0; rock < field.rockLayer.length; rock++) {
      const disc = discOf(field, rock);
      const { places, width, height } = unwrapped(disc);
      let [flat, surface, outline, turned, hollow] = [0, 0, 0, 0, 0];
      for (const corners of cornersOf(disc.triangles)) {
        const own = twiceFlat(places, corners) / 2;
        if (!(own > 0)) turned += 1;
        const [a, b, c] = [pointAt(disc.points, corners[0]), pointAt(disc.points, corners[1]), pointAt(disc.points, corners[2])];
        const area = lengthOf(cross(minus(b, a), minus(c, a))) / 2;
        flat += own;
        surface += area;
        if (own < 0.4 * area) starved += area;
      }
      for (let v = 0; v < disc.rim; v++) {
        const [next, last] = [(v + 1) % disc.rim, (v + 2) % disc.rim];
        if (!(twiceFlat(places, [v, next, last]) > 0)) hollow += 1;
        outline += (places[2 * v]! * places[2 * next + 1]! - places[2 * next]! * places[2 * v + 1]!) / 2;
      }
      whole += surface;
      const outside = places.filter((value, n) => value < 0 || value > (n % 2 === 0 ? width : height)).length;
      assert.deepEqual({ turned, hollow, outside }, { turned: 0, hollow: 0, outside: 0 }, `${preset}, rock ${rock}`);
      // Triangles that are all turned the same way, and together are as large as their outline, cover every place of it once.
      assert.ok(
        Math.abs(flat / outline - 1) < 1e-6 && Math.abs(flat / surface - 1) < 1e-6,
        `${preset}, rock ${rock}: ${flat}, ${outline}, ${surface}`,
      );
    }
    assert.ok(
      starved < 0.015 * whole,
      `${preset}: ${((100 * starved) / whole).toFixed(2)} % of the surface has less than 40 % of its share of texels`,
    );
  }
});

async function laidOut(options: ExportOptions, preset: PresetName = 'riverbed'): Promise<Laid & { field: Field }> {
  const params = resolveParams({ preset, ...SMALL });
  const field = await generate(params);
  return { field, ...(await layOutField(field, params, resolveOptions(options))) };
}

/** For each body the box around its places, of its undersides apart; texels. */
function boxesOf({ mesh, atlas, field }: Laid & { field: Field }): number[][] {
  const boxes: number[][] = [];
  for (let k = 0; k < field.rockLayer.length; k++) {
    if (atlas.holds[k] === 0) continue;
    const own = field.vertexStarts[k + 1]! - field.vertexStarts[k]!;
    const [first, last] = [mesh.vertexStarts[k]!, mesh.vertexStarts[k + 1]!];
    for (const [begin, end] of [
      [first, first + own],
      [first + own, last],
    ] as const) {
      if (begin === end) continue;
      const places = Array.from({ length: end - begin }, (_, v) =>
        [0, 1].map((axis) => atlas.vertices[ATLAS_STRIDE * (begin + v) + axis]!),
      );
      boxes.push(
        [0, 1].flatMap((axis) => [Math.min(...places.map((place) => place[axis]!)), Math.max(...places.map((place) => place[axis]!))]),
      );
    }
  }
  return boxes;
}

test('patches lie within the texture, four texels and more from one another, and fill most of it', async () => {
  for (const options of [{ mesh: 'one' }, { mesh: 'rocks', solid: true }, { mesh: 'kit', kinds: 5 }] as const) {
    const laid = await laidOut({ ...options, textures: '1k' });
    const { side } = laid.atlas;
    const boxes = boxesOf(laid);
    assert.ok(boxes.length > 5);
    for (const [k, [left, right, top, low]] of boxes.entries()) {
      assert.ok(left! >= 2 && right! <= side - 2 && top! >= 2 && low! <= side - 2, `${JSON.stringify(options)}: ${boxes[k]}`);
      for (const [l, other] of boxes.entries()) {
        if (l <= k) continue;
        const apart = Math.max(other[0]! - right!, left! - other[1]!, other[2]! - low!, top! - other[3]!);
        assert.ok(apart >= 4, `${JSON.stringify(options)}: ${boxes[k]} and ${other}`);
      }
    }
    const covered = boxes.reduce((sum, [left, right, top, low]) => sum + (right! - left!) * (low! - top!), 0);
    assert.ok(covered > 0.5 * side * side, `${JSON.stringify(options)}: ${covered / side / side}`);
  }
});

test('the same field is laid out the same way, and twice as large with textures of twice the side', async () => {
  const [once, again, larger] = [await laidOut({ textures: '1k' }), await laidOut({ textures: '1k' }), await laidOut({ textures: '2k' })];
  assert.deepEqual(once.atlas, again.atlas);
  const ratio = larger.atlas.density / once.atlas.density;
  // The margins do not grow with it.
  assert.ok(ratio > 2 && ratio < 2.4, String(ratio));
});

test('tangents are of length 1, at right angles to the normals, and point to the right in the texture', async () => {
  for (const solid of [false, true]) {
    const { mesh, atlas } = await laidOut({ textures: '1k', solid });
    const tangentOf = (v: number): Vector => [0, 1, 2].map((axis) => atlas.vertices[ATLAS_STRIDE * v + 2 + axis]!) as unknown as Vector;
    for (let v = 0; v < mesh.positions.length / 3; v++) {
      assert.ok(Math.abs(lengthOf(tangentOf(v)) - 1) < 1e-5);
      assert.ok(Math.abs(dot(tangentOf(v), pointAt(mesh.normals, v))) < 1e-4);
    }
    let [right, all] = [0, 0];
    for (const corners of cornersOf(mesh.indices)) {
      const [a, b, c] = corners;
      const [x, y] = [0, 1].map((axis) =>
        [b, c].map((v) => atlas.vertices[ATLAS_STRIDE * v + axis]! - atlas.vertices[ATLAS_STRIDE * a + axis]!),
      );
      const [toB, toC] = [
        minus(pointAt(mesh.positions, b), pointAt(mesh.positions, a)),
        minus(pointAt(mesh.positions, c), pointAt(mesh.positions, a)),
      ];
      // y of the atlas points down, so that its triangles are clockwise.
      const along = toB.map((value, axis) => -(value * y![1]! - toC[axis]! * y![0]!)) as unknown as Vector;
      assert.ok(x![0]! * y![1]! - x![1]! * y![0]! < 0.01, 'a triangle is turned over');
      for (const v of corners) {
        all += 1;
        if (dot(along, tangentOf(v)) > 0) right += 1;
      }
    }
    // At a ridge that is sharper than 90° a vertex has triangles on whose other side its tangent points back.
    assert.ok(right > 0.99 * all, `${right} of ${all}`);
  }
});

test('more rocks than there is room for are refused before any work, with the numbers', () => {
  const count = 20_000;
  const model = {
    groupOf: new Uint8Array(count),
    groups: [{ name: 'layer-1', noun: 'rock', isOpenBelow: true, extras: {} }],
  } as unknown as Model;
  assert.throws(() => atlasOf(model, model, [...model.groupOf.keys()], 1024), {
    name: 'ExportTooLarge',
    key: 'textures',
    value: count,
    max: 14_563,
    message: /20000 rocks do not fit into textures of 1024 × 1024, which have room for 14563/,
  });
  assert.ok(OPTIONS.textures.choices.includes('8k'));
});

test('what was not drawn of a texture is the mean of what was drawn near it, which stays as it is', () => {
  const side = 8;
  const texels = new Uint8Array(TEXEL * side * side);
  const draw = (x: number, y: number, value: number): void =>
    void texels
      .fill(value, TEXEL * (y * side + x), TEXEL * (y * side + x) + TEXEL - 1)
      .fill(255, TEXEL * (y * side + x) + TEXEL - 1, TEXEL * (y * side + x + 1));
  draw(0, 0, 10);
  draw(1, 0, 20);
  draw(7, 7, 200);
  filled(texels, side);
  const at = (x: number, y: number): number => texels[TEXEL * (y * side + x)]!;
  assert.deepEqual([at(0, 0), at(1, 0), at(7, 7)], [10, 20, 200]);
  // Of 2 × 2 texels, of 4 × 4, and of all.
  assert.deepEqual([at(0, 1), at(3, 3), at(6, 6), at(4, 4), at(7, 0)], [15, 15, 200, 200, 108]);
  assert.ok(texels.every((value, n) => n % TEXEL < TEXEL - 1 || value <= 255));
});
