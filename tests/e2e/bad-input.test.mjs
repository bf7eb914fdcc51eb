// What nobody means and everybody can send: cameras in rocks and under the ground, suns that have set, devices that go while a still is taken, none at all.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { readPicture } from '../../scripts/lib/pixels.mjs';
import { launch, pageOf } from './browser.mjs';

const ATTRIBUTES = 'preset="scree" color="natural" quality="low" image-width="160" image-height="120" seed="3"';
/** Every device that is made, so that it can be taken away. */
const SCRIPT = `
  globalThis.devices = [];
  const { requestDevice } = GPUAdapter.prototype;
  GPUAdapter.prototype.requestDevice = async function (...args) {
    const device = await requestDevice.apply(this, args);
    devices.push(device);
    return device;
  };
`;
const pageWith = (
  /** @type {string} */ attributes,
) => `<!doctype html><html lang="en"><meta charset="utf-8"><title>bad input</title><link rel="icon" href="data:,">
<style>rock-field { width: 96px; height: 60px }</style><script>${SCRIPT}</script><rock-field ${ATTRIBUTES} ${attributes}></rock-field>
<script type="module" src="/rock-field.js"></script>`;

let html = '';
/** @type {import('./browser.mjs').Session} */
let session;

before(async () => {
  session = await launch({ webgpu: true, intercept: pageOf('bad-input.html', () => html) });
});

after(() => session?.close());

async function open(attributes, options = {}) {
  html = pageWith(attributes);
  const opened = await session.open('bad-input.html', options);
  await opened.page.evaluate(() => customElements.whenDefined('rock-field').then(() => document.querySelector('rock-field').ready));
  return opened;
}

/** In the page: the pixels of a picture as a PNG file, or the words in which it is refused. `loses`: the device goes after the first sample. */
async function taken(
  /** @type {{ camera?: object | null, loses?: boolean } & Parameters<HTMLElementTagNameMap['rock-field']['toBlob']>[0]} */ picture,
) {
  const { camera = null, loses = false, ...options } = picture;
  const element = document.querySelector('rock-field');
  element.camera = /** @type {typeof element.camera | null} */ (camera);
  let isLost = !loses;
  const onProgress = () => {
    if (isLost) return;
    isLost = true;
    for (const device of /** @type {{ devices: { destroy(): void }[] }} */ (/** @type {unknown} */ (globalThis)).devices) device.destroy();
  };
  try {
    const bytes = new Uint8Array(await (await element.toBlob({ ...options, onProgress })).arrayBuffer());
    return { png: btoa(String.fromCharCode(...bytes)), isLost, refused: '' };
  } catch (thrown) {
    const { name, message } = /** @type {Error} */ (thrown);
    return { png: '', isLost, refused: `${name}: ${message}` };
  }
}

/** How many colours a picture has: few where it is blank. */
function colours({ png }) {
  const { data } = readPicture(Buffer.from(png, 'base64'));
  return new Set(Array.from({ length: data.length / 4 }, (_, k) => data.subarray(4 * k, 4 * k + 3).join())).size;
}

test('in a rock, under the ground, at the zenith and far away there is a picture, of few pixels and through every lens', async () => {
  const { page, errors } = await open('backend="webgpu"');
  const at = { azimuth: 0.4, elevation: 0.3, distance: 1, target: [80, 60, 5] };
  const size = { width: 48, height: 30 };
  for (const camera of [
    at,
    { ...at, target: [80, 60, -500] },
    { ...at, elevation: -1.5, distance: 50 },
    { ...at, elevation: -Math.PI },
    { ...at, elevation: Math.PI / 2, distance: 1e6 },
    { ...at, target: [1e6, -1e6, 1e6], fov: 120 },
    { ...at, fov: 5, distance: 0.1 },
  ]) {
    const picture = await page.evaluate(taken, { camera, ...size });
    assert.ok(picture.png, `${JSON.stringify(camera)}: ${picture.refused}`);
  }
  const still = await page.evaluate(taken, { camera: { ...at, distance: 40 }, ...size, samples: 2, aperture: 0.1, focus: 1e6 });
  assert.ok(still.png, still.refused);
  const small = await page.evaluate(taken, { camera: { ...at, distance: 60 }, width: 360, height: 200 });
  assert.ok(colours(small) > 500, `${colours(small)} colours`);
  assert.deepEqual(errors, []);
});

test('a sun below the horizon in a link stands as low as it can, with a word on it', async () => {
  const { page, errors, warnings } = await open('src="#v=1&amp;preset=scree&amp;w=160&amp;h=120&amp;se=-30" backend="webgpu"');
  const { sunElevation } = await page.evaluate(() => document.querySelector('rock-field').params);
  assert.equal(sunElevation, 5);
  assert.match(warnings.join(), /\bse\b.*-30/);
  const picture = await page.evaluate(taken, { width: 48, height: 30 });
  assert.ok(colours(picture) > 100, `${colours(picture)} colours`);
  assert.deepEqual(errors, []);
});

test('a device that goes during a still is replaced, and the still is the very same', async () => {
  const { page } = await open('backend="webgpu"');
  const still = { width: 48, height: 30, samples: 3 };
  const whole = await page.evaluate(taken, still);
  const again = await page.evaluate(taken, { ...still, loses: true });
  assert.ok(again.png && again.isLost, again.refused);
  const pixels = ({ png }) => readPicture(Buffer.from(png, 'base64')).data;
  assert.deepEqual(pixels(again), pixels(whole));
});

test('without a GPU a still is the plan, and a picture without the ground is refused in words', async () => {
  const { page, errors } = await open('backend="canvas2d"');
  const plan = await page.evaluate(taken, { width: 48, height: 30, samples: 4, aperture: 2.8 });
  assert.ok(colours(plan) > 3, plan.refused);
  const { refused } = await page.evaluate(taken, { width: 48, height: 30, ground: false });
  assert.match(refused, /^NoPicture: without a GPU/);
  assert.deepEqual(errors, []);
});

test('four device pixels in a CSS pixel are drawn, as many as fit a screen', async () => {
  const { page, errors } = await open('backend="webgpu" style="width: 150px; height: 90px"', { deviceScaleFactor: 4 });
  const size = await page.evaluate(() => {
    const { width, height } = document.querySelector('rock-field').shadowRoot.querySelector('canvas');
    return [width, height];
  });
  assert.deepEqual(size, [600, 360]);
  assert.deepEqual(errors, []);
});
