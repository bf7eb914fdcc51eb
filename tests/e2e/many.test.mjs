// Many elements on one page, and one after the other: what they share, and what they leave behind.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { launch, pageOf, screenshotPath } from './browser.mjs';

/** Counts what a page can run out of. */
const COUNTERS = `
  globalThis.counts = { frames: 0, contexts: new Set(), devices: 0, workers: 0, ended: 0, listeners: 0 };
  const raf = requestAnimationFrame;
  globalThis.requestAnimationFrame = (callback) => { counts.frames += 1; return raf(callback); };
  const { getContext } = HTMLCanvasElement.prototype;
  HTMLCanvasElement.prototype.getContext = function (...args) {
    const context = getContext.apply(this, args);
    if (args[0] === 'webgl2' && context) counts.contexts.add(context);
    return context;
  };
  const living = () => [...counts.contexts].filter((context) => !context.isContextLost()).length;
  const { requestDevice } = globalThis.GPUAdapter?.prototype ?? {};
  if (requestDevice) GPUAdapter.prototype.requestDevice = async function (...args) {
    const device = await requestDevice.apply(this, args);
    counts.devices += 1;
    device.lost.then(() => (counts.devices -= 1));
    return device;
  };
  globalThis.Worker = class extends Worker {
    constructor(...args) { super(...args); counts.workers += 1; }
    terminate() { counts.ended += 1; super.terminate(); }
  };
  for (const target of [window, document]) {
    const { addEventListener, removeEventListener } = target;
    const heard = new Map();
    const keyOf = (type, options) => type + (options === true || options?.capture ? ' capture' : '');
    target.addEventListener = function (type, listener, options) {
      const key = keyOf(type, options);
      const list = heard.get(key) ?? new Set();
      heard.set(key, list);
      if (!list.has(listener)) {
        list.add(listener);
        counts.listeners += 1;
        options?.signal?.addEventListener('abort', () => list.delete(listener) && (counts.listeners -= 1));
      }
      return addEventListener.call(this, type, listener, options);
    };
    target.removeEventListener = function (type, listener, options) {
      if (heard.get(keyOf(type, options))?.delete(listener)) counts.listeners -= 1;
      return removeEventListener.call(this, type, listener, options);
    };
  }
  globalThis.held = () => ({ contexts: living(), devices: counts.devices, workers: counts.workers - counts.ended, listeners: counts.listeners });
  const sleep = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
`;

const GRID = `<style>body { margin: 8px; display: grid; grid-template-columns: repeat(6, 200px); gap: 8px } rock-field { width: 200px; height: 150px }</style>`;
const pageWith = (body) => `<!doctype html><html lang="en"><meta charset="utf-8"><title>many</title><link rel="icon" href="data:,"><script>${COUNTERS}</script>${GRID}${body}
<script type="module" src="/rock-field.js"></script>`;

/** Small fields, so that a software GPU gets through them. */
const SMALL = 'image-width="400" image-height="300"';

async function withPage(webgpu, body, use) {
  const session = await launch({ webgpu, intercept: pageOf('many.html', () => pageWith(body)), args: ['--js-flags=--expose-gc', '--enable-precise-memory-info'] });
  try {
    const opened = await session.open('many.html', { viewport: { width: 1280, height: 720 } });
    await use(opened.page);
    assert.deepEqual(opened.errors, []);
  } finally {
    await session.close();
  }
}

for (const webgpu of [false, true]) {
  const backend = webgpu ? 'webgpu' : 'webgl';

  test(`24 elements are all painted, each with its own field, on one device, and then rest (${backend})`, async () => {
    const elements = Array.from({ length: 24 }, (_, seed) => `<rock-field ${SMALL} seed="${seed}"></rock-field>`).join('');
    await withPage(webgpu, elements, async (page) => {
      await page.evaluate(() => customElements.whenDefined('rock-field').then(() => Promise.all([...document.querySelectorAll('rock-field')].map(({ ready }) => ready))));
      const seen = await page.evaluate(async () => {
        const before = { ...held(), backends: [...new Set([...document.querySelectorAll('rock-field')].map(({ backend }) => backend))] };
        await sleep(500);
        const { frames } = counts;
        await sleep(1500);
        return { ...before, frames: counts.frames - frames };
      });
      assert.deepEqual([seen.backends, seen.frames], [[backend], 0]);
      assert.deepEqual([seen.contexts, seen.devices], webgpu ? [0, 1] : [1, 0]);
      assert(seen.workers <= 4, `${seen.workers} workers`);
      await page.screenshot({ path: screenshotPath(`many-${backend}`) });
      // What is on the screen, not what a canvas says of itself.
      const pictures = [];
      for (const element of await page.locator('rock-field').all()) pictures.push((await element.screenshot()).toString('base64'));
      assert.equal(new Set(pictures).size, 24, 'two elements show the same picture');
      const blank = pictures.filter((picture) => picture.length < 20_000).length;
      assert.equal(blank, 0, `${blank} elements show next to nothing`);
    });
  });
}
