// What people who embed <rock-field> rely on: attributes and properties of parameters, orbit, poster, laziness, files, links, undo.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { PATIENCE, launch, pageOf, staysQuietFor } from './browser.mjs';

const SMALL = 'image-width="256" image-height="192"';

/** @type {import('./browser.mjs').Session} */
let session;
let html = '';

before(async () => {
  session = await launch({ intercept: pageOf('embed.html', () => html) });
});

after(() => session?.close());

/**
 * A page with this body, whose element is `a`; `heard` has its events.
 *
 * @param {string} body
 * @param {import('./browser.mjs').OpenOptions & { painted?: boolean, lang?: string }} [options]
 */
async function open(body, { painted = true, lang = 'en', ...options } = {}) {
  html = `<!doctype html><html lang="${lang}"><meta charset="utf-8"><title>embed</title><link rel="icon" href="data:,">
<style>body { margin: 0 } rock-field { width: 320px; height: 240px }</style>${body}
<script>
  const a = document.querySelector('rock-field');
  const heard = [];
  for (const type of ['generate', 'error', 'load', 'notice', 'progress']) a.addEventListener(type, ({ detail }) => heard.push({ type, detail }));
</script>
<script type="module" src="/rock-field.js"></script>`;
  const opened = await session.open('embed.html', options);
  if (painted) await opened.page.evaluate(() => customElements.whenDefined('rock-field').then(() => a.ready));
  return opened;
}

test('attributes and properties of parameters are two ways to the same field', async () => {
  const { page, errors, warnings, close } = await open(`<rock-field ${SMALL} seed="3" radius="40 12" taper-rock="1 2"></rock-field>`);
  const byAttribute = await page.evaluate(() => ({ params: a.params, radius: a.radius, taperRock: a.taperRock, width: a.imageWidth }));
  assert.deepEqual(
    [byAttribute.radius, byAttribute.taperRock, byAttribute.width, byAttribute.params.layers.length],
    [[40, 12], [1, 2], 256, 2],
  );
  const byProperty = await page.evaluate(async () => {
    const b = document.createElement('rock-field');
    document.body.append(b);
    Object.assign(b, { imageWidth: 256, imageHeight: 192, seed: 3, radius: [40, 12], taperRock: [1, 2] });
    const [one, two] = await Promise.all([a.getField(), b.getField()]);
    return { params: b.params, same: one.positions.length > 0 && one.positions.every((value, k) => value === two.positions[k]) };
  });
  assert.deepEqual(byProperty, { params: byAttribute.params, same: true });
  const grown = await page.evaluate(() => {
    const [b, c] = [document.createElement('rock-field'), document.createElement('rock-field')];
    b.setAttribute('radius', '90 30 10 5');
    c.radius = [90, 30, 10, 5];
    return [b.params, c.params];
  });
  assert.deepEqual(grown[0], grown[1], 'a layer more is another one as an attribute than as a property');
  const thrown = await page.evaluate(() => {
    const before = JSON.stringify(a.params);
    const errors = [{ packing: 2 }, { radius: [0] }, { radius: 7 }, { layers: [{ radius: 'x' }] }].map((wrong) => {
      try {
        Object.assign(a, wrong);
        return '';
      } catch (error) {
        const { name, key } = /** @type {ErrorInfo} */ (error);
        return `${name} ${key}`;
      }
    });
    return { errors, unchanged: before === JSON.stringify(a.params) };
  });
  assert.deepEqual(thrown, {
    errors: ['OutOfRange packing', 'OutOfRange radius', 'WrongType radius', 'WrongType radius'],
    unchanged: true,
  });
  assert.deepEqual([errors, warnings], [[], []]);
  await close();
});

test('what a framework assigns: text is the attribute, nothing takes it away, and no order matters', async () => {
  const { page, errors, warnings, close } = await open(`<rock-field ${SMALL}></rock-field>`);
  const seen = await page.evaluate(async () => {
    const radii = ({ layers }) => layers.map(({ radius }) => radius);
    const b = document.createElement('rock-field');
    // Properties before the attributes that fill everything, or their layers, otherwise.
    Object.assign(b, {
      seed: 7,
      packing: '0.6',
      radius: [80, 30, 10],
      imageWidth: 256,
      imageHeight: 192,
      disabled: false,
      autoRotate: true,
      backend: 'null',
    });
    b.setAttribute('taper-rock', '6 6 2');
    b.preset = 'journal-fig1';
    document.body.append(b);
    await b.getField();
    // The renderer may come later than the field.
    while (!b.backend) await new Promise((resolve) => setTimeout(resolve, 5));
    const first = [
      b.seed,
      b.packing,
      radii(b),
      b.taperRock,
      b.imageWidth,
      b.getAttribute('packing'),
      b.getAttribute('preset'),
      b.hasAttribute('disabled'),
      b.hasAttribute('auto-rotate'),
      b.backend,
    ];
    b.preset = 'journal-fig11a';
    const moved = [b.seed, b.packing, radii(b), b.imageWidth];
    Object.assign(b, { seed: '9', radius: '40 12' });
    const texts = [b.seed, radii(b)];
    Object.assign(b, {
      seed: undefined,
      radius: null,
      packing: undefined,
      view: undefined,
      preset: undefined,
      metresPerPixel: undefined,
      taperRock: undefined,
    });
    const gone = [b.seed, radii(b), b.packing, b.preset, b.getAttributeNames().sort()];
    b.seed = 5;
    b.params = { ...b.params, seed: 6 };
    b.preset = 'journal-fig1';
    const replaced = [b.seed, b.imageWidth];
    b.remove();
    return { first, moved, texts, gone, replaced };
  });
  assert.deepEqual(seen, {
    first: [7, 0.6, [80, 30, 10], [6, 6, 2], 256, '0.6', 'journal-fig1', false, true, 'null'],
    moved: [7, 0.6, [80, 30, 10], 256],
    texts: [9, [40, 12]],
    gone: [0, [90, 30, 10], 0.7, '', ['auto-rotate', 'backend']],
    replaced: [0, 1024],
  });
  assert.deepEqual([errors, warnings], [[], []]);
  await close();
});

test('attributes changed while it generates: the last ones win, and every malformed one is named once', async () => {
  const { page, errors, close } = await open(`<rock-field ${SMALL}></rock-field>`);
  const result = await page.evaluate(async () => {
    for (let seed = 1; seed <= 5; seed++) {
      a.setAttribute('seed', String(seed));
      a.setAttribute('packing', '0.6');
      await new Promise((resolve) => setTimeout(resolve, 2));
    }
    a.setAttribute('packing', 'much');
    a.setAttribute('radius', '30 x');
    a.setAttribute('view', 'sideways');
    await a.getField();
    return {
      seed: a.seed,
      packing: a.packing,
      view: a.view,
      notices: heard.filter(({ type }) => type === 'notice').map(({ detail }) => detail.message.split(':')[0]),
      errors: heard.filter(({ type }) => type === 'error').length,
    };
  });
  assert.deepEqual(result, { seed: 5, packing: 0.7, view: '3d', notices: ['packing', 'radius', 'view'], errors: 0 });
  assert.deepEqual(errors, []);
  await close();
});

test('camera-orbit is the default camera: frame all shows the whole field first and goes back there second', async () => {
  const { page, close } = await open(`<rock-field ${SMALL} camera-orbit="45deg 55deg 120%"></rock-field>`);
  const { own, whole, orbit, last, isFramed } = await page.evaluate(() => {
    const orbit = a.camera;
    a.removeAttribute('camera-orbit');
    const own = a.camera;
    a.cameraOrbit = '45deg 55deg 120%';
    a.camera = { ...own, azimuth: 2 };
    a.frameAll(false);
    const whole = a.camera;
    a.frameAll(false);
    return { own, whole, orbit, last: a.camera, isFramed: a.framed };
  });
  assert(Math.abs(orbit.azimuth - Math.PI / 4) < 1e-9 && Math.abs(orbit.elevation - (35 * Math.PI) / 180) < 1e-9);
  assert(Math.abs(orbit.distance / own.distance - 1.2) < 1e-9);
  assert.deepEqual([whole.azimuth, whole.distance > own.distance], [2, true]);
  assert.deepEqual([last, isFramed], [orbit, true]);
  await close();
});

test('auto-rotate turns, and not where the system asks for less motion', async () => {
  for (const reducedMotion of /** @type {const} */ (['no-preference', 'reduce'])) {
    const { page, close } = await open(`<rock-field ${SMALL} auto-rotate></rock-field>`, { reducedMotion });
    const turns = reducedMotion === 'no-preference';
    // However slowly its frames come; and where nothing moves, for a while.
    const turned = await page.evaluate(
      async (patience) => {
        const before = a.camera.azimuth;
        const end = performance.now() + patience;
        while (a.camera.azimuth === before && performance.now() < end) await new Promise((resolve) => setTimeout(resolve, 50));
        return { angle: a.camera.azimuth - before, framed: a.framed };
      },
      turns ? PATIENCE : 700,
    );
    assert.deepEqual([turned.angle > 0, turned.framed], [turns, true], reducedMotion);
    await close();
  }
});

test('a lazy element loads nothing before it comes near, and then like any other', async () => {
  const { page, close } = await open(`<div style="height: 5000px"></div><rock-field ${SMALL} loading="lazy"></rock-field>`, {
    painted: false,
  });
  const requests = [];
  page.on('request', (request) => requests.push(request.url()));
  await page.evaluate(() => customElements.whenDefined('rock-field'));
  await staysQuietFor(page, 500);
  assert.deepEqual(
    requests.filter((url) => url.endsWith('.wasm')),
    [],
  );
  await page.evaluate(() => a.scrollIntoView());
  await page.evaluate(() => a.ready);
  assert(requests.some((url) => url.endsWith('.wasm')));
  await close();
});

test('a poster stands in until the first picture; slots take the place of poster, progress and error', async () => {
  const image = 'data:image/gif;base64,R0lGODlhAQABAIAAAAUEBAAAACwAAAAAAQABAAACAkQBADs=';
  const { page, close } = await open(
    `<rock-field ${SMALL} poster="${image}" backend="null"><p slot="poster">soon</p><p slot="error">sorry</p></rock-field>`,
    { painted: false },
  );
  await page.evaluate(() => customElements.whenDefined('rock-field'));
  const parts = await page.evaluate(() => {
    const root = a.shadowRoot;
    return {
      slots: [...root.querySelectorAll('slot')].map(({ name }) => name),
      image: root.querySelector('[part=poster] img')?.getAttribute('src'),
    };
  });
  assert.deepEqual(parts, { slots: ['poster', 'progress', 'error'], image });
  await page.evaluate(() => a.ready);
  assert.equal(await page.evaluate(() => a.shadowRoot.querySelector('[part=poster]').hidden), true);
  await close();
});

test('toBlob gives a picture of the size asked for, and the screen keeps its own', async () => {
  const { page, close } = await open(`<rock-field ${SMALL}></rock-field>`);
  const result = await page.evaluate(async () => {
    const canvas = a.shadowRoot.querySelector('canvas');
    const before = [canvas.width, canvas.height];
    const blob = await a.toBlob({ width: 500, height: 200 });
    const bitmap = await createImageBitmap(blob);
    const sheet = /** @type {OffscreenCanvasRenderingContext2D} */ (new OffscreenCanvas(500, 200).getContext('2d'));
    sheet.drawImage(bitmap, 0, 0);
    const colours = new Set(new Uint32Array(sheet.getImageData(0, 0, 500, 200).data.buffer));
    const refused = await a.toBlob({ width: 100_000, height: 100_000 }).catch(({ name, key }) => `${name} ${key}`);
    const jpeg = await a.toBlob({ type: 'image/jpeg', quality: 0.8 });
    return {
      type: blob.type,
      size: [bitmap.width, bitmap.height],
      isPicture: colours.size > 50,
      same: before.join() === [canvas.width, canvas.height].join(),
      refused,
      jpeg: jpeg.type,
    };
  });
  assert.deepEqual(result, {
    type: 'image/png',
    size: [500, 200],
    isPicture: true,
    same: true,
    refused: 'OutOfRange width',
    jpeg: 'image/jpeg',
  });
  await close();
});

test('shareURL shows the same field elsewhere; undo and redo go back and forth; randomize keeps what is locked', async () => {
  const { page, errors, close } = await open(`<rock-field ${SMALL} seed="9"></rock-field>`);
  const result = await page.evaluate(async () => {
    const first = a.params;
    await a.randomize({ lock: ['imageWidth', 'packing'] });
    const second = a.params;
    await a.getField();
    const b = document.createElement('rock-field');
    b.setAttribute('src', a.shareURL('https://example.org/field?x=1'));
    document.body.append(b);
    const shared = JSON.stringify(b.params) === JSON.stringify(second);
    const undone = a.undo() && JSON.stringify(a.params) === JSON.stringify(first);
    const atStart = a.undo();
    const redone = a.redo() && JSON.stringify(a.params) === JSON.stringify(second);
    await a.randomize({ lock: ['layers'] });
    const layersKept = JSON.stringify(a.layers) === JSON.stringify(second.layers);
    const stranger = await a.randomize({ lock: ['size'] }).catch(({ name, key }) => `${name} ${key}`);
    return { changed: second.seed !== first.seed, width: second.imageWidth, shared, undone, atStart, redone, layersKept, stranger };
  });
  assert.deepEqual(result, {
    changed: true,
    width: 256,
    shared: true,
    undone: true,
    atStart: false,
    redone: true,
    layersKept: true,
    stranger: 'UnknownKey size',
  });
  assert.deepEqual(errors, []);
  await close();
});

test('what it shows is said to those who cannot see it, in the language of the page', async () => {
  for (const { lang, label, sentence } of [
    { lang: 'en', label: 'Field of rocks', sentence: /^\d+ rocks in three sizes, largest [\d.]+ c?m, \d+% covered$/ },
    { lang: 'ja', label: '岩の地面', sentence: /^3種類の大きさの岩\d+個、最大[\d.]+ c?m、被覆率\d+%$/ },
  ]) {
    const { page, close } = await open(`<rock-field ${SMALL} radius="60 20 8"></rock-field>`, { lang });
    const said = await page.evaluate(async () => {
      const stage = a.shadowRoot.querySelector('[role=application]');
      const description = a.shadowRoot.querySelector(`#${stage.getAttribute('aria-describedby')}`);
      // The words come after the picture.
      while (!description.textContent) await new Promise((resolve) => setTimeout(resolve, 5));
      return [stage.getAttribute('aria-label'), description.textContent];
    });
    assert.equal(said[0], label);
    assert.match(said[1] ?? '', sentence);
    await close();
  }
});

test('a disabled element takes neither focus nor input', async () => {
  const { page, close } = await open(`<rock-field ${SMALL} disabled></rock-field>`);
  const before = await page.evaluate(() => a.camera);
  await page.mouse.move(100, 100);
  await page.mouse.down();
  await page.mouse.move(200, 120, { steps: 4 });
  await page.mouse.up();
  await page.keyboard.press('Tab');
  await page.keyboard.press('ArrowLeft');
  assert.deepEqual(await page.evaluate(() => [a.camera, document.activeElement === a]), [before, false]);
  await close();
});
