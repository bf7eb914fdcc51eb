// Offline use, and that it never shows an old build: the service worker against the built page.
/** @import { Page } from 'playwright-core' */
import assert from 'node:assert/strict';
import { rmSync } from 'node:fs';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { root } from '../../scripts/lib/env.mjs';
import { buildWeb } from '../../scripts/build/web.mjs';
import { launch, until, untilIn } from './browser.mjs';

const folder = path.join(root, '.cache', 'offline-test');
/** The page with few rocks. */
const SMALL = '#preset=journal-fig1&w=256&h=256';
/** A stroke, as links have it. */
const STROKES = 'BAggBggEggE';

/** @type {import('./browser.mjs').Session} */
let session;
let down = false;
const served = [];

before(async () => {
  rmSync(folder, { recursive: true, force: true });
  await buildWeb({ to: folder, mark: 'first' });
  session = await launch({
    folder,
    intercept(request) {
      if (down) request.socket.destroy();
      else served.push(request.url);
      return down;
    },
  });
});

after(async () => {
  await session?.close();
  rmSync(folder, { recursive: true, force: true });
});

test('the second scene works offline too, after one visit', async () => {
  const { page, close } = await session.open('wood-ear.html#preset=thesis-default&d=20&r=25', { serviceWorkers: 'allow' });
  await page.evaluate(() => navigator.serviceWorker.ready);
  await keptRenderer(page);
  await kept(page, /wood-ear_bg-/);
  down = true;
  await page.reload({ waitUntil: 'load' });
  await page.waitForFunction(() => document.querySelector('wood-ear-log')?.scene, undefined, { polling: 100 });
  down = false;
  await close();
});

test('after one visit the page works without a network, and a new deploy is seen at once', async () => {
  const { page, close } = await session.open(SMALL, { serviceWorkers: 'allow' });
  await page.evaluate(() => navigator.serviceWorker.ready);
  await keptRenderer(page);

  const failed = [];
  page.on('requestfailed', (request) => failed.push(request.url()));
  const workers = page.waitForEvent('worker');
  down = true;
  await page.reload({ waitUntil: 'load' });
  await workers;
  await untilIn(page, () => performance.getEntriesByType('resource').some(({ name }) => /renderer-web\w+_bg-\w+\.wasm/.test(name)));
  assert.deepEqual(failed, [], 'everything the page asked for offline was there');
  down = false;

  await page.reload({ waitUntil: 'load' });
  served.length = 0;
  await page.reload({ waitUntil: 'load' });
  assert.ok(!served.some((url) => /main-/.test(url)), 'scripts of the same build come from the cache');

  await buildWeb({ to: folder, mark: 'second' });
  await page.reload({ waitUntil: 'load' });
  assert.deepEqual(
    await page.evaluate(() => [...globalThis.rockFieldMarks]),
    ['second'],
    'the first load after a deploy runs the new code',
  );

  await untilIn(page, async () => Boolean((await navigator.serviceWorker.getRegistration())?.waiting));
  const caches = await page.evaluate(async () => (await globalThis.caches.keys()).filter((name) => /:\w{16}$/.test(name)));
  assert.equal(caches.length, 2, 'the old build stays whole until its last page is closed');
  await close();
});

test('what is painted is shown offline where the full generator has been used, and refused in words where it has not', async () => {
  const used = await session.open(`${SMALL}&strokes=${STROKES}`, { serviceWorkers: 'allow' });
  await used.page.evaluate(() => navigator.serviceWorker.ready);
  await kept(used.page, /generator-full_bg-/);
  await keptRenderer(used.page);
  down = true;
  await used.page.reload({ waitUntil: 'load' });
  await used.page.waitForFunction(() => document.querySelector('rock-field')?.field, undefined, { polling: 100 });
  down = false;
  await used.close();

  const { page, close } = await session.open(SMALL, { serviceWorkers: 'allow' });
  await page.evaluate(() => navigator.serviceWorker.ready);
  await keptRenderer(page);
  const paint = () =>
    page.evaluate(async (strokes) => {
      const element = /** @type {import('../../www/entries/element.ts').RockFieldElement} */ (document.querySelector('rock-field'));
      const before = await element.getField();
      element.strokes = strokes;
      const thrown = await element.getField().then(
        () => undefined,
        (/** @type {Error} */ error) => error,
      );
      return [thrown?.name, thrown?.message, element.strokes, element.field === before];
    }, STROKES);
  down = true;
  const [name, message, strokes, isSame] = await paint();
  assert.equal(name, 'WasmUnavailable');
  assert.match(String(message), /^generator-full_bg-\w+\.wasm could not be fetched; check the connection$/);
  assert.deepEqual([strokes, isSame], ['', true]);
  down = false;
  assert.deepEqual(await paint(), [undefined, undefined, STROKES, false]);
  await close();
});

test('old caches go when the new worker takes over', async () => {
  const { page, close } = await session.open(SMALL, { serviceWorkers: 'allow' });
  await page.evaluate(async () =>
    (await caches.open('rock-field-0123456789abcdef')).put(new URL('./', location.href), new Response('of yore')),
  );
  await page.evaluate(() => navigator.serviceWorker.ready);
  await untilIn(page, async () => !(await caches.has('rock-field-0123456789abcdef')));
  await close();
});

/** Waits until the page has had its renderer kept, which it does once its first picture stands. */
function keptRenderer(/** @type {Page} */ page) {
  return kept(page, /renderer-web\w+_bg-\w+\.wasm/);
}

/** Waits until a file is kept whose name is like this. */
function kept(/** @type {Page} */ page, /** @type {RegExp} */ like) {
  return until(async () => (await page.evaluate(keptFiles)).some((url) => like.test(url)), keptFiles);
}

async function keptFiles() {
  const names = await caches.keys();
  return (await Promise.all(names.map(async (name) => (await caches.open(name)).keys()))).flat().map(({ url }) => url);
}
