// What a file will be, reckoned before it is written: it decides what is refused.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { generate, presets } from 'rock-field/core';
import { estimateOf } from '../../www/export/estimate.ts';
import { exportModel, toldOf } from '../../www/export/file.ts';
import type { ExportedFile } from '../../www/export/file.ts';
import type { Model } from '../../www/export/model.ts';
import { resolveOptions } from '../../www/export/options.ts';
import { writtenOptions } from '../../www/export/origin/written-options.ts';
import type { ExportOptions } from '../../www/export/options.ts';
import { joined } from '../../www/export/shapes/join.ts';
import { kitOf } from '../../www/export/shapes/kit.ts';
import { rocksModel } from '../../www/rocks/export.ts';
import { resolveParams as resolveField } from '../../www/rocks/request.ts';

/** How far from 1 an estimate may be of the length of the file. */
const BORDER = 0.03;

const source = {
  title: 'rocks-7',
  link: `v1?${'radius=12&'.repeat(12)}`,
  hash: async () => 'f'.repeat(64),
  hasPatterns: false,
  extrasOf: (k: number) => ({ id: k + 1, layer: 1 }),
};

/** The file's length beside its estimate, whose counts have to be the report's. */
async function ratioOf(model: Model, given: ExportOptions, what: string): Promise<{ ratio: number; file: ExportedFile }> {
  const options = resolveOptions(given);
  const file = await exportModel(model, source, options);
  const kit = options.mesh === 'kit' ? await kitOf(model, options.kinds) : undefined;
  const { bytes, triangles, objects } = estimateOf({
    model,
    options,
    told: toldOf(model, source, 'f'.repeat(64), writtenOptions(options)),
    kit,
  });
  if (options.mesh !== 'points') assert.deepEqual([triangles, objects], [file.report.triangles, file.report.objects], what);
  return { ratio: bytes / file.bytes.length, file };
}

/** Two triangles under all rocks, which are one thing, as the ground is. */
const SHEET: Model = {
  unit: 1,
  positions: Float32Array.of(0, 0, 0, 400, 0, 0, 400, 300, 0, 0, 300, 0),
  normals: Float32Array.of(0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1),
  indices: Uint32Array.of(0, 1, 2, 2, 3, 0),
  indexStarts: Uint32Array.of(0, 6),
  vertexStarts: Uint32Array.of(0, 4),
  groupOf: Uint8Array.of(0),
  groups: [{ name: 'ground', extras: { size: [4, 0, 3] } }],
  materialOf: Uint8Array.of(0),
  materials: [{ name: 'soil', color: [0.2, 0.1, 0.1] }],
  origins: new Float64Array(3),
  centre: [0, 0, 0],
};

async function models(): Promise<[string, Model][]> {
  const all: [string, Model][] = [];
  for (const preset of Object.keys(presets) as (keyof typeof presets)[]) {
    const request = { preset, seed: 3, imageWidth: 160, imageHeight: 120 };
    const rocks = rocksModel(await generate(request), resolveField(request), 0.01, true);
    all.push([preset, joined(rocks, SHEET, [0, 0, 0])]);
  }
  return all;
}

const EXACT: ExportOptions[] = [
  { mesh: 'rocks' },
  { mesh: 'one' },
  { mesh: 'kit', kinds: 3 },
  { format: 'obj', mesh: 'rocks' },
  { format: 'obj', mesh: 'one', scale: 1000 },
  { format: 'stl' },
  { format: 'ply' },
  { mesh: 'kit', kinds: 3, instancing: true },
  { mesh: 'rocks', vertexColors: true },
];

const BOUNDS: ExportOptions[] = [
  { lods: 4, solid: true },
  { lods: 2, mesh: 'one' },
  { lods: 3, format: 'obj' },
  { lods: 2, mesh: 'kit', kinds: 3, hulls: 'godot' },
  { hulls: 'unreal' },
  { compress: true },
  { format: 'csv' },
  { format: 'ply', mesh: 'points' },
];

const all = await models();

test('what a file will be is known to 3 % before it is written, and what is counted exactly', async (t) => {
  let [least, most] = [1, 1];
  for (const [m, [name, model]] of all.entries()) {
    for (const [k, form] of EXACT.entries()) {
      const options = { ...form, solid: (m + k) % 2 === 0 };
      const what = `${name} with ${JSON.stringify(options)}`;
      const { ratio } = await ratioOf(model, options, what);
      [least, most] = [Math.min(least, ratio), Math.max(most, ratio)];
      if (options.format === 'stl' || options.format === 'ply') assert.equal(ratio, 1, what);
      else assert.ok(Math.abs(ratio - 1) < BORDER, `${what}: ${ratio}`);
    }
  }
  t.diagnostic(`${least.toFixed(4)} … ${most.toFixed(4)}`);
});

test('a file with levels of detail, hulls or compression is no larger than was said, nor one of points', async (t) => {
  for (const options of BOUNDS) {
    const ratios: number[] = [];
    for (const [name, model] of all.slice(0, 4)) {
      const what = `${name} with ${JSON.stringify(options)}`;
      const { ratio } = await ratioOf(model, options, what);
      ratios.push(ratio);
      assert.ok(ratio >= 1, `${what}: ${ratio}`);
    }
    t.diagnostic(`${JSON.stringify(options)}: ${Math.min(...ratios).toFixed(2)} … ${Math.max(...ratios).toFixed(2)}`);
  }
});
