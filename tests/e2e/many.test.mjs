// Many elements on one page, and one after the other: what they share, and what they leave behind.
/** @import { Page } from 'playwright-core' */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { PNG } from 'pngjs';
import { PATIENCE, launch, pageOf, screenshotPath } from './browser.mjs';

/** Counts what a page can run out of. */
const COUNTERS = `
  globalThis.counts = { frames: 0, contexts: [], devices: 0, workers: 0, ended: 0, listeners: 0 };
  const raf = requestAnimationFrame;
  globalThis.requestAnimationFrame = (callback) => { counts.frames += 1; return raf(callback); };
  const { getContext } = HTMLCanvasElement.prototype;
  HTMLCanvasElement.prototype.getContext = function (...args) {
    const context = getContext.apply(this, args);
    // Not held: a context holds its canvas.
    if (args[0] === 'webgl2' && context && !counts.contexts.some((known) => known.deref() === context)) counts.contexts.push(new WeakRef(context));
    return context;
  };
  const living = () => counts.contexts.filter((known) => known.deref()?.isContextLost() === false).length;
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
const pageWith = (
  body,
) => `<!doctype html><html lang="en"><meta charset="utf-8"><title>many</title><link rel="icon" href="data:,"><script>${COUNTERS}</script>${GRID}${body}
<script type="module" src="/rock-field.js"></script>`;

/** Small fields, so that a software GPU gets through them. */
const SMALL = 'image-width="400" image-height="300"';

/** A whole test has ten times as long. */
const WHOLE_TEST_MS = 10 * PATIENCE;

async function withPage(webgpu, body, use, deviceScaleFactor = 1) {
  const session = await launch({
    webgpu,
    intercept: pageOf('many.html', () => pageWith(body)),
    args: ['--js-flags=--expose-gc', '--enable-precise-memory-info'],
  });
  // A page that hangs never answers: without its browser the test fails instead of waiting for ever.
  const watchdog = setTimeout(() => session.browser.close(), WHOLE_TEST_MS);
  try {
    const opened = await session.open('many.html', { viewport: { width: 1280, height: 720 }, deviceScaleFactor });
    await use(opened.page);
    assert.deepEqual(opened.errors, []);
  } finally {
    clearTimeout(watchdog);
    await session.close();
  }
}

/** A part of a picture, as PNG. */
function partOf(picture, { x, y, width, height }) {
  const part = new PNG({ width, height });
  PNG.bitblt(picture, part, x, y, width, height, 0, 0);
  return PNG.sync.write(part);
}

for (const webgpu of [false, true]) {
  const backend = webgpu ? 'webgpu' : 'webgl';

  // A browser has sixteen WebGL contexts for a page.
  const count = webgpu ? 8 : 18;

  test(`${count} elements are all painted, each with its own field, on one device, and then rest (${backend})`, async () => {
    const elements = Array.from({ length: count }, (_, seed) => `<rock-field ${SMALL} seed="${seed}"></rock-field>`).join('');
    await withPage(webgpu, elements, async (/** @type {Page} */ page) => {
      await page.evaluate(() =>
        customElements
          .whenDefined('rock-field')
          .then(() => Promise.all([...document.querySelectorAll('rock-field')].map(({ ready }) => ready))),
      );
      const seen = await page.evaluate(async () => {
        const before = { ...held(), backends: [...new Set([...document.querySelectorAll('rock-field')].map(({ backend }) => backend))] };
        for (let frames = -1; frames !== counts.frames; await sleep(1500)) frames = counts.frames;
        return before;
      });
      assert.deepEqual(seen.backends, [backend]);
      assert.deepEqual([seen.contexts, seen.devices], webgpu ? [0, 1] : [1, 0]);
      assert(seen.workers <= 4, `${seen.workers} workers`);
      const shown = PNG.sync.read(await page.screenshot({ path: screenshotPath(`many-${backend}`) }));
      // What is on the screen, not what a canvas says of itself.
      const boxes = await page.evaluate(() =>
        [...document.querySelectorAll('rock-field')].map((element) => {
          const { x, y, width, height } = element.getBoundingClientRect();
          return { x, y, width, height };
        }),
      );
      const pictures = boxes.map((box) => partOf(shown, box).toString('base64'));
      assert.equal(new Set(pictures).size, count, 'two elements show the same picture');
      const blank = pictures.filter((picture) => picture.length < 20_000).length;
      assert.equal(blank, 0, `${blank} elements show next to nothing`);
    });
  });
}

for (const webgpu of [false, true]) {
  test(`130 elements, one after the other, leave nothing behind and the heap flat (${webgpu ? 'webgpu' : 'webgl'})`, async () => {
    await withPage(
      webgpu,
      '',
      async (/** @type {Page} */ page) => {
        const before = await page.evaluate(async () => {
          await customElements.whenDefined('rock-field');
          const state = held();
          // Keeps the device: Chromium's software WebGPU hangs now and then when the garbage of one is collected while the next is made.
          globalThis.anchor = document.createElement('rock-field');
          anchor.imageWidth = anchor.imageHeight = 200;
          document.body.append(anchor);
          await anchor.ready;
          return state;
        });
        const session = await page.context().newCDPSession(page);
        const measure = async () => {
          // Again and again: what one lets go of may have been holding something, and the browser clears up in tasks of its own.
          for (let pass = 0; pass < 4; pass += 1) {
            await session.send('HeapProfiler.collectGarbage');
            await page.waitForTimeout(150);
          }
          const { usedSize, embedderHeapUsedSize, backingStorageSize } = await session.send('Runtime.getHeapUsage');
          return usedSize + embedderHeapUsedSize + backingStorageSize;
        };
        const measured = [];
        for (let cycle = 1; cycle <= 130; cycle += 1) {
          await page.evaluate(async (seed) => {
            const element = document.createElement('rock-field');
            Object.assign(element.style, { width: `${200 + (seed % 7)}px` });
            element.seed = seed;
            element.imageWidth = element.imageHeight = 200;
            document.body.append(element);
            await element.ready;
            element.remove();
          }, cycle);
          // From 70 on: V8 lets go of code that has not run for a few collections.
          if (cycle < 70 || cycle % 10 > 0) continue;
          // The idle time of an element.
          await page.evaluate(() => sleep(1500));
          measured.push(await measure());
        }
        // The idle times of the last element and, after that, of its worker; what is let go of is told of in tasks of the browser's own.
        const after = await page.evaluate(
          async ({ before, patience }) => {
            anchor.remove();
            const end = performance.now() + patience;
            while (JSON.stringify(held()) !== JSON.stringify(before) && performance.now() < end) await sleep(100);
            return held();
          },
          { before, patience: PATIENCE },
        );
        assert.deepEqual(after, before);
        // What is not collected yet can only add to a measurement, so the smallest of three is the truest.
        const bytes = measured.slice(-6);
        const growth = Math.min(...bytes.slice(3)) / Math.min(...bytes.slice(0, 3)) - 1;
        assert(growth <= 0.02, `the heap grew by ${(100 * growth).toFixed(1)} % in the last 50 cycles: ${bytes}`);
      },
      0.25,
    );
  });
}
