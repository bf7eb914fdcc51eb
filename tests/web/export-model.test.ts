// What becomes an object in a file, and how it is called: a model made by hand, of two groups of bodies and of one thing.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { WebIO } from '@gltf-transform/core';
import type { Document } from '@gltf-transform/core';
import validator from 'gltf-validator';
import { exportModel } from '../../www/export/file.ts';
import type { ExportedFile } from '../../www/export/file.ts';
import type { Model } from '../../www/export/model.ts';
import { FORMS, resolveOptions } from '../../www/export/options.ts';
import type { ExportOptions } from '../../www/export/options.ts';

/** A pyramid at (x, 0, 0), open below, as rocks are. */
const PYRAMID = { positions: [-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, 0, 0, 1], indices: [0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4] };

/** Two stones, then a thing of two parts, a stone of another group, and an ear. */
const GROUP_OF = [0, 0, 1, 1, 2, 3];

function modelOf(): Model {
  const count = GROUP_OF.length;
  const at = (k: number): number => 3 * k;
  const starts = (length: number): Uint32Array => Uint32Array.from({ length: count + 1 }, (_, k) => k * length);
  return {
    unit: 0.5,
    positions: Float32Array.from(GROUP_OF.flatMap((_, k) => PYRAMID.positions.map((value, axis) => value + (axis % 3 === 0 ? at(k) : 0)))),
    normals: Float32Array.from(GROUP_OF.flatMap(() => PYRAMID.positions.map((_, axis) => (axis % 3 === 2 ? 1 : 0)))),
    indices: Uint32Array.from(GROUP_OF.flatMap((_, k) => PYRAMID.indices.map((index) => index + 5 * k))),
    indexStarts: starts(PYRAMID.indices.length),
    vertexStarts: starts(5),
    groupOf: Uint8Array.from(GROUP_OF),
    groups: [
      { name: 'layer-1', noun: 'rock', isOpenBelow: true, extras: {} },
      { name: 'log', extras: { length: 2 } },
      { name: 'layer-2', noun: 'rock', isOpenBelow: true, extras: {} },
      { name: 'colony-1', noun: 'ear', isOpenBelow: true, extras: {} },
    ],
    materialOf: Uint8Array.of(0, 0, 1, 2, 0, 3),
    materials: ['stone', 'bark', 'end-grain', 'flesh'].map((name) => ({ name, color: [0.2, 0.2, 0.2] as const })),
    // The parts of the thing have one origin.
    origins: Float64Array.from(GROUP_OF.flatMap((_, k) => [at(k === 3 ? 2 : k), 0, 0])),
    centre: [0, 0, 0],
  };
}

const written = (options: ExportOptions): Promise<ExportedFile> =>
  exportModel(
    modelOf(),
    { title: 'test', link: 'v=1', hash: async () => '', hasPatterns: false, extrasOf: (k) => ({ k }) },
    resolveOptions(options),
  );
const read = ({ bytes }: ExportedFile): Promise<Document> => new WebIO().readBinary(bytes);

test('bodies are numbered by their noun through all groups, and what is one thing is one object with the name of its group', async () => {
  const root = (await read(await written({}))).getRoot();
  const tree = root
    .listScenes()[0]!
    .listChildren()
    .map((node) => [node.getName(), node.listChildren().map((child) => child.getName())]);
  assert.deepEqual(tree, [
    ['layer-1', ['rock-1', 'rock-2']],
    ['log', []],
    ['layer-2', ['rock-3']],
    ['colony-1', ['ear-1']],
  ]);
  const log = root.listNodes().find((node) => node.getName() === 'log')!;
  const materials = log
    .getMesh()!
    .listPrimitives()
    .map((primitive) => primitive.getMaterial()!.getName());
  assert.deepEqual([materials, log.getExtras(), log.getTranslation()], [['bark', 'end-grain'], { length: 2, k: 2 }, [3, 0, 0]]);
  const objects = new TextDecoder()
    .decode((await written({ format: 'obj' })).bytes)
    .split('\n')
    .filter((line) => /^(o|usemtl) /.test(line));
  assert.deepEqual(objects, [
    'o rock-1',
    'usemtl stone',
    'o rock-2',
    'o log',
    'usemtl bark',
    'usemtl end-grain',
    'o rock-3',
    'usemtl stone',
    'o ear-1',
    'usemtl flesh',
  ]);
});

test('a kit places what is one thing as it is, once', async () => {
  const root = (await read(await written({ mesh: 'kit', kinds: 1 }))).getRoot();
  const meshes = root.listMeshes().map((mesh) => mesh.getName());
  assert.deepEqual(meshes, ['rock-kind-1', 'log', 'rock-kind-2', 'ear-kind-1']);
  const log = root.listNodes().filter((node) => node.getMesh()?.getName() === 'log');
  assert.deepEqual(
    log.map((node) => [node.getName(), node.getTranslation(), node.getScale(), node.getMesh()!.listPrimitives().length]),
    [['log', [3, 0, 0], [1, 1, 1], 2]],
  );
  for (const instancing of [false, true]) {
    const { objects, triangles } = (await written({ mesh: 'kit', kinds: 1, instancing })).report;
    assert.deepEqual([objects, triangles], [5, 24]);
  }
});

test('what is one thing is not closed, and files with it are valid', async () => {
  for (const mesh of FORMS.glb!) {
    for (const solid of [false, true]) {
      for (const instancing of [false, true]) {
        const { bytes, report } = await written({ mesh, solid, instancing });
        const { issues } = await validator.validateBytes(bytes);
        assert.deepEqual([issues.numErrors, issues.numWarnings], [0, 0], `${mesh}, ${solid}, ${instancing}`);
        assert.equal(report.triangles, solid ? 4 * 8 + 2 * 4 : 6 * 4);
      }
    }
  }
});
