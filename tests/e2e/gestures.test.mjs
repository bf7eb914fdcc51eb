// The manners of the picture on a page that scrolls, with the browser's own scrolling and touch: wheel, fingers, mouse, keys.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { launch, pageOf, staysQuietFor } from './browser.mjs';
import { boxOf, closeClean } from './shown.mjs';

const HTML = `<!doctype html><html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width"><title>gestures</title><link rel="icon" href="data:,">
<style>body { margin: 0; height: 3000px } rock-field { width: 320px; height: 240px; margin: 300px 20px }</style>
<rock-field src="#w=256&amp;h=192"></rock-field>
<script>
  const a = document.querySelector('rock-field');
  let framings = 0;
  a.addEventListener('camera-change', ({ detail }) => (framings += detail.framed));
  globalThis.cameraState = () => ({ scroll: scrollY, scale: visualViewport.scale, framings, ...a.camera, framed: a.framed });
</script>
<script type="module" src="/rock-field.js"></script>`;

/** @type {import('./browser.mjs').Session} */
let session;

before(async () => {
  session = await launch({ intercept: pageOf('gestures.html', () => HTML) });
});

after(() => session?.close());

/** The page, scrolled by 200 px: it can give way up and down. `mid` is the middle of the picture. */
async function open(options) {
  const opened = await session.open('gestures.html', { viewport: { width: 360, height: 640 }, reducedMotion: 'reduce', ...options });
  const { page } = opened;
  await page.evaluate(() => customElements.whenDefined('rock-field').then(() => document.querySelector('rock-field').ready));
  await page.evaluate(() => scrollTo(0, 200));
  await page.waitForFunction(() => scrollY === 200);
  const box = await boxOf(page.locator('rock-field'));
  const state = () => page.evaluate(() => cameraState());
  return { ...opened, state, mid: { x: box.x + box.width / 2, y: box.y + box.height / 2 } };
}

async function phone() {
  const opened = await open({ hasTouch: true, isMobile: true });
  const device = await opened.context.newCDPSession(opened.page);
  /**
   * Fingers as the device reports them: `[x, y]` each.
   *
   * @param {'Start' | 'Move' | 'End'} type
   * @param {number[][]} points
   */
  const touch = (type, ...points) =>
    device.send('Input.dispatchTouchEvent', { type: `touch${type}`, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
  /** Fingers from here to there, several reports on the way. */
  const slide = async (from, to, { lift = true } = {}) => {
    const steps = 8;
    await touch('Start', ...from);
    for (let step = 1; step <= steps; step += 1) {
      await touch('Move', ...from.map(([x, y], k) => [x + ((to[k][0] - x) * step) / steps, y + ((to[k][1] - y) * step) / steps]));
      await opened.page.waitForTimeout(16);
    }
    if (lift) await touch('End');
  };
  /** Not waited for in between: a report is answered when the page has heard it, and a busy page would make the tap a long one. */
  const tap = (x, y) => Promise.all([touch('Start', [x, y]), touch('End')]);
  return { ...opened, touch, slide, tap };
}

test('the wheel scrolls the page; after a click on the picture, or with ctrl, it zooms', async () => {
  const opened = await open();
  const { page, mid, state } = opened;
  const first = await state();
  await page.mouse.move(mid.x, mid.y);
  await page.mouse.wheel(0, 40);
  await page.waitForFunction(() => scrollY === 240);
  assert.equal((await state()).distance, first.distance);

  await page.keyboard.down('Control');
  await page.mouse.wheel(0, 40);
  await page.keyboard.up('Control');
  await page.waitForFunction((distance) => cameraState().distance > distance, first.distance);
  const zoomed = await state();
  assert.deepEqual([zoomed.scroll, zoomed.scale], [240, 1]);

  await page.mouse.click(mid.x, mid.y - 40);
  await page.mouse.wheel(0, -40);
  await page.waitForFunction((distance) => cameraState().distance < distance, zoomed.distance);
  assert.equal((await state()).scroll, 240);

  // The focus elsewhere, the page has the wheel again.
  const { distance } = await state();
  await page.mouse.click(10, 10);
  await page.mouse.move(mid.x, mid.y - 40);
  await page.mouse.wheel(0, 40);
  await page.waitForFunction(() => scrollY === 280);
  assert.equal((await state()).distance, distance);
  await closeClean(opened);
});

test('the mouse: a drag orbits, with shift, right or middle it pans, a double click frames all', async () => {
  const opened = await open();
  const { page, mid, state } = opened;
  const drag = async (button) => {
    await page.mouse.move(mid.x, mid.y);
    await page.mouse.down({ button });
    await page.mouse.move(mid.x + 40, mid.y + 20, { steps: 4 });
    await page.mouse.up({ button });
    return state();
  };
  let last = await state();
  const turned = await drag('left');
  assert.ok(turned.azimuth !== last.azimuth && turned.elevation > last.elevation);
  last = turned;
  await page.keyboard.down('Shift');
  const shifted = await drag('left');
  await page.keyboard.up('Shift');
  for (const panned of [shifted, await drag('right'), await drag('middle')]) {
    assert.deepEqual([panned.azimuth, panned.elevation, panned.scroll], [last.azimuth, last.elevation, 200]);
    assert.notDeepEqual(panned.target, last.target);
    last = panned;
  }
  await page.mouse.dblclick(mid.x, mid.y);
  const framed = await state();
  assert.deepEqual([framed.framings, framed.framed], [1, true]);
  await closeClean(opened);
});

test('keys move the picture that has the focus; Tab leaves it', async () => {
  const opened = await open();
  const { page, state } = opened;
  const isFocused = () => page.evaluate(() => document.activeElement === document.querySelector('rock-field'));
  const first = await state();
  await page.keyboard.press('Tab');
  assert.ok(await isFocused());
  await page.keyboard.press('ArrowLeft');
  await page.keyboard.press('+');
  const moved = await state();
  assert.ok(moved.azimuth !== first.azimuth && moved.distance < first.distance);
  await page.keyboard.press('Home');
  assert.ok((await state()).framed);
  await page.keyboard.press('Escape');
  await page.keyboard.press('Tab');
  assert.ok(!(await isFocused()));
  await closeClean(opened);
});

for (const dy of [-120, 80]) {
  test(`one finger ${dy < 0 ? 'up' : 'down'}: the page scrolls, the camera stays`, async () => {
    const opened = await phone();
    const { page, mid, state, slide } = opened;
    const first = await state();
    await slide([[mid.x, mid.y]], [[mid.x + 10, mid.y + dy]]);
    await page.waitForFunction((isUp) => (isUp ? scrollY > 240 : scrollY < 160), dy < 0);
    await staysQuietFor(page, 400);
    const { scroll, framings, ...camera } = await state();
    assert.ok(dy < 0 ? scroll > 240 : scroll < 160, `scrolled to ${scroll}`);
    const { scroll: before, framings: none, ...same } = first;
    assert.deepEqual([camera, framings], [same, 0]);
    await closeClean(opened);
  });
}

test('one finger sideways: the picture turns, the page stays, also when the finger goes on upright', async () => {
  const opened = await phone();
  const { page, mid, state, slide, touch } = opened;
  const first = await state();
  await slide([[mid.x, mid.y]], [[mid.x + 80, mid.y + 4]], { lift: false });
  const turned = await state();
  assert.ok(turned.azimuth !== first.azimuth);
  for (const dy of [30, 60, 90]) await touch('Move', [mid.x + 80, mid.y + dy]);
  await touch('End');
  await staysQuietFor(page, 400);
  const last = await state();
  assert.ok(last.elevation > turned.elevation);
  assert.deepEqual([last.scroll, last.distance], [200, first.distance]);
  await closeClean(opened);
});

test('a tap, then a drag: the picture turns upright, the page stays', async () => {
  const opened = await phone();
  const { page, mid, state, slide, tap } = opened;
  const first = await state();
  await Promise.all([tap(mid.x, mid.y), slide([[mid.x + 4, mid.y]], [[mid.x + 4, mid.y + 90]])]);
  await staysQuietFor(page, 400);
  const last = await state();
  assert.ok(last.elevation > first.elevation);
  assert.deepEqual([last.scroll, last.azimuth, last.framings], [200, first.azimuth, 0]);
  await closeClean(opened);
});

test('two taps frame all, once', async () => {
  const opened = await phone();
  const { page, mid, state, slide, tap } = opened;
  await slide([[mid.x, mid.y]], [[mid.x + 80, mid.y]]);
  assert.ok(!(await state()).framed);
  // Sooner, the first tap would be taken for the second of two.
  await staysQuietFor(page, 400);
  await Promise.all([tap(mid.x, mid.y), tap(mid.x, mid.y)]);
  await page.waitForFunction(() => cameraState().framed);
  await staysQuietFor(page, 400);
  const last = await state();
  assert.deepEqual([last.framings, last.scroll, last.scale], [1, 200, 1]);
  await closeClean(opened);
});

test('two fingers: apart they zoom, together up they pan; the page neither scrolls nor zooms', async () => {
  const opened = await phone();
  const { page, mid, state, slide } = opened;
  const first = await state();
  await slide(
    [
      [mid.x - 30, mid.y],
      [mid.x + 30, mid.y],
    ],
    [
      [mid.x - 90, mid.y],
      [mid.x + 90, mid.y],
    ],
  );
  await staysQuietFor(page, 400);
  const zoomed = await state();
  assert.ok(zoomed.distance < 0.6 * first.distance);
  assert.deepEqual([zoomed.scroll, zoomed.scale, zoomed.azimuth], [200, 1, first.azimuth]);
  await slide(
    [
      [mid.x - 30, mid.y],
      [mid.x + 30, mid.y],
    ],
    [
      [mid.x - 30, mid.y - 100],
      [mid.x + 30, mid.y - 100],
    ],
  );
  await staysQuietFor(page, 400);
  const panned = await state();
  assert.notDeepEqual(panned.target, zoomed.target);
  assert.deepEqual([panned.scroll, panned.scale, panned.azimuth], [200, 1, first.azimuth]);
  await closeClean(opened);
});
