// Quality as it is seen: a still of `auto` is one of `high`, and no frame follows it.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { meanDifference, readPicture } from '../../scripts/lib/pixels.mjs';
import { launch, pageOf } from './browser.mjs';
import { quiet } from './element-page.mjs';

const html = `<!doctype html><html lang="en"><meta charset="utf-8"><title>quality</title><link rel="icon" href="data:,"><style>rock-field { width: 160px; height: 100px }</style>
<script>
  globalThis.counts = { frames: 0 };
  const request = requestAnimationFrame;
  globalThis.frame = () => new Promise((resolve) => request(resolve));
  globalThis.requestAnimationFrame = (callback) => (counts.frames += 1, request(callback));
</script>
<script type="module" src="/rock-field.js"></script><rock-field preset="riverbed" image-width="200" image-height="200" color="natural"></rock-field>`;

test('a still of auto is one of high, also after a motion, and nothing is drawn after it', async () => {
  const session = await launch({ intercept: pageOf('quality.html', () => html) });
  try {
    const { page, errors } = await session.open('quality.html', { colorScheme: 'light' });
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
    assert(meanDifference(low, high) > 0.1, 'low looks like high');
    assert.deepEqual(errors, []);
  } finally {
    await session.close();
  }
});
