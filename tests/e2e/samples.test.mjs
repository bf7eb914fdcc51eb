// Pictures that are the mean of samples: they converge, on both backends to the same, and what is no number of samples is refused.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { meanDifference, readPicture } from '../../scripts/lib/pixels.mjs';
import { openStudio } from '../../scripts/pictures/studio.mjs';

const SIZE = { width: 96, height: 60 };
const FIELD = { preset: 'riverbed', color: 'natural', quality: 'high', 'image-width': '160', 'image-height': '160', seed: '3' };
/** Close by and low, where shade counts most. */
const CAMERA = { azimuth: 0.5, elevation: 0.35, distance: 110, target: [80, 80, 6] };

/** @type {Awaited<ReturnType<typeof openStudio>>} */
let studio;

before(async () => {
  studio = await openStudio({ backends: ['webgpu', 'webgl'] });
  for (const backend of ['webgpu', 'webgl']) await studio.show(backend, FIELD);
});

after(() => studio?.close());

const drawn = async (backend, samples) => readPicture((await studio.take(backend, { ...SIZE, camera: CAMERA, samples })).png);

test('a still comes nearer to what it converges to with every sample, and both backends to the same', async () => {
  const last = await drawn('webgpu', 64);
  const [four, sixteen] = [await drawn('webgpu', 4), await drawn('webgpu', 16)];
  const [coarse, fine] = [meanDifference(four, last), meanDifference(sixteen, last)];
  assert.ok(fine < 0.6 * coarse, `${fine} % after 16 samples, ${coarse} % after 4`);
  assert.ok(fine < 2, `${fine} % after 16 samples`);
  const other = await drawn('webgl', 16);
  const apart = meanDifference(sixteen, other);
  assert.ok(apart < 0.5, `${apart} % between the backends`);
});

test('the same samples give the same picture', async () => {
  const [first, second] = [await drawn('webgpu', 2), await drawn('webgpu', 2)];
  assert.equal(meanDifference(first, second), 0);
});

/** How much neighbours in rows from `top` to `bottom` differ, on the mean: what a blur takes away. */
function detail({ width, data }, top, bottom) {
  let sum = 0;
  for (let y = top; y < bottom; y += 1) {
    for (let x = 1; x < width; x += 1) {
      const at = 4 * (y * width + x);
      for (let k = at; k < at + 3; k += 1) sum += Math.abs(data[k] - data[k - 4]);
    }
  }
  return sum / (3 * (width - 1) * (bottom - top));
}

test('through a lens what is in focus stays as sharp as it is, on both backends, and what is far from it is blurred', async () => {
  const sharp = await drawn('webgpu', 16);
  const taken = async (backend, focus) =>
    readPicture((await studio.take(backend, { ...SIZE, camera: CAMERA, samples: 16, aperture: 0.5, focus })).png);
  const near = await taken('webgpu', [0.5, 0.9]);
  const kept = (picture, top, bottom) => detail(picture, top, bottom) / detail(sharp, top, bottom);
  // Rows of the focus, and of what lies farther away.
  assert.ok(kept(near, 50, 58) > 0.8, `${kept(near, 50, 58)} of the detail is left in focus`);
  assert.ok(kept(near, 12, 24) < 0.6, `${kept(near, 12, 24)} of the detail is left out of it`);
  const apart = meanDifference(near, await taken('webgl', [0.5, 0.9]));
  assert.ok(apart < 0.5, `${apart} % between the backends`);
});
