// Points: the CSV and the PLY place a kit as the GLB of the same kit does, in the axes of every program.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { WebIO } from '@gltf-transform/core';
import { presets } from 'rock-field/core';
import { exportScene } from 'rock-field/export';
import type { ExportOptions } from 'rock-field/export';
import { OPTIONS, resolveOptions } from '../../www/export/options.ts';

const REQUEST = { preset: 'riverbed', seed: 7, imageWidth: 200, imageHeight: 150 } as const;

type Vector = [number, number, number];
type Matrix = [Vector, Vector, Vector];

async function csv(options: ExportOptions = {}): Promise<Record<string, string>[]> {
  const lines = new TextDecoder().decode((await exportScene(REQUEST, { format: 'csv', ...options })).bytes).split('\r\n');
  assert.equal(lines.pop(), '');
  const [names, ...rows] = lines.map((line) => line.split(','));
  return rows.map((row) => Object.fromEntries(names!.map((name, k) => [name, row[k]!])));
}

const numbers = (row: Record<string, string>, names: readonly string[]): number[] => names.map((name) => Number(row[name]));

/** Rotation after scale. */
function turned([x, y, z, w]: readonly number[], [sx, sy, sz]: readonly number[]): Matrix {
  return [
    [(1 - 2 * (y! * y! + z! * z!)) * sx!, 2 * (x! * y! - z! * w!) * sy!, 2 * (x! * z! + y! * w!) * sz!],
    [2 * (x! * y! + z! * w!) * sx!, (1 - 2 * (x! * x! + z! * z!)) * sy!, 2 * (y! * z! - x! * w!) * sz!],
    [2 * (x! * z! - y! * w!) * sx!, 2 * (y! * z! + x! * w!) * sy!, (1 - 2 * (x! * x! + y! * y!)) * sz!],
  ];
}

const times = (a: Matrix, b: Matrix): Matrix =>
  a.map((row) => [0, 1, 2].map((k) => row[0] * b[0][k]! + row[1] * b[1][k]! + row[2] * b[2][k]!)) as Matrix;
const transposed = (a: Matrix): Matrix => [0, 1, 2].map((k) => a.map((row) => row[k])) as Matrix;

function assertNear(found: readonly number[], expected: readonly number[], within: number, what: string): void {
  assert.ok(
    found.length === expected.length && found.every((value, k) => Math.abs(value - expected[k]!) <= within),
    `${what}: ${found} instead of ${expected}`,
  );
}

/** What the glTF importers of the programs do to a vector, before units. */
const IMPORTS: Record<(typeof OPTIONS.axes.choices)[number], { unit: number; axes: Matrix }> = {
  gltf: {
    unit: 1,
    axes: [
      [1, 0, 0],
      [0, 1, 0],
      [0, 0, 1],
    ],
  },
  blender: {
    unit: 1,
    axes: [
      [1, 0, 0],
      [0, 0, -1],
      [0, 1, 0],
    ],
  },
  unreal: {
    unit: 100,
    axes: [
      [1, 0, 0],
      [0, 0, 1],
      [0, 1, 0],
    ],
  },
  unity: {
    unit: 1,
    axes: [
      [-1, 0, 0],
      [0, 1, 0],
      [0, 0, 1],
    ],
  },
};

test('a point places a kind of the kit where the GLB of that kit has it, in the axes of each program', async () => {
  const { bytes } = await exportScene(REQUEST, { mesh: 'kit', kinds: 5 });
  const root = (await new WebIO().readBinary(bytes)).getRoot();
  const nodes = new Map(root.listNodes().map((node) => [node.getName(), node]));
  for (const axes of OPTIONS.axes.choices) {
    const { unit, axes: map } = IMPORTS[axes];
    const rows = await csv({ kinds: 5, axes });
    assert.equal(rows.length, root.listNodes().filter((node) => node.getMesh()).length);
    for (const row of rows) {
      const node = nodes.get(`rock-${row.id}`)!;
      assert.equal(node.getMesh()!.getName(), `rock-kind-${row.kind}`);
      assert.equal(node.getExtras().layer, Number(row.layer));
      assert.equal(node.getMesh()!.listPrimitives()[0]!.getMaterial()!.getName(), row.material);
      const place = map.map((line) => unit * line.reduce((sum, part, k) => sum + part * node.getTranslation()[k]!, 0));
      assertNear(numbers(row, ['x', 'y', 'z']), place, 2e-6 * unit, `${axes}, place of ${row.id}`);
      const expected = times(times(map, turned(node.getRotation(), node.getScale())), transposed(map));
      const found = turned(numbers(row, ['qx', 'qy', 'qz', 'qw']), numbers(row, ['sx', 'sy', 'sz']));
      assertNear(found.flat(), expected.flat(), 1e-5, `${axes}, turn of ${row.id}`);
    }
  }
});

test('length, width and height are those of the rock along its own axes', async () => {
  const root = (await new WebIO().readBinary((await exportScene(REQUEST)).bytes)).getRoot();
  const nodes = new Map(root.listNodes().map((node) => [node.getName(), node]));
  for (const row of await csv()) {
    const positions = nodes.get(`rock-${row.id}`)!.getMesh()!.listPrimitives()[0]!.getAttribute('POSITION')!;
    // Turned back, the box around the rock is as long as it says.
    const [x, y, z, w] = numbers(row, ['qx', 'qy', 'qz', 'qw']);
    const back = transposed(turned([x!, y!, z!, w!], [1, 1, 1]));
    const points = Array.from({ length: positions.getCount() }, (_, v) => {
      const point = positions.getElement<Vector>(v, [0, 0, 0]);
      return back.map((line) => line.reduce((sum, part, k) => sum + part * point[k]!, 0));
    });
    const span = (axis: number): number =>
      Math.max(...points.map((point) => point[axis]!)) - Math.min(...points.map((point) => point[axis]!));
    const height = Math.max(0, ...points.map((point) => point[1]!));
    assertNear(numbers(row, ['length', 'height', 'width']), [span(0), height, span(2)], 1e-5, `rock ${row.id}`);
  }
});

test('PLY has the points of the CSV', async () => {
  const rows = await csv({ axes: 'unreal' });
  const { bytes, report, name } = await exportScene(REQUEST, { format: 'ply', mesh: 'points', axes: 'unreal' });
  assert.deepEqual([name, report.objects, report.triangles], ['riverbed-7.ply', rows.length, 0]);
  const text = new TextDecoder('latin1').decode(bytes);
  const begin = text.indexOf('end_header\n') + 'end_header\n'.length;
  const properties = [...text.slice(0, begin).matchAll(/^property (float|int) (\w+)$/gm)].map(
    ([, type, property]) => [type, property!] as const,
  );
  assert.deepEqual(new Set(properties.map(([, property]) => property)), new Set(Object.keys(rows[0]!).filter((key) => key !== 'material')));
  assert.match(text.slice(0, begin), new RegExp(`^element vertex ${rows.length}$`, 'm'));
  const view = new DataView(bytes.buffer, begin);
  assert.equal(view.byteLength, rows.length * 4 * properties.length);
  rows.forEach((row, k) => {
    properties.forEach(([type, property], p) => {
      const at = 4 * (k * properties.length + p);
      const found = type === 'float' ? view.getFloat32(at, true) : view.getInt32(at, true);
      assert.ok(Math.abs(found - Number(row[property])) <= 1e-6 * Math.max(1, Math.abs(found)), `${property} of ${row.id}`);
    });
  });
});

test('a closed kit has the same kinds and places as an open one, so that its points are the same', async () => {
  const options = { kinds: 3 } as const;
  const root = (await new WebIO().readBinary((await exportScene(REQUEST, { ...options, mesh: 'kit', solid: true })).bytes)).getRoot();
  const nodes = new Map(root.listNodes().map((node) => [node.getName(), node]));
  for (const row of await csv(options)) {
    assert.equal(nodes.get(`rock-${row.id}`)!.getMesh()!.getName(), `rock-kind-${row.kind}`);
    assertNear(numbers(row, ['sx', 'sy', 'sz']), nodes.get(`rock-${row.id}`)!.getScale(), 1e-6, `scale of ${row.id}`);
  }
});

test('every preset has a point for each rock, and a field without rocks has none', async () => {
  for (const preset of Object.keys(presets) as (keyof typeof presets)[]) {
    const request = { preset, seed: 2, imageWidth: 80, imageHeight: 60 };
    const [points, rocks] = await Promise.all([exportScene(request, { format: 'csv' }), exportScene(request, { mesh: 'rocks' })]);
    assert.equal(points.report.objects, rocks.report.objects, preset);
    assert.doesNotMatch(new TextDecoder().decode(points.bytes), /NaN|Infinity/);
  }
  const { bytes } = await exportScene({ ...REQUEST, layers: [] }, { format: 'csv' });
  assert.equal(new TextDecoder().decode(bytes).split('\r\n').length, 2);
});

test('points are CSV or PLY, and other formats refuse them', () => {
  assert.equal(resolveOptions({ format: 'csv' }).mesh, 'points');
  assert.equal(resolveOptions({ target: 'unreal', format: 'csv' }).axes, 'unreal');
  assert.equal(resolveOptions({ format: 'ply' }).mesh, 'one');
  for (const options of [
    { format: 'glb', mesh: 'points' },
    { format: 'csv', mesh: 'rocks' },
  ] as const) {
    assert.throws(() => resolveOptions(options), { name: 'ExportImpossible', key: 'mesh', value: options.mesh });
  }
});
