// Workers that die at 100 moments from a stored seed, in every way a worker can, while two clients share them.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { mulberry32 } from '../../www/controls/mulberry32.ts';
import { RockFieldError } from '../../www/base/errors.ts';
import type { Field } from '../../www/data/field.ts';
import { GeneratorClient } from '../../www/rocks/client.ts';
import { defaultParams } from '../../www/rocks/request.ts';
import { SilentWorker } from './fake-worker.ts';
import type { Heard, Start } from './fake-worker.ts';

const STORED_SEED = 20_131_211;
const MOMENTS = 100;

/** Nobody waits longer for a field or for an error. */
const PATIENCE_MS = 20_000;
const STEP_MS = 50;

const WAYS = ['falls silent', 'throws', 'answers what nobody can read', 'traps', 'has no wasm', 'hears no more', 'is not found'] as const;
type Way = (typeof WAYS)[number];

interface Fate {
  way: Way;
  /** After its start, ms. */
  at: number;
}

/** A worker as it is, in the test's time: its script and wasm arrive, it answers pings and grows fields, until its fate. */
class MortalWorker extends SilentWorker {
  #isDead = false;
  #isDeaf = false;
  #isStarted = false;
  #isReady = false;
  /** From a start to its result, ms. */
  readonly #slow: number;
  #count = 0;
  #waiting: Start[] = [];
  #lastId = 0;

  constructor(random: () => number, fate: Fate | undefined) {
    super();
    const later = (ms: number, act: () => void) => setTimeout(() => !this.#isDead && !this.ended && act(), ms);
    const script = 20 + 500 * random();
    if (fate?.way !== 'is not found') {
      later(script, () => {
        this.#isStarted = true;
        this.tells({ type: 'started' });
        for (const message of this.heard) this.#hear(message);
      });
      later(script + 20 + 800 * random(), () => {
        this.tells({ type: 'ready' });
        this.#isReady = true;
        for (const start of this.#waiting.splice(0)) this.#grow(start);
      });
    }
    this.#slow = 50 + 1500 * random();
    if (fate) later(fate.at, () => this.#die(fate.way));
  }

  probe = async (): Promise<void> => {
    if (!this.#isStarted) throw new Error('the server answered 404');
  };

  override postMessage(message: Heard): void {
    super.postMessage(message);
    if (this.#isStarted) this.#hear(message);
  }

  #hear(message: Heard): void {
    if (this.#isDead || this.#isDeaf) return;
    this.#count += 1;
    if (message.type === 'ping') this.tells({ type: 'pong', heard: this.#count });
    if (message.type === 'cancel') this.tells({ type: 'dropped', client: message.client, id: message.id });
    if (message.type !== 'start') return;
    this.#lastId = message.id;
    if (this.#isReady) this.#grow(message);
    else this.#waiting.push(message);
  }

  #grow({ client, id, request }: Start): void {
    const seed = request.params[0];
    setTimeout(
      () => !this.#isDead && !this.ended && this.tells({ type: 'result', client, id, result: { stats: { rocks: seed } } as Field }),
      this.#slow,
    );
  }

  #die(way: Way): void {
    const [starting] = this.heard.filter((message) => message.type === 'start');
    this.#isDead = way !== 'hears no more';
    this.#isDeaf = true;
    if (way === 'throws') this.dies('Uncaught Error: oh');
    if (way === 'answers what nobody can read') this.onmessageerror?.(new MessageEvent('messageerror'));
    if (way === 'has no wasm')
      this.tells({
        type: 'failed',
        error: { name: 'WasmUnavailable', message: 'generator_bg.wasm could not be fetched: the server answered 404' },
      });
    if (way === 'traps' && starting)
      this.tells({ type: 'crashed', client: starting.client, id: this.#lastId, error: { name: 'Internal', message: 'unreachable' } });
  }
}

const settled = () => new Promise<void>((resolve) => setImmediate(resolve));

test(`workers that die at ${MOMENTS} random moments: every run ends with its field or a named error within 20 s, and the next one works`, async (t) => {
  const { timers } = t.mock;
  timers.enable({ apis: ['setTimeout'] });
  const before = Object.getOwnPropertyDescriptor(globalThis, 'navigator');
  // One worker for all.
  Object.defineProperty(globalThis, 'navigator', { value: { hardwareConcurrency: 2 }, configurable: true });
  t.after(() => (before ? Object.defineProperty(globalThis, 'navigator', before) : Reflect.deleteProperty(globalThis, 'navigator')));

  const outcomes = new Map<string, number>();
  let longest = 0;
  for (let moment = 0; moment < MOMENTS; moment += 1) {
    const random = mulberry32(STORED_SEED + moment);
    // A second and a third may die as well.
    const fates = Array.from(
      { length: 1 + Math.floor(3 * random()) },
      (): Fate => ({ way: WAYS[Math.floor(WAYS.length * random())]!, at: 3000 * random() ** 2 }),
    );
    let now = 0;
    const mortal = [...fates];
    const spawn = () => new MortalWorker(random, mortal.shift());
    const clients = [new GeneratorClient({ spawn }), new GeneratorClient({ spawn })];
    const context = `moment ${moment}: ${JSON.stringify(fates)}`;

    let open = 0;
    const ask = (client: GeneratorClient, seed: number): Promise<string> => {
      const asked = now;
      open += 1;
      const name = (error: unknown): string =>
        error instanceof RockFieldError || error instanceof DOMException ? error.name : `unnamed: ${String(error)}`;
      return client
        .generate({ ...defaultParams(), seed })
        .then((field) => (field.stats.rocks === seed ? 'field' : `another's field`), name)
        .finally(() => {
          open -= 1;
          longest = Math.max(longest, now - asked);
          assert.ok(now - asked <= PATIENCE_MS, `${now - asked} ms; ${context}`);
        });
    };
    const pass = async (until: () => boolean, most: number): Promise<void> => {
      for (const end = now + most; now < end && !until(); now += STEP_MS) {
        timers.tick(STEP_MS);
        await settled();
      }
    };

    const answers: Promise<string>[] = [];
    for (let k = 0; k < 4; k += 1) {
      answers.push(ask(clients[k % 2]!, 10 * moment + k));
      await pass(() => false, 1000 * random());
    }
    await pass(() => open === 0, PATIENCE_MS);
    assert.equal(open, 0, `not settled; ${context}`);
    for (const outcome of await Promise.all(answers)) outcomes.set(outcome, (outcomes.get(outcome) ?? 0) + 1);

    mortal.length = 0;
    // A worker that is to die yet may do so now: from then on they live.
    await pass(() => false, 4000);
    const next = clients.map((client, k) => ask(client, 1e6 + k));
    await pass(() => open === 0, PATIENCE_MS);
    assert.deepEqual(await Promise.all(next), ['field', 'field'], context);
    for (const client of clients) client.dispose();
    await pass(() => false, 2000);
  }
  t.diagnostic(`${JSON.stringify(Object.fromEntries(outcomes))}, longest ${longest} ms`);
  const named = ['AbortError', 'Internal', 'WasmUnavailable', 'WorkerLost', 'WorkerUnavailable', 'field'];
  assert.deepEqual(
    [...outcomes.keys()].filter((name) => !named.includes(name)),
    [],
  );
});
