// Walking at eye height in a browser: on the page by its button, in an element by its attribute.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { launch, pageOf } from './browser.mjs';

const HTML = `<!doctype html><html lang="ja"><meta charset="utf-8"><title>walk</title><link rel="icon" href="data:,">
<rock-field style="width: 200px; height: 150px" src="#w=256&amp;h=192" navigation="walk"></rock-field>
<script type="module" src="/rock-field.js"></script>`;

/** @type {import('./browser.mjs').Session} */
let session;

before(async () => {
  session = await launch({ intercept: pageOf('walk.html', () => HTML) });
});

after(() => session?.close());

/** Height of the eye, px. */
const eyeOf = ({ distance, elevation, target }) => target[2] + distance * Math.sin(elevation);

test('the button of the page walks: keys go, Escape and the button come back to the camera of before', async () => {
  const { page, errors } = await session.open('index.html#v=1&preset=journal-fig1&w=400&h=300', {
    viewport: { width: 360, height: 640 },
    reducedMotion: 'reduce',
  });
  const state = () =>
    page.evaluate(() => {
      const element = document.querySelector('rock-field');
      return { camera: element.camera, navigation: element.navigation, framed: element.framed };
    });
  const button = page.getByRole('button', { name: 'Walk at eye height' });
  await button.waitFor();
  const before = await state();
  await button.click();
  await page.waitForFunction(() => !document.querySelector('rock-field').framed);
  const down = await state();
  assert.equal(await button.getAttribute('aria-pressed'), 'true');
  assert.equal(down.navigation, 'walk');
  assert.ok(eyeOf(down.camera) < 150, `the eye is at ${eyeOf(down.camera)} px`);
  assert.match(await page.locator('rock-field').locator('[role=status]', { hasText: 'W A S D' }).innerText(), /Esc/);
  await page.keyboard.down('w');
  await page.waitForFunction((y) => Math.abs(document.querySelector('rock-field').camera.target[1] - y) > 5, down.camera.target[1]);
  await page.keyboard.up('w');
  await page.keyboard.press('Escape');
  await page.waitForFunction(() => document.querySelector('rock-field').framed);
  const back = await state();
  assert.deepEqual([back.camera, back.navigation], [before.camera, 'orbit']);
  assert.equal(await button.getAttribute('aria-pressed'), 'false');
  await button.click();
  await page.waitForFunction(() => !document.querySelector('rock-field').framed);
  await button.click();
  await page.waitForFunction(() => document.querySelector('rock-field').framed);
  // Nothing of the walk is left in the address.
  await page.waitForFunction(() => !location.hash.includes('camera='));
  await button.click();
  await page.waitForFunction(() => !document.querySelector('rock-field').framed);
  await page.keyboard.press('f');
  await page.waitForFunction(() => document.querySelector('rock-field').navigation === 'orbit');
  await page.waitForFunction(() => document.querySelector('rock-field').framed);
  assert.deepEqual(errors, []);
});

test('an element walks by its attribute, in its language; a camera that is assigned ends it', async () => {
  const { page, errors } = await session.open('walk.html', { reducedMotion: 'reduce' });
  await page.evaluate(() => customElements.whenDefined('rock-field').then(() => document.querySelector('rock-field').ready));
  await page.waitForFunction(() => !document.querySelector('rock-field').framed);
  assert.match(await page.locator('rock-field').locator('[role=status]', { hasText: 'W A S D' }).innerText(), /歩く/);
  const place = { azimuth: 1, elevation: 0.6, distance: 300, target: [100, 90, 0], fov: 36 };
  const after = await page.evaluate(async (camera) => {
    const element = document.querySelector('rock-field');
    element.camera = /** @type {typeof element.camera} */ (camera);
    while (element.hasAttribute('navigation')) await new Promise((resolve) => requestAnimationFrame(resolve));
    let refused = '';
    try {
      element.navigation = /** @type {'walk'} */ (/** @type {unknown} */ ('fly'));
    } catch (error) {
      refused = /** @type {Error} */ (error).message;
    }
    return { camera: element.camera, refused };
  }, place);
  assert.deepEqual(after, { camera: place, refused: 'navigation is "fly"; it must be one of orbit, walk' });
  assert.deepEqual(errors, []);
});
