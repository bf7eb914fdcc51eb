// Offline use, and that it never shows an old build: the service worker against the built page.
/** @import { Page } from 'playwright-core' */
import assert from 'node:assert/strict';
import { rmSync } from 'node:fs';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { root } from '../../scripts/lib/env.mjs';
import { buildWeb } from '../../scripts/build/web.mjs';
import { launch, untilIn } from './browser.mjs';

const folder = path.join(root, '.cache', 'offline-test');
/** The page with few rocks. */
const SMALL = '#preset=journal-fig1&w=256&h=256';

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
  await untilIn(page, async () =>
    (await Promise.all((await caches.keys()).map(async (name) => (await caches.open(name)).keys())))
      .flat()
      .some(({ url }) => /wood-ear_bg-/.test(url)),
  );
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
  return untilIn(page, async () => {
    for (const name of await caches.keys()) {
      const kept = await (await caches.open(name)).keys();
      if (kept.some(({ url }) => /renderer-web\w+_bg-\w+\.wasm/.test(url))) return true;
    }
    return false;
  });
}
