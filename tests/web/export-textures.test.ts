// Textures in files: tiles as a renderer draws them become images that others read, in files that are valid; where none are drawn, the file says so.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { WebIO } from '@gltf-transform/core';
import type { Document } from '@gltf-transform/core';
import validator from 'gltf-validator';
import { PNG } from 'pngjs';
import { generate } from 'rock-field/core';
import { exportScene } from 'rock-field/export';
import type { ExportedFile } from '../../www/export/file.ts';
import { resolveOptions } from '../../www/export/options.ts';
import type { ExportOptions } from '../../www/export/options.ts';
import { ATLAS_STRIDE } from '../../www/export/textures/atlas.ts';
import { TEXEL } from '../../www/export/textures/fill.ts';
import { imagesOf, TILE } from '../../www/export/textures/images.ts';
import type { Baked, Laid } from '../../www/export/textures/textured.ts';
import { exportField, layOutField } from '../../www/rocks/export.ts';
import type { GroundModule } from '../../www/rocks/ground.ts';
import { Realm } from '../../www/generator/headless.ts';
import { resolveParams } from '../../www/rocks/request.ts';

const GROUND = new Realm<GroundModule>(
  () => import('../../pkg/ground-mesh.js'),
  () => readFileSync(new URL('../../pkg/ground-mesh_bg.wasm', import.meta.url)),
);
const REQUEST = { preset: 'riverbed', seed: 7, imageWidth: 64, imageHeight: 48 } as const;

/** As a renderer would draw it: the left half of the texture red, the right half green; open, in their plane, and rough. */
function drawn(side: number): Uint8Array[] {
  return Array.from({ length: (side / TILE) ** 2 }, (_, number) => {
    const tile = new Uint8Array(TEXEL * TILE * TILE);
    for (let at = 0; at < tile.length; at += TEXEL) {
      const x = (number % (side / TILE)) * TILE + ((at / TEXEL) % TILE);
      tile.set(x < side / 2 ? [200, 10, 20, 255, 128, 128, 210, 255] : [10, 200, 20, 100, 192, 64, 90, 255], at);
    }
    return tile;
  });
}

async function exported(options: ExportOptions): Promise<{ file: ExportedFile; laid: Laid; baked: Baked }> {
  const params = resolveParams(REQUEST);
  const field = await generate(params);
  const resolved = resolveOptions({ textures: '1k', ...options });
  const laid = await layOutField(field, params, resolved);
  const baked = { atlas: laid.atlas, images: await IMAGES };
  return { file: await exportField(field, { params, preset: 'riverbed' }, resolved, GROUND, undefined, baked), laid, baked };
}

const IMAGES = imagesOf(drawn(1024), 1024);
const read = ({ bytes }: ExportedFile): Promise<Document> => new WebIO().readBinary(bytes);

test('tiles become three images: colours as they were, normals of length 1, and occlusion, roughness and no metal', async () => {
  const { color, normal, surface } = await imagesOf(drawn(2048), 2048);
  const pixels = [color, normal, surface].map((file) => PNG.sync.read(Buffer.from(file)));
  for (const { width, height } of pixels) assert.deepEqual([width, height], [2048, 2048]);
  // Just left and right of the middle, which lies between two tiles, in the lower row of them.
  const at = (x: number): number[][] => pixels.map(({ data }) => [...data.subarray(4 * (1500 * 2048 + x), 4 * (1500 * 2048 + x) + 3)]);
  const bent = Math.round(127.5 + 127.5 * Math.sqrt(1 - (192 / 127.5 - 1) ** 2 - (64 / 127.5 - 1) ** 2));
  assert.deepEqual(at(1023), [
    [200, 10, 20],
    [128, 128, 255],
    [255, 210, 0],
  ]);
  assert.deepEqual(at(1024), [
    [10, 200, 20],
    [192, 64, bent],
    [100, 90, 0],
  ]);
});

test('files with textures are valid, whatever their mesh form, closed or open', async () => {
  for (const options of [
    { mesh: 'one' },
    { mesh: 'rocks', solid: true },
    { mesh: 'kit', kinds: 3 },
    { mesh: 'kit', instancing: true, solid: true },
    { mesh: 'rocks', solid: true, lods: 3, hulls: 'unreal', groundMesh: 'cut' },
    { mesh: 'one', lods: 2, groundMesh: 'whole' },
  ] as const) {
    const { file } = await exported(options);
    const { issues } = await validator.validateBytes(file.bytes);
    assert.deepEqual(
      issues.messages.filter(({ severity }) => severity < 2),
      [],
      JSON.stringify(options),
    );
  }
});

test('every rock is of one material with the images, and its vertices are in the texture where they were laid', async () => {
  const { file, laid } = await exported({ mesh: 'one', belowGround: 'cut' });
  const root = (await read(file)).getRoot();
  const [material, ...others] = root.listMaterials();
  assert.equal(others.length, 0);
  const images = [
    material!.getBaseColorTexture(),
    material!.getNormalTexture(),
    material!.getOcclusionTexture(),
    material!.getMetallicRoughnessTexture(),
  ];
  assert.deepEqual(
    images.map((texture) => [texture!.getName(), texture!.getMimeType(), texture!.getSize()]),
    ['color', 'normal', 'surface', 'surface'].map((name) => [name, 'image/png', [1024, 1024]]),
  );
  const places = root
    .listMeshes()
    .flatMap((mesh) => mesh.listPrimitives().flatMap((primitive) => [...primitive.getAttribute('TEXCOORD_0')!.getArray()!]));
  const expected = [0, 1].map((axis) =>
    Array.from({ length: places.length / 2 }, (_, v) => laid.atlas.vertices[ATLAS_STRIDE * v + axis]! / 1024),
  );
  assert.deepEqual([places.filter((_, n) => n % 2 === 0), places.filter((_, n) => n % 2 === 1)], expected);
});

test('a vertex of a coarser level is in the texture where it is at the finest', async () => {
  const root = (await read((await exported({ lods: 3, hulls: 'godot' })).file)).getRoot();
  const places = new Map<string, string>();
  const nodes = root.listNodes().filter((node) => /_LOD\d$/.test(node.getName()));
  for (const node of nodes.sort((a, b) => a.getName().localeCompare(b.getName()))) {
    const [primitive] = node.getMesh()!.listPrimitives();
    const [positions, coordinates] = ['POSITION', 'TEXCOORD_0'].map((name) => primitive!.getAttribute(name)!);
    for (let v = 0; v < positions!.getCount(); v++) {
      const [place, found] = [
        `${node.getName().split('_')[0]} ${positions!.getElement(v, []).join()}`,
        coordinates!.getElement(v, []).join(),
      ];
      if (node.getName().endsWith('_LOD0')) places.set(place, found);
      else assert.equal(places.get(place), found, place);
    }
  }
  assert.ok(places.size > 0);
});

test('tangents are turned like the normals: at right angles to them, also of the kinds of a kit', async () => {
  const { file } = await exported({ mesh: 'kit', kinds: 4 });
  for (const mesh of (await read(file)).getRoot().listMeshes()) {
    const [{ NORMAL, TANGENT }] = mesh.listPrimitives().map((primitive) => ({
      NORMAL: primitive.getAttribute('NORMAL')!,
      TANGENT: primitive.getAttribute('TANGENT')!,
    })) as [{ NORMAL: ReturnType<typeof Object>; TANGENT: ReturnType<typeof Object> }];
    for (let v = 0; v < NORMAL.getCount(); v++) {
      const [normal, tangent] = [NORMAL.getElement(v, []), TANGENT.getElement(v, [])];
      assert.ok(Math.abs(normal[0] * tangent[0] + normal[1] * tangent[1] + normal[2] * tangent[2]) < 1e-4);
      assert.equal(tangent[3], 1);
    }
  }
});

test('of a kit only its kinds are in the texture, so that they are finer', async () => {
  const [kit, all] = [await exported({ mesh: 'kit', kinds: 3 }), await exported({ mesh: 'rocks' })];
  assert.ok(kit.laid.atlas.holds.reduce((sum, held) => sum + held, 0) < all.laid.atlas.holds.length);
  assert.ok(kit.file.report.texelsPerMetre! > all.file.report.texelsPerMetre!);
});

test('the report says how fine the textures are, and no longer that patterns are lost; without a graphics device it says that there are none', async () => {
  const { file, laid } = await exported({ mesh: 'one', belowGround: 'cut' });
  const codes = ({ report }: Pick<ExportedFile, 'report'>): string[] => report.notes.map(({ code }) => code);
  assert.equal(file.report.texelsPerMetre, Math.round(laid.atlas.density / 0.01));
  assert.deepEqual(codes(file), []);
  const plain = await exportScene(REQUEST, { textures: '1k', belowGround: 'cut' });
  assert.deepEqual([codes(plain), plain.report.texelsPerMetre], [['no-device'], undefined]);
});

test('textures go with GLB and natural stone alone', async () => {
  for (const format of ['obj', 'stl', 'ply'] as const) {
    await assert.rejects(exportScene(REQUEST, { format, mesh: 'one', textures: '2k' }), {
      name: 'ExportImpossible',
      key: 'textures',
      value: '2k',
    });
  }
  await assert.rejects(exportScene(REQUEST, { color: 'layer', textures: '2k' }), { name: 'ExportImpossible', key: 'textures' });
  await assert.rejects(exportScene(REQUEST, { textures: '3k' as '2k' }), { name: 'OutOfRange', key: 'textures', value: '3k' });
});
