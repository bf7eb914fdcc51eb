// What becomes of a request whose worker traps, dies, falls silent or never starts.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { TestContext } from 'node:test';
import { japaneseFailure } from '../../www/base/failures.ja.ts';
import { GRACE_MS, SILENCE_MS, START_MS } from '../../www/generator/pool-worker.ts';
import { FakeWorker, isAbort, isNamed, mockTimers, params, settle, setUp } from './fake-client.ts';

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
