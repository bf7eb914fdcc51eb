// The worker's side: the host, its run loops and their sessions, over a generator that does nothing but let a clock go on.
import assert from 'node:assert/strict';
import { beforeEach, mock, test } from 'node:test';
import { RockFieldError } from '../../www/base/errors.ts';
import type { Field } from '../../www/data/field.ts';
import { LoopHost } from '../../www/generator/host.ts';
import { PATIENCE_MS, PROGRESS_AFTER_MS, RunLoop } from '../../www/generator/loop.ts';
import type { FlatRequest, FromWorker } from '../../www/generator/protocol.ts';
import { FIELD_LOOPS, fieldSession } from '../../www/rocks/session.ts';
import type { GeneratorModule, RawGenerator } from '../../www/rocks/session.ts';
import { SLICE_MS } from '../../www/generator/session.ts';

const STEP_MS = 2;

// Time passes in steps alone, so that nothing here depends on how busy the machine is.
let now = 0;
let script: { at: number; act: () => void }[] = [];

mock.method(performance, 'now', () => now);
beforeEach(() => {
  now = 1000;
  script = [];
});

/** Does something `ms` from now, as a message would arrive: in a task of its own, when the loop next lets one in. */
function after(ms: number, act: () => void): void {
  script.push({ at: now + ms, act });
  script.sort((a, b) => a.at - b.at);
}

/** Takes `params[1]` steps of 2 ms; `params[0]` says how to misbehave. */
class FakeGenerator {
  static all: FakeGenerator[] = [];
  started: number[] = [];
  freed = 0;
  #left = 0;
  #steps = 1;
  #mode = 0;

  constructor() {
    FakeGenerator.all.push(this);
  }

  start(params: Float64Array, maxBytes: number): void {
    if (maxBytes < 100)
      throw Object.assign(new Error('too much'), { name: 'OverBudget', key: 'imageWidth', value: 200, min: 0, max: maxBytes });
    this.started.push(params[0]!);
    this.#mode = params[0]!;
    this.#left = params[1]!;
    this.#steps = params[1]!;
  }

  step(): boolean {
    if (this.#mode === TRAP) throw new WebAssembly.RuntimeError('unreachable');
    now += STEP_MS;
    while (script[0] && script[0].at <= now) setImmediate(script.shift()!.act);
    this.#left -= 1;
    return this.#left <= 0;
  }

  stage = () => Math.floor(((this.#steps - this.#left) * 5) / this.#steps);
  progress = () => 1 - this.#left / this.#steps;
  summary = () => Float64Array.of(3, 30, 0.5, 1);
  layer_summary = () => Float64Array.of(4, 30, 100, 1, 0.5, 0.4, 0);
  positions = () => new Float32Array(3);
  normals = () => new Float32Array(3);
  indices = () => new Uint32Array(3);
  rock_starts = () => new Uint32Array(2);
  vertex_starts = () => new Uint32Array(2);
  rock_layer = () => new Uint8Array(1);
  layer_sites = () => new Float32Array(2);
  layer_cell_starts = () => new Uint32Array(2);
  layer_cell_vertices = () => new Float32Array(6);
  layer_selected = () => new Uint32Array(1);
  free = () => {
    this.freed += 1;
  };
}

const TRAP = 666;

function request(mode: number, steps: number, maxBytes = 1000): FlatRequest {
  return { params: Float64Array.of(mode, steps), imageWidth: steps, imageHeight: 1, maxBytes };
}

function setUp(
  load: () => Promise<GeneratorModule> = async () => ({ Generator: FakeGenerator, fresh_seed: () => 7 }) as unknown as GeneratorModule,
) {
  const said: (FromWorker & { at: number })[] = [];
  const waiting: { wanted: (message: FromWorker) => boolean; resolve: (message: FromWorker) => void }[] = [];
  const host = new LoopHost(
    load,
    (module, post) => new RunLoop(module, FIELD_LOOPS, post),
    (message) => {
      said.push({ ...message, at: now });
      for (const { wanted, resolve } of waiting) if (wanted(message)) resolve(message);
    },
  );
  const until = (wanted: (message: FromWorker) => boolean) => {
    const found = said.find(wanted);
    return found ? Promise.resolve(found as FromWorker) : new Promise<FromWorker>((resolve) => waiting.push({ wanted, resolve }));
  };
  const answer = (id: number, client = 1) =>
    until((message) => 'id' in message && message.id === id && message.client === client && message.type !== 'progress');
  const start = (id: number, flat: FlatRequest, client = 1) => host.receive({ type: 'start', client, id, request: flat });
  const times = (type: FromWorker['type']) => said.filter((message) => message.type === type).map(({ at }) => at - 1000);
  return { host, said, until, answer, start, times };
}

test('a run is answered with all its buffers and the time of each stage', async () => {
  const { start, answer } = setUp();
  start(1, request(1, 20));
  const message = await answer(1);
  assert(message.type === 'result');
  const field = message.result as Field;
  assert.deepEqual(
    [field.imageWidth, field.layers.length, field.layers[0]!.id, field.layers[0]!.sitesSaturated, field.layers[0]!.saturated],
    [20, 1, 4, true, false],
  );
  assert.deepEqual(field.stats.ms, { sites: 8, cells: 8, selection: 8, shape: 8, mesh: 8, total: 40 });
});

test('the script says that it runs before it has its wasm, and answers pings with the number of messages it has heard', async () => {
  const { host, said } = setUp(() => new Promise(() => {}));
  host.receive({ type: 'start', client: 1, id: 1, request: request(1, 1) });
  host.receive({ type: 'ping' });
  assert.deepEqual(
    said.map(({ at: _, ...message }) => message),
    [{ type: 'started' }, { type: 'pong', heard: 2 }],
  );
});

test('messages are read between slices of bounded length', async () => {
  const { host, start, answer, times } = setUp();
  for (let ms = 0; ms < 200; ms += 10) after(ms, () => host.receive({ type: 'ping' }));
  start(1, request(1, 100));
  await answer(1);
  const read = times('pong');
  assert(read.length >= 19, `${read.length} of 20 messages were read`);
  read.forEach((at, index) => assert(at - 10 * index <= SLICE_MS + STEP_MS, `read ${at - 10 * index} ms late`));
});

test('progress is told for runs of more than 200 ms, and not for shorter ones', async () => {
  const { start, answer, said, times } = setUp();
  start(1, request(1, (PROGRESS_AFTER_MS - 1) / STEP_MS));
  await answer(1);
  assert.deepEqual(times('progress'), []);

  const begin = now - 1000;
  start(2, request(1, 250));
  await answer(2);
  const reports = times('progress').map((at) => at - begin);
  assert(reports[0]! >= PROGRESS_AFTER_MS && reports[0]! < PROGRESS_AFTER_MS + 20, `the first after ${reports[0]} ms`);
  assert(reports.length >= 4 && reports.length <= 6, `${reports.length} reports in 300 ms`);
  const fractions = said.filter((message) => message.type === 'progress').map(({ progress }) => progress.fraction);
  assert.deepEqual(
    fractions,
    [...fractions].sort((a, b) => a - b),
  );
});

test('a superseded run that ends soon is delivered, then the newest runs; those between never start', async () => {
  const { start, answer, said } = setUp();
  start(1, request(1, 40));
  after(20, () => start(2, request(2, 10)));
  after(30, () => start(3, request(3, 10)));
  await answer(3);
  assert.deepEqual(
    said.filter(({ type }) => type !== 'started' && type !== 'ready').map((message) => [message.type, 'id' in message && message.id]),
    [
      ['dropped', 2],
      ['result', 1],
      ['result', 3],
    ],
  );
});

test('a superseded run that goes on is dropped when patience ends', async () => {
  const { start, answer, times } = setUp();
  start(1, request(1, 5000));
  after(20, () => start(2, request(2, 5)));
  await answer(2);
  const [dropped] = times('dropped');
  assert(dropped! >= PATIENCE_MS && dropped! <= PATIENCE_MS + SLICE_MS + STEP_MS, `dropped after ${dropped} ms`);
  assert.equal(times('result').length, 1);
});

test('a run older than that is dropped at once', async () => {
  const { start, answer, times } = setUp();
  start(1, request(1, 5000));
  after(PATIENCE_MS + 100, () => start(2, request(2, 5)));
  await answer(2);
  assert(times('dropped')[0]! <= PATIENCE_MS + 100 + SLICE_MS + STEP_MS);
});

test('a drag faster than its runs is never starved, whatever a run costs', async () => {
  for (const cost of [100, 500, 3000]) {
    const { start, until, times, said } = setUp();
    const length = 12 * cost;
    let id = 0;
    const edit = () => {
      id += 1;
      start(id, request(id, cost / STEP_MS));
      if (now - begin < length) after(16, edit);
    };
    const begin = now;
    edit();
    await until((message) => message.type === 'result' && message.id === id && now - begin >= length);
    const shown = times('result').map((at) => at + 1000 - begin);
    // Doubling wastes less than twice what the run that ends takes; then the newest request is the next to run.
    let last = 0;
    for (const at of shown) {
      assert(at - last <= 4 * cost, `nothing was shown for ${at - last} ms when a run takes ${cost} ms`);
      last = at;
    }
    const ids = said.flatMap((message) => (message.type === 'result' ? [message.id] : []));
    assert.deepEqual(
      ids,
      [...ids].sort((a, b) => a - b),
    );
  }
});

test('a cancelled run is dropped at once, and its generator with the finished stages stays', async () => {
  const made = FakeGenerator.all.length;
  const { host, start, answer, times } = setUp();
  start(1, request(1, 5000));
  after(30, () => host.receive({ type: 'cancel', client: 1, id: 1 }));
  assert.equal((await answer(1)).type, 'dropped');
  assert(times('dropped')[0]! <= 30 + SLICE_MS + STEP_MS);
  start(2, request(2, 2));
  assert.equal((await answer(2)).type, 'result');
  assert.equal(FakeGenerator.all.length, made + 1, 'the cache was thrown away');
});

test('a request that waits can be cancelled, and cancelling what is answered does nothing', async () => {
  const { host, start, answer, said } = setUp();
  start(1, request(1, 40));
  after(20, () => start(2, request(2, 20)));
  after(21, () => host.receive({ type: 'cancel', client: 1, id: 2 }));
  assert.equal((await answer(2)).type, 'dropped');
  assert.equal((await answer(1)).type, 'result');
  const count = said.length;
  host.receive({ type: 'cancel', client: 1, id: 1 });
  await new Promise((resolve) => setImmediate(resolve));
  assert.equal(said.length, count);
});

test('a refused request is told with its key and bounds, and the next one runs', async () => {
  const { start, answer } = setUp();
  start(1, request(1, 10, 50));
  const message = await answer(1);
  assert(message.type === 'rejected');
  assert.deepEqual(
    { ...message.error },
    { name: 'OverBudget', message: 'too much', key: 'imageWidth', layer: undefined, value: 200, min: 0, max: 50, words: undefined },
  );
  start(2, request(2, 2));
  assert.equal((await answer(2)).type, 'result');
});

test('a trap is told as a crash, and the instance is not used again', async () => {
  const { start, answer } = setUp();
  start(1, request(TRAP, 10));
  const message = await answer(1);
  assert(message.type === 'crashed');
  assert.equal(message.error.name, 'Internal');
  assert.match(message.error.message, /unreachable/);
  start(2, request(2, 2));
  assert.equal((await answer(2)).type, 'crashed');
});

test('wasm that cannot be had answers every request', async () => {
  const { start, until, answer } = setUp(() => Promise.reject(new RockFieldError({ name: 'WasmUnavailable', message: 'no wasm' })));
  start(1, request(1, 2));
  const failed = await until(({ type }) => type === 'failed');
  assert(failed.type === 'failed' && failed.error.name === 'WasmUnavailable');
  const message = await answer(1);
  assert(message.type === 'rejected' || message.type === 'crashed');
});

test('a seed is drawn while a run goes on', async () => {
  const { host, start, answer } = setUp();
  start(1, request(1, 100));
  host.receive({ type: 'seed', client: 1, id: 2 });
  assert.deepEqual(await answer(2).then((message) => message.type === 'seed' && message.seed), 7);
  host.receive({ type: 'cancel', client: 1, id: 1 });
});

test('a session runs one thing at a time and frees its generator once', async () => {
  const generator = new FakeGenerator();
  const session = fieldSession(generator as unknown as RawGenerator);
  const run = session.run(request(1, 20));
  await assert.rejects(session.run(request(1, 1)), /running already/);
  await run;
  const reason = new Error('before it began');
  await assert.rejects(session.run(request(1, 1), { signal: AbortSignal.abort(reason) }), reason);
  assert.deepEqual(generator.started, [1]);
  session.free();
  session.free();
  assert.equal(generator.freed, 1);
  await assert.rejects(session.run(request(1, 1)), RockFieldError);
});

/** Lets other tasks have their turns, until `isSo`, or as many as bring everything that waits to its end. */
async function rest(isSo = () => false): Promise<void> {
  for (let turn = 0; turn < 10_000 && !isSo(); turn += 1) await new Promise((resolve) => setImmediate(resolve));
}

test('the wasm is loaded once, for all clients', async () => {
  let loads = 0;
  const { start, answer, said } = setUp(async () => {
    loads += 1;
    return { Generator: FakeGenerator, fresh_seed: () => 7 } as unknown as GeneratorModule;
  });
  start(1, request(1, 2), 1);
  start(1, request(1, 2), 2);
  await Promise.all([answer(1, 1), answer(1, 2)]);
  assert.equal(loads, 1);
  assert.equal(said.filter(({ type }) => type === 'ready').length, 1);
});

test('runs of two clients take turns', async () => {
  const { start, answer, times } = setUp();
  const length = 400;
  start(1, request(1, length / STEP_MS), 1);
  start(1, request(2, length / STEP_MS), 2);
  await Promise.all([answer(1, 1), answer(1, 2)]);
  const [first, second] = times('result');
  assert(first! >= 2 * length - 2 * SLICE_MS, `the first had ended after ${first} ms`);
  assert.equal(second, 2 * length);
});

test('a newer request, a cancel and a refusal of one client leave the run of another alone', async () => {
  const made = FakeGenerator.all.length;
  const { host, start, answer, said } = setUp();
  start(1, request(1, 500), 1);
  start(1, request(2, 200), 2);
  after(10, () => start(2, request(3, 200), 2));
  after(50, () => host.receive({ type: 'cancel', client: 2, id: 1 }));
  after(90, () => host.receive({ type: 'cancel', client: 2, id: 2 }));
  after(130, () => start(3, request(4, 10, 50), 2));
  const answers = await Promise.all([answer(1, 1), answer(1, 2), answer(2, 2), answer(3, 2)]);
  assert.deepEqual(
    answers.map(({ type }) => type),
    ['result', 'dropped', 'dropped', 'rejected'],
  );
  assert.equal(said.filter((message) => 'client' in message && message.client === 1 && message.type !== 'progress').length, 1);
  assert.equal(FakeGenerator.all.length, made + 2, 'each client has a cache of its own, and keeps it');
});

test('a client that is closed frees its generator and no other: at once, or when the slice of its run is over', async () => {
  const made = FakeGenerator.all.length;
  const { host, start, answer } = setUp();
  for (const client of [1, 2]) {
    start(1, request(1, 2), client);
    await answer(1, client);
  }
  const [a, b] = FakeGenerator.all.slice(made);
  host.receive({ type: 'close', client: 1 });
  assert.deepEqual([a!.freed, b!.freed], [1, 0]);

  start(2, request(2, 5000), 2);
  after(50, () => {
    host.receive({ type: 'close', client: 2 });
    assert.equal(b!.freed, 0, 'freed under a run');
  });
  await rest(() => b!.freed > 0);
  assert.equal(b!.freed, 1);
  assert(now < 1000 + 50 + 3 * SLICE_MS, 'the run went on');
  // Nothing is left of a client that has never asked for a field.
  host.receive({ type: 'close', client: 3 });
  host.receive({ type: 'seed', client: 4, id: 1 });
  host.receive({ type: 'close', client: 4 });
  assert.equal(FakeGenerator.all.length, made + 2);
});

test('a client that is closed while the wasm loads leaves no generator', async () => {
  const made = FakeGenerator.all.length;
  const { host, start } = setUp();
  start(1, request(1, 20));
  host.receive({ type: 'close', client: 1 });
  await rest();
  assert(FakeGenerator.all.slice(made).every(({ freed, started }) => freed === 1 && started.length === 0));
});

test('in a browser each task runs one slice, whosever it is, and what came in during it is read before the next', async (t) => {
  // The browser's queue of tasks; nothing else is put into it than what the session and this test put there.
  const tasks: (() => void)[] = [];
  class Channel {
    port1 = { onmessage: () => {} };
    port2 = { postMessage: () => void tasks.push(() => this.port1.onmessage()) };
  }
  const kept = { setImmediate, MessageChannel };
  const settle = () => new Promise<void>((resolve) => void kept.setImmediate(resolve));
  Object.assign(globalThis, { setImmediate: undefined, MessageChannel: Channel });
  t.after(() => Object.assign(globalThis, kept));

  const slices: number[] = [];
  const sessions = [1, 2, 3].map((mode) => {
    const generator = new FakeGenerator();
    const step = generator.step.bind(generator);
    generator.step = () => {
      slices.push(mode);
      now += SLICE_MS;
      return step();
    };
    return fieldSession(generator as unknown as RawGenerator).run(request(mode, 4 - mode));
  });
  while (tasks.length > 0) {
    assert.equal(tasks.length, 1, 'a message would have to wait for several slices');
    tasks.shift()!();
    await settle();
  }
  await Promise.all(sessions);
  assert.deepEqual(slices, [1, 2, 3, 1, 2, 1]);
});
