// The generator in a real worker of a real browser: the same bytes as in Node, and what happens when things are missing or die.
/** @import { Page } from 'playwright-core' */
import assert from 'node:assert/strict';
import { createHash } from 'node:crypto';
import { after, before, test } from 'node:test';
import { createGenerator, presets, strokesToText } from 'rock-field/core';
import { plainName } from '../../scripts/build/hashed-names.mjs';
import { holdTimers, launch } from './browser.mjs';

/** A page with nothing but the element, and what its events said. `null` draws nothing: these tests are about the generator. */
const HTML = `<!doctype html><meta charset="utf-8"><title>generator</title><link rel="icon" href="data:,">
<script>
  globalThis.heard = [];
  for (const type of ['generate', 'error', 'progress', 'load', 'notice']) {
    document.addEventListener(type, ({ detail }) => heard.push({ type, error: detail?.error, rocks: detail?.stats?.rocks }), true);
  }
</script>
<rock-field backend="null" seed="1"></rock-field>
<script type="module" src="/rock-field.js"></script>`;

/** @type {(Partial<import('../../www/rocks/params.ts').Params> & { preset: keyof typeof presets })[]} */
const CASES = [
  { preset: 'journal-fig1', seed: 42 },
  { preset: 'conference-fig1', seed: 7, imageWidth: 500, imageHeight: 300 },
  { preset: 'journal-fig12b', seed: 4294967295, border: 'drop', swing: 'separate', darts: 'attempts' },
];

/** @type {import('./browser.mjs').Session} */
let session;
/**
 * Answers requests in the server's stead, per test: path → [status, type, body].
 *
 * @typedef {Record<string, [status: number, type: string, body: string]>} Files
 * @type {Files}
 */
let broken = {};

before(async () => {
  session = await launch({
    intercept(request, response) {
      const { pathname } = new URL(request.url, 'http://localhost');
      const answer = broken[plainName(pathname)] ?? (pathname === '/element.html' ? [200, 'text/html', HTML] : undefined);
      if (!answer) return false;
      response.writeHead(answer[0], { 'content-type': answer[1] }).end(answer[2]);
      return true;
    },
  });
});

after(() => session?.close());

/** @param {import('./browser.mjs').OpenOptions & { files?: Files }} [options] */
async function open({ files = {}, ...options } = {}) {
  broken = files;
  return session.open('element.html', options);
}

function hashOf(lists) {
  const hash = createHash('sha256');
  for (const list of lists) hash.update(Buffer.from(list.buffer, list.byteOffset, list.byteLength));
  return hash.digest('hex');
}

function listsOf(field) {
  return [
    field.positions,
    field.normals,
    field.indices,
    field.rockStarts,
    field.vertexStarts,
    field.rockLayer,
    ...field.layers.flatMap((layer) => [layer.sites, layer.cellStarts, layer.cellVertices, layer.selected]),
  ];
}

/** In the page: `hashOf(listsOf(field))` of the element's field. */
async function digest() {
  const field = await document.querySelector('rock-field').getField();
  const lists = [
    field.positions,
    field.normals,
    field.indices,
    field.rockStarts,
    field.vertexStarts,
    field.rockLayer,
    ...field.layers.flatMap((layer) => [layer.sites, layer.cellStarts, layer.cellVertices, layer.selected]),
  ];
  const all = await new Blob(/** @type {BlobPart[]} */ (lists)).arrayBuffer();
  const bytes = new Uint8Array(await crypto.subtle.digest('SHA-256', all));
  return [...bytes].map((byte) => byte.toString(16).padStart(2, '0')).join('');
}

async function until(/** @type {Page} */ page, /** @type {() => boolean} */ test) {
  await page.waitForFunction(test);
}

test('the worker makes the same bytes as Node', async () => {
  const { page, errors, close } = await open();
  const g = await createGenerator();
  for (const request of CASES) {
    const wanted = hashOf(listsOf(await g.generate(request)));
    const { preset, ...rest } = request;
    const params = { ...presets[preset], ...rest };
    await page.evaluate((given) => Object.assign(document.querySelector('rock-field'), { params: given }), params);
    assert.equal(await page.evaluate(digest), wanted, JSON.stringify(request));
  }
  g.dispose();
  assert.deepEqual(errors, []);
  await close();
});

test('an element fetches the generator that its field needs, and another one when an edit asks for it', async () => {
  const strokes = strokesToText([{ mode: 'erase', width: 0.25, points: [0.5, 0.5] }]);
  const g = await createGenerator();
  const wanted = { plain: hashOf(listsOf(await g.generate({ seed: 1 }))), full: hashOf(listsOf(await g.generate({ seed: 1, strokes }))) };
  g.dispose();
  for (const first of ['plain', 'full']) {
    /** @type {string[]} */
    const asked = [];
    const { page, errors, close } = await open({
      files: first === 'full' ? { '/element.html': [200, 'text/html', HTML.replace('seed="1"', `seed="1" strokes="${strokes}"`)] } : {},
      prepare: (page) => page.context().on('request', (request) => asked.push(plainName(new URL(request.url()).pathname))),
    });
    const fetched = () => asked.filter((name) => /generator(-full)?_bg\.wasm$/.test(name));
    assert.equal(await page.evaluate(digest), wanted[first]);
    assert.deepEqual(fetched(), [first === 'full' ? '/generator-full_bg.wasm' : '/generator_bg.wasm']);
    await page.evaluate((text) => Object.assign(document.querySelector('rock-field'), { strokes: text }), first === 'full' ? '' : strokes);
    assert.equal(await page.evaluate(digest), wanted[first === 'full' ? 'plain' : 'full']);
    assert.deepEqual(fetched(), first === 'full' ? ['/generator-full_bg.wasm'] : ['/generator_bg.wasm', '/generator-full_bg.wasm']);
    assert.deepEqual(errors, []);
    await close();
  }
});

test('`core.js` makes fields on the page itself, without a worker', async () => {
  const { page, errors, close } = await session.open('#preset=journal-fig1&w=64&h=64');
  const [rocks, name, key] = await page.evaluate(async () => {
    const { createGenerator, generate } = await import('/core.js');
    const field = await generate({ imageWidth: 300, imageHeight: 300, seed: 5 });
    const g = await createGenerator();
    const error = await g.generate({ seed: 0.5 }).catch((thrown) => thrown);
    g.dispose();
    return [field.stats.rocks, error.name, error.key];
  });
  const g = await createGenerator();
  assert.equal(rocks, (await g.generate({ imageWidth: 300, imageHeight: 300, seed: 5 })).stats.rocks);
  g.dispose();
  assert.deepEqual([name, key], ['NotAnInteger', 'seed']);
  assert.deepEqual(errors, []);
  await close();
});

test('a drag shows results all the way and ends at its last request', async () => {
  const { page, errors, close } = await open();
  await until(page, () => heard.some(({ type }) => type === 'generate'));
  const result = await page.evaluate(async () => {
    const element = document.querySelector('rock-field');
    heard.length = 0;
    const params = element.params;
    const shown = () => heard.filter(({ type }) => type === 'generate').length;
    for (let seed = 101; shown() < 5; seed += 1) {
      element.params = { ...params, seed };
      await new Promise((resolve) => setTimeout(resolve, 16));
    }
    const field = await element.getField();
    return { isLast: element.field === field, errors: heard.filter(({ type }) => type === 'error') };
  });
  assert.deepEqual(result, { isLast: true, errors: [] });
  assert.deepEqual(errors, []);
  await close();
});

test('a long run tells its progress, leaves the page alive, can be cancelled softly, and the same worker goes on', async () => {
  const { page, errors, close } = await open();
  await until(page, () => heard.some(({ type }) => type === 'generate'));
  const [before] = page.workers();
  // A worker that does not answer a cancel within 100 ms is replaced: on a busy machine, any.
  await page.evaluate(holdTimers, 100);
  const seen = await page.evaluate(async () => {
    const element = document.querySelector('rock-field');
    heard.length = 0;
    element.params = { ...element.params, imageWidth: 8192, imageHeight: 8192 };
    let name = '';
    element.getField().then(
      () => (name = 'finished'),
      (error) => (name = error.name),
    );
    element.addEventListener('progress', () => element.cancel(), { once: true });
    let turns = 0;
    for (; name === ''; turns += 1) await new Promise((resolve) => setTimeout(resolve));
    element.params = { ...element.params, imageWidth: 256, imageHeight: 256 };
    const next = await element.getField();
    return [name, turns > 1, next.imageWidth, heard.filter(({ type }) => type === 'generate').length];
  });
  assert.deepEqual(seen, ['AbortError', true, 256, 1]);
  assert.deepEqual(page.workers(), [before]);
  assert.deepEqual(await page.evaluate(() => heard.filter(({ type }) => type === 'error')), []);
  assert.deepEqual(errors, []);
  await close();
});

test('a worker that is killed, idle or in a run, is replaced and the page goes on', async () => {
  const { page, errors, close } = await open();
  await until(page, () => heard.some(({ type }) => type === 'generate'));
  const edit = (seed, side) =>
    page.evaluate(
      ([seed, side]) => {
        const element = document.querySelector('rock-field');
        element.params = { ...element.params, seed, imageWidth: side, imageHeight: side };
        return element.getField().then((field) => field.imageWidth);
      },
      [seed, side],
    );

  await page.workers()[0].evaluate(() => self.close());
  assert.equal(await edit(2, 300), 300);
  assert.deepEqual(await page.evaluate(() => heard.filter(({ type }) => type === 'error')), []);

  await page.evaluate(() => (heard.length = 0));
  const run = edit(3, 4096);
  await until(page, () => heard.some(({ type }) => type === 'progress'));
  const workers = page.workers();
  await workers[workers.length - 1].evaluate(() => self.close()).catch(() => {});
  assert.equal(await run, 4096);
  assert.deepEqual(await page.evaluate(() => heard.filter(({ type }) => type === 'error')), []);
  assert.deepEqual(errors, []);
  await close();
});

/** @type {[what: string, files: Files, wanted: RegExp][]} */
const MISSING = [
  [
    'wasm that is missing',
    { '/generator_bg.wasm': [404, 'text/plain', 'no'] },
    /generator_bg-\w+\.wasm could not be fetched: the server answered 404/,
  ],
  [
    'wasm served as a page',
    { '/generator_bg.wasm': [200, 'text/html', '<!doctype html>'] },
    /generator_bg-\w+\.wasm is not a wasm file: the server sent text\/html/,
  ],
  ['damaged wasm', { '/generator_bg.wasm': [200, 'application/wasm', '\0asm\x01\0\0\0junk'] }, /wasm could not be started/],
  ['a worker script that is missing', { '/worker.js': [404, 'text/plain', 'no'] }, /worker could not be started/],
  ['a worker script served as a page', { '/worker.js': [200, 'text/html', '<!doctype html>'] }, /worker could not be started/],
];

for (const [what, files, wanted] of MISSING) {
  test(`${what} is a readable message in the element, and it recovers when the file is back`, async () => {
    const { page, errors, close } = await open({ files });
    await until(page, () => heard.some(({ type }) => type === 'error'));
    const message = page.locator('rock-field').locator('[part=message]');
    assert.match(await message.innerText(), wanted);
    assert(await message.isVisible());
    assert.equal(await page.evaluate(() => heard.filter(({ type }) => type === 'error').length), 1);
    // The browser itself reports what could not be fetched; nothing else may complain.
    assert.deepEqual(
      errors.filter((text) => !/Failed to load (resource|module script)/.test(text)),
      [],
    );

    broken = {};
    await page.evaluate(() => document.querySelector('rock-field').generate());
    assert(await message.isHidden());
    await close();
  });
}

test('a request over the budget is refused with the numbers, and the picture stays', async () => {
  const { page, errors, close } = await open({
    prepare: (page) => page.addInitScript(() => Object.defineProperty(Navigator.prototype, 'deviceMemory', { get: () => 4 })),
  });
  await until(page, () => heard.some(({ type }) => type === 'generate'));
  const [error, still] = await page.evaluate(async () => {
    const element = document.querySelector('rock-field');
    const field = element.field;
    element.params = {
      ...element.params,
      imageWidth: 8192,
      imageHeight: 8192,
      layers: Array.from({ length: 8 }, (_, id) => ({ ...element.params.layers[0], id, radius: 2 })),
    };
    const thrown = await element.getField().catch((error) => error);
    return [{ name: thrown.name, key: thrown.key, value: thrown.value, max: thrown.max }, element.field === field];
  });
  assert.equal(error.name, 'OverBudget');
  assert(['radius', 'imageWidth', 'imageHeight', 'layers'].includes(error.key), error.key);
  assert.equal(error.max, 2 ** 29);
  assert(error.value > error.max);
  assert(still);
  assert.equal(await page.evaluate(() => heard.filter(({ type }) => type === 'error').length), 1);
  assert.deepEqual(errors, []);
  await close();
});
