// Files of rocks: the same bytes in Node, in a page and from the element's worker, whatever the page looks like; and what happens when there is none.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { exportScene, exportWoodEar } from 'rock-field/export';
import { SMALL, pageWith } from './element-page.mjs';
import { launch, pageOf } from './browser.mjs';

/** @type {import('rock-field/export').FieldRequest} */
const REQUEST = { preset: 'riverbed', seed: 5, imageWidth: 200, imageHeight: 150 };
/** @type {import('rock-field/export').ExportOptions[]} */
const OPTIONS = [
  {},
  { target: 'blender' },
  { mesh: 'one', solid: true, groundMesh: 'cut' },
  { mesh: 'kit', kinds: 6, groundMesh: 'whole' },
  { mesh: 'kit', instancing: true },
  { format: 'obj', up: 'z' },
  { target: 'print' },
  { format: 'ply' },
];

const body = (attributes) =>
  `<rock-field id="a" ${SMALL} preset="riverbed" seed="5" ${attributes}></rock-field><script>listenTo(a)</script>`;

let session;
let html = '';

before(async () => {
  session = await launch({ intercept: pageOf('element.html', () => html) });
});

after(() => session?.close());

const sha256 = (bytes) => createHash('sha256').update(bytes).digest('hex');

async function openPage(attributes = '', options = {}) {
  html = pageWith(body(attributes));
  const opened = await session.open('element.html', options);
  await opened.page.waitForFunction(() => customElements.get('rock-field'));
  return opened;
}

/** What is typed for `REQUEST`, with the standard output as its file. */
const LINE = 'export --preset riverbed --seed 5 --image-width 200 --image-height 150 --target blender --out -';
const CLI = fileURLToPath(new URL('../../dist/cli.js', import.meta.url));

test('a link gives the same file in Node, on the command line, in a page and from an element that is not even seen', async () => {
  const expected = [];
  for (const options of OPTIONS) expected.push(sha256((await exportScene(REQUEST, options)).bytes));
  const { stdout } = spawnSync(process.execPath, [CLI, ...LINE.split(' ')], { maxBuffer: 2 ** 28 });
  assert.equal(sha256(stdout), expected[OPTIONS.findIndex(({ target }) => target === 'blender')]);
  const { page, errors, close } = await openPage('style="display: none"');
  const found = await page.evaluate(
    async ([request, list]) => {
      const hex = async (bytes) =>
        [...new Uint8Array(await crypto.subtle.digest('SHA-256', bytes))].map((byte) => byte.toString(16).padStart(2, '0')).join('');
      const { exportScene: here } = await import('/export.js');
      const both = [];
      for (const options of list) {
        const file = await a.exportFile(options);
        both.push([await hex((await here(request, options)).bytes), await hex(await file.arrayBuffer()), file.name.split('.')[0]]);
      }
      return both;
    },
    [REQUEST, OPTIONS],
  );
  assert.deepEqual(
    found,
    expected.map((hash) => [hash, hash, 'riverbed-5']),
  );
  assert.deepEqual(errors, []);
  await close();
});

/** @type {import('rock-field/export').WoodEarExportRequest} */
const COLONY = {
  preset: 'wet-colony',
  seed: 2,
  density: 10,
  range: 20,
  rings: 4,
  meridians: 10,
  log: { length: 40, radius: 6, spacing: 3 },
};
const COLONY_ATTRIBUTES =
  'preset="wet-colony" seed="2" density="10" range="20" rings="4" meridians="10" log-length="40" log-radius="6" log-spacing="3"';

test('a colony gives the same file in Node, in a page and from its element, with the rocks around its log', async () => {
  /** @type {import('rock-field/export').ExportOptions[]} */
  const options = [{}, { mesh: 'one', solid: true }, { target: 'print' }];
  const expected = [];
  for (const one of options) expected.push(sha256((await exportWoodEar(COLONY, one)).bytes));
  html = pageWith(`<wood-ear-log id="a" ${COLONY_ATTRIBUTES} style="display: none"></wood-ear-log><script>listenTo(a)</script>
<script type="module" src="/wood-ear-log.js"></script>`);
  const { page, errors, close } = await session.open('element.html');
  const found = await page.evaluate(
    async ([request, list]) => {
      const hex = async (bytes) =>
        [...new Uint8Array(await crypto.subtle.digest('SHA-256', bytes))].map((byte) => byte.toString(16).padStart(2, '0')).join('');
      const { exportWoodEar: here } = await import('/export.js');
      await customElements.whenDefined('wood-ear-log');
      const both = [];
      for (const one of list) {
        const file = await a.exportFile(one);
        both.push([await hex((await here(request, one)).bytes), await hex(await file.arrayBuffer()), file.name.split('.')[0]]);
      }
      return both;
    },
    [COLONY, options],
  );
  assert.deepEqual(
    found,
    expected.map((hash) => [hash, hash, 'wet-colony-2']),
  );
  assert.equal(
    await page.evaluate(() =>
      a.exportFile({ mesh: 'kit' }).then(
        () => 'done',
        (error) => error.name,
      ),
    ),
    'ExportImpossible',
  );
  assert.deepEqual(errors, []);
  await close();
});

test('a bad option, an abort and a missing worker are named errors, after which the next export works', async () => {
  const { page, errors, close } = await openPage();
  const said = await page.evaluate(async () => {
    const nameOf = (promise) =>
      promise.then(
        () => 'done',
        (error) => error.name,
      );
    const results = [
      await nameOf(a.exportFile(JSON.parse('{ "format": "fbx" }'))),
      await nameOf(a.exportFile({}, { signal: AbortSignal.abort() })),
    ];
    const Native = globalThis.Worker;
    globalThis.Worker = class extends EventTarget {
      constructor() {
        super();
        setTimeout(() => this.onerror?.(new ErrorEvent('error')));
      }
      /** @type {((event: ErrorEvent) => unknown) | null} */
      onerror = null;
      onmessage = null;
      onmessageerror = null;
      postMessage() {}
      terminate() {}
    };
    results.push(await nameOf(a.exportFile()));
    globalThis.Worker = Native;
    results.push(await nameOf(a.exportFile()));
    return results;
  });
  assert.deepEqual(said, ['OutOfRange', 'AbortError', 'WorkerUnavailable', 'done']);
  assert.deepEqual(errors, []);
  await close();
});

test('an edit that is under way is in the file, whose link brings it back', async () => {
  const { page, close } = await openPage('metres-per-pixel="0.02"');
  const scene = await page.evaluate(async () => {
    await a.getField();
    a.seed = 6;
    const file = await a.exportFile({ mesh: 'one' });
    const bytes = await file.arrayBuffer();
    const json = new TextDecoder().decode(new Uint8Array(bytes, 20, new DataView(bytes).getUint32(12, true)));
    return JSON.parse(json).scenes[0];
  });
  const { link, metresPerPixel } = scene.extras;
  assert.deepEqual([link, metresPerPixel], ['v=1&preset=riverbed&seed=6&w=200&h=150', 0.02]);
  await close();
});
