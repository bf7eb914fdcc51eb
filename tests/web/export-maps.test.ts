// Maps as files: what their numbers are, read back by others, and what is refused.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { unzipSync } from 'fflate';
import type { PNG } from 'pngjs';
import { generate } from 'rock-field/core';
import { exportScene } from 'rock-field/export';
import type { ExportOptions, RockFieldError } from 'rock-field/export';
import { fieldBuffers } from '../../www/data/buffers.ts';
import { hashOf } from '../../www/export/origin/hash.ts';
import { bytesPerPixel, MOST_MEMORY, writeMaps } from '../../www/export/maps/maps.ts';
import { Rasters } from '../../www/export/maps/rasters.ts';
import { reliefOf } from '../../www/export/maps/relief.ts';
import { OPTIONS, resolveOptions } from '../../www/export/options.ts';
import { VERSION } from '../../www/data/version.ts';
import { sceneInFile } from '../../www/export/origin/scene-in-file.ts';
import { first, gridFor, METRES_PER_PIXEL, modelOf, pyramid, read, readExr, told } from './map-files.ts';
import type { Point } from './map-files.ts';

const REQUEST = { preset: 'riverbed', seed: 7, imageWidth: 96, imageHeight: 64 } as const;

test('PNG, R16 and EXR have the same heights: 16 bits up to the highest vertex, and metres', async () => {
  const field = await generate(REQUEST);
  const files = await Promise.all((['png', 'r16', 'exr'] as const).map((format) => exportScene(REQUEST, { format })));
  const [png, r16, exr] = files.map(({ bytes }) => bytes) as [Uint8Array, Uint8Array, Uint8Array];
  const highest = METRES_PER_PIXEL * field.positions.reduce((most, value, k) => (k % 3 === 2 ? Math.max(most, value) : most), 0);
  const { width, height, metresPerPixel, highest: said } = files[0]!.report.map!;
  assert.deepEqual([width, height, metresPerPixel], [96, 64, [METRES_PER_PIXEL, METRES_PER_PIXEL]]);
  assert.ok(Math.abs(said - highest) < 1e-6 * highest);
  const raw = [...new Uint16Array(r16.slice().buffer)];
  assert.equal(raw.length, width * height);
  assert.deepEqual(first(read(png)), raw);
  const metres = readExr(exr);
  assert.deepEqual([metres.width, metres.height], [width, height]);
  const grid = gridFor([96, 64]);
  const { heights } = await reliefOf(field, grid, false);
  metres.values.forEach((value, at) => {
    assert.equal(value, Math.fround(METRES_PER_PIXEL * Math.max(0, heights[at]!)));
    assert.ok(Math.abs(raw[at]! - (65_535 * value) / highest) <= 0.501, `${raw[at]} for ${value} m`);
  });
  assert.ok(raw.includes(0) && Math.max(...raw) > 60_000);
});

test('a map says where it comes from and what its numbers are, and so brings its scene back', async () => {
  const field = await generate(REQUEST);
  const origin = { link: 'v=1&preset=riverbed&seed=7&w=96&h=64', hash: hashOf(fieldBuffers(field)) };
  for (const options of [{ format: 'png' }, { format: 'zip' }, { format: 'zip', map: 'id' }] as const) {
    const written = { ...options, metresPerPixel: 0.01 };
    assert.deepEqual(await sceneInFile(new Blob([(await exportScene(REQUEST, options)).bytes])), {
      ...origin,
      version: VERSION,
      options: written,
    });
  }
  const { bytes } = await exportScene(REQUEST, { format: 'png', contact: 0.25, map: 'contact' });
  const chunks = new TextDecoder('latin1').decode(bytes);
  assert.match(chunks, /iTXtrock-field\0\0\0\0\0\{"link":"v=1&preset=riverbed&seed=7&w=96&h=64"/);
  assert.match(chunks, /iTXtrock-field-map\0\0\0\0\0\{"pixels":\{"width":96.*"contact":\{"rock":255,"radius":0.25,"unit":"m"\}/);
  assert.match(
    readExr((await exportScene(REQUEST, { format: 'exr' })).bytes).header,
    /comments\0string\0.{4}\{"link":"v=1&preset=riverbed/,
  );
});

test('normals are those of OpenGL, green up, or of DirectX, green down', async () => {
  const faces = { east: 8 * 16 + 13, north: 2 * 16 + 8, west: 8 * 16 + 2, south: 13 * 16 + 8 };
  const [slope, level, steep] = [Math.round(127.5 + 127.5 / Math.sqrt(2)), 128, Math.round(127.5 - 127.5 / Math.sqrt(2))];
  for (const green of OPTIONS.green.choices) {
    const { samples } = (await Rasters.of(pyramid(0), gridFor([16, 16]), { contact: 1, green }, true)).normal();
    const at = (pixel: number): number[] => [...samples.subarray(3 * pixel, 3 * pixel + 3)];
    const [north, south] = green === 'up' ? [slope, steep] : [steep, slope];
    assert.deepEqual(Object.values(faces).map(at), [
      [slope, level, slope],
      [level, north, slope],
      [steep, level, slope],
      [level, south, slope],
    ]);
  }
});

test('ids tell more than 65,535 rocks apart, in PNG as in EXR, and 0 is the ground', async () => {
  const side = 270;
  const triangles = Array.from({ length: side * (side - 10) }, (_, k) => {
    const [x, y] = [k % side, Math.floor(k / side)];
    return [
      [x, y, 1],
      [x + 1, y, 1],
      [x + 0.5, y + 1, 1],
    ] as const;
  });
  const model = modelOf(triangles, [side, side]);
  const png = read((await writeMaps(model, resolveOptions({ format: 'png', map: 'id' }), told)).bytes);
  const exr = readExr((await writeMaps(model, resolveOptions({ format: 'exr', map: 'id' }), told)).bytes);
  for (let at = 0; at < side * side; at++) {
    const k = (side - 1 - Math.floor(at / side)) * side + (at % side);
    const id = k < triangles.length ? k + 1 : 0;
    const [red, green, blue] = png.data.subarray(4 * at, 4 * at + 3) as unknown as Point;
    assert.deepEqual([red + 256 * green + 65_536 * blue, exr.values[at]], [id, id]);
  }
  assert.ok(triangles.length > 65_536);
});

test('cover, contact and splat agree with the ids: contact falls with the distance from the nearest rock, and splat sums to 255', async () => {
  const request = { ...REQUEST, preset: 'journal-fig1' } as const;
  const field = await generate(request);
  const [radius, options] = [0.05, { format: 'png', contact: 0.05, square: true, side: 40 } as const];
  const maps = await Promise.all(
    (['id', 'cover', 'contact', 'splat'] as const).map(async (map) => read((await exportScene(request, { ...options, map })).bytes)),
  );
  const [id, cover, contact, splat] = maps as [PNG, PNG, PNG, PNG];
  const ids = Array.from({ length: 40 * 40 }, (_, at) => id.data[4 * at]! + 256 * id.data[4 * at + 1]!);
  assert.deepEqual(
    first(cover),
    ids.map((value) => (value > 0 ? 255 : 0)),
  );
  const [across, along] = [(96 * METRES_PER_PIXEL) / 40, (64 * METRES_PER_PIXEL) / 40];
  const rocks = ids.flatMap((value, at) => (value > 0 ? [at] : []));
  const radii = field.layers.map((layer) => layer.radius);
  const isGravel = (rock: number): boolean => radii[field.rockLayer[rock - 1]!]! ** 2 < Math.min(...radii) * Math.max(...radii);
  const kinds = new Set<string>();
  ids.forEach((value, at) => {
    const away = rocks.reduce(
      (least, rock) =>
        Math.min(least, Math.hypot(((rock % 40) - (at % 40)) * across, (Math.floor(rock / 40) - Math.floor(at / 40)) * along)),
      Infinity,
    );
    const near = Math.max(0, 255 * (1 - away / radius));
    assert.ok(Math.abs(contact.data[4 * at]! - near) <= 0.5 + 1e-9, `pixel ${at}: ${contact.data[4 * at]} instead of ${near}`);
    const weights = [...splat.data.subarray(4 * at, 4 * at + 4)];
    assert.equal(
      weights.reduce((sum, weight) => sum + weight),
      255,
    );
    const foot = contact.data[4 * at]!;
    assert.deepEqual(weights, value === 0 ? [0, 0, foot, 255 - foot] : isGravel(value) ? [0, 255, 0, 0] : [255, 0, 0, 0]);
    kinds.add(value === 0 ? 'ground' : isGravel(value) ? 'gravel' : 'rock');
  });
  assert.equal(kinds.size, 3);
});

test('maps are as large as is asked, and no name has a size in it, which Unreal would take for the place of a tile', async () => {
  const sizeOf = async (options: ExportOptions): Promise<[number, number, string]> => {
    const { bytes, name } = await exportScene(REQUEST, { format: 'png', map: 'cover', ...options });
    const { width, height } = read(bytes);
    return [width, height, name];
  };
  assert.deepEqual(await sizeOf({}), [96, 64, 'riverbed-7-cover.png']);
  assert.deepEqual(await sizeOf({ side: 129, samples: 'corners' }), [129, 86, 'riverbed-7-cover.png']);
  assert.deepEqual(await sizeOf({ side: 33, square: true }), [33, 33, 'riverbed-7-cover.png']);
  assert.deepEqual((await sizeOf({ side: 1 })).slice(0, 2), [1, 1]);
});

test('a ZIP has every map and the points, says what they are, and is the same file on every day and in every time zone', async () => {
  const zone = process.env.TZ;
  const zips = [];
  for (const tz of ['Asia/Tokyo', 'America/St_Johns']) {
    process.env.TZ = tz;
    zips.push(await exportScene(REQUEST, { format: 'zip', side: 48 }));
  }
  if (zone === undefined) delete process.env.TZ;
  else process.env.TZ = zone;
  const [{ bytes, name }, other] = zips as [(typeof zips)[0], (typeof zips)[0]];
  assert.deepEqual(Buffer.from(bytes), Buffer.from(other.bytes));
  assert.equal(name, 'riverbed-7-maps.zip');
  // Date and time of the first entry: 1 January 1980, 0:00.
  assert.equal(new DataView(bytes.buffer).getUint32(10, true), (((0 << 9) | (1 << 5) | 1) << 16) >>> 0);
  const entries = unzipSync(bytes);
  const maps = [
    'height.png',
    'height.r16',
    'height.exr',
    'normal.png',
    'id.png',
    'id.exr',
    'cover.png',
    'contact.png',
    'splat.png',
    'points.csv',
  ];
  assert.deepEqual(Object.keys(entries), [...maps.map((map) => `riverbed-7-${map}`), 'rock-field.json']);
  const alone = await exportScene(REQUEST, { format: 'png', map: 'normal', side: 48 });
  assert.deepEqual(Buffer.from(entries['riverbed-7-normal.png']!), Buffer.from(alone.bytes));
  const said = JSON.parse(new TextDecoder().decode(entries['rock-field.json'])) as Record<string, unknown> & {
    maps: Record<string, unknown>;
  };
  assert.deepEqual([said.metresPerPixel, said.pixels], [0.01, { width: 48, height: 32, samples: 'centres', metresPerPixel: [0.02, 0.02] }]);
  assert.deepEqual(Object.keys(said.maps), ['height', 'normal', 'id', 'cover', 'contact', 'splat']);
  const single = unzipSync((await exportScene(REQUEST, { format: 'zip', map: 'id', side: 48 })).bytes);
  assert.deepEqual(Object.keys(single), ['riverbed-7-id.png', 'riverbed-7-id.exr', 'rock-field.json']);
});

test('what would take too much memory is refused before anything is allocated, with the side that fits', async () => {
  for (const [format, map] of [
    ['png', 'height'],
    ['exr', 'id'],
    ['r16', 'height'],
    ['zip', 'all'],
  ] as const) {
    const model = modelOf([], [16_384, 16_384]);
    const before = process.memoryUsage().arrayBuffers;
    let message = '';
    await assert.rejects(writeMaps(model, resolveOptions({ format, map }), told), (error: RockFieldError) => {
      message = error.message;
      return error.name === 'ExportTooLarge' && error.key === 'side' && error.max === MOST_MEMORY && (error.value as number) > MOST_MEMORY;
    });
    assert.ok(process.memoryUsage().arrayBuffers - before < 1e6);
    const side = Number(/side (\d+) or less/.exec(message)![1]);
    const fits = (pixels: number): boolean => bytesPerPixel(format, map) * pixels * pixels <= MOST_MEMORY;
    assert.deepEqual([fits(side), fits(side + 1)], [true, false], message);
  }
});

test('a field without rocks is ground on every map', async () => {
  const nothing = { ...REQUEST, layers: [] };
  const values = async (map: ExportOptions['map']): Promise<number[]> => [
    ...new Set(read((await exportScene(nothing, { format: 'png', map })).bytes).data),
  ];
  assert.deepEqual(await values('height'), [0, 65_535]);
  assert.deepEqual(await values('cover'), [0, 255]);
  assert.deepEqual(await values('contact'), [0, 255]);
  assert.deepEqual(await values('normal'), [128, 255]);
  assert.deepEqual(await values('splat'), [0, 255]);
  assert.equal((await exportScene(nothing, { format: 'zip' })).report.map!.highest, 0);
});

test('a scene without ground has no maps', async () => {
  const { ground: _, ...model } = pyramid(0);
  await assert.rejects(writeMaps(model, resolveOptions({ format: 'png' }), told), { name: 'ExportImpossible', key: 'format' });
});

test('a format takes the maps that it can hold, and refuses others by name', () => {
  assert.equal(resolveOptions({ format: 'zip' }).map, 'all');
  assert.equal(resolveOptions({ format: 'png' }).map, 'height');
  // What has no meshes takes no notice of their form.
  assert.equal(resolveOptions({ format: 'png', mesh: 'kit' }).format, 'png');
  for (const options of [
    { format: 'png', map: 'all' },
    { format: 'r16', map: 'normal' },
    { format: 'exr', map: 'splat' },
  ] as const) {
    assert.throws(() => resolveOptions(options), { name: 'ExportImpossible', key: 'map', value: options.map });
  }
});
