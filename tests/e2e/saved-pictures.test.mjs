// Pictures that are files of their scene: what a PNG carries.
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { after, before, test } from 'node:test';
import { PNG } from 'pngjs';
import { generate } from 'rock-field/core';
import { launch } from './browser.mjs';
import { hashField } from './golden.mjs';
import { closeClean, openPage } from './shown.mjs';

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
  const field = await generate({ preset: 'riverbed', seed: 5, imageWidth: 200, imageHeight: 150 });
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
