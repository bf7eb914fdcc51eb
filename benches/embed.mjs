// `npm run bench -- --embed`: what an embed makes its visitors wait for, in Chromium.
//
// The first field is timed beside a bare page that does what cannot be avoided: it fetches and compiles the same wasm files, makes
// the device, clears a canvas and generates once. Both wait until the device has done its work. The GPU is software here, which
// draws the rocks slowly: on a real one the ratio is smaller.
import { readdirSync } from 'node:fs';
import { dist } from '../scripts/lib/env.mjs';
import { plainName } from '../scripts/build/hashed-names.mjs';
import { launch } from '../tests/e2e/browser.mjs';

const SIZE = 'width: 400px; height: 300px';
const head = '<!doctype html><html lang="en"><meta charset="utf-8"><title>embed</title><link rel="icon" href="data:,">';

const ELEMENT = `${head}<rock-field style="${SIZE}"></rock-field><script type="module" src="/rock-field.js"></script><script>
  globalThis.done = customElements.whenDefined('rock-field').then(() => document.querySelector('rock-field').ready).then(() => performance.now());
</script>`;

const BARE = `${head}<canvas style="${SIZE}"></canvas><script type="module">
  import { generate } from '/core.js';
  const adapter = navigator.gpu.requestAdapter();
  const module = WebAssembly.compileStreaming(fetch('/${readdirSync(dist).find((name) => plainName(name) === 'renderer-webgpu_bg.wasm')}'));
  const field = generate({ preset: 'journal-fig1' });
  const device = await (await adapter).requestDevice();
  const context = document.querySelector('canvas').getContext('webgpu');
  context.configure({ device, format: navigator.gpu.getPreferredCanvasFormat() });
  await Promise.all([module, field]);
  const encoder = device.createCommandEncoder();
  encoder.beginRenderPass({ colorAttachments: [{ view: context.getCurrentTexture().createView(), loadOp: 'clear', storeOp: 'store' }] }).end();
  device.queue.submit([encoder.finish()]);
  globalThis.done = performance.now();
</script>`;

const PAGES = { '/element.html': ELEMENT, '/bare.html': BARE };

export async function measureEmbed(rounds) {
  const session = await launch({
    webgpu: true,
    intercept(request, response) {
      const html = PAGES[request.url];
      if (html) response.writeHead(200, { 'content-type': 'text/html' }).end(html);
      return Boolean(html);
    },
  });
  try {
    const times = { element: [], bare: [] };
    for (let round = 0; round <= rounds; round += 1) {
      for (const name of Object.keys(times)) {
        const { page, close } = await session.open(`${name}.html`, { deviceScaleFactor: 1 });
        const ms = await page.waitForFunction(() => globalThis.done).then((handle) => handle.jsonValue());
        // The first round warms the browser up.
        if (round > 0) times[name].push(ms);
        await close();
      }
    }
    return { first: median(times.element), bare: median(times.bare), drag: await drag(session) };
  } finally {
    await session.close();
  }
}

/** A slider dragged for three seconds, an edit with every frame: the longest tasks of the page's thread, ms. */
async function drag(session) {
  const { page, close } = await session.open('element.html', { deviceScaleFactor: 1 });
  await page.waitForFunction(() => globalThis.done);
  const seen = await page.evaluate(async () => {
    const element = document.querySelector('rock-field');
    await element.getField();
    await new Promise((resolve) => setTimeout(resolve, 500));
    const tasks = [];
    const observer = new PerformanceObserver((list) => tasks.push(...list.getEntries().map(({ duration }) => duration)));
    observer.observe({ entryTypes: ['longtask'] });
    let fields = 0;
    element.addEventListener('generate', () => (fields += 1));
    const end = performance.now() + 3000;
    for (let height = 5; performance.now() < end; height += 0.1) {
      element.heightBase = element.heightBase.map(() => height);
      await new Promise((resolve) => requestAnimationFrame(resolve));
    }
    await element.getField();
    await new Promise((resolve) => setTimeout(resolve, 300));
    return { fields, tasks };
  });
  await close();
  return seen;
}

function median(values) {
  const sorted = values.toSorted((a, b) => a - b);
  return sorted[sorted.length >> 1];
}

export function reportEmbed({ first, bare, drag: { fields, tasks } }, rounds) {
  const ratio = first / bare;
  return [
    `Cold embed in Chromium, WebGPU in software, medians of ${rounds}`,
    `first field on screen    ${first.toFixed(0).padStart(6)} ms`,
    `bare page                ${bare.toFixed(0).padStart(6)} ms   ${ratio.toFixed(2)}×   ${ratio <= 1.5 ? '✓' : '✗ MISSED:'} at most 1.5`,
    `drag of 3 s              ${String(fields).padStart(6)} fields shown; tasks of more than 50 ms: ${tasks.length === 0 ? 'none ✓' : `✗ ${tasks.map(Math.round).join(', ')} ms`}`,
  ].join('\n');
}
