// Wood ears of `rock-field/core` as a user of the package gets them: the built file, in Node, with the real wasm.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { createWoodEarGenerator, growWoodEar, RockFieldError, woodEarPresets, woodEarSchema } from 'rock-field/core';
import type { WoodEarColony, WoodEarPresetName, WoodEarRequest } from 'rock-field/core';
import { hashColony } from '../e2e/golden.mjs';

const golden = JSON.parse(readFileSync(new URL('../data/wood-ear-golden.json', import.meta.url), 'utf8')) as Record<
  WoodEarPresetName,
  string
>;
const small = {
  density: 60,
  range: 26,
  log: { length: 60, radius: 9, spacing: 3, seed: 1 },
  base: { position: [2, -6, 14] },
} satisfies WoodEarRequest;
/** A closed box, cm. */
const box = {
  positions: [0, 0, 0, 40, 0, 0, 40, 20, 0, 0, 20, 0, 0, 0, 20, 40, 0, 20, 40, 20, 20, 0, 20, 20],
  indices: [0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4, 2, 3, 7, 2, 7, 6, 1, 2, 6, 1, 6, 5, 3, 0, 4, 3, 4, 7],
};

test('every preset has its golden hash in Node', async () => {
  assert.deepEqual(Object.keys(golden), Object.keys(woodEarPresets));
  for (const preset of Object.keys(golden) as WoodEarPresetName[])
    assert.equal(await hashColony(await growWoodEar({ preset })), golden[preset], preset);
});

test('a preset is a complete request, and cannot be changed', async () => {
  assert.equal(await hashColony(await growWoodEar(woodEarPresets['thesis-fig4-2'])), golden['thesis-fig4-2']);
  assert.throws(() => {
    woodEarPresets['fallen-log'].bases[0].range = 1;
  }, TypeError);
  assert.deepEqual(JSON.parse(JSON.stringify(woodEarSchema)), woodEarSchema);
  assert.deepEqual(
    Object.keys(woodEarSchema.properties as object).sort(),
    ['base', 'preset', ...Object.keys(woodEarPresets['thesis-default'])].sort(),
  );
});

test('the preview comes before the colony, which it equals but for collisions', async () => {
  let preview: WoodEarColony | undefined;
  const colony = await growWoodEar(small, { onPreview: (shown) => (preview = shown) });
  assert(preview);
  assert.equal(preview.positions.length, colony.positions.length);
  assert.notDeepEqual(preview.positions, colony.positions);
  assert.equal(preview.log, colony.log);
  const off = await growWoodEar({ ...small, collisions: 'off' });
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
    [
      { base: {}, bases: [{}] },
      { name: 'MalformedRequest', key: 'base' },
    ],
    [{ log: { positions: [0, 0], indices: [] } }, { name: 'LogNotInThrees', key: 'log', value: 2 }],
    [{ log: { positions: box.positions, indices: [0, 1, 99] } }, { name: 'LogBadIndex', key: 'log', value: 99, min: 0, max: 7 }],
    [{ log: { positions: box.positions, indices: [0, 1, -1] } }, { name: 'LogBadIndex', key: 'log', value: -1, min: 0, max: 7 }],
    [{ log: { positions: box.positions, indices: [0, 1, 1.5] } }, { name: 'LogBadIndex', key: 'log', value: 1.5 }],
    [{ log: { positions: box.positions, indices: Float64Array.of(0, 1, 2 ** 32) } }, { name: 'LogBadIndex', key: 'log', value: 2 ** 32 }],
    [{ log: { positions: [0, NaN, 0], indices: [0, 0, 0] } }, { name: 'LogBadPosition', key: 'log', value: NaN, min: -10000, max: 10000 }],
    [
      { log: { positions: [0, 0, 0, 0, 0, 1e9], indices: [0, 0, 0] } },
      { name: 'LogBadPosition', key: 'log', value: 1e9, min: -10000, max: 10000 },
    ],
    [{ log: { positions: [0, 0, 0], indices: [0, 0, 0] } }, { name: 'LogNoArea', key: 'log' }],
    [
      { log: { positions: new Float32Array(600_003), indices: [0, 0, 0] } },
      { name: 'LogTooLarge', key: 'log', value: 200_001, max: 200_000 },
    ],
    [{ log: { positions: 'all', indices: [] } }, { name: 'WrongType', key: 'positions' }],
    [{ log: { positions: { length: 3 }, indices: [] } }, { name: 'WrongType', key: 'positions' }],
    [{ log: { positions: new DataView(new ArrayBuffer(12)), indices: [] } }, { name: 'WrongType', key: 'positions' }],
    [{ log: { positions: BigInt64Array.of(1n, 2n, 3n), indices: [] } }, { name: 'WrongType', key: 'positions' }],
    [{ log: { ...box, spacing: 0.1 } }, { name: 'OutOfRange', key: 'logSpacing', value: 0.1, min: 1.5, max: 6 }],
    [{}, { name: 'OverBudget', max: 1000 }, { maxBytes: 1000 }],
  ];
  for (const [request, wanted, options] of refused) {
    await assert.rejects(g.generate(request, options), (error: Error & Record<string, unknown>) => {
      assert(error instanceof RockFieldError);
      for (const [key, value] of Object.entries(wanted))
        assert.deepEqual(error[key], value, `${Object.keys(request).join()}: ${error.name} ${key} (${error.message})`);
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
  const run = g.generate(
    { preset: 'thesis-maximum', collisions: 'thesis' },
    { signal: controller.signal, onProgress: () => controller.abort() },
  );
  await assert.rejects(run, { name: 'AbortError' });
  assert.equal(await hashColony(await g.generate(small)), before);
  g.dispose();
});

test('a log of the user carries the colony, and goes again', async () => {
  const g = await createWoodEarGenerator();
  const before = await hashColony(await g.generate(small));
  const log = { positions: Float32Array.from(box.positions), indices: Uint16Array.from(box.indices) };
  const colony = await g.generate({ density: 100, range: 200, log });
  assert(colony.stats.individuals > 0);
  const again = await g.generate({ density: 100, range: 200, log, moisture: 10 });
  assert.equal(again.stats.ms.log, 0);
  assert.equal(again.log, colony.log);
  assert.equal(await hashColony(await g.generate(small)), before);
  g.dispose();
});

test('numbers of a log are taken from every array of them', async () => {
  const hashes = [];
  for (const positions of [
    box.positions,
    Float32Array.from(box.positions),
    Float64Array.from(box.positions),
    Int16Array.from(box.positions),
    Uint8Array.from(box.positions),
  ]) {
    for (const indices of [
      box.indices,
      Uint8Array.from(box.indices),
      Uint16Array.from(box.indices),
      Uint32Array.from(box.indices),
      Int32Array.from(box.indices),
      Float32Array.from(box.indices),
    ]) {
      hashes.push(await hashColony(await growWoodEar({ density: 60, range: 20, log: { positions, indices } })));
    }
  }
  assert.equal(new Set(hashes).size, 1);
});

test('feet on a log of one’s own are as dense as asked for, and each is told by a triangle of what was passed', async () => {
  for (const spacing of [2, 3, 6]) {
    const colony = await growWoodEar({ density: 100, range: 200, collisions: 'off', log: { ...box, spacing } });
    const expected = 4000 / (Math.sqrt(0.75) * spacing ** 2);
    assert.ok(Math.abs(colony.foot.length / expected - 1) < 0.01, `${colony.foot.length} instead of ${expected}`);
    assert.ok(colony.foot.every((triangle) => triangle < box.indices.length / 3));
    assert.ok(new Set(colony.foot).size === box.indices.length / 3);
  }
});

test('a log in other units is scaled, one that is inside out is turned, and the result tells both', async () => {
  const insideOut = box.indices.map((_, k) => box.indices[k + [0, 1, -1][k % 3]!]!);
  const request: WoodEarRequest = { density: 100, range: 200, collisions: 'off' };
  const plain = await growWoodEar({ ...request, log: box });
  assert.deepEqual([plain.log.turned, plain.log.scale], [false, 1]);
  for (const [unit, scale] of [
    [0.01, 500],
    [0.4, 12.5],
    [100, 0.05],
    [1e-9, 5e9],
    [1e5, 5e-5],
  ] as const) {
    const colony = await growWoodEar({
      ...request,
      log: { positions: box.positions.map((value) => value * unit), indices: insideOut },
    });
    assert.equal(colony.log.turned, true);
    assert.ok(Math.abs(colony.log.scale / scale - 1) < 1e-6, `${colony.log.scale} instead of ${scale}`);
    const xs = colony.log.positions.filter((_, k) => k % 3 === 0);
    assert.ok(Math.abs(Math.max(...xs) - Math.min(...xs) - 200) < 1e-3);
    assert.equal(colony.stats.individuals > 0, true);
  }
  // A vertex that no triangle uses has no say.
  const colony = await growWoodEar({ ...request, log: { ...box, positions: [...box.positions, 5000, 0, 0] } });
  assert.equal(colony.log.scale, 1);
  const made = await growWoodEar(small);
  assert.deepEqual([made.log.turned, made.log.scale], [false, 1]);
});

test('what is not counted yet is absent, and nothing is told that nobody counts', async () => {
  let preview: WoodEarColony | undefined;
  const colony = await growWoodEar(small, { onPreview: (shown) => (preview = shown) });
  assert.ok(preview && !('crossingPairs' in preview.stats));
  assert.equal(typeof colony.stats.crossingPairs, 'number');
  assert.deepEqual(Object.keys(colony.stats).sort(), [
    'crossingPairs',
    'individuals',
    'keptMedian',
    'keptP10',
    'ms',
    'rounds',
    'sweeps',
    'triangles',
  ]);
  assert.deepEqual(Object.keys(colony.stats.ms).sort(), ['collide', 'deform', 'log', 'mesh', 'spawn', 'total']);
});

test('a run that takes minutes says so within its first seconds, and can be cancelled there', async () => {
  const controller = new AbortController();
  let told: number | undefined;
  const run = growWoodEar(
    { preset: 'thesis-maximum', collisions: 'thesis', log: { length: 400, spacing: 1.5 } },
    {
      signal: controller.signal,
      onProgress: ({ stage, secondsLeft }) => {
        if (stage !== 'collide' || secondsLeft === undefined) return;
        told = secondsLeft;
        controller.abort();
      },
    },
  );
  await assert.rejects(run, { name: 'AbortError' });
  assert.ok(told! > 5, `${told}`);
});
