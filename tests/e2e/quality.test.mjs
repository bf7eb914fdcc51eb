// Quality as it is seen: a still of `auto` is one of `high`, and no frame follows it.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { meanDifference, readPicture } from '../../scripts/lib/pixels.mjs';
import { launch, pageOf } from './browser.mjs';
import { pageWith, quiet } from './element-page.mjs';

const html = pageWith(
  '<rock-field style="width: 160px; height: 100px" preset="riverbed" image-width="200" image-height="200" color="natural" samples="0"></rock-field>',
);

test('a still of auto is one of high, also after a motion, and nothing is drawn after it', async () => {
  // From afar, levels look alike.
  const near = html.replace('<rock-field ', '<rock-field camera-orbit="20deg 50deg 20%" ');
  const session = await launch({ intercept: pageOf('quality.html', () => near) });
  try {
    const { page, errors } = await session.open('quality.html', { colorScheme: 'light', deviceScaleFactor: 1 });
    const shoot = async (quality) => {
      if (quality) await page.evaluate((level) => document.querySelector('rock-field').setAttribute('quality', level), quality);
      await page.evaluate(() => document.querySelector('rock-field').ready);
      await quiet(page);
      return readPicture(await page.locator('rock-field').screenshot());
    };
    const first = await shoot();
    const turned = await page.evaluate(async () => {
      const element = document.querySelector('rock-field');
      const { camera } = element;
      for (let step = 1; step <= 10; step += 1) {
        element.camera = { ...camera, azimuth: camera.azimuth + 0.1 * (step % 10) };
        await new Promise((resolve) => requestAnimationFrame(resolve));
      }
      return element.quality;
    });
    assert.equal(turned, 'auto');
    const again = await shoot();
    const high = await shoot('high');
    const low = await shoot('low');
    assert.equal(meanDifference(first, high), 0, 'the first still is not the best');
    assert.equal(meanDifference(again, high), 0, 'the still after a motion is not the best');
    assert(meanDifference(low, high) > 0.1, `low looks like high: ${meanDifference(low, high)}`);
    assert.deepEqual(errors, []);
  } finally {
    await session.close();
  }
});

test('a still drawn in pieces has the shadows of one that is drawn at once', async () => {
  const session = await launch({ intercept: pageOf('quality.html', () => html) });
  try {
    const { page, errors } = await session.open('quality.html', { colorScheme: 'light', deviceScaleFactor: 1 });
    await page.evaluate(() => document.querySelector('rock-field').ready);
    await quiet(page);
    const pictures = await page.evaluate(async () => {
      const shown = document.querySelector('rock-field');
      const other = /** @type {typeof shown} */ (shown.cloneNode(true));
      other.style.display = 'none';
      document.body.append(other);
      // The shadow maps of the first are those of its pieces; the other has never drawn any.
      const take = async (element) => {
        const blob = await element.toBlob({ width: 160, height: 100, link: false });
        return [...new Uint8Array(await blob.arrayBuffer())];
      };
      return [await take(shown), await take(other)];
    });
    const [pieces, whole] = pictures.map((bytes) => readPicture(Buffer.from(bytes)));
    assert.equal(meanDifference(pieces, whole), 0);
    assert.deepEqual(errors, []);
  } finally {
    await session.close();
  }
});

test('without a GPU a small picture comes before the whole one, also after a touch and when the device is lost meanwhile', async () => {
  const session = await launch({ intercept: pageOf('quality.html', () => html) });
  try {
    const { page, errors } = await session.open('quality.html', {
      colorScheme: 'light',
      deviceScaleFactor: 1,
      prepare: (page) =>
        page.addInitScript(() => {
          // The widths of what is shown, as shares of the canvas.
          globalThis.shares = [];
          const { drawImage } = CanvasRenderingContext2D.prototype;
          CanvasRenderingContext2D.prototype.drawImage = function (...args) {
            const [image, , , width] = args;
            if (image instanceof HTMLCanvasElement) globalThis.shares.push(width / this.canvas.width);
            globalThis.deviceCanvas = image;
            return Reflect.apply(drawImage, this, args);
          };
        }),
    });
    await page.evaluate(() => Object.assign(document.querySelector('rock-field').style, { width: '320px', height: '200px' }));
    await page.evaluate(() => document.querySelector('rock-field').ready);
    const shares = () => page.evaluate(() => globalThis.shares.splice(0));
    await quiet(page);
    const [first, ...rest] = await shares();
    assert(first < 1, String(first));
    assert.deepEqual(rest.slice(-2), [1, 1], 'one with all pixels, and the best');
    // A touch while the whole one is drawn.
    const blob = await page.evaluate(async () => {
      const element = document.querySelector('rock-field');
      const turn = () => (element.camera = { ...element.camera, azimuth: element.camera.azimuth + 0.1 });
      turn();
      while (globalThis.shares.length === 0) await frame();
      for (let waited = 0; waited < 12; waited += 1) await frame();
      turn();
      const { size } = await element.toBlob({ width: 40, height: 25 });
      return size;
    });
    assert(blob > 500);
    await quiet(page);
    assert.equal((await shares()).at(-1), 1);
    // The device goes while a picture is in pieces.
    const restored = await page.evaluate(async () => {
      const element = document.querySelector('rock-field');
      const back = new Promise((resolve) => element.addEventListener('restored', () => resolve(true), { once: true }));
      element.camera = { ...element.camera, azimuth: 1 };
      while (globalThis.shares.length === 0) await frame();
      await frame();
      globalThis.deviceCanvas.getContext('webgl2').getExtension('WEBGL_lose_context').loseContext();
      return back;
    });
    assert(restored);
    await quiet(page);
    assert.equal((await shares()).at(-1), 1);
    assert.deepEqual(errors, []);
  } finally {
    await session.close();
  }
});
