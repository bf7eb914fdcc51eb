// `rock-field/core` as a user of the package gets it: the built file, in Node, with the real wasm.
import assert from 'node:assert/strict';
import { createHash } from 'node:crypto';
import { test } from 'node:test';
import { createGenerator, generate, presets, RockFieldError, schema } from 'rock-field/core';
import type { FieldRequest, Triple } from 'rock-field/core';
import type { Field } from '../../www/data/field.ts';
import { buffersOf } from '../../www/rocks/session.ts';
import { PRESETS } from '../../www/rocks/params.ts';
import { presetParams } from '../../www/rocks/request.ts';

/** The parts of a JSON Schema that are looked at here. */
interface Schema {
  properties: Record<string, Schema>;
  items: Schema;
  minimum?: number;
}

function hashOf(field: Field): string {
  const hash = createHash('sha256');
  for (const buffer of buffersOf(field)) hash.update(new Uint8Array(buffer));
  return hash.digest('hex');
}

/** Every offset list is monotone, every index is in its range, every number is finite. */
function checkField(field: Field): void {
  const rocks = field.rockLayer.length;
  const vertices = field.positions.length / 3;
  assert.equal(field.stats.rocks, rocks);
  assert.equal(field.stats.triangles, field.indices.length / 3);
  assert.equal(field.normals.length, field.positions.length);
  assert.equal(field.rockStarts.length, rocks + 1);
  assert.equal(field.vertexStarts.length, rocks + 1);
  assert.equal(field.rockStarts.at(-1), field.indices.length);
  assert.equal(field.vertexStarts.at(-1), vertices);
  assert(field.positions.every(Number.isFinite) && field.normals.every(Number.isFinite));
  for (let k = 0; k < rocks; k += 1) {
    const own = field.indices.subarray(field.rockStarts[k], field.rockStarts[k + 1]);
    const [from, to] = [field.vertexStarts[k]!, field.vertexStarts[k + 1]!];
    assert(
      own.every((index) => index >= from && index < to),
      `rock ${k} uses another's vertices`,
    );
    const n = (to - from) / 2;
    assert.equal(own.length, 3 * (3 * n - 2));
  }
  const selected = field.layers.reduce((sum, layer) => sum + layer.selected.length, 0);
  assert.equal(selected, rocks);
  for (const layer of field.layers) {
    const cells = layer.sites.length / 2;
    assert.equal(layer.cellStarts.length, cells + 1);
    assert.equal(layer.cellVertices.length / 2, layer.cellStarts.at(-1));
    assert(layer.selected.every((site) => site < cells));
  }
}

test('Fig. 1 has some 3,100 rocks of some 49,000 triangles that cover 84 % of the ground', async () => {
  const field = await generate({ preset: 'journal-fig1', seed: 42 });
  checkField(field);
  assert(Math.abs(field.stats.rocks - 3100) < 5 * 36, `${field.stats.rocks} rocks`);
  assert(Math.abs(field.stats.triangles - 48_938) < 5 * 577, `${field.stats.triangles} triangles`);
  assert(Math.abs(field.stats.coveredFraction - 0.84) < 5 * 0.0023, `${field.stats.coveredFraction} covered`);
  assert.deepEqual(
    field.layers.map(({ id, radius, targetSites }) => [id, radius, targetSites]),
    [
      [0, 90, 115],
      [1, 30, 1038],
      [2, 10, 9345],
    ],
  );
  assert.deepEqual(
    field.layers.map(({ saturated }) => saturated),
    [false, false, true],
  );
  const { total, ...stages } = field.stats.ms;
  for (const [stage, ms] of Object.entries(stages)) assert(ms > 0, `${stage} took no time`);
  assert(total >= Object.values(stages).reduce((a, b) => a + b, 0));
});

test('the same request gives the same bytes, whatever ran before it', async () => {
  const request: FieldRequest = { preset: 'journal-fig12a', seed: 3, imageWidth: 400, imageHeight: 300 };
  const once = hashOf(await generate(request));
  const g = await createGenerator();
  await g.generate({ preset: 'conference-fig1', seed: 3, imageWidth: 200, imageHeight: 200 });
  assert.equal(hashOf(await g.generate(request)), once);
  assert.notEqual(hashOf(await g.generate({ ...request, seed: 4 })), once);
  assert.equal(hashOf(await g.generate(request)), once);
  g.dispose();
});

test('an edit re-runs from the first stage it touches: the times of the stages before it are 0', async () => {
  const g = await createGenerator();
  const { layers } = presets['journal-fig1'];
  await g.generate({ seed: 1 });
  const { stats } = await g.generate({
    seed: 1,
    layers: layers.map((layer) => ({ ...layer, height: layer.height.map((h) => h * 1.25) as Triple })),
  });
  assert.deepEqual([stats.ms.sites, stats.ms.cells, stats.ms.selection, stats.ms.shape], [0, 0, 0, 0]);
  assert(stats.ms.mesh > 0);
  g.dispose();
});

test('a refused request has a name, a key, the value and the bounds, and changes nothing', async () => {
  const g = await createGenerator();
  const before = hashOf(await g.generate({ imageWidth: 200, imageHeight: 200 }));
  const refused: [object, object, Record<string, unknown>][] = [
    [{ packing: 1.5 }, {}, { name: 'OutOfRange', key: 'packing', value: 1.5, min: 0, max: 1 }],
    [{ imageWidth: 12.5 }, {}, { name: 'NotAnInteger', key: 'imageWidth', value: 12.5 }],
    [{ layers: [{ radius: NaN }] }, {}, { name: 'OutOfRange', key: 'radius', layer: 0, min: 1, max: 8192 }],
    [{ colour: 'red' }, {}, { name: 'UnknownKey', key: 'colour', value: 'red' }],
    [{ preset: '<b>' }, {}, { name: 'UnknownPreset', key: 'preset', value: '<b>' }],
    [{ imageWidth: 8192, imageHeight: 8192 }, { maxBytes: 2 ** 20 }, { name: 'OverBudget', max: 2 ** 20 }],
  ];
  for (const [request, options, wanted] of refused) {
    await assert.rejects(g.generate(request, options), (error: Error & Record<string, unknown>) => {
      assert(error instanceof RockFieldError);
      for (const [key, value] of Object.entries(wanted)) assert.deepEqual(error[key], value, `${error.name}.${key}`);
      return true;
    });
  }
  const again = await g.generate({ imageWidth: 200, imageHeight: 200 });
  assert.equal(hashOf(again), before);
  assert.equal(again.stats.ms.sites, 0);
  g.dispose();
});

test('Fig. 1 at 8192 × 8192 fits the default budget, and the estimate says so before anything is done', async () => {
  const g = await createGenerator();
  const bytes = g.memoryEstimate({ imageWidth: 8192, imageHeight: 8192 });
  assert(bytes > 2 ** 26 && bytes < 1.5 * 2 ** 30, `${bytes} bytes`);
  g.dispose();
});

test('degenerate requests have a field', async () => {
  const g = await createGenerator();
  const requests: FieldRequest[] = [
    { layers: [] },
    { imageWidth: 1, imageHeight: 1 },
    { imageWidth: 300, imageHeight: 1 },
    { imageWidth: 64, imageHeight: 64, layers: [{ radius: 8192 }] },
    { imageWidth: 64, imageHeight: 64, layers: [{ radius: 1 }] },
    { imageWidth: 64, imageHeight: 64, layers: [{ areaFraction: 0 }] },
    {
      imageWidth: 64,
      imageHeight: 64,
      layers: [
        { radius: 5, areaFraction: 1 },
        { radius: 5, areaFraction: 1 },
      ],
    },
    { imageWidth: 64, imageHeight: 64, layers: [{ radius: 9, taper: [-500, -500, -500] }] },
  ];
  for (const request of requests) checkField(await g.generate(request));
  g.dispose();
});

test('a run can be aborted between slices, tells its progress, and the next one is whole', async () => {
  const g = await createGenerator();
  const controller = new AbortController();
  const fractions: number[] = [];
  const run = g.generate(
    { imageWidth: 4096, imageHeight: 4096, seed: 9 },
    {
      signal: controller.signal,
      onProgress: ({ fraction }) => {
        fractions.push(fraction);
        if (fractions.length === 3) controller.abort();
      },
    },
  );
  await assert.rejects(run, { name: 'AbortError' });
  assert.equal(fractions.length, 3);
  assert.deepEqual(
    fractions,
    [...fractions].sort((a, b) => a - b),
  );
  checkField(await g.generate({ imageWidth: 300, imageHeight: 200 }));
  g.dispose();
});

test('calls made at once are all answered, in turn, each with its own field', async () => {
  const g = await createGenerator();
  const side = (n: number) => ({ imageWidth: 100 * n, imageHeight: 100 });
  const fields = await Promise.all([
    g.generate(side(1)),
    g.generate({ seed: -1 }).catch(() => null),
    g.generate(side(2)),
    g.generate(side(3)),
  ]);
  assert.deepEqual(
    fields.map((field) => field?.imageWidth),
    [100, undefined, 200, 300],
  );
  g.dispose();
});

test('a disposed generator refuses, others go on, and disposing twice is nothing', async () => {
  const [a, b] = [await createGenerator(), await createGenerator()];
  const last = a.generate({ imageWidth: 100, imageHeight: 100 });
  a.dispose();
  a.dispose();
  await last.catch(() => {});
  await assert.rejects(a.generate({ imageWidth: 100, imageHeight: 100 }));
  checkField(await b.generate({ imageWidth: 100, imageHeight: 100 }));
  b.dispose();
});

test('fresh seeds are whole, in range and not always the same', async () => {
  const g = await createGenerator();
  const seeds = Array.from({ length: 8 }, () => g.freshSeed());
  assert(seeds.every((seed) => Number.isInteger(seed) && seed >= 0 && seed <= 0xffff_ffff));
  assert(new Set(seeds).size > 1);
  g.dispose();
});

test('presets are complete requests and cannot be changed', async () => {
  assert.deepEqual(
    Object.keys(presets),
    PRESETS.map(({ name }) => name),
  );
  for (const [name, params] of Object.entries(presets)) assert.deepEqual(params, presetParams(name));
  assert.throws(() => {
    presets['journal-fig1'].layers[0].radius = 1;
  }, TypeError);
  checkField(await generate({ ...presets['conference-fig1'], imageWidth: 200, imageHeight: 200 }));
});

test('the schema is plain JSON and has a property for every key of a request', () => {
  assert.deepEqual(JSON.parse(JSON.stringify(schema)), schema);
  const { properties, then: relative, else: px } = schema as unknown as Schema & Record<'then' | 'else', Schema>;
  assert.deepEqual(Object.keys(properties), ['preset', ...Object.keys(presetParams('journal-fig1')), 'strokes']);
  for (const [branch, name, least] of [
    [relative, 'conference-fig1', 0.01],
    [px, 'journal-fig1', 1],
  ] as const) {
    const layer = branch.properties.layers.items.properties;
    assert.deepEqual(Object.keys(layer).sort(), Object.keys(presetParams(name).layers[0]!).sort());
    assert.equal(layer.radius.minimum, least);
  }
});
