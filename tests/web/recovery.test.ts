// When a scene that is not drawn as it was asked for is tried again; time and the page's visibility are the test's.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { TestContext } from 'node:test';
import { ErrorPace } from '../../www/base/error-pace.ts';
import { RockFieldError, scriptUnavailable } from '../../www/base/errors.ts';
import type { ErrorInfo } from '../../www/base/errors.ts';
import { CAUTIOUS_WAIT_MS, FIRST_WAIT_MS, Recovery } from '../../www/renderer/recovery.ts';
import type { Refusal } from '../../www/renderer/load.ts';

const refusals = (...messages: string[]): Refusal[] =>
  messages.map((message, k) => ({ backend: k === 0 ? 'webgpu' : 'webgl', error: new Error(message) }));
const ABSENT = refusals('no graphics adapter', 'no WebGL2 context');

function setUp(t: TestContext, isBack: () => boolean | Promise<boolean> = () => false, arrived: () => number | null = () => null) {
  t.mock.timers.enable({ apis: ['setTimeout', 'setInterval'] });
  const page = Object.assign(new EventTarget(), { visibilityState: 'visible' });
  const restore = (['document', 'window'] as const).map((name) => {
    const before = Object.getOwnPropertyDescriptor(globalThis, name);
    Object.defineProperty(globalThis, name, { value: page, configurable: true });
    return () => (before ? Object.defineProperty(globalThis, name, before) : Reflect.deleteProperty(globalThis, name));
  });
  t.after(() => restore.forEach((undo) => undo()));
  const counts = { tries: 0, said: 0 };
  const recovery: Recovery = new Recovery(
    {
      again: async () => {
        counts.tries += 1;
        const back = await isBack();
        if (back) recovery.end();
        return back;
      },
      said: () => (counts.said += 1),
    },
    arrived,
  );
  const pass = async (ms: number) => {
    t.mock.timers.tick(ms);
    await settled();
  };
  return { recovery, counts, page, pass };
}

const settled = () => new Promise<void>((resolve) => setImmediate(resolve));

test('3D is tried again at ever longer intervals, a minute at most', async (t) => {
  const { recovery, counts, pass } = setUp(t);
  recovery.begin(ABSENT, 1, false);
  const tried: number[] = [];
  for (let second = 1; second <= 300; second += 1) {
    const before = counts.tries;
    await pass(1000);
    if (counts.tries > before) tried.push(second);
  }
  assert.deepEqual(tried.slice(0, 7), [1, 3, 7, 15, 31, 63, 123]);
  assert.equal(counts.tries, 9);
});

test('while a try fetches the renderer, it is said how much of it has come, and no other try is offered', async (t) => {
  let arrived: number | null = null;
  let finish: (isBack: boolean) => void = () => {};
  const { recovery, counts, pass } = setUp(
    t,
    () => new Promise((resolve) => (finish = resolve)),
    () => arrived,
  );
  recovery.begin(ABSENT, 1, false);
  const reason = recovery.words('en');
  const said = () => [recovery.words('en'), recovery.words('ja'), recovery.canRetry];
  await pass(FIRST_WAIT_MS);
  assert.deepEqual([counts.tries, recovery.words('en'), recovery.canRetry], [1, reason, true]);
  arrived = 0;
  await pass(200);
  assert.deepEqual([recovery.words('en'), recovery.canRetry], [reason, true], 'a server that answers nothing is not loaded from');
  arrived = 0.42;
  await pass(200);
  assert.deepEqual(said(), ['Loading the renderer 40 %', '3D 描画プログラムを読み込み中：40 %', false]);
  const { said: before } = counts;
  await pass(200);
  assert.equal(counts.said, before, 'nothing new is not said');
  arrived = null;
  finish(false);
  await pass(0);
  assert.deepEqual([recovery.words('en'), recovery.canRetry], [reason, true]);
  assert.ok(counts.said > before);
});

test('after losses in a row the first try comes later, and no sooner after another loss', async (t) => {
  let isBack = true;
  const { recovery, counts, pass } = setUp(t, () => isBack);
  recovery.begin([], 4, true);
  await pass(CAUTIOUS_WAIT_MS - 1);
  assert.equal(counts.tries, 0);
  await pass(1);
  assert.equal(counts.tries, 1);
  isBack = false;
  recovery.begin([], 4, true);
  await pass(2 * CAUTIOUS_WAIT_MS - 1);
  assert.equal(counts.tries, 1);
  await pass(1);
  assert.equal(counts.tries, 2);
});

test('a hidden page is left alone, and tried at once when it is seen', async (t) => {
  const { recovery, counts, page, pass } = setUp(t);
  page.visibilityState = 'hidden';
  recovery.begin(ABSENT, 1, false);
  await pass(600_000);
  page.dispatchEvent(new Event('visibilitychange'));
  await settled();
  assert.equal(counts.tries, 0);
  page.visibilityState = 'visible';
  page.dispatchEvent(new Event('visibilitychange'));
  await settled();
  assert.equal(counts.tries, 1);
  page.dispatchEvent(new Event('online'));
  await settled();
  assert.equal(counts.tries, 2);
});

test('once the picture is back nothing is tried or said any more', async (t) => {
  const { recovery, counts, page, pass } = setUp(t, () => true);
  recovery.begin(ABSENT, 1, false);
  assert.notEqual(recovery.words('en'), '');
  await pass(FIRST_WAIT_MS);
  assert.equal(counts.tries, 1);
  assert.equal(recovery.words('en'), '');
  page.dispatchEvent(new Event('visibilitychange'));
  await recovery.retry();
  await pass(600_000);
  assert.equal(counts.tries, 1);
});

test('the words say what is true: no GPU, lost, lost often, busy, or files that did not arrive', (t) => {
  const { recovery } = setUp(t);
  const unavailable: Refusal = {
    backend: 'webgl',
    error: new RockFieldError({ name: 'WasmUnavailable', message: 'renderer-webgl_bg.wasm could not be fetched: the server answered 404' }),
  };
  for (const [given, losses, isTooMany, wanted] of [
    [ABSENT, 0, false, /neither WebGPU nor WebGL2/],
    [refusals('this browser has no WebGPU', 'no WebGL2 context'), 0, false, /neither WebGPU nor WebGL2/],
    [ABSENT, 1, false, /was lost;/],
    [[], 4, true, /several times/],
    [refusals('no graphics adapter', 'the graphics adapter refused a device: busy'), 0, false, /at the moment/],
    [[...refusals('no graphics adapter'), unavailable], 0, false, /could not be loaded/],
    [[unavailable], 2, false, /could not be loaded/],
    [[{ backend: 'webgl', error: scriptUnavailable('it does not arrive') }], 0, false, /could not be loaded/],
  ] as const) {
    recovery.begin(given, losses, isTooMany);
    assert.match(recovery.words('en'), wanted);
    assert.match(recovery.words('ja'), /平面図/);
    recovery.end();
  }
});

test('errors are told at most once a second, equal ones once, and none of another kind is lost', (t) => {
  t.mock.timers.enable({ apis: ['setTimeout'] });
  const told: string[] = [];
  const pace = new ErrorPace(({ error: { name, message } }) => told.push(`${name} ${message}`));
  const push = (name: ErrorInfo['name'], message: string, key?: string) => pace.push({ error: { name, message, key }, shown: true });
  push('WorkerLost', 'first');
  assert.deepEqual(told, ['WorkerLost first']);
  for (let k = 0; k < 5000; k += 1) push('WorkerLost', `again ${k}`);
  push('OutOfRange', 'a', 'packing');
  push('OutOfRange', 'b', 'seed');
  assert.equal(told.length, 1);
  for (let second = 1; second <= 5; second += 1) {
    t.mock.timers.tick(1000);
    assert.ok(told.length <= second + 1);
  }
  assert.deepEqual(told, ['WorkerLost first', 'WorkerLost again 4999', 'OutOfRange a', 'OutOfRange b']);
  push('WorkerLost', 'much later');
  assert.equal(told.at(-1), 'WorkerLost much later');
});
