// The workers of a page and the clients that share them; every word of the workers is written by the test.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { TestContext } from 'node:test';
import { RockFieldError } from '../../www/base/errors.ts';
import type { Field } from '../../www/data/field.ts';
import { GeneratorClient } from '../../www/rocks/client.ts';
import { CANCEL_MS } from '../../www/generator/worker-client.ts';
import { IDLE_MS } from '../../www/generator/pool.ts';
import { GRACE_MS, SILENCE_MS } from '../../www/generator/pool-worker.ts';
import type { FromWorker } from '../../www/generator/protocol.ts';
import { defaultParams } from '../../www/rocks/request.ts';
import { SilentWorker } from './fake-worker.ts';
import type { Start } from './fake-worker.ts';

class FakeWorker extends SilentWorker {
  says(message: FromWorker): void {
    this.tells(message);
  }

  /** The field tells whose it is: its client's number. */
  finishes({ client, id }: Start): void {
    this.says({ type: 'result', client, id, result: { stats: { rocks: client } } as Field });
  }

  get starts(): Start[] {
    return this.heard.filter((message) => message.type === 'start');
  }

  /** The start of the request with this seed. */
  start(seed: number): Start {
    return this.starts.find(({ request }) => request.params[0] === seed) ?? assert.fail(`seed ${seed} was not started here`);
  }
}

/** A page with `cores` cores: `client()` makes one more client of its pool. */
function setUp(t: TestContext, cores: number) {
  const { timers } = t.mock;
  timers.enable({ apis: ['setTimeout'] });
  const before = Object.getOwnPropertyDescriptor(globalThis, 'navigator');
  Object.defineProperty(globalThis, 'navigator', { value: { hardwareConcurrency: cores }, configurable: true });
  t.after(() => (before ? Object.defineProperty(globalThis, 'navigator', before) : Reflect.deleteProperty(globalThis, 'navigator')));

  const workers: FakeWorker[] = [];
  const spawn = () => {
    workers.push(new FakeWorker());
    return workers.at(-1)!;
  };
  const client = () => new GeneratorClient({ spawn });
  const alive = () => workers.filter(({ ended }) => !ended);
  return { timers, workers, alive, client, clients: (count: number) => Array.from({ length: count }, client) };
}

/** One core for the page, one for the worker. */
const ONE_WORKER = 2;

function params(seed: number) {
  return { ...defaultParams(), seed };
}

/** Long enough for the question and for the verdict; in two steps, since the second timer is set by the first. */
function fallSilent(timers: TestContext['mock']['timers']): void {
  timers.tick(SILENCE_MS);
  timers.tick(GRACE_MS);
}

/** What a promise came to, in a word. */
function outcome(answer: Promise<Field>): Promise<string> {
  return answer.then(
    () => 'field',
    (error: Error) => error.name,
  );
}

test('twenty-four clients share at most four workers, evenly', (t) => {
  const { workers, clients } = setUp(t, 16);
  const all = clients(24);
  assert.equal(workers.length, 0, 'made before anything was asked for');
  all.forEach((client, seed) => void outcome(client.generate(params(seed))));
  assert.deepEqual(
    workers.map(({ starts }) => new Set(starts.map(({ client }) => client)).size),
    [6, 6, 6, 6],
  );
});

test('there is one worker at least, and one core is left to the page', (t) => {
  for (const [cores, wanted] of [
    [0, 1],
    [1, 1],
    [2, 1],
    [3, 2],
    [4, 3],
    [5, 4],
    [64, 4],
  ] as const) {
    const { workers, clients } = setUp(t, cores);
    clients(8).forEach((client) => void outcome(client.generate(params(1))));
    assert.equal(workers.length, wanted, `with ${cores} cores`);
    t.mock.timers.reset();
  }
});

test('a client stays with its worker, and the next one goes where there are fewest', async (t) => {
  const { workers, client, clients } = setUp(t, 3);
  const all = clients(4);
  all.forEach((one, seed) => void outcome(one.generate(params(seed))));
  all[1]!.dispose();
  all[0]!.generate(params(10)).catch(() => {});
  workers[0]!.start(10);
  client()
    .generate(params(11))
    .catch(() => {});
  workers[1]!.start(11);
});

test('the last client to go takes the worker along, after a while', async (t) => {
  const { timers, workers, clients } = setUp(t, ONE_WORKER);
  const [a, b] = clients(2);
  const answers = [outcome(a!.generate(params(1))), outcome(b!.generate(params(2)))];
  a!.dispose();
  timers.tick(60_000);
  assert(!workers[0]!.ended);
  assert.deepEqual(workers[0]!.heard.at(-1), { type: 'close', client: workers[0]!.start(1).client });
  b!.dispose();
  timers.tick(IDLE_MS - 1);
  assert(!workers[0]!.ended);
  timers.tick(1);
  assert(workers[0]!.ended);
  assert.deepEqual(await Promise.all(answers), ['AbortError', 'AbortError']);
});

test('a client that comes back within that while finds the worker still there', (t) => {
  const { timers, workers, client } = setUp(t, 16);
  for (let view = 0; view < 5; view += 1) {
    const shown = client();
    void outcome(shown.generate(params(view)));
    workers[0]!.start(view);
    timers.tick(10 * IDLE_MS);
    shown.dispose();
    timers.tick(IDLE_MS - 1);
  }
  assert.equal(workers.length, 1);
  timers.tick(1);
  assert(workers[0]!.ended);
});

test('mounting and unmounting leaves no worker', (t) => {
  const { timers, workers, alive, clients } = setUp(t, 16);
  for (let round = 0; round < 5; round += 1) {
    const all = clients(24);
    all.forEach((client, seed) => void outcome(client.generate(params(seed))));
    alive().forEach((worker) => worker.says({ type: 'ready' }));
    assert.equal(alive().length, 4);
    all.forEach((client) => client.dispose());
    timers.tick(IDLE_MS);
    assert.equal(alive().length, 0);
  }
  assert.equal(workers.length, 20);
});

test('a client that has asked for nothing has no worker, and leaves none', (t) => {
  const { timers, workers, client } = setUp(t, 16);
  const idle = client();
  idle.cancel();
  idle.dispose();
  idle.dispose();
  timers.tick(60_000);
  assert.equal(workers.length, 0);
});

for (const [how, die] of [
  ['that dies', (worker) => worker.dies('killed')],
  ['that vanishes without a word', (_, { timers }) => fallSilent(timers)],
] satisfies [string, (worker: FakeWorker, page: ReturnType<typeof setUp>) => void][]) {
  test(`a worker ${how} is replaced once, and every client of it goes on`, async (t) => {
    const page = setUp(t, ONE_WORKER);
    const { workers, clients } = page;
    const all = clients(3);
    const answers = all.map((client, seed) => outcome(client.generate(params(seed))));
    workers[0]!.says({ type: 'ready' });
    workers[0]!.finishes(workers[0]!.start(2));
    die(workers[0]!, page);
    assert.deepEqual(
      workers.map(({ ended }) => ended),
      [true, false],
    );
    assert.deepEqual(
      workers[1]!.starts.map(({ request }) => request.params[0]),
      [0, 1],
      'what was answered is not run again',
    );
    workers[1]!.says({ type: 'ready' });
    for (const start of workers[1]!.starts) workers[1]!.finishes(start);
    assert.deepEqual(await Promise.all(answers), ['field', 'field', 'field']);
  });
}

test('two deaths give up the requests that saw both', async (t) => {
  const { workers, client } = setUp(t, ONE_WORKER);
  const first = outcome(client().generate(params(1)));
  workers[0]!.says({ type: 'ready' });
  workers[0]!.dies();
  workers[1]!.says({ type: 'ready' });
  const second = outcome(client().generate(params(2)));
  workers[1]!.dies();
  assert.equal(await first, 'WorkerLost');
  assert.equal(workers.length, 3);
  workers[2]!.finishes(workers[2]!.start(2));
  assert.equal(await second, 'field');
});

test('a trap is told to the client whose run it was; the others go on in a new worker, as if nothing had been', async (t) => {
  const { workers, clients } = setUp(t, ONE_WORKER);
  const [a, b] = clients(2);
  const first = a!.generate(params(1));
  const second = outcome(b!.generate(params(2)));
  for (let traps = 0; traps < 3; traps += 1) {
    const worker = workers.at(-1)!;
    worker.says({ type: 'ready' });
    const answer = traps === 0 ? first : a!.generate(params(1));
    const { client, id } = worker.starts.findLast(({ request }) => request.params[0] === 1)!;
    const innocent = worker.start(2);
    worker.says({ type: 'crashed', client, id, error: { name: 'Internal', message: 'unreachable' } });
    // What it says after that comes out of a broken instance.
    worker.finishes(innocent);
    await assert.rejects(answer, (error) => error instanceof RockFieldError && error.name === 'Internal');
    assert.equal(workers.length, traps + 2);
  }
  workers[3]!.finishes(workers[3]!.start(2));
  assert.equal(await second, 'field');
});

test("two clients of one worker do not see each other's results, and cancelling one leaves the other alone", async (t) => {
  const { timers, workers, clients } = setUp(t, ONE_WORKER);
  const [a, b, c] = clients(3);
  const answers = [a!, b!].map((client, k) => client.generate(params(k)));
  const dropped = outcome(c!.generate(params(2)));
  const [worker] = workers;
  worker!.says({ type: 'ready' });
  const [first, second, third] = [worker!.start(0), worker!.start(1), worker!.start(2)];
  assert.deepEqual([first.id, second.id, third.id], [1, 1, 1], 'the ids alone would not tell them apart');
  c!.cancel();
  assert.deepEqual(worker!.heard.at(-1), { type: 'cancel', client: third.client, id: third.id });
  assert.equal(await dropped, 'AbortError');
  worker!.says({ type: 'dropped', client: third.client, id: third.id });
  timers.tick(CANCEL_MS);
  assert(a!.busy && b!.busy && !c!.busy);
  worker!.finishes(second);
  assert(a!.busy && !b!.busy);
  worker!.finishes(first);
  assert.deepEqual(
    (await Promise.all(answers)).map(({ stats }) => stats.rocks),
    [first.client, second.client],
  );
  assert.equal(workers.length, 1);
});

test('a cancel that is not answered in time does not end a worker that others share; silence does', async (t) => {
  const { timers, workers, clients } = setUp(t, ONE_WORKER);
  const [a, b] = clients(2);
  void outcome(a!.generate(params(1)));
  const other = outcome(b!.generate(params(2)));
  workers[0]!.says({ type: 'ready' });
  a!.cancel();
  timers.tick(CANCEL_MS);
  assert(!workers[0]!.ended);
  fallSilent(timers);
  assert(workers[0]!.ended);
  assert.deepEqual(
    workers[1]!.starts.map(({ request }) => request.params[0]),
    [2],
    'what was cancelled is not run again',
  );
  workers[1]!.finishes(workers[1]!.start(2));
  assert.equal(await other, 'field');
});

test('one client that is answered is a sign of life for all', (t) => {
  const { timers, workers, clients } = setUp(t, ONE_WORKER);
  const [a, b] = clients(2);
  void outcome(a!.generate(params(1)));
  workers[0]!.says({ type: 'ready' });
  for (let seed = 2; seed < 62; seed += 1) {
    void outcome(b!.generate(params(seed)));
    timers.tick(SILENCE_MS);
    workers[0]!.finishes(workers[0]!.start(seed));
  }
  assert.equal(workers.length, 1);
});

test('nobody is asked any more when the one who waited has gone', (t) => {
  const { timers, workers, clients } = setUp(t, ONE_WORKER);
  const [a, b] = clients(2);
  void outcome(a!.generate(params(1)));
  void outcome(b!.generate(params(2)));
  workers[0]!.says({ type: 'ready' });
  workers[0]!.finishes(workers[0]!.start(1));
  b!.dispose();
  timers.tick(60_000);
  assert(!workers[0]!.heard.some(({ type }) => type === 'ping'));
  a!.dispose();
});

test('comings and goings do not put the question to a dead worker off', (t) => {
  const { timers, workers, client } = setUp(t, ONE_WORKER);
  void outcome(client().generate(params(1)));
  workers[0]!.says({ type: 'ready' });
  for (let time = 0; time <= SILENCE_MS + GRACE_MS; time += 100) {
    const passing = client();
    void outcome(passing.generate(params(2)));
    timers.tick(100);
    passing.dispose();
  }
  assert(workers[0]!.ended);
});

test('what keeps a worker from starting is told to every client of it, and the next request tries again', async (t) => {
  const { workers, clients } = setUp(t, ONE_WORKER);
  const all = clients(2);
  const ask = () => all.map((client, seed) => outcome(client.generate(params(seed))));
  let answers = ask();
  workers[0]!.dies();
  assert.deepEqual(await Promise.all(answers), ['WorkerUnavailable', 'WorkerUnavailable']);
  answers = ask();
  workers[1]!.says({ type: 'failed', error: { name: 'WasmUnavailable', message: 'generator_bg.wasm: 404' } });
  assert.deepEqual(await Promise.all(answers), ['WasmUnavailable', 'WasmUnavailable']);
  answers = ask();
  assert.equal(workers.length, 3);
  for (const start of workers[2]!.starts) workers[2]!.finishes(start);
  assert.deepEqual(await Promise.all(answers), ['field', 'field']);
});
