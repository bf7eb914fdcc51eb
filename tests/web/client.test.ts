// Requests of a client to its worker: answered, superseded, cancelled, disposed of.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { RockFieldError } from '../../www/base/errors.ts';
import type { ErrorInfo } from '../../www/base/errors.ts';
import { CANCEL_MS } from '../../www/generator/worker-client.ts';
import { IDLE_MS } from '../../www/generator/pool.ts';
import { CLIENT, isAbort, isNamed, mockTimers, params, settle, setUp } from './fake-client.ts';

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
