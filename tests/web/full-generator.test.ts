// Two artefacts of one generator: the plain one for most fields, the full one for those that are painted.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { TestContext } from 'node:test';
import { createGenerator, generate, strokesToText } from 'rock-field/core';
import type { FieldRequest } from 'rock-field/core';
import { IDLE_MS } from '../../www/generator/pool.ts';
import { Realm } from '../../www/generator/headless.ts';
import { openGenerator } from '../../www/rocks/headless.ts';
import type { FullModule } from '../../www/rocks/full-session.ts';
import { GeneratorClient } from '../../www/rocks/client.ts';
import { PRESETS } from '../../www/rocks/params.ts';
import { flatRequest } from '../../www/rocks/request.ts';
import { buffersOf, fieldSession } from '../../www/rocks/session.ts';
import type { GeneratorModule, RawGenerator } from '../../www/rocks/session.ts';
import type { Field } from '../../www/data/field.ts';
import { CLIENT, FakeWorker, isAbort, isNamed, params, settle } from './fake-client.ts';

/** In the middle, erased. */
const STROKES = [{ mode: 'erase', width: 0.25, points: [0.5, 0.5] }] as const;
const PAINTED = { ...params(1), strokes: strokesToText(STROKES) };

function bytesOf(field: Field): Buffer {
  return Buffer.concat(buffersOf(field).map((buffer) => Buffer.from(buffer)));
}

test('the full generator gives the same bytes as the plain one for every preset', async () => {
  const full = await createGenerator();
  await full.generate({ imageWidth: 16, imageHeight: 16, strokes: STROKES });
  for (const { name } of PRESETS) {
    const request: FieldRequest = { preset: name, seed: 5, imageWidth: 150, imageHeight: 120 };
    assert.ok(bytesOf(await full.generate(request)).equals(bytesOf(await generate(request))), name);
  }
  full.dispose();
});

test('a generator that is asked for strokes in the midst of plain runs gives what others give at once', async () => {
  const request = { preset: 'journal-fig1', imageWidth: 200, imageHeight: 200 } as const;
  const painted = { ...request, strokes: STROKES };
  const [plainly, withStrokes] = [bytesOf(await generate(request)), bytesOf(await generate(painted))];
  assert.ok(!plainly.equals(withStrokes));
  const generator = await createGenerator();
  for (const turn of [0, 1]) {
    assert.ok(bytesOf(await generator.generate(request)).equals(plainly), `plain, ${turn}`);
    assert.ok(bytesOf(await generator.generate(painted)).equals(withStrokes), `painted, ${turn}`);
  }
  generator.dispose();
});

test('a plain generator refuses what is painted, and is none the worse for it', async () => {
  let starts = 0;
  const raw = {
    set_footprint: () => {},
    start: () => (starts += 1),
    step: () => true,
    stage: () => 4,
    summary: () => new Float64Array(4),
    ...Object.fromEntries(
      ['positions', 'normals', 'indices', 'rock_starts', 'vertex_starts', 'rock_layer'].map((name) => [name, () => new Float32Array()]),
    ),
  } as unknown as RawGenerator;
  const session = fieldSession(raw);
  await assert.rejects(session.run(flatRequest(PAINTED, 1e9)), isNamed('Internal'));
  assert.equal(starts, 0);
  await session.run(flatRequest(params(1), 1e9));
  assert.equal(starts, 1);
});

/** A module without a wasm, whose generators can do nothing but be freed. */
function moduleOf(freed: string[], name: string): () => Promise<FullModule & { default(): Promise<void> }> {
  class Generator {
    step = () => true;
    stage = () => 4;
    start = () => {};
    set_paint = () => {};
    summary = () => new Float64Array(4);
    positions = () => new Float32Array();
    normals = () => new Float32Array();
    indices = () => new Uint32Array();
    rock_starts = () => new Uint32Array();
    vertex_starts = () => new Uint32Array();
    rock_layer = () => new Uint8Array();
    free = () => freed.push(name);
  }
  const module = { Generator, fresh_seed: () => 1, memory_estimate: () => 1, default: async () => {} };
  return async () => module as unknown as FullModule & { default(): Promise<void> };
}

test('what was generated stays where the full generator cannot be had, and a wait for it can be given up', async () => {
  const freed: string[] = [];
  let asked = 0;
  let arrive: () => void = () => {};
  const plain = new Realm<GeneratorModule>(moduleOf(freed, 'plain'), () => new ArrayBuffer(0));
  const full = new Realm<FullModule>(moduleOf(freed, 'full'), async () => {
    asked += 1;
    if (asked === 1) throw new Error('no network');
    await new Promise<void>((resolve) => (arrive = resolve));
    return new ArrayBuffer(0);
  });
  const generator = await openGenerator({ plain, full });
  await generator.generate(params(1));
  assert.equal(asked, 0);
  await assert.rejects(generator.generate(PAINTED), isNamed('WasmUnavailable'));
  await generator.generate(params(2));
  assert.deepEqual(freed, []);
  const controller = new AbortController();
  const painted = generator.generate(PAINTED, { signal: controller.signal });
  await settle();
  controller.abort();
  await assert.rejects(painted, isAbort);
  const again = generator.generate(PAINTED);
  await settle();
  arrive();
  await again;
  assert.deepEqual(freed, ['plain']);
  generator.dispose();
});

/** Workers by the names of their scripts, in the order in which they were made. */
function withWorkers(t: TestContext): [string, FakeWorker][] {
  const made: [string, FakeWorker][] = [];
  const { Worker, origin } = globalThis;
  // That of the scripts here.
  globalThis.origin = 'null';
  globalThis.Worker = function (this: unknown, address: URL | string) {
    made.push([/[\w-]+(?=\.js)/.exec(String(address))?.[0] ?? String(address), new FakeWorker()]);
    return made.at(-1)![1];
  } as unknown as typeof globalThis.Worker;
  t.after(() => Object.assign(globalThis, { Worker, origin }));
  t.mock.timers.enable({ apis: ['setTimeout'] });
  return made;
}

test('a client changes over to the worker of the full generator when a run is painted, with all that waits, and stays there', async (t) => {
  const workers = withWorkers(t);
  const client = new GeneratorClient();
  const superseded = client.generate(params(1));
  const seed = client.freshSeed();
  const painted = client.generate(PAINTED);
  await assert.rejects(superseded, isAbort);
  assert.deepEqual(
    workers.map(([name]) => name),
    ['worker', 'full-worker'],
  );
  const [plain, full] = workers.map(([, worker]) => worker) as [FakeWorker, FakeWorker];
  assert.equal(plain.heard.at(-1)!.type, 'close');
  full.tells({ client: CLIENT, type: 'seed', id: 2, seed: 9 });
  assert.equal(await seed, 9);
  assert.equal(full.lastStart.request.strokes, PAINTED.strokes);
  full.finishes(full.lastStart.id);
  await painted;
  const later = client.generate(params(2));
  full.finishes(full.lastStart.id);
  await later;
  assert.equal(workers.length, 2);
  client.dispose();
  assert.equal(full.heard.at(-1)!.type, 'close');
  t.mock.timers.tick(IDLE_MS);
  assert.ok(plain.ended && full.ended);
});

test('a client whose full generator cannot be had says so, and does what is not painted with the plain one', async (t) => {
  const workers = withWorkers(t);
  const client = new GeneratorClient();
  const painted = client.generate(PAINTED);
  assert.deepEqual(
    workers.map(([name]) => name),
    ['full-worker'],
  );
  const error = { name: 'WasmUnavailable', message: 'generator-full_bg.wasm could not be fetched; check the connection' } as const;
  workers[0]![1].says({ type: 'failed', error });
  await assert.rejects(painted, isNamed('WasmUnavailable'));
  const plainly = client.generate(params(1));
  const [name, worker] = workers[1]!;
  assert.equal(name, 'worker');
  const { client: seat, id } = worker.lastStart;
  worker.tells({ client: seat, type: 'result', id, result: { stats: { rocks: 1 } } });
  await plainly;
  client.dispose();
  t.mock.timers.tick(IDLE_MS);
});
