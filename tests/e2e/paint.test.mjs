// Painting on the page's ground, by pointer, fingers and keys, and the mask of a picture that is dropped on it.
/** @import { Page } from 'playwright-core' */
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { violations } from './axe.mjs';
import { copied, launch, until } from './browser.mjs';
import { boxOf, closeClean, openRocks } from './rock-page.mjs';

/** @type {import('./browser.mjs').Session} */
let session;

before(async () => {
  session = await launch();
});

after(() => session?.close());

/** Opens the page of a small field, and begins to paint. */
async function openPainting(options = {}) {
  const opened = await openRocks(session, '#w=200&h=200&r=14,6&a=0.3,1', options);
  const { page } = opened;
  // In a part of the panel that is closed.
  const begin = page.locator('button', { hasText: 'Paint on the ground' });
  await begin.waitFor({ state: 'attached' });
  await begin.evaluate((button) => button.closest('details')?.setAttribute('open', ''));
  await begin.click();
  return opened;
}

const brush = (/** @type {Page} */ page, /** @type {string} */ mode) => page.locator(`.paint-bar input[value=${mode}]`).check();
const strokes = (/** @type {Page} */ page) => page.evaluate(() => document.querySelector('rock-field').strokes.split('.').filter(Boolean));
const camera = (/** @type {Page} */ page) => page.evaluate(() => document.querySelector('rock-field').camera);

/** A point of the picture of a ground point, in widths of the image, seen from above. */
async function placeOf(/** @type {Page} */ page, /** @type {number} */ u, /** @type {number} */ v) {
  const { x, y, width, height } = await boxOf(page.locator('rock-field'));
  const seen = await page.evaluate(() => {
    const { camera: at, params } = document.querySelector('rock-field');
    return { half: at.distance * Math.tan(((at.fov ?? 36) * Math.PI) / 360), target: at.target, across: params.imageWidth };
  });
  const scale = height / 2 / seen.half;
  return /** @type {[number, number]} */ ([
    x + width / 2 + (u * seen.across - seen.target[0]) * scale,
    y + height / 2 - (v * seen.across - seen.target[1]) * scale,
  ]);
}

/** How many rocks stand within a tenth of the image's width of a place. */
const rocksNear = (/** @type {Page} */ page, /** @type {number} */ u, /** @type {number} */ v) =>
  page.evaluate(
    async ([x, y]) => {
      const { positions, indices, rockStarts, imageWidth } = await document.querySelector('rock-field').getField();
      let count = 0;
      for (let rock = 0; rock + 1 < rockStarts.length; rock += 1) {
        const [from, to] = [rockStarts[rock], rockStarts[rock + 1]];
        let [sumX, sumY] = [0, 0];
        for (const at of indices.subarray(from, to)) [sumX, sumY] = [sumX + positions[3 * at], sumY + positions[3 * at + 1]];
        const [middleX, middleY] = [sumX / (to - from) / imageWidth, sumY / (to - from) / imageWidth];
        if (Math.hypot(middleX - x, middleY - y) < 0.1) count += 1;
      }
      return count;
    },
    [u, v],
  );

test('a drag paints where the pointer goes, undo takes it back, and the way back is to what was seen before', async () => {
  const opened = await openPainting();
  const { page } = opened;
  const above = await camera(page);
  assert.ok(above.elevation > 1.57);
  const [here, there] = [await rocksNear(page, 0.3, 0.7), await rocksNear(page, 0.7, 0.3)];
  assert.ok(here > 0 && there > 0);
  await brush(page, 'erase');
  await page.mouse.move(...(await placeOf(page, 0.3, 0.7)));
  for (let k = 0; k < 9; k += 1) await page.keyboard.press(']');
  await page.mouse.down();
  await page.mouse.move(...(await placeOf(page, 0.32, 0.7)), { steps: 3 });
  await page.mouse.up();
  await until(async () => (await rocksNear(page, 0.3, 0.7)) === 0, 'the rocks below the brush are gone');
  assert.equal(await rocksNear(page, 0.7, 0.3), there);
  assert.equal((await strokes(page)).length, 1);
  await page.waitForURL(/strokes=/);
  assert.deepEqual((await camera(page)).target, above.target, 'the drag moved the camera');

  // The middle button and the wheel still move the camera.
  await page.mouse.wheel(0, -300);
  await until(async () => (await camera(page)).distance < 0.9 * above.distance, 'the wheel comes closer');

  await page.keyboard.press('Control+z');
  await until(async () => (await rocksNear(page, 0.3, 0.7)) === here, 'undo brings them back');
  assert.deepEqual(await strokes(page), []);
  assert.deepEqual(await violations(page), []);

  await page.keyboard.press('Escape');
  await page.locator('.paint-bar').waitFor({ state: 'detached' });
  assert.deepEqual(await camera(page), await page.evaluate(() => document.querySelector('rock-field').defaultCamera));
  await closeClean(opened);
});

test('keys paint too, and a stroke that is given up leaves nothing', async () => {
  const opened = await openPainting();
  const { page } = opened;
  await brush(page, 'path');
  await page.locator('rock-field .stage').focus();
  await page.keyboard.press(' ');
  for (let k = 0; k < 4; k += 1) await page.keyboard.press('Shift+ArrowRight');
  await page.keyboard.press('Escape');
  assert.deepEqual(await strokes(page), []);
  await page.keyboard.press(' ');
  for (let k = 0; k < 4; k += 1) await page.keyboard.press('Shift+ArrowUp');
  await page.keyboard.press(' ');
  const [stroke] = await page.evaluate(async () => {
    const { strokesOfText } = await import('/core.js');
    return strokesOfText(document.querySelector('rock-field').strokes);
  });
  assert.equal(stroke?.mode, 'path');
  assert.ok(
    stroke.points.length === 4 && stroke.points[0] === stroke.points[2] && stroke.points[3] > stroke.points[1],
    JSON.stringify(stroke),
  );
  await closeClean(opened);
});

test('one finger paints; two move the picture, and paint nothing', async () => {
  const opened = await openPainting({ hasTouch: true });
  const { page } = opened;
  const client = await page.context().newCDPSession(page);
  const touch = (
    /** @type {'touchStart' | 'touchMove' | 'touchEnd' | 'touchCancel'} */ type,
    /** @type {[number, number][]} */ ...points
  ) => client.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
  const { x, y, width, height } = await boxOf(page.locator('rock-field'));
  const at = (/** @type {number} */ u, /** @type {number} */ v) => /** @type {[number, number]} */ ([x + u * width, y + v * height]);
  await touch('touchStart', at(0.4, 0.4));
  await touch('touchMove', at(0.5, 0.45));
  await touch('touchMove', at(0.6, 0.5));
  await touch('touchEnd');
  assert.equal((await strokes(page)).length, 1);
  const before = await camera(page);
  await touch('touchStart', at(0.45, 0.4));
  await touch('touchStart', at(0.45, 0.4), at(0.55, 0.4));
  await touch('touchMove', at(0.35, 0.4), at(0.65, 0.4));
  await touch('touchMove', at(0.3, 0.4), at(0.7, 0.4));
  await touch('touchEnd');
  await until(async () => (await camera(page)).distance < 0.8 * before.distance, 'two fingers come closer');
  assert.equal((await strokes(page)).length, 1);
  // The browser may take the fingers away, too.
  await touch('touchStart', at(0.45, 0.4));
  await touch('touchStart', at(0.45, 0.4), at(0.55, 0.4));
  await touch('touchCancel');
  await touch('touchStart', at(0.4, 0.4));
  await touch('touchMove', at(0.5, 0.45));
  await touch('touchEnd');
  assert.equal((await strokes(page)).length, 2);
  await closeClean(opened);
});

test('a picture that is dropped on the page is a mask; the copied link says that it has none, and the button takes it away', async () => {
  const opened = await openRocks(session, '#w=200&h=200&r=14,6&a=0.3,1', { permissions: ['clipboard-read', 'clipboard-write'] });
  const { page } = opened;
  const count = () => page.evaluate(async () => (await document.querySelector('rock-field').getField()).stats.rocks);
  const all = await count();
  // What takes files comes with what opens them.
  await page.locator('.panel input[type=file][accept*=png]').waitFor({ state: 'attached' });
  await page.evaluate(async () => {
    const canvas = document.createElement('canvas');
    [canvas.width, canvas.height] = [2, 1];
    const context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d'));
    context.fillStyle = '#fff';
    context.fillRect(0, 0, 1, 1);
    const blob = await new Promise((resolve) => canvas.toBlob(resolve));
    const dataTransfer = new DataTransfer();
    dataTransfer.items.add(new File([blob], 'left.png', { type: 'image/png' }));
    document
      .querySelector('.stage')
      ?.dispatchEvent(new DragEvent('drop', { dataTransfer, bubbles: true, cancelable: true, composed: true }));
  });
  await page.getByText('left.png has no scene in it: it is the mask now').waitFor();
  const left = await count();
  assert.ok(left > 0.3 * all && left < 0.7 * all, `${left} of ${all}`);
  await copied(page, page.getByRole('button', { name: 'Share', exact: true }));
  await page.getByText('Link copied. The link does not hold the mask.').waitFor();
  await page.getByRole('button', { name: 'Remove the mask' }).click();
  await until(async () => (await count()) === all, 'all rocks are back');
  await copied(page, page.getByRole('button', { name: 'Share', exact: true }));
  await page.getByText(/^Link copied$/).waitFor();
  await closeClean(opened);
});
