// What the real wasm is not made to do: traps, and wasm that cannot be had.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { japaneseFailure } from '../../www/base/failures.ja.ts';
import type { FullModule } from '../../www/rocks/full-session.ts';
import { openGenerator } from '../../www/rocks/headless.ts';
import type { FieldRealms } from '../../www/rocks/headless.ts';
import { Realm } from '../../www/generator/headless.ts';
import { STALL_MS } from '../../www/base/wasm-file.ts';
import { loadGenerator } from '../../www/generator/wasm.ts';
import type { GeneratorGlue, GeneratorModule } from '../../www/rocks/session.ts';

const TRAP_SEED = 666;

/** The full generator is not asked for here. */
function both(plain: Realm<GeneratorModule>): FieldRealms {
  return { plain, full: plain as unknown as Realm<FullModule> };
}

/** A glue whose instance can be replaced; its generators trap at one seed and are void afterwards. */
function fakeGlue({ canReset = true } = {}) {
  const state = { instance: 0, poisoned: false, made: 0 };
  class Generator {
    #instance = state.instance;
    #seed = 0;
    constructor() {
      state.made += 1;
      assert(!state.poisoned, 'a poisoned instance was used');
    }
    #check() {
      if (this.#instance !== state.instance) throw new Error('Invalid stale object from previous Wasm instance');
      assert(!state.poisoned, 'a poisoned instance was used');
    }
    start(params: Float64Array) {
      this.#check();
      this.#seed = params[0]!;
    }
    step() {
      if (this.#seed !== TRAP_SEED) return true;
      state.poisoned = true;
      throw new WebAssembly.RuntimeError('unreachable');
    }
    stage = () => 0;
    progress = () => 0;
    summary = () => Float64Array.of(this.#seed, 0, 0, 0);
    positions = () => new Float32Array();
    normals = () => new Float32Array();
    indices = () => new Uint32Array();
    rock_starts = () => new Uint32Array();
    vertex_starts = () => new Uint32Array();
    rock_layer = () => new Uint8Array();
    free() {
      this.#check();
    }
  }
  const glue = {
    Generator,
    default: async () => {},
    fresh_seed: () => 1,
    memory_estimate: () => 1,
    ...(canReset && {
      __wbg_reset_state: () => {
        state.instance += 1;
        state.poisoned = false;
      },
    }),
  };
  return { glue: glue as unknown as GeneratorGlue, state };
}

test('after a trap the next run has a new instance, and other generators of the realm move to it', async () => {
  const { glue, state } = fakeGlue();
  const realm = new Realm(glue, () => new ArrayBuffer(0));
  const [a, b] = [await openGenerator(both(realm)), await openGenerator(both(realm))];
  assert.equal((await b.generate({ seed: 1 })).stats.rocks, 1);
  await assert.rejects(a.generate({ seed: TRAP_SEED }), { name: 'Internal' });
  assert.equal((await a.generate({ seed: 2 })).stats.rocks, 2);
  assert.equal((await b.generate({ seed: 3 })).stats.rocks, 3);
  assert.equal(state.instance, 1);
  a.dispose();
  b.dispose();
});

test('a generator beside one that trapped does not run in the poisoned instance', async () => {
  const { glue, state } = fakeGlue();
  const realm = new Realm(glue, () => new ArrayBuffer(0));
  const [a, b] = [await openGenerator(both(realm)), await openGenerator(both(realm))];
  await b.generate({ seed: 1 });
  await assert.rejects(a.generate({ seed: TRAP_SEED }), { name: 'Internal' });
  assert.equal((await b.generate({ seed: 3 })).stats.rocks, 3);
  assert.equal(state.instance, 1);
});

test('where the instance cannot be replaced a trap is told at every further run', async () => {
  const realm = new Realm(fakeGlue({ canReset: false }).glue, () => new ArrayBuffer(0));
  const g = await openGenerator(both(realm));
  await assert.rejects(g.generate({ seed: TRAP_SEED }), { name: 'Internal' });
  await assert.rejects(g.generate({ seed: 1 }), /restart the process/);
});

/** What loading says when the server answers with this. */
async function refusal(answer: () => Response | Promise<Response>): Promise<string> {
  const fetch = globalThis.fetch;
  globalThis.fetch = async () => answer();
  try {
    await loadGenerator(fakeGlue().glue, new URL('https://example.org/files/generator_bg.wasm?v=3'));
    return '';
  } catch (error) {
    const { name, message } = error as Error;
    assert.equal(name, 'WasmUnavailable');
    assert.match(japaneseFailure(message), /[ぁ-ん]/, message);
    return message;
  } finally {
    globalThis.fetch = fetch;
  }
}

test('wasm that is missing, a page instead of wasm, or no network is said in words', async () => {
  assert.match(await refusal(() => new Response('', { status: 404 })), /generator_bg\.wasm could not be fetched: the server answered 404/);
  assert.match(
    await refusal(() => new Response('<!doctype html>', { headers: { 'Content-Type': 'text/html' } })),
    /generator_bg\.wasm is not a wasm file: the server sent text\/html/,
  );
  assert.match(
    await refusal(() => Promise.reject(new TypeError('Failed to fetch'))),
    /generator_bg\.wasm could not be fetched; check the connection/,
  );
  assert.equal(
    await refusal(() => new Response(Uint8Array.of(0, 97, 115, 109), { headers: { 'Content-Type': 'application/octet-stream' } })),
    '',
  );
});

/** An answer whose body is what the test writes. */
function flowing() {
  let pipe!: ReadableStreamDefaultController<Uint8Array>;
  const body = new ReadableStream<Uint8Array>({
    start: (controller) => {
      pipe = controller;
    },
  });
  return { response: new Response(body, { headers: { 'Content-Type': 'application/octet-stream' } }), pipe };
}

test('a wasm file that stops arriving is a named error; one that arrives slowly is waited for', async (t) => {
  t.mock.timers.enable({ apis: ['setTimeout'] });
  const tick = async (ms: number) => {
    t.mock.timers.tick(ms);
    for (let turn = 0; turn < 5; turn += 1) await new Promise((resolve) => setImmediate(resolve));
  };
  const { fetch } = globalThis;
  t.after(() => (globalThis.fetch = fetch));
  for (const stalls of [true, false]) {
    const { response, pipe } = flowing();
    globalThis.fetch = async (_, init) => {
      init?.signal?.addEventListener('abort', () => pipe.error(init.signal?.reason));
      return response;
    };
    const loading = loadGenerator(fakeGlue().glue, new URL('https://example.org/generator_bg.wasm')).then(
      () => '',
      (error: Error) => `${error.name} ${error.message}`,
    );
    await tick(0);
    for (const byte of [0, 97, 115, 109]) {
      pipe.enqueue(Uint8Array.of(byte));
      await tick(0);
      await tick(STALL_MS - 1);
    }
    if (stalls) await tick(1);
    else pipe.close();
    assert.equal(await loading, stalls ? 'WasmUnavailable generator_bg.wasm stopped arriving after 4 bytes; check the connection' : '');
  }
});

test("a connection that breaks and a file that does not compile are told apart, in our words; the engine's are the cause", async () => {
  const { response, pipe } = flowing();
  const broken = refusal(() => response);
  pipe.enqueue(Uint8Array.of(0, 97));
  pipe.error(new TypeError('network error'));
  assert.match(await broken, /^generator_bg\.wasm could not be fetched; check the connection$/);
  const engine = new WebAssembly.CompileError('expected 10 bytes at offset 8');
  const damaged = { ...fakeGlue().glue, default: () => Promise.reject(engine) };
  await assert.rejects(
    loadGenerator(damaged, new ArrayBuffer(8)),
    (error: Error) =>
      error.cause === engine && error.name === 'WasmUnavailable' && /damaged/.test(error.message) && !error.message.includes('offset'),
  );
  const forbidden = {
    ...fakeGlue().glue,
    default: () => Promise.reject(new WebAssembly.CompileError('violates the Content Security Policy')),
  };
  await assert.rejects(loadGenerator(forbidden, new ArrayBuffer(8)), /'wasm-unsafe-eval'/);
});

test('a load that failed is tried again', async () => {
  const { glue } = fakeGlue();
  let tries = 0;
  const realm = new Realm(glue, () => {
    tries += 1;
    return tries === 1 ? Promise.reject(new Error('ENOENT')) : new ArrayBuffer(0);
  });
  await assert.rejects(openGenerator(both(realm)), { name: 'WasmUnavailable' });
  const g = await openGenerator(both(realm));
  assert.equal((await g.generate({ seed: 5 })).stats.rocks, 5);
});
