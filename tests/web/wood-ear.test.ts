// Wood ears of `rock-field/core` as a user of the package gets them: the built file, in Node, with the real wasm.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
// @ts-expect-error: the built package, not part of the sources
import { createWoodEarGenerator, growWoodEar, RockFieldError, woodEarPresets, woodEarSchema } from 'rock-field/core';
import type { WoodEarColony } from '../../www/colony.ts';
// @ts-expect-error: plain JavaScript
import { hashColony } from '../golden.mjs';

const golden = JSON.parse(readFileSync(new URL('../data/wood-ear-golden.json', import.meta.url), 'utf8')) as Record<string, string>;
const small = { density: 60, range: 26, log: { length: 60, radius: 9, spacing: 3, seed: 1 }, base: { position: [2, -6, 14] } };
/** A closed box, cm. */
const box = {
  positions: [0, 0, 0, 40, 0, 0, 40, 20, 0, 0, 20, 0, 0, 0, 20, 40, 0, 20, 40, 20, 20, 0, 20, 20],
  indices: [0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4, 2, 3, 7, 2, 7, 6, 1, 2, 6, 1, 6, 5, 3, 0, 4, 3, 4, 7],
};

test('every preset has its golden hash in Node', async () => {
  assert.deepEqual(Object.keys(golden), Object.keys(woodEarPresets));
  for (const preset of Object.keys(golden)) assert.equal(await hashColony(await growWoodEar({ preset })), golden[preset], preset);
});

test('a preset is a complete request, and cannot be changed', async () => {
  assert.equal(await hashColony(await growWoodEar(woodEarPresets['thesis-fig4-2'])), golden['thesis-fig4-2']);
  assert.throws(() => {
    woodEarPresets['fallen-log'].bases[0].range = 1;
  }, TypeError);
  assert.deepEqual(JSON.parse(JSON.stringify(woodEarSchema)), woodEarSchema);
  assert.deepEqual(Object.keys(woodEarSchema.properties).sort(), ['base', 'preset', ...Object.keys(woodEarPresets['thesis-default'])].sort());
});

test('the preview comes before the colony, which it equals but for collisions', async () => {
  let preview: WoodEarColony | undefined;
  const colony: WoodEarColony = await growWoodEar(small, { onPreview: (shown: WoodEarColony) => (preview = shown) });
  assert(preview);
  assert.equal(preview.positions.length, colony.positions.length);
  assert.notDeepEqual(preview.positions, colony.positions);
  assert.equal(preview.log, colony.log);
  const off: WoodEarColony = await growWoodEar({ ...small, collisions: 'off' });
  assert.deepEqual(preview.positions, off.positions);
  assert.equal(colony.stats.individuals, colony.vertexStarts.length - 1);
  assert.equal(colony.stats.triangles, colony.indices.length / 3);
});

test('every bad value is named, and the same generator goes on', async () => {
  const g = await createWoodEarGenerator();
  const before = await hashColony(await g.generate(small));
  const refused: [object, Record<string, unknown>, object?][] = [
    [{ colour: 'red' }, { name: 'UnknownKey', key: 'colour', value: 'red' }],
    [{ log: { width: 3 } }, { name: 'UnknownKey', key: 'width', value: 3 }],
    [{ bases: [{}, { size: 3 }] }, { name: 'UnknownKey', key: 'size', layer: 1 }],
    [{ density: NaN }, { name: 'OutOfRange', key: 'density', min: 0, max: 100 }],
    [{ density: 101 }, { name: 'OutOfRange', key: 'density', value: 101, min: 0, max: 100 }],
    [{ moisture: '50' }, { name: 'WrongType', key: 'moisture', value: '50' }],
    [{ seed: 1.5 }, { name: 'NotAnInteger', key: 'seed', value: 1.5 }],
    [{ collisions: 'maybe' }, { name: 'OutOfRange', key: 'collisions', value: 'maybe' }],
    [{ log: { length: -1 } }, { name: 'OutOfRange', key: 'logLength', value: -1 }],
    [{ log: 3 }, { name: 'WrongType', key: 'log', value: 3 }],
    [{ preset: 'none' }, { name: 'UnknownPreset', key: 'preset', value: 'none' }],
    [{ preset: 3 }, { name: 'WrongType', key: 'preset', value: 3 }],
    [{ base: { position: [0, 1e6, 0] } }, { name: 'OutOfRange', key: 'y', layer: 0, value: 1e6, min: -10000, max: 10000 }],
    [{ base: { position: [0, 0] } }, { name: 'WrongType', key: 'position', layer: 0 }],
    [{ base: { range: 5 } }, { name: 'OutOfRange', key: 'range', layer: 0, value: 5 }],
    [{ bases: [] }, { name: 'OutOfRange', key: 'bases', value: 0, min: 1, max: 16 }],
    [{ bases: Array(17).fill({}) }, { name: 'OutOfRange', key: 'bases', value: 17 }],
    [{ base: {}, bases: [{}] }, { name: 'MalformedRequest', key: 'base' }],
    [{ log: { positions: [0, 0], indices: [] } }, { name: 'LogNotInThrees', key: 'log' }],
    [{ log: { positions: box.positions, indices: [0, 1, 99] } }, { name: 'LogBadIndex', key: 'log' }],
    [{ log: { positions: box.positions, indices: [0, 1, -1] } }, { name: 'LogBadIndex', key: 'log', value: -1 }],
    [{ log: { positions: 'all', indices: [] } }, { name: 'WrongType', key: 'positions' }],
    [{}, { name: 'OverBudget', max: 1000 }, { maxBytes: 1000 }],
  ];
  for (const [request, wanted, options] of refused) {
    await assert.rejects(g.generate(request, options), (error: Error & Record<string, unknown>) => {
      assert(error instanceof RockFieldError);
      for (const [key, value] of Object.entries(wanted)) assert.deepEqual(error[key], value, `${JSON.stringify(request)?.slice(0, 60)}: ${error.name} ${key} (${error.message})`);
      return true;
    });
  }
  assert.equal(await hashColony(await g.generate(small)), before);
  g.dispose();
  await assert.rejects(g.generate(small));
});

test('a run can be aborted, and the next one is whole', async () => {
  const g = await createWoodEarGenerator();
  const before = await hashColony(await growWoodEar(small));
  const controller = new AbortController();
  const run = g.generate({ preset: 'thesis-maximum', collisions: 'thesis' }, { signal: controller.signal, onProgress: () => controller.abort() });
  await assert.rejects(run, { name: 'AbortError' });
  assert.equal(await hashColony(await g.generate(small)), before);
  g.dispose();
});

test('a log of the user carries the colony, and goes again', async () => {
  const g = await createWoodEarGenerator();
  const before = await hashColony(await g.generate(small));
  const log = { positions: Float32Array.from(box.positions), indices: Uint16Array.from(box.indices) };
  const colony: WoodEarColony = await g.generate({ density: 100, range: 200, log });
  assert(colony.stats.individuals > 0);
  const again: WoodEarColony = await g.generate({ density: 100, range: 200, log, moisture: 10 });
  assert.equal(again.stats.ms.log, 0);
  assert.equal(again.log, colony.log);
  assert.equal(await hashColony(await g.generate(small)), before);
  g.dispose();
});
