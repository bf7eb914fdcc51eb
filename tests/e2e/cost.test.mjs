// What an embed costs its page: what it fetches, and that a drag shows nothing that is out of date.
/** @import { Page } from 'playwright-core' */
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import path from 'node:path';
import { test } from 'node:test';
import { dist } from '../../scripts/lib/env.mjs';
import { plainName } from '../../scripts/build/hashed-names.mjs';
import { brotli } from '../../scripts/build/size.mjs';
import { metafile, scriptsOf } from '../../scripts/build/web.mjs';
import { launch, pageOf, staysQuietFor } from './browser.mjs';

/** Bytes after brotli; as heavy as `<model-viewer>` is without its models, less 10 kB. */
const COLD_EMBED_BUDGET = 225_000;

/** Fetched beside the rest where the field is ready before the renderer has come, which depends on the machine: always counted. */
const STAND_IN = 'later:www/scene/stand-in.ts';

const pageWith = (element) =>
  `<!doctype html><html lang="en"><meta charset="utf-8"><title>cost</title><link rel="icon" href="data:,">${element}<script type="module" src="/rock-field.js"></script>`;

async function withPage(element, use) {
  const asked = [];
  const session = await launch({ webgpu: true, intercept: pageOf('cost.html', () => pageWith(element)) });
  try {
    const prepare = (/** @type {Page} */ page) => page.context().on('request', (request) => asked.push(new URL(request.url())));
    const { page, errors } = await session.open('cost.html', { prepare });
    await page.evaluate(() => customElements.whenDefined('rock-field').then(() => document.querySelector('rock-field').ready));
    await use(page, asked);
    assert.deepEqual(errors, []);
  } finally {
    await session.close();
  }
}

test('a cold embed on WebGPU fetches one renderer, one generator and nothing beside them, within its budget', async () => {
  await withPage('<rock-field></rock-field>', async (/** @type {Page} */ page, asked) => {
    await staysQuietFor(page, 1500);
    const names = asked
      .filter(({ protocol }) => protocol === 'http:')
      .map(({ pathname }) => pathname.slice(1))
      .filter((name) => name !== 'cost.html');
    // A script that the page and its worker share is asked for by both, and counted twice.
    assert.deepEqual(
      names
        .map(plainName)
        .filter((name) => name.endsWith('.wasm'))
        .sort(),
      ['generator_bg.wasm', 'renderer-webgpu_bg.wasm'],
    );
    const standIn = scriptsOf(JSON.parse(readFileSync(metafile, 'utf8')), STAND_IN).filter((name) => !names.includes(name));
    const sizes = [...names, ...standIn].map((name) => [name, brotli(readFileSync(path.join(dist, name)))]);
    const total = sizes.reduce((sum, [, bytes]) => sum + bytes, 0);
    console.log(
      `cold embed: ${(total / 1000).toFixed(1)} kB brotli in ${sizes.length} files: ${sizes.map(([name, bytes]) => `${name} ${(bytes / 1000).toFixed(1)}`).join(', ')}`,
    );
    assert(total <= COLD_EMBED_BUDGET, `${total} bytes after brotli; at most ${COLD_EMBED_BUDGET}`);
  });
});

test('a drag shows newer and newer fields, and ends with the newest', async () => {
  await withPage('<rock-field></rock-field>', async (/** @type {Page} */ page) => {
    const seen = await page.evaluate(async () => {
      const element = document.querySelector('rock-field');
      const shown = [];
      // More and more of the ground: which field it is can be told from the field itself.
      element.addEventListener('generate', ({ detail }) => shown.push(detail.field.layers[2].areaFraction));
      let asked = 0.1;
      // Without a pause, until some have been seen.
      while (shown.length < 6) {
        asked += 0.0005;
        element.layers = element.layers.map((layer, index) => (index === 2 ? { ...layer, areaFraction: asked } : layer));
        await new Promise((resolve) => setTimeout(resolve, 8));
      }
      await element.getField();
      return { shown, asked, last: element.field.layers[2].areaFraction };
    });
    assert.deepEqual(
      seen.shown,
      seen.shown.toSorted((a, b) => a - b),
      'a field was shown after a newer one',
    );
    assert(Math.abs(seen.last - seen.asked) < 1e-6);
  });
});
