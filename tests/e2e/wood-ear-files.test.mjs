// Logs from files on the page of wood ears: dropped, read beside the page, refused in words, dragged, shared.
// Drawn by WebGL2 (software), in the plain colours.
/** @import { Page } from 'playwright-core' */
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { hidePictures, holdResults, holdTimers, launch, screenshotPath } from './browser.mjs';
import { MESSAGE, closeClean, colony, hash, openWoodEars, params } from './wood-ear-page.mjs';

/** @type {import('./browser.mjs').Session} */
let session;

before(async () => {
  session = await launch();
});

after(() => session?.close());

const open = (address, options, browser = session) => openWoodEars(browser, address, options);

const OBJ = (() => {
  // A box of quads, 120 long.
  const corners = [0, 1].flatMap((x) => [0, 1].flatMap((y) => [0, 1].map((z) => `v ${120 * x} ${24 * y} ${24 * z}`)));
  return `# a box\n${corners.join('\n')}\nf 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n`;
})();

const drop = (/** @type {Page} */ page, name, text) =>
  page.evaluate(
    ([fileName, content]) => {
      const transfer = new DataTransfer();
      transfer.items.add(new File([content], fileName));
      document
        .querySelector('wood-ear-log')
        .dispatchEvent(new DragEvent('drop', { dataTransfer: transfer, bubbles: true, cancelable: true }));
    },
    [name, text],
  );

test('a log from a file carries the colony; a broken, foreign or empty file is refused in words and the old log stays', async () => {
  const opened = await open('#preset=thesis-default&r=25&d=100');
  const { page } = opened;
  await hidePictures(page);
  const grown = await hash(page);
  for (const { name, text, words } of [
    { name: 'notes.txt', text: 'hello', words: /neither a GLB nor an OBJ/ },
    { name: 'page.glb', text: '<!doctype html>', words: /is a web page, neither a GLB nor an OBJ/ },
    { name: 'half.glb', text: 'glTF\u0002', words: /no whole GLB/ },
    { name: 'points.obj', text: 'v 0 0 0\nv 1 0 0\n', words: /no triangles/ },
    { name: 'nan.obj', text: 'v a b c\nv 1 0 0\nv 1 1 0\nf 1 2 3\n', words: /line 1: "a" is not a number/ },
  ]) {
    await drop(page, name, text);
    const said = page.locator(`${MESSAGE} p, .control-problem`).filter({ hasText: words });
    await said.first().waitFor();
    assert.equal(await hash(page), grown, name);
    // Some are said in the panel.
    await page
      .locator(`${MESSAGE} button`)
      .evaluateAll((/** @type {HTMLElement[]} */ buttons) => buttons.forEach((button) => button.click()));
  }
  await drop(page, 'box.obj', OBJ);
  await page.waitForFunction(() => document.querySelector('wood-ear-log').params.mesh !== null);
  const { individuals } = await colony(page);
  assert.ok(individuals > 0);
  assert.equal(await page.evaluate(() => document.querySelector('wood-ear-log').colony.log.indices.length), 36);
  await page.getByRole('button', { name: 'Back to the grown log' }).click();
  assert.equal(await hash(page), grown);
  await closeClean(opened);
});

/** Two triangles so thin that they have an area in the file and none in the generator, which has 32-bit positions. */
const SLIVERS =
  'v 0 100 0\nv 200 100 0\nv 100 100 0.0000000001\nv 0 -100 0\nv 200 -100 0\nv 100 -100 0.0000000001\nf 1 2 3\nf 4 5 6\n'.replaceAll(
    '0 0.0000000001',
    '0.0000000001 0',
  );

test('a log that the generator refuses leaves the old one, on the element, in the panel, in the history and in the address', async () => {
  // As the page itself writes it, so that its address stays as it is.
  const opened = await open('#v=1&preset=thesis-default&d=100&r=25');
  const { page } = opened;
  await hidePictures(page);
  await page.evaluate(() => {
    globalThis.changes = [];
    document.querySelector('wood-ear-log').addEventListener('change', ({ detail }) => changes.push(detail.params.mesh !== null));
  });
  const before = { hash: await hash(page), params: await params(page), address: page.url() };
  await drop(page, 'slivers.obj', SLIVERS);
  await page
    .locator(`${MESSAGE} p, .control-problem`)
    .filter({ hasText: /no triangle of the log has an area/ })
    .first()
    .waitFor();
  assert.deepEqual(await params(page), before.params);
  assert.equal(await hash(page), before.hash);
  assert.equal(page.url(), before.address);
  assert.equal(await page.getByRole('button', { name: 'Back to the grown log' }).count(), 0);
  assert.equal(await page.getByRole('button', { name: 'Undo' }).isDisabled(), true);
  // Edits still work.
  await page.locator('[id="d"]').press('PageDown');
  assert.notEqual(await hash(page), before.hash);
  assert.deepEqual(await page.evaluate(() => changes), []);
  // An edit while a log is tried is kept, with the log.
  const kept = await page.evaluate(async (text) => {
    const element = document.querySelector('wood-ear-log');
    const loading = element.loadLog(new File([text], 'box.obj'));
    for (let k = 0; k < 20; k += 1) {
      element.density = 40 + k;
      await new Promise((resolve) => setTimeout(resolve, 10));
    }
    await loading;
    return [element.density, element.params.mesh !== null, element.colony.log.indices.length];
  }, OBJ);
  assert.deepEqual(kept, [59, true, 36]);
  assert.deepEqual(await page.evaluate(() => changes), [true]);
  await closeClean(opened);
});

test('of several files the latest is shown, others are given up by name, and what is no file is refused by name', async () => {
  const opened = await open('#preset=thesis-default&r=25&d=60', { prepare: (/** @type {Page} */ page) => page.addInitScript(holdResults) });
  const { page } = opened;
  await hidePictures(page);
  const outcome = await page.evaluate(async (text) => {
    const element = document.querySelector('wood-ear-log');
    const box = (length) => new File([text.replaceAll('120', length)], `${length}.obj`);
    const errors = [];
    element.addEventListener('error', ({ detail }) => errors.push(detail.error.name));
    const settled = await Promise.allSettled([element.loadLog(box('100')), element.loadLog(box('110')), element.loadLog(box('130'))]);
    const size = () => Math.max(...(element.params.mesh?.positions ?? []));
    const latest = size();
    // In the moment in which the first is tried.
    results.hold();
    const first = element.loadLog(box('140'));
    while (results.held === 0) await new Promise((resolve) => setTimeout(resolve, 20));
    const second = element.loadLog(await box('150').arrayBuffer());
    results.release();
    const both = await Promise.allSettled([first, second]);
    const cancelled = element.loadLog(box('160')).catch(({ name }) => name);
    element.cancel();
    const names = [];
    for (const wrong of [undefined, null, 'https://example.org/log.glb', {}, new URL('https://example.org/'), 7, []]) {
      await element
        .loadLog(/** @type {File} */ (wrong))
        .catch(({ name, key, message }) => names.push([name, key, /file, a Blob or an ArrayBuffer/.test(message)].join()));
    }
    await element.loadLog(new Uint8Array(await box('170').arrayBuffer()));
    return {
      settled: settled.map((one) => (one.status === 'rejected' ? one.reason.name : one.status)),
      latest,
      both: both[1].status,
      cancelled: await cancelled,
      names: [...new Set(names)],
      last: size(),
      errors,
    };
  }, OBJ);
  assert.deepEqual(outcome, {
    settled: ['AbortError', 'AbortError', 'fulfilled'],
    latest: 65,
    both: 'fulfilled',
    cancelled: 'AbortError',
    names: ['WrongType,log,true'],
    last: 85,
    errors: [],
  });
  await closeClean(opened);
});

test('a large file is read in a worker of its own, and refused by name', async () => {
  const opened = await open('#preset=thesis-default&r=25&d=60');
  const { page } = opened;
  await hidePictures(page);
  const reader = page.waitForEvent('worker', (worker) => worker.url().includes('wood-ear-file-worker'));
  const name = await page.evaluate(() => {
    const lines = [];
    for (let x = 0; x < 700; x += 1) for (let y = 0; y < 300; y += 1) lines.push(`v ${x}.123456 ${y}.123456 ${(x * y) % 7}.123456`);
    for (let x = 0; x < 699; x += 1)
      for (let y = 0; y < 299; y += 1) lines.push(`f ${x * 300 + y + 1} ${x * 300 + y + 301} ${x * 300 + y + 302} ${x * 300 + y + 2}`);
    const file = new File([lines.join('\n')], 'grid.obj');
    return document
      .querySelector('wood-ear-log')
      .loadLog(file)
      .then(
        () => 'taken',
        (thrown) => thrown.name,
      );
  });
  assert.equal(name, 'LogTooLarge');
  await reader;
  await closeClean(opened);
});

test('while files are dragged over the picture a frame says what happens; of an OBJ and its materials the OBJ is taken; a link without the log says so', async () => {
  const opened = await open('#preset=thesis-default&r=25&d=60&e=6&ls=6', { deviceScaleFactor: 1 });
  const { page } = opened;
  const frame = () => page.evaluate(() => document.querySelector('wood-ear-log').shadowRoot.querySelector('.drop').checkVisibility());
  const drag = (type, target, files) =>
    page.evaluate(
      ([name, selector, list]) => {
        const transfer = new DataTransfer();
        for (const [file, text] of list) transfer.items.add(new File([text], file));
        const event = new DragEvent(name, { dataTransfer: transfer, bubbles: true, cancelable: true, composed: true });
        document.querySelector(selector).dispatchEvent(event);
        return event.defaultPrevented;
      },
      [type, target, files],
    );
  const both = [
    ['box.mtl', 'newmtl bark\n'],
    ['box.obj', OBJ],
  ];
  assert.equal(await frame(), false);
  assert.equal(await drag('dragover', 'wood-ear-log', both), true);
  assert.equal(await frame(), true);
  await page.screenshot({ path: screenshotPath('wood-ear-drop') });
  await drag('dragleave', 'wood-ear-log', both);
  assert.equal(await frame(), false);
  assert.equal(await drag('drop', 'wood-ear-log', both), true);
  await page.waitForFunction(() => document.querySelector('wood-ear-log').params.mesh !== null);
  // The words would go by themselves.
  await page.evaluate(holdTimers);
  await page.getByRole('button', { name: 'Share' }).first().click();
  await page.locator('.toast, .dialog').filter({ hasText: 'The log from your file is not in it' }).first().waitFor();
  await page.screenshot({ path: screenshotPath('wood-ear-share-file') });
  await page.evaluate(() => releaseTimers());
  // Beside the picture the browser would leave the page for the file.
  await page.evaluate(
    () => (document.querySelector('wood-ear-log').params = { ...document.querySelector('wood-ear-log').params, mesh: null }),
  );
  assert.equal(await drag('drop', '#controls', both), true);
  await page.waitForFunction(() => document.querySelector('wood-ear-log').params.mesh !== null);
  await closeClean(opened);
});
