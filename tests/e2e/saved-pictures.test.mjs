// Files of their scene: what a picture carries, and how files bring scenes back.
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { after, before, test } from 'node:test';
import { PNG } from 'pngjs';
import { generate } from 'rock-field/core';
import { exportScene } from 'rock-field/export';
import { holdTimers, launch } from './browser.mjs';
import { hashField } from './golden.mjs';
import { MESSAGE, closeClean, openPage, params } from './shown.mjs';

/** @type {import('./browser.mjs').Session} */
let session;

before(async () => {
  const golden = await readFile(new URL('./golden.mjs', import.meta.url), 'utf8');
  session = await launch({
    intercept(request, response) {
      const isAsked = request.url === '/golden.mjs';
      if (isAsked) response.writeHead(200, { 'content-type': 'text/javascript' }).end(golden);
      return isAsked;
    },
  });
});

after(() => session?.close());

/** A small field, in plain colours and seen by a camera of its own. */
const ROCKS = '#v=1&preset=riverbed&seed=5&w=200&h=150&color=rock&camera=0.5,0.9,260,100,75,0';
/** @type {import('rock-field/export').FieldRequest} */
const REQUEST = { preset: 'riverbed', seed: 5, imageWidth: 200, imageHeight: 150 };
const EARS = 'wood-ear.html#v=1&preset=thesis-default&d=30&r=25&m=90&e=6&ls=6&ground=v.1_preset.shingle_w.200_h.200';

/**
 * What `toBlob` gives, byte by byte.
 *
 * @param {import('playwright-core').Page} page
 * @param {import('../../www/scene/picture.ts').PictureOptions} [options]
 */
async function pictureOf(page, options) {
  const bytes = await page.evaluate(async (given) => {
    const blob = await document.querySelector('rock-field, wood-ear-log').toBlob({ width: 96, height: 64, ...given });
    return [...new Uint8Array(await blob.arrayBuffer())];
  }, options);
  return Buffer.from(bytes);
}

/** The text under `rock-field` in a PNG file. */
function textIn(png) {
  const at = png.indexOf('iTXtrock-field\0');
  return at < 0 ? undefined : JSON.parse(png.toString('utf8', at + 19, at + 4 + png.readUInt32BE(at - 4)));
}

test('a saved picture has the link to what is shown, as it is seen, and the golden hash of its field; without it, the same pixels', async () => {
  const opened = await openPage(session, ROCKS);
  const { page } = opened;
  const png = await pictureOf(page);
  const { version, ...told } = textIn(png);
  const field = await generate(REQUEST);
  assert.deepEqual(told, { link: ROCKS.slice(1), hash: await hashField(field), metresPerPixel: 0.01 });
  assert.match(version, /^\d+\.\d+\.\d+/);
  const bare = await pictureOf(page, { link: false });
  assert.equal(textIn(bare), undefined);
  assert.deepEqual(PNG.sync.read(bare).data, PNG.sync.read(png).data);
  assert.equal(textIn(await pictureOf(page, { type: 'image/jpeg' })), undefined);
  await closeClean(opened);
});

test('a picture of wood ears has their link, with the ground in it, and the hash of the colony', async () => {
  const opened = await openPage(session, EARS);
  const { link, hash } = textIn(await pictureOf(opened.page));
  assert.equal(`wood-ear.html#${link}`, EARS);
  const golden = await opened.page.evaluate(async () => {
    const { hashColony } = await import('/golden.mjs');
    return hashColony(document.querySelector('wood-ear-log').colony);
  });
  assert.equal(hash, golden);
  await closeClean(opened);
});

/** What is shown, and how: everything that a file may bring back, and that a refusal leaves alone. */
const state = (page) =>
  page.evaluate(() => {
    const { params, preset, view, color, camera } = document.querySelector('rock-field, wood-ear-log');
    return { params, preset, view, color, camera, address: location.hash };
  });

/** Drops files on the middle of the page; `kind` is `paste` for a paste. */
const drop = (page, files, kind = 'drop') =>
  page.evaluate(
    ([given, type]) => {
      const transfer = new DataTransfer();
      for (const [name, content] of given) transfer.items.add(new File([Uint8Array.from(content)], name));
      const target = document.querySelector('.stage');
      target.dispatchEvent(
        type === 'paste'
          ? new ClipboardEvent('paste', { clipboardData: transfer, bubbles: true, cancelable: true, composed: true })
          : new DragEvent('drop', { dataTransfer: transfer, bubbles: true, cancelable: true, composed: true }),
      );
    },
    [files.map(([name, bytes]) => [name, [...bytes]]), kind],
  );

const pasteText = (page, text) =>
  page.evaluate((pasted) => {
    const clipboardData = new DataTransfer();
    clipboardData.setData('text/plain', pasted);
    document.body.dispatchEvent(new ClipboardEvent('paste', { clipboardData, bubbles: true, cancelable: true }));
  }, text);

/** The listeners come after the page, as its button does. */
const canOpen = (page) => page.locator('.panel input[type=file][accept*=png]').waitFor({ state: 'attached' });
const fieldHash = (page) =>
  page.evaluate(async () => {
    const { hashField } = await import('/golden.mjs');
    return hashField(await document.querySelector('rock-field').getField());
  });
const toast = (page, text) => page.locator('.toast.is-shown').filter({ hasText: text }).waitFor();
const isUndone = (page) => page.getByRole('button', { name: 'Undo' }).isDisabled();

test('a picture, a model, an archive, parameters and a link bring their scene back: the same hash, as one step of undo', async () => {
  const opened = await openPage(session, ROCKS);
  const { page } = opened;
  await canOpen(page);
  // A busy machine may look for the words when they have gone.
  await page.evaluate(holdTimers, 4000);
  const [png, before, hash] = [await pictureOf(page), await state(page), await fieldHash(page)];
  const glb = Buffer.from((await exportScene(REQUEST)).bytes);
  await page.evaluate(() =>
    Object.assign(document.querySelector('rock-field'), { params: { preset: 'journal-fig1', imageWidth: 100, imageHeight: 100 } }),
  );
  const other = await fieldHash(page);
  assert.notEqual(other, hash);
  /** @type {[string, () => Promise<unknown>][]} */
  const ways = [
    [
      'saved.png',
      () =>
        drop(page, [
          ['notes.txt', Buffer.from('hello')],
          ['saved.png', png],
        ]),
    ],
    ['saved.png', () => drop(page, [['saved.png', png]], 'paste')],
    ['rocks.glb', () => drop(page, [['rocks.glb', glb]])],
    [
      'rocks.json',
      () =>
        page
          .locator('.panel input[type=file][accept*=png]')
          .setInputFiles({ name: 'rocks.json', mimeType: 'application/json', buffer: Buffer.from(JSON.stringify(REQUEST)) }),
    ],
    ['pasted scene', () => pasteText(page, `https://example.com/${ROCKS}`)],
  ];
  for (const [name, bring] of ways) {
    await bring();
    await toast(page, name);
    await page.evaluate(() => document.querySelector('.toast').classList.remove('is-shown'));
    assert.equal(await fieldHash(page), hash, name);
    if (name === 'saved.png') {
      // The address follows in a moment.
      await page.waitForFunction((wanted) => location.hash === wanted, before.address);
      assert.deepEqual(await state(page), before);
    }
    await page.getByRole('button', { name: 'Undo' }).click();
    assert.equal(await fieldHash(page), other, `${name}, undone`);
  }
  assert.equal(await page.locator(MESSAGE).count(), 0);
  await closeClean(opened);
});

test('what was not made here, or is damaged, is refused in words, and nothing changes', async () => {
  const opened = await openPage(session, ROCKS);
  const { page } = opened;
  await canOpen(page);
  const [png, before, hash] = [await pictureOf(page), await state(page), await fieldHash(page)];
  const bare = await pictureOf(page, { link: false });
  const damaged = Buffer.from(png);
  damaged[80] ^= 1;
  /** @type {[string, Buffer, RegExp][]} */
  const refused = [
    ['photo.png', bare, /^photo\.png brings no scene back: it was not made here/],
    ['half.png', damaged, /^half\.png is damaged/],
    ['notes.txt', Buffer.from('hello'), /^notes\.txt brings no scene back/],
    ['bad.json', Buffer.from('{"preset":"riverbed","imageWidth":-5}'), /must be between 1 and 8192/],
  ];
  for (const [name, bytes, words] of refused) {
    await drop(page, [[name, bytes]]);
    await page.locator(`${MESSAGE} p`).filter({ hasText: words }).waitFor();
    await page.locator(`${MESSAGE} button`).click();
    assert.deepEqual(await state(page), before, name);
    assert.equal(await fieldHash(page), hash, name);
    assert.equal(await isUndone(page), true, name);
  }
  await pasteText(page, 'hello');
  await page
    .locator(`${MESSAGE} p`)
    .filter({ hasText: /^what was pasted brings no scene back/ })
    .waitFor();
  await closeClean(opened);
});

test('a file of the other page is offered there, in both directions', async () => {
  const opened = await openPage(session, EARS);
  const { page } = opened;
  await canOpen(page);
  const ears = await pictureOf(page);
  const model = Buffer.from((await exportScene(REQUEST)).bytes);
  const before = await state(page);
  await drop(page, [['rocks.glb', model]]);
  await page.locator(`${MESSAGE} p`).filter({ hasText: 'rocks.glb is a scene of the page “Rocks”.' }).waitFor();
  assert.deepEqual(await state(page), before);
  await page.getByRole('button', { name: 'Open it there' }).click();
  await page.waitForURL(/\/(index\.html)?#v=1&preset=riverbed&seed=5&w=200&h=150$/);
  await canOpen(page);
  assert.equal((await params(page)).seed, 5);
  await drop(page, [['ears.png', ears]]);
  await page.locator(`${MESSAGE} p`).filter({ hasText: 'ears.png is a scene of the page “Wood ears”.' }).waitFor();
  await page.getByRole('button', { name: 'Open it there' }).click();
  await page.waitForURL((url) => url.href.endsWith(EARS));
  await closeClean(opened);
});

test('a postcard is made of what is shown, with its place, and brings the scene back; without the ground a picture has another', async () => {
  const opened = await openPage(session, ROCKS);
  const { page } = opened;
  await canOpen(page);
  await page.getByRole('button', { name: 'Picture', exact: true }).click();
  const preview = page.locator('.picture-preview img');
  await preview.waitFor();
  const saved = page.waitForEvent('download');
  await page.locator('.dialog').getByRole('button', { name: 'Save' }).click();
  const download = await saved;
  assert.equal(download.suggestedFilename(), 'riverbed-5-postcard.png');
  const postcard = await readFile(await download.path());
  const { width, height } = PNG.sync.read(postcard);
  assert.deepEqual([width, height, textIn(postcard).link], [1200, 630, ROCKS.slice(1)]);
  const address = await preview.getAttribute('src');
  await page.locator('input[name=picture-kind][value=cutout]').check();
  await page.waitForFunction(
    (before) => document.querySelector('.picture-preview.is-bare img[src]')?.getAttribute('src') !== before,
    address,
  );
  await page.keyboard.press('Escape');
  await page.waitForFunction(() => !document.querySelector('dialog[open]'));
  await closeClean(opened);
});

test('importFile shows the scene of a file as one step of undo, and refuses by name what has none, changing nothing', async () => {
  const opened = await openPage(session, ROCKS);
  const { page } = opened;
  const found = await page.evaluate(async () => {
    const element = document.querySelector('rock-field');
    const seen = () => JSON.stringify([element.params, element.view, element.color, element.camera]);
    const nameOf = (promise) =>
      promise.then(
        () => 'done',
        ({ name }) => name,
      );
    const [before, picture, bare] = [seen(), await element.toBlob({ width: 30 }), await element.toBlob({ width: 30, link: false })];
    Object.assign(element, {
      params: { preset: 'journal-fig1', imageWidth: 100, imageHeight: 100 },
      view: 'wireframe',
      color: null,
      camera: null,
    });
    await element.getField();
    const other = seen();
    const ears = new Blob(['{"preset":"fallen-log"}']);
    const refusals = [];
    for (const file of [bare, picture.slice(0, 60), ears, new Blob(['{"seed":-1}'])]) refusals.push(await nameOf(element.importFile(file)));
    refusals.push(await nameOf(document.createElement('rock-field').importFile(picture)));
    const [isUntouched, outcome] = [seen() === other, await nameOf(element.importFile(picture))];
    const isBack = seen() === before;
    element.undo();
    return { refusals, isUntouched, outcome, isBack, undone: element.params.imageWidth };
  });
  assert.deepEqual(found, {
    refusals: ['ImportForeign', 'ImportBroken', 'ImportOther', 'OutOfRange', 'NotConnected'],
    isUntouched: true,
    outcome: 'done',
    isBack: true,
    undone: 100,
  });
  await closeClean(opened);
});
