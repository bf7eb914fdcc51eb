// Files in parts: a ZIP of files that fit together.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { WebIO } from '@gltf-transform/core';
import type { Document } from '@gltf-transform/core';
import { unzipSync } from 'fflate';
import { exportScene, exportWoodEar } from 'rock-field/export';
import type { ExportOptions, RockFieldError } from 'rock-field/export';
import type { Model } from '../../www/export/model.ts';
import { resolveOptions } from '../../www/export/options.ts';
import { sceneInFile } from '../../www/export/origin/scene-in-file.ts';
import { cellsOf, fewestParts } from '../../www/export/parts.ts';
import { checkFits } from '../../www/export/too-large.ts';

const REQUEST = { preset: 'riverbed', seed: 7, imageWidth: 160, imageHeight: 120 } as const;

const partsOf = async (options: ExportOptions): Promise<[string, Uint8Array][]> =>
  Object.entries(unzipSync((await exportScene(REQUEST, options)).bytes));

const read = (bytes: Uint8Array): Promise<Document> => new WebIO().readBinary(Uint8Array.from(bytes));

/** For each object by its name where it stands, what is said of it, and its vertices. */
function objectsOf(document: Document): Map<string, object> {
  const objects = new Map<string, object>();
  for (const node of document.getRoot().listNodes()) {
    const mesh = node.getMesh();
    if (!mesh) continue;
    assert.ok(!objects.has(node.getName()), `${node.getName()} is there twice`);
    const vertices = mesh.listPrimitives().map((primitive) => [...primitive.getAttribute('POSITION')!.getArray()!]);
    objects.set(node.getName(), { at: node.getWorldTranslation(), extras: node.getExtras(), vertices });
  }
  return objects;
}

test('every object of the whole is in one part: by the same name, at the same place, with the same mesh and link', async () => {
  const whole = await read((await exportScene(REQUEST, { groundMesh: 'whole' })).bytes);
  const expected = objectsOf(whole);
  const found = new Map<string, object>();
  const files = await partsOf({ groundMesh: 'whole', parts: 4 });
  assert.deepEqual(
    files.map(([name]) => name),
    ['x0_y0', 'x1_y0', 'x0_y1', 'x1_y1'].map((cell) => `riverbed-7_${cell}.glb`),
  );
  for (const [name, bytes] of files) {
    const part = await read(bytes);
    const extras = { ...whole.getRoot().listScenes()[0]!.getExtras(), options: { groundMesh: 'whole', parts: 4 } };
    assert.deepEqual(part.getRoot().listScenes()[0]!.getExtras(), extras);
    const [east, north] = [name.includes('x1'), name.includes('y1')];
    for (const [object, facts] of objectsOf(part)) {
      assert.ok(!found.has(object), `${object} is in two parts`);
      found.set(object, facts);
      const [x, , z] = (facts as { at: [number, number, number] }).at;
      if (object !== 'ground') assert.ok(x >= 0 === east && z <= 0 === north, `${object} at ${x}, ${z} in ${name}`);
    }
  }
  assert.equal(found.size, expected.size);
  for (const [name, facts] of expected) assert.deepEqual(found.get(name), facts, name);
});

test('parts of a mesh for each layer tell which rock a vertex is of, and those of all formats have all triangles', async () => {
  const ids = async (files: Uint8Array[]): Promise<number[]> => {
    const found = new Set<number>();
    for (const bytes of files) {
      for (const mesh of (await read(bytes)).getRoot().listMeshes()) {
        for (const primitive of mesh.listPrimitives()) for (const id of primitive.getAttribute('_FEATURE_ID_0')!.getArray()!) found.add(id);
      }
    }
    return [...found].sort((a, b) => a - b);
  };
  const parts = await partsOf({ mesh: 'one', parts: 6 });
  assert.deepEqual(await ids(parts.map(([, bytes]) => bytes)), await ids([(await exportScene(REQUEST, { mesh: 'one' })).bytes]));
  for (const format of ['glb', 'obj', 'stl', 'ply'] as const) {
    const [one, six] = [await exportScene(REQUEST, { format }), await exportScene(REQUEST, { format, parts: 6 })];
    assert.equal(six.report.triangles, one.report.triangles, format);
    assert.deepEqual([six.name, six.type], ['riverbed-7.zip', 'application/zip']);
  }
});

/** The corners of all triangles, each a text, sorted. */
function cornersOf(files: readonly Uint8Array[]): string[] {
  return files
    .flatMap((bytes) => {
      const view = new DataView(bytes.buffer, bytes.byteOffset);
      return Array.from({ length: view.getUint32(80, true) }, (_, t) =>
        Array.from({ length: 9 }, (_, k) => view.getFloat32(84 + 50 * t + 12 + 4 * k, true)).join(),
      );
    })
    .sort();
}

test('the triangles of STL parts lie where they lie in the whole', async () => {
  const parts = (await partsOf({ format: 'stl', parts: 3 })).map(([, bytes]) => bytes);
  assert.deepEqual(cornersOf(parts), cornersOf([(await exportScene(REQUEST, { format: 'stl' })).bytes]));
});

test('a ZIP of parts brings the scene back, and the same request gives the same ZIP', async () => {
  const file = await exportScene(REQUEST, { parts: 4 });
  const scene = await sceneInFile(new Blob([file.bytes]));
  const [, bytes] = Object.entries(unzipSync(file.bytes))[0]!;
  assert.equal((scene as { link: string }).link, (await read(bytes)).getRoot().listScenes()[0]!.getExtras().link);
  assert.deepEqual(Buffer.from((await exportScene(REQUEST, { parts: 4 })).bytes), Buffer.from(file.bytes));
});

test('a colony in parts has all of its ears, and its log once', async () => {
  const request = { preset: 'thesis-fig4-8', ground: '' } as const;
  const whole = objectsOf(await read((await exportWoodEar(request)).bytes));
  const found = Object.values(unzipSync((await exportWoodEar(request, { parts: 4 })).bytes)).map(async (bytes) => [
    ...objectsOf(await read(bytes)).keys(),
  ]);
  assert.deepEqual((await Promise.all(found)).flat().sort(), [...whole.keys()].sort());
});

test('a field without rocks is one part without meshes', async () => {
  const files = Object.entries(unzipSync((await exportScene({ ...REQUEST, layers: [] }, { parts: 4 })).bytes));
  assert.equal(files.length, 1);
});

test('a grid has as many cells as were asked for, as square as can be', () => {
  const model = {
    groups: [{ name: 'layer-1', noun: 'rock', extras: {} }],
    groupOf: new Uint8Array(1200),
    origins: Float64Array.from({ length: 3600 }, (_, k) => [Math.floor(k / 3) % 40, Math.floor(k / 120), 0][k % 3]!),
    ground: { size: [40, 30], gravel: [false] },
  } as unknown as Model;
  const shapes = ([2, 7, 12, 64] as const).map((count) => {
    const cells = cellsOf(model, count);
    assert.equal(cells.length, count);
    assert.equal(cells.flatMap(({ bodies }) => bodies).length, 1200);
    return cells.at(-1)!.name;
  });
  assert.deepEqual(shapes, ['x1_y0', 'x6_y0', 'x3_y2', 'x7_y7']);
});

test('what is too large for a file is offered as a kit, or in as many parts as fit', () => {
  const [rocks, each] = [10_000, 10_000];
  const starts = (length: number): Uint32Array => Uint32Array.from({ length: rocks + 1 }, (_, k) => k * length);
  const model = {
    groups: [{ name: 'layer-1', noun: 'rock', isOpenBelow: true, extras: {} }],
    groupOf: new Uint8Array(rocks),
    materials: [{ name: 'stone', color: [0, 0, 0] }],
    materialOf: new Uint8Array(rocks),
    vertexStarts: starts(each),
    indexStarts: starts(3 * each),
    origins: Float64Array.from({ length: 3 * rocks }, (_, k) => [Math.floor(k / 3) % 100, Math.floor(k / 300), 0][k % 3]!),
    ground: { size: [100, 100], gravel: [false] },
  } as unknown as Model;
  const told = { title: '', scene: {}, body: () => undefined };
  const check = (parts: number): void => checkFits({ model, options: resolveOptions({ format: 'stl', parts }), told });
  let parts = 0;
  assert.throws(
    () => check(1),
    (error: unknown) => {
      assert.equal((error as Error).name, 'ExportTooLarge');
      const { message, words } = error as RockFieldError;
      assert.match(words?.ja ?? '', /5000 MB.*2147 MB.*シーン/);
      assert.match(message, /5000 MB; it may be at most 2147 MB: choose mesh "kit" with format "glb", or a smaller image/);
      return true;
    },
  );
  const half = { ...model, indexStarts: starts(1.5 * each) };
  assert.throws(
    () => checkFits({ model: half, options: resolveOptions({ format: 'stl' }), told }),
    (error: unknown) => {
      parts = Number(/or parts (\d+),/.exec((error as Error).message)?.[1]);
      return parts > 1;
    },
  );
  checkFits({ model: half, options: resolveOptions({ format: 'stl', parts }), told });
});

test('the number of parts that is offered is the first by which each has no more than fits', () => {
  assert.equal(fewestParts(2001, 2000, 1), 4);
  assert.equal(fewestParts(7000, 2000, 1), 4);
  assert.equal(fewestParts(7300, 2000, 1), 9);
  // Of parts that are there already, the largest is told of.
  assert.equal(fewestParts(3000, 2000, 4), 9);
  assert.equal(fewestParts(1e6, 2000, 1), undefined);
});

test('objects are counted by file', async () => {
  const request = { preset: 'conference-fig1', seed: 4, imageWidth: 500, imageHeight: 400 } as const;
  const countOf = async (parts: number): Promise<number | undefined> =>
    (await exportScene(request, { parts })).report.notes.find(({ code }) => code === 'many-objects')?.count;
  assert.equal(await countOf(1), 2626);
  assert.equal(await countOf(4), undefined);
});
