// What becomes of a picture that is left alone: it passes into the mean of samples, and no frame follows that.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { meanDifference, readPicture } from '../../scripts/lib/pixels.mjs';
import { launch, pageOf } from './browser.mjs';
import { pageWith } from './element-page.mjs';

const SAMPLES = 16;

const html = pageWith(
  `<rock-field style="width: 72px; height: 48px" preset="riverbed" image-width="96" image-height="96" color="natural" quality="high" samples="${SAMPLES}"></rock-field>`,
);

/** Until samples are drawn (true), which ask for no frame, or nothing is (false), for so long that nothing follows. */
const drawing = (page, isUnderWay) =>
  page.evaluate(async (isUnderWay) => {
    const { dataset } = document.querySelector('rock-field').shadowRoot.querySelector('canvas');
    for (let since = performance.now(), last = -1; performance.now() - since < (isUnderWay ? 150 : 1800); ) {
      await new Promise((resolve) => setTimeout(resolve, 20));
      if (counts.frames !== last || 'drawing' in dataset !== isUnderWay) since = performance.now();
      last = counts.frames;
    }
  }, isUnderWay);

for (const webgpu of [false, true]) {
  test(`a picture at rest passes into the mean of samples, and a change begins anew without a flash, ${webgpu ? 'WebGPU' : 'WebGL2'}`, async () => {
    const session = await launch({ webgpu, intercept: pageOf('refine.html', () => html) });
    try {
      const { page, errors } = await session.open('refine.html', { colorScheme: 'light', deviceScaleFactor: 1 });
      await page.evaluate(() => document.querySelector('rock-field').ready);
      const taken = async (samples) => {
        const bytes = await page.evaluate(
          async (samples) => [
            ...new Uint8Array(
              await (await document.querySelector('rock-field').toBlob({ width: 72, height: 48, link: false, samples })).arrayBuffer(),
            ),
          ],
          samples,
        );
        return readPicture(Buffer.from(bytes));
      };
      const shown = async () => readPicture(await page.locator('rock-field').screenshot());
      await drawing(page, false);
      const [first, estimated, mean] = [await shown(), await taken(undefined), await taken(SAMPLES)];
      const [before, after] = [meanDifference(estimated, mean), meanDifference(first, mean)];
      assert(after < 0.2 && before > 1, `${after} % from the mean of ${SAMPLES} samples, ${before} % before`);
      const frames = await page.evaluate(async () => {
        const { frames } = counts;
        await new Promise((resolve) => setTimeout(resolve, 1200));
        return counts.frames - frames;
      });
      assert.equal(frames, 0);

      // How bright each frame is, while the camera is turned in the middle of a still, and then again. A canvas of WebGPU is blank for whoever
      // reads it between two pictures.
      await page.evaluate(async () => {
        globalThis.brightness = [];
        const canvas = Object.assign(document.createElement('canvas'), { width: 12, height: 8 });
        const small = /** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d', { willReadFrequently: true }));
        const look = () => {
          small.drawImage(document.querySelector('rock-field').shadowRoot.querySelector('canvas'), 0, 0, 12, 8);
          const { data } = small.getImageData(0, 0, 12, 8);
          brightness.push(data.reduce((sum, value, at) => sum + (at % 4 === 3 ? 0 : value), 0) / (3 * 96));
          void frame().then(look);
        };
        look();
      });
      const turn = () =>
        page.evaluate(() => {
          const element = document.querySelector('rock-field');
          element.camera = { ...element.camera, azimuth: element.camera.azimuth + 0.02 };
        });
      await turn();
      await drawing(page, true);
      await turn();
      await drawing(page, false);
      const last = await shown();
      const brightness = await page.evaluate(() => globalThis.brightness);
      const [least, most] = [Math.min(...brightness), Math.max(...brightness)];
      assert(webgpu || least > 0.85 * most, `frames between ${least} and ${most}`);
      const again = meanDifference(last, await taken(SAMPLES));
      assert(again < 0.2, `${again} % from the mean after a turn`);
      assert.deepEqual(errors, []);
    } finally {
      await session.close();
    }
  });
}
