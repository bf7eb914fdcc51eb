import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { TestContext } from 'node:test';
import { RockFieldError } from '../../www/base/errors.ts';
import type { ErrorInfo } from '../../www/base/errors.ts';
import { japaneseFailure } from '../../www/base/failures.ja.ts';
import type { Field } from '../../www/data/field.ts';
import { GeneratorClient } from '../../www/rocks/client.ts';
import { CANCEL_MS } from '../../www/generator/worker-client.ts';
import type { FieldJob } from '../../www/rocks/client.ts';
import type { ClientOptions } from '../../www/generator/worker-client.ts';
import { IDLE_MS } from '../../www/generator/pool.ts';
import { GRACE_MS, SILENCE_MS, START_MS } from '../../www/generator/pool-worker.ts';
import type { FailedMessage, FromLoop, FromWorker, PongMessage, ReadyMessage, StartedMessage } from '../../www/generator/protocol.ts';
import { defaultParams } from '../../www/rocks/request.ts';
import { SilentWorker } from './fake-worker.ts';
import type { Start } from './fake-worker.ts';

/** The first of its pool, and here the only one. */
const CLIENT = 1;

class FakeWorker extends SilentWorker {
  says(message: FromLoop | StartedMessage | ReadyMessage | FailedMessage | PongMessage): void {
    this.tells({ client: CLIENT, ...message } as FromWorker);
  }

  finishes(id: number): void {
    this.says({ type: 'result', id, result: fieldOf(id) });
  }

  get starts(): Start[] {
    return this.heard.filter((message) => message.type === 'start');
  }

  get lastStart(): Start {
    return this.starts.at(-1) ?? assert.fail('nothing was started');
  }
}

function fieldOf(id: number): Field {
  return { stats: { rocks: id } } as Field;
}

/** A client, the workers it made, and what it gave out for display. */
function setUp(options: ClientOptions<FieldJob, Field> = {}) {
  const workers: FakeWorker[] = [];
  const shown: [number, boolean][] = [];
  const client = new GeneratorClient({
    spawn: () => {
      workers.push(new FakeWorker());
      return workers.at(-1)!;
    },
    onResult: (field, { superseded }) => shown.push([field.stats.rocks, superseded]),
    ...options,
  });
  const worker = () => workers.at(-1) ?? assert.fail('no worker');
  return { client, workers, shown, worker };
}

function params(seed: number) {
  return { ...defaultParams(), seed };
}

function isAbort(error: unknown): boolean {
  return error instanceof DOMException && error.name === 'AbortError';
}

function isNamed(name: string): (error: unknown) => boolean {
  return (error) => error instanceof RockFieldError && error.name === name;
}

function mockTimers(t: TestContext) {
  t.mock.timers.enable({ apis: ['setTimeout'] });
  return t.mock.timers;
}

/** For the microtasks of promises that have been settled. */
const settle = () => new Promise((resolve) => setImmediate(resolve));

test('a request is answered with its field, and no worker is made before the first', async () => {
  const { client, workers, shown, worker } = setUp();
  assert.equal(workers.length, 0);
  const answer = client.generate(params(1));
  assert(client.busy);
  worker().says({ type: 'ready' });
  const { id, request } = worker().lastStart;
  assert.equal(request.params[0], 1);
  assert.equal(request.imageWidth, 1024);
  worker().finishes(id);
  assert.equal((await answer).stats.rocks, id);
  assert.deepEqual(shown, [[id, false]]);
  assert(!client.busy);
  client.dispose();
});

test('a field comes with the parameters it was asked with, also when a newer request is on its way', async () => {
  const given: unknown[] = [];
  const { client, worker } = setUp({ onResult: (field, _superseded, of) => given.push([field.stats.rocks, of]) });
  const [first, second] = [params(1), params(2)];
  client.generate(first).catch(() => {});
  worker().says({ type: 'ready' });
  const a = worker().lastStart.id;
  const done = client.generate(second);
  const b = worker().lastStart.id;
  worker().finishes(a);
  worker().finishes(b);
  await done;
  assert.deepEqual(given, [
    [a, first],
    [b, second],
  ]);
  client.dispose();
});

test('the latest request wins: the ones before it reject as aborted, and are shown when they finish first', async () => {
  const { client, shown, worker } = setUp();
  const first = client.generate(params(1));
  const second = client.generate(params(2));
  const third = client.generate(params(3));
  await assert.rejects(first, isAbort);
  await assert.rejects(second, isAbort);
  const [a, b, c] = worker().starts.map(({ id }) => id);
  worker().finishes(a!);
  worker().says({ type: 'dropped', id: b! });
  worker().finishes(c!);
  assert.equal((await third).stats.rocks, c);
  assert.deepEqual(shown, [
    [a, true],
    [c, false],
  ]);
  client.dispose();
});

test('an older result is never shown after a newer one', async () => {
  const { client, shown, worker } = setUp();
  client.generate(params(1)).catch(() => {});
  const second = client.generate(params(2));
  const [a, b] = worker().starts.map(({ id }) => id);
  worker().finishes(b!);
  worker().finishes(a!);
  await second;
  assert.deepEqual(shown, [[b, false]]);
  client.dispose();
});

test('progress reaches the current request alone', async () => {
  const { client, worker } = setUp();
  const seen: string[] = [];
  client.generate(params(1), { onProgress: () => seen.push('old') }).catch(() => {});
  const current = client.generate(params(2), { onProgress: ({ stage, fraction }) => seen.push(`${stage} ${fraction}`) });
  const [a, b] = worker().starts.map(({ id }) => id);
  worker().says({ type: 'progress', id: a!, progress: { stage: 'sites', fraction: 0.1 } });
  worker().says({ type: 'progress', id: b!, progress: { stage: 'cells', fraction: 0.5 } });
  worker().finishes(b!);
  await current;
  assert.deepEqual(seen, ['cells 0.5']);
  client.dispose();
});

test('a refused request rejects with key, value and bounds, and the worker stays', async () => {
  const { client, workers, worker } = setUp();
  const answer = client.generate(params(1), { maxBytes: 10 });
  assert.equal(worker().lastStart.request.maxBytes, 10);
  const error: ErrorInfo = { name: 'OverBudget', message: 'too much', key: 'imageWidth', value: 20, min: 0, max: 10, layer: undefined };
  worker().says({ type: 'rejected', id: worker().lastStart.id, error });
  await assert.rejects(answer, (thrown: RockFieldError) => {
    assert.deepEqual([thrown.name, thrown.key, thrown.value, thrown.max], ['OverBudget', 'imageWidth', 20, 10]);
    return isNamed('OverBudget')(thrown);
  });
  const next = client.generate(params(2));
  worker().finishes(worker().lastStart.id);
  await next;
  assert.equal(workers.length, 1);
  client.dispose();
});

test('cancel is soft when it is answered in time: the worker and its cache stay', async (t) => {
  const timers = mockTimers(t);
  const { client, workers, shown, worker } = setUp();
  const answer = client.generate(params(1));
  worker().says({ type: 'ready' });
  const { id } = worker().lastStart;
  client.cancel();
  await assert.rejects(answer, isAbort);
  assert.deepEqual(worker().heard.at(-1), { type: 'cancel', client: CLIENT, id });
  timers.tick(CANCEL_MS - 1);
  worker().says({ type: 'dropped', id });
  timers.tick(60_000);
  assert(!worker().ended);
  assert.deepEqual(shown, []);
  const next = client.generate(params(2));
  worker().finishes(worker().lastStart.id);
  await next;
  assert.equal(workers.length, 1);
  client.dispose();
});

test('a result that crosses a cancel on its way is not shown', async () => {
  const { client, shown, worker } = setUp();
  const answer = client.generate(params(1));
  worker().says({ type: 'ready' });
  client.cancel();
  await assert.rejects(answer, isAbort);
  worker().finishes(worker().lastStart.id);
  assert.deepEqual(shown, []);
  client.dispose();
});

test('a cancel that is not answered in time ends the worker, and the next request makes a new one', async (t) => {
  const timers = mockTimers(t);
  const { client, workers, worker } = setUp();
  const answer = client.generate(params(1));
  worker().says({ type: 'ready' });
  client.cancel();
  await assert.rejects(answer, isAbort);
  timers.tick(CANCEL_MS);
  assert(worker().ended);
  assert.equal(workers.length, 1, 'respawned before it is needed');
  const next = client.generate(params(2));
  assert.equal(workers.length, 2);
  worker().finishes(worker().lastStart.id);
  await next;
  client.dispose();
});

test('a request made while a cancel is unanswered moves to the new worker', async (t) => {
  const timers = mockTimers(t);
  const { client, workers, worker } = setUp();
  client.generate(params(1)).catch(() => {});
  worker().says({ type: 'ready' });
  client.cancel();
  const next = client.generate(params(2));
  timers.tick(CANCEL_MS);
  assert.equal(workers.length, 2);
  assert.equal(worker().lastStart.request.params[0], 2);
  worker().finishes(worker().lastStart.id);
  await next;
  client.dispose();
});

test('an aborted signal cancels its own request and no other', async () => {
  const { client, worker } = setUp();
  const [old, current] = [new AbortController(), new AbortController()];
  client.generate(params(1), { signal: old.signal }).catch(() => {});
  const answer = client.generate(params(2), { signal: current.signal });
  old.abort();
  assert(client.busy);
  const reason = new Error('enough');
  current.abort(reason);
  await assert.rejects(answer, reason);
  assert.deepEqual(worker().heard.at(-1), { type: 'cancel', client: CLIENT, id: worker().lastStart.id });
  await assert.rejects(client.generate(params(3), { signal: current.signal }), reason);
  client.dispose();
});

test('a trap rejects the request once and replaces the worker, but does not run the same parameters again', async () => {
  const { client, workers, worker } = setUp();
  const answer = client.generate(params(1));
  worker().says({ type: 'ready' });
  worker().says({ type: 'crashed', id: worker().lastStart.id, error: { name: 'Internal', message: 'unreachable' } });
  await assert.rejects(answer, isNamed('Internal'));
  assert(workers[0]!.ended);
  assert.equal(workers.length, 1);
  const next = client.generate(params(2));
  assert.equal(workers.length, 2);
  worker().finishes(worker().lastStart.id);
  await next;
  client.dispose();
});

test('a trap of a superseded run moves the newer request to a new worker', async () => {
  const { client, workers, worker } = setUp();
  client.generate(params(1)).catch(() => {});
  const second = client.generate(params(2));
  worker().says({ type: 'ready' });
  worker().says({ type: 'crashed', id: worker().starts[0]!.id, error: { name: 'Internal', message: 'unreachable' } });
  assert.equal(workers.length, 2);
  assert.equal(worker().lastStart.request.params[0], 2);
  worker().finishes(worker().lastStart.id);
  await second;
  client.dispose();
});

test('a worker that dies in a run is replaced and the run goes on there', async () => {
  const { client, workers, worker } = setUp();
  const answer = client.generate(params(1));
  worker().says({ type: 'ready' });
  worker().dies('killed');
  assert.equal(workers.length, 2);
  assert(workers[0]!.ended);
  worker().says({ type: 'ready' });
  worker().finishes(worker().lastStart.id);
  await answer;
  client.dispose();
});

test('a worker that vanishes without a word is asked, then replaced', async (t) => {
  const timers = mockTimers(t);
  const { client, workers, worker } = setUp();
  const answer = client.generate(params(1));
  worker().says({ type: 'ready' });
  timers.tick(SILENCE_MS);
  assert.deepEqual(worker().heard.at(-1), { type: 'ping' });
  assert.equal(workers.length, 1);
  timers.tick(GRACE_MS);
  assert.equal(workers.length, 2);
  worker().says({ type: 'ready' });
  worker().finishes(worker().lastStart.id);
  await answer;
  client.dispose();
});

test('a drag on a dead worker does not put its replacement off', async (t) => {
  const timers = mockTimers(t);
  const { client, workers, worker } = setUp();
  client.generate(params(0)).catch(() => {});
  worker().says({ type: 'ready' });
  for (let time = 0; time <= SILENCE_MS + GRACE_MS; time += 16) {
    client.generate(params(time)).catch(() => {});
    timers.tick(16);
  }
  assert.equal(workers.length, 2);
  client.dispose();
});

test('a worker that answers, however long it works, is left alone', async (t) => {
  const timers = mockTimers(t);
  const { client, workers, worker } = setUp();
  const answer = client.generate(params(1));
  worker().says({ type: 'ready' });
  for (let second = 0; second < 60; second += 1) {
    timers.tick(SILENCE_MS);
    worker().says({ type: 'pong', heard: worker().heard.length });
  }
  worker().finishes(worker().lastStart.id);
  await answer;
  assert.equal(workers.length, 1);
  client.dispose();
});

test('a worker that is still loading and answers is given all the time it needs', async (t) => {
  const timers = mockTimers(t);
  const { client, workers, worker } = setUp();
  const answer = client.generate(params(1));
  worker().says({ type: 'started' });
  for (let second = 0; second < 600; second += 1) {
    timers.tick(SILENCE_MS);
    worker().says({ type: 'pong', heard: worker().heard.length });
  }
  assert.equal(workers.length, 1);
  worker().says({ type: 'ready' });
  worker().finishes(worker().lastStart.id);
  await answer;
  client.dispose();
});

/** A worker whose script does what the test says when the page fetches it too. */
function probed(t: TestContext, probe: (heard: () => void) => Promise<void>) {
  const workers: FakeWorker[] = [];
  const spawn = () => {
    const worker = Object.assign(new FakeWorker(), { probe });
    workers.push(worker);
    return worker;
  };
  return { ...setUp({ spawn }), workers, worker: () => workers.at(-1)!, timers: mockTimers(t) };
}

const forever = () => new Promise<void>(() => {});

for (const [what, probe, limit, wanted] of [
  ['whose script does nothing', async () => {}, START_MS + GRACE_MS, /says nothing/],
  ['whose script cannot be fetched', () => Promise.reject(new Error('the server answered 503')), START_MS, /the server answered 503/],
  ['whose script never arrives', forever, 2 * START_MS, /does not arrive/],
] satisfies [string, () => Promise<void>, number, RegExp][]) {
  test(`a worker ${what} is given up with a named error, and the next request starts another`, async (t) => {
    const { client, workers, worker, timers } = probed(t, probe);
    const answer = client.generate(params(1)).catch((error: Error) => error);
    const seed = client.freshSeed().catch((error: Error) => error);
    for (let ms = 0; ms <= limit; ms += 100) {
      timers.tick(100);
      await settle();
    }
    const error = (await answer) as Error;
    assert(isNamed('WorkerUnavailable')(error), String(error));
    assert.match(error.message, wanted);
    assert.doesNotMatch(japaneseFailure(error.message), /[a-z]{4}/, 'there is an English piece in the Japanese words');
    assert.equal(await seed, error);
    assert(worker().ended);
    const next = client.generate(params(2));
    assert.equal(workers.length, 2);
    worker().says({ type: 'started' });
    worker().finishes(worker().lastStart.id);
    await next;
    client.dispose();
  });
}

test('a worker whose script arrives slowly is waited for', async (t) => {
  let arrives = () => {};
  const { client, workers, worker, timers } = probed(t, (heard) => {
    arrives = heard;
    return forever();
  });
  const answer = client.generate(params(1));
  timers.tick(START_MS);
  for (let ms = 0; ms < 10 * START_MS; ms += START_MS - 1) {
    arrives();
    timers.tick(START_MS - 1);
  }
  worker().says({ type: 'started' });
  worker().says({ type: 'ready' });
  worker().finishes(worker().lastStart.id);
  await answer;
  timers.tick(60_000);
  assert.equal(workers.length, 1);
  client.dispose();
});

test('a worker that ends while it loads is replaced once; a second death then gives the request up', async (t) => {
  const timers = mockTimers(t);
  const { client, workers, worker } = setUp();
  const answer = client.generate(params(1)).catch((error: Error) => error);
  for (const count of [1, 2]) {
    assert.equal(workers.length, count);
    worker().says({ type: 'started' });
    timers.tick(SILENCE_MS);
    timers.tick(GRACE_MS);
  }
  assert(isNamed('WorkerLost')(await answer));
  assert.equal(workers.length, 2);
  client.generate(params(2)).catch(() => {});
  assert.equal(workers.length, 3);
  client.dispose();
});

test('a replacement that never starts gives the request up', async (t) => {
  const { client, workers, worker, timers } = probed(t, async () => {});
  const answer = client.generate(params(1)).catch((error: Error) => error);
  worker().says({ type: 'ready' });
  worker().dies('killed');
  timers.tick(START_MS);
  await settle();
  timers.tick(GRACE_MS);
  assert(isNamed('WorkerUnavailable')(await answer));
  assert.equal(workers.length, 2);
  client.dispose();
});

test('a request that is cancelled while its worker does not start leaves nothing behind: the next one has a worker of its own', async (t) => {
  const { client, workers, timers } = probed(t, async () => {});
  const cancelled = client.generate(params(1));
  timers.tick(START_MS - 1);
  client.cancel();
  await assert.rejects(cancelled, isAbort);
  timers.tick(1);
  await settle();
  timers.tick(GRACE_MS);
  assert(workers[0]!.ended);
  const last = client.generate(params(2));
  assert.equal(workers.length, 2);
  client.dispose();
  await assert.rejects(last, isAbort);
  timers.tick(START_MS);
  await settle();
  timers.tick(60_000);
  assert(workers[1]!.ended);
  assert.equal(workers.length, 2);
});

test('a message that got lost on its way is asked again of another worker', async (t) => {
  const timers = mockTimers(t);
  const { client, workers, worker } = setUp();
  const answer = client.generate(params(1));
  worker().says({ type: 'ready' });
  timers.tick(SILENCE_MS);
  worker().says({ type: 'pong', heard: worker().heard.length - 1 });
  assert.equal(workers.length, 2);
  worker().says({ type: 'ready' });
  worker().finishes(worker().lastStart.id);
  await answer;
  client.dispose();
});

test('two deaths over one request give it up with a readable message, and the page can go on', async () => {
  const { client, workers, worker } = setUp();
  const answer = client.generate(params(1));
  worker().says({ type: 'ready' });
  worker().dies();
  worker().says({ type: 'ready' });
  worker().dies();
  await assert.rejects(answer, isNamed('WorkerLost'));
  assert.equal(workers.length, 2);
  const next = client.generate(params(2));
  worker().finishes(worker().lastStart.id);
  await next;
  assert.equal(workers.length, 3);
  client.dispose();
});

test('a worker killed while idle is noticed at the next request', async () => {
  const { client, workers, worker } = setUp();
  const first = client.generate(params(1));
  worker().says({ type: 'ready' });
  worker().finishes(worker().lastStart.id);
  await first;
  worker().dies();
  assert.equal(workers.length, 1, 'respawned before it is needed');
  const second = client.generate(params(2));
  assert.equal(workers.length, 2);
  worker().finishes(worker().lastStart.id);
  await second;
  client.dispose();
});

test('a missing worker script, a blocked worker and missing wasm are readable errors, and the next request tries again', async () => {
  const { client, workers, worker } = setUp();
  const missing = client.generate(params(1));
  worker().dies();
  await assert.rejects(
    missing,
    (error: Error) => isNamed('WorkerUnavailable')(error) && /its file is missing, or blocked/.test(error.message),
  );
  const noWasm = client.generate(params(2));
  worker().says({ type: 'failed', error: { name: 'WasmUnavailable', message: 'generator_bg.wasm: 404' } });
  await assert.rejects(noWasm, isNamed('WasmUnavailable'));
  assert(workers.every(({ ended }) => ended));
  assert.equal(workers.length, 2);
  client.dispose();

  const blocked = setUp({
    spawn: () => {
      throw new DOMException('refused by policy', 'SecurityError');
    },
  });
  await assert.rejects(
    blocked.client.generate(params(1)),
    (error: Error) => isNamed('WorkerUnavailable')(error) && /refused by policy/.test(error.message),
  );
  await assert.rejects(blocked.client.freshSeed(), isNamed('WorkerUnavailable'));
});

test('seeds are answered beside runs, and by the new worker when the old one is lost', async () => {
  const { client, workers, worker } = setUp();
  client.generate(params(1)).catch(() => {});
  const seed = client.freshSeed();
  worker().says({ type: 'ready' });
  worker().dies();
  assert.equal(workers.length, 2);
  const asked = worker().heard.find((message) => message.type === 'seed');
  worker().says({ type: 'seed', id: asked!.id, seed: 123 });
  assert.equal(await seed, 123);
  client.dispose();
});

test('disposal ends the worker and aborts what is open; no timer is left', async (t) => {
  const timers = mockTimers(t);
  const { client, workers, worker } = setUp();
  const answer = client.generate(params(1));
  const seed = client.freshSeed();
  worker().says({ type: 'ready' });
  client.dispose();
  await assert.rejects(answer, isAbort);
  await assert.rejects(seed, isAbort);
  assert.deepEqual(worker().heard.at(-1), { type: 'close', client: CLIENT });
  timers.tick(IDLE_MS);
  assert(worker().ended);
  timers.tick(60_000);
  await settle();
  assert.equal(workers.length, 1);
  await assert.rejects(client.generate(params(2)), isAbort);
});

test('nothing is timed while nobody waits', async (t) => {
  const { client, worker } = setUp();
  const answer = client.generate(params(1));
  worker().says({ type: 'ready' });
  worker().finishes(worker().lastStart.id);
  await answer;
  const set = t.mock.method(globalThis, 'setTimeout');
  await settle();
  assert.equal(set.mock.callCount(), 0);
  client.dispose();
});
