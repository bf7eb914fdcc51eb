// The picture of a <rock-field> and its life in a document: size, sight, moves, removal, camera, a lost context, no GPU. Drawn by WebGL2 unless
// said otherwise.
/** @import { Page } from 'playwright-core' */
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { readPicture } from '../../scripts/lib/pixels.mjs';
import { holdTimers, launch, staysQuietFor } from './browser.mjs';
import { SMALL, launchElement, openElement, pageWith, quiet, until } from './element-page.mjs';

/** @type {import('./browser.mjs').Session} */
let session;

before(async () => {
  session = await launchElement();
});

after(() => session?.close());

const open = (body, options) => openElement(session, body, options);

test('before the first picture one sees what the page has put behind the element, not a black canvas', async () => {
  const body = '<rock-field id="a" style="--rock-field-background: rgb(0 160 0)"></rock-field><script>listenTo(a)</script>';
  const { page, close } = await open(body, {
    painted: false,
    prepare: (/** @type {Page} */ page) => page.route('**/generator_bg-*', (route) => route.abort()),
  });
  await page.waitForFunction(() => types().includes('error') && a.shadowRoot.querySelector('.stage canvas'), undefined, { polling: 100 });
  const { data, width } = readPicture(await page.screenshot({ scale: 'css', clip: { x: 0, y: 0, width: 400, height: 100 } }));
  assert.deepEqual([...data.subarray(4 * (50 * width + 200)).subarray(0, 3)], [0, 160, 0]);
  await page.unrouteAll();
  await page.evaluate(() => a.generate());
  await page.evaluate(() => a.ready);
  assert.equal(await page.evaluate(() => getComputedStyle(a.shadowRoot.querySelector('.stage canvas')).opacity), '1');
  await close();
});

test('it has the size of a replaced element unless the page says otherwise, in device pixels', async () => {
  const { page, close } = await open(
    `<style>rock-field { width: revert-layer; height: revert-layer }</style><rock-field id="a" ${SMALL} view="selection" quality="low"></rock-field><script>listenTo(a)</script>`,
    { deviceScaleFactor: 2 },
  );
  const measure = () =>
    page.evaluate(async () => {
      await frame();
      await frame();
      const { width, height } = a.getBoundingClientRect();
      const canvas = a.shadowRoot.querySelector('canvas');
      return [width, height, canvas.width, canvas.height];
    });
  await page.evaluate(() => document.querySelectorAll('style').forEach((style) => style.remove()));
  assert.deepEqual(await measure(), [300, 150, 600, 300]);
  await page.evaluate(() => Object.assign(a.style, { width: '123px', height: '77px' }));
  assert.deepEqual(await measure(), [123, 77, 246, 154]);
  await page.evaluate(() => Object.assign(a.style, { width: '9000px', height: '6000px' }));
  const [, , width, height] = await measure();
  assert(width * height <= 3840 * 2160 && width * height > 8e6, `${width} × ${height}`);
  const twoFrames = () => page.evaluate(() => frame().then(frame));
  await page.evaluate(() => (a.hidden = true));
  await twoFrames();
  await page.evaluate(() => Object.assign(a, { hidden: false }) && Object.assign(a.style, { width: '200px', height: '0' }));
  await twoFrames();
  await page.evaluate(() => Object.assign(a.style, { height: '100px' }));
  assert.deepEqual(await measure(), [200, 100, 400, 200]);
  await close();
});

test('out of sight nothing is drawn, and the newest field is there when it comes back', async () => {
  const { page, close } = await open(
    `<rock-field id="a" ${SMALL}></rock-field><div style="height: 5000px"></div><script>listenTo(a)</script>`,
  );
  await page.evaluate(
    () =>
      new Promise((resolve) => {
        scrollTo(0, 4000);
        new IntersectionObserver((entries) => entries.at(-1)?.isIntersecting || resolve(true)).observe(a);
      }),
  );
  const before = await quiet(page);
  await page.evaluate(async () => {
    a.params = { ...a.params, seed: 3 };
    await a.getField();
    a.color = 'rock';
  });
  assert.equal(await quiet(page), before);
  await page.evaluate(() => scrollTo(0, 0));
  await page.waitForFunction((frames) => counts.frames > frames, before);
  await close();
});

test('moving it in the document costs nothing', async () => {
  const { page, close } = await open(`<rock-field id="a" ${SMALL}></rock-field><p id="b"></p><script>listenTo(a)</script>`);
  // What is taken out is cleared up some time later, unless it is back by then.
  await page.evaluate(holdTimers);
  const kept = await page.evaluate(async () => {
    heard.length = 0;
    const canvas = a.shadowRoot.querySelector('canvas');
    b.append(a);
    await frame();
    document.body.prepend(a);
    a.remove();
    await frame();
    document.body.append(a);
    for (let round = 0; round < 3; round += 1) {
      await frame();
      passTime();
    }
    return [a.shadowRoot.querySelector('canvas') === canvas, counts.workers, counts.ended, types()];
  });
  assert.deepEqual(kept, [true, 1, 0, []]);
  await close();
});

test('taken out for good it ends its worker and canvas; put back it shows the same field again, without a run', async () => {
  const { page, errors, close } = await open();
  const seen = await page.evaluate(async () => {
    const { field } = a;
    const ready = a.ready;
    a.remove();
    // After two seconds, and on a busy machine later.
    while (counts.ended === 0) await new Promise((resolve) => setTimeout(resolve, 100));
    const gone = [a.shadowRoot.querySelectorAll('canvas').length, counts.workers, counts.ended, a.backend];
    const refused = await a.generate().catch((error) => error.name);
    heard.length = 0;
    document.body.append(a);
    await a.ready;
    const frames = counts.frames;
    const back = [a.field === field, a.ready !== ready, types(), counts.workers];
    a.params = { ...a.params, seed: 8 };
    await a.getField();
    return { gone, refused, back, frames, workers: counts.workers };
  });
  assert.deepEqual(seen.gone, [0, 1, 1, null]);
  assert.equal(seen.refused, 'NotConnected');
  assert.deepEqual(seen.back, [true, true, ['load'], 1]);
  assert.equal(seen.workers, 2);
  assert.deepEqual(errors, []);
  await close();
});

test('taken out before it has loaded anything, it leaves nothing behind', async () => {
  const { page, errors, close } = await open('', { painted: false });
  await page.evaluate(async () => {
    await customElements.whenDefined('rock-field');
    for (let round = 0; round < 20; round += 1) {
      const element = document.createElement('rock-field');
      document.body.append(element);
      if (round % 2 === 0) await frame();
      element.remove();
    }
  });
  // Long enough for a worker that was asked for to be there, and to be given up.
  await staysQuietFor(page, 3800);
  await until(page, () => counts.workers === counts.ended);
  assert.deepEqual(errors, []);
  await close();
});

test('after a loss of the context the same field comes back through the same camera', async () => {
  const { page, errors, close } = await open();
  const seen = await page.evaluate(async () => {
    a.camera = { ...a.camera, azimuth: 1 };
    await frame();
    await frame();
    heard.length = 0;
    const before = { canvas: a.shadowRoot.querySelector('canvas'), field: a.field, camera: JSON.stringify(a.camera) };
    const restored = new Promise((resolve) => a.addEventListener('restored', resolve, { once: true }));
    loseContext();
    await restored;
    const canvases = a.shadowRoot.querySelectorAll('canvas');
    return {
      types: types(),
      same: a.field === before.field,
      camera: JSON.stringify(a.camera) === before.camera,
      one: canvases.length === 1 && canvases[0] !== before.canvas,
      backend: a.backend,
    };
  });
  assert.deepEqual(seen, { types: ['restored'], same: true, camera: true, one: true, backend: 'webgl' });
  assert.deepEqual(errors, []);
  await close();
});

test('a context that is lost again and again ends in the plan with true words; a button brings 3D back', async () => {
  const { page, close } = await open();
  // Nothing is tried again by itself: what brings 3D back is the button.
  await page.evaluate(holdTimers);
  const backend = await page.evaluate(async () => {
    // On a busy machine four losses take their time: by the page's clock they follow each other closely.
    const now = performance.now.bind(performance);
    performance.now = () => now() / 10;
    for (let round = 0; round < 4; round += 1) {
      const restored = new Promise((resolve) => a.addEventListener('restored', resolve, { once: true }));
      loseContext();
      await restored;
    }
    return a.backend;
  });
  assert.equal(backend, 'canvas2d');
  const message = page.locator('rock-field [part=message]');
  await message.getByText('The graphics device was lost several times; the plan is shown, and 3D is tried again later.').waitFor();
  await message.getByRole('button', { name: 'Retry' }).click();
  await until(page, () => a.backend === 'webgl');
  assert.deepEqual(await page.evaluate(() => [a.backend, types().filter((type) => type === 'error').length]), ['webgl', 1]);
  assert.equal(await message.isVisible(), false);
  await close();
});

test('keys and pointer move the camera; frame all brings it back, with and without motion', async () => {
  for (const reducedMotion of /** @type {const} */ (['no-preference', 'reduce'])) {
    const { page, errors, close } = await open(undefined, { reducedMotion });
    await page.locator('rock-field').hover();
    await page.mouse.down();
    await page.mouse.move(260, 160, { steps: 4 });
    await page.mouse.up();
    await page.keyboard.press('ArrowLeft');
    const moved = await page.evaluate(() => ({
      framed: a.framed,
      times: types().filter((type) => type === 'camera-change').length,
      elsewhere: JSON.stringify(a.camera) !== JSON.stringify(a.defaultCamera),
    }));
    assert.deepEqual([moved.framed, moved.elsewhere], [false, true]);
    assert(moved.times >= 3);
    await quiet(page);
    const changes = () => page.evaluate(() => types().filter((type) => type === 'camera-change').length);
    const before = await changes();
    await page.evaluate(() => a.frameAll());
    await until(page, () => a.framed);
    await quiet(page);
    // How many frames are drawn is the device's affair; without motion, the camera is there at once.
    const used = (await changes()) - before;
    if (reducedMotion === 'reduce') assert(used <= 2, `${used} changes of the camera`);
    // All of the field first, from where it was looked at; the default camera with the second call.
    await page.evaluate(() => a.frameAll());
    await until(page, () => a.framed && JSON.stringify(a.camera) === JSON.stringify(a.defaultCamera));
    assert.deepEqual(errors, []);
    await close();
  }
});

test('the whole field stays framed when the size changes, until the camera is moved', async () => {
  const { page, close } = await open();
  const seen = await page.evaluate(async () => {
    const wide = a.camera.distance;
    a.style.width = '150px';
    await frame();
    await frame();
    const narrow = a.camera.distance;
    a.camera = { ...a.camera, distance: 500 };
    a.style.width = '400px';
    await frame();
    await frame();
    return [narrow !== wide, a.camera.distance];
  });
  assert.deepEqual(seen, [true, 500]);
  await close();
});

test('without any GPU it draws the plan and says so, in the language of the page', async () => {
  const blind = await launch({
    gpu: false,
    intercept(request, response) {
      if (!request.url.startsWith('/element.html')) return false;
      response
        .writeHead(200, { 'content-type': 'text/html' })
        .end(pageWith('<rock-field id="a" lang="ja"></rock-field><script>listenTo(a)</script>'));
      return true;
    },
  });
  try {
    const { page } = await blind.open('element.html', { deviceScaleFactor: 1 });
    await page.evaluate(() => customElements.whenDefined('rock-field').then(() => a.ready));
    const seen = await page.evaluate(() => {
      const canvas = a.shadowRoot.querySelector('canvas');
      const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
      const color = (at) => data[at] * 65536 + data[at + 1] * 256 + data[at + 2];
      const [colors, border] = [new Set(), new Set()];
      for (let at = 0; at < data.length; at += 4) {
        const [x, y] = [(at / 4) % canvas.width, Math.floor(at / 4 / canvas.width)];
        (x % (canvas.width - 1) === 0 || y % (canvas.height - 1) === 0 ? border : colors).add(color(at));
      }
      const words = a.shadowRoot.querySelector('[part=message]').innerText;
      return { backend: a.backend, words, colors: colors.size, border: border.size };
    });
    assert.equal(seen.backend, 'canvas2d');
    assert.match(seen.words, /平面図/);
    assert(seen.colors > 10, `a picture of ${seen.colors} colours`);
    assert.equal(seen.border, 1, 'the plan has a margin on all sides');
  } finally {
    await blind.close();
  }
});
