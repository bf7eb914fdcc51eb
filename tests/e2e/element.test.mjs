// <rock-field> in a real browser: lifecycle, sizing, frames, loss, attributes. Drawn by WebGL2 unless said otherwise.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { decodePng } from '../engines/png.mjs';
import { holdTimers, launch, pageOf } from './browser.mjs';

/** Everything the element could leave behind is counted. */
const COUNTERS = `
  globalThis.heard = [];
  globalThis.counts = { frames: 0, workers: 0, ended: 0 };
  const raf = requestAnimationFrame;
  globalThis.requestAnimationFrame = (callback) => { counts.frames += 1; return raf(callback); };
  globalThis.frame = () => new Promise((resolve) => raf(resolve));
  globalThis.Worker = class extends Worker {
    constructor(...args) { super(...args); counts.workers += 1; }
    terminate() { counts.ended += 1; super.terminate(); }
  };
  // The device's own canvas stands nowhere.
  globalThis.contexts = [];
  const getContext = HTMLCanvasElement.prototype.getContext;
  HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
    const context = getContext.call(this, kind, ...rest);
    if (kind === 'webgl2' && context && !contexts.includes(context)) contexts.push(context);
    return context;
  };
  globalThis.loseContext = () => contexts.at(-1).getExtension('WEBGL_lose_context').loseContext();
  globalThis.listenTo = (element) => {
    // Not by its id, under which it is known only while it stands in the document.
    globalThis.a = element;
    for (const type of ['generate', 'error', 'load', 'notice', 'restored', 'camera-change', 'progress']) {
      element.addEventListener(type, ({ detail }) => heard.push({ type, detail }));
    }
    return element;
  };
  globalThis.types = () => heard.map(({ type }) => type);
`;

/** A small field: a software GPU pays by the triangle, too. */
const SMALL = 'image-width="200" image-height="150"';

const page0 = (body) => `<!doctype html><html lang="en"><meta charset="utf-8"><title>element</title><link rel="icon" href="data:,">
<style>body { margin: 0 } rock-field { width: 400px; height: 300px }</style><script>${COUNTERS}</script>${body}
<script type="module" src="/rock-field.js"></script>`;

let session;
let html = '';

before(async () => {
  session = await launch({ intercept: pageOf('element.html', () => html) });
});

after(() => session?.close());

/** A page with this body; waits for the first picture unless told otherwise. */
async function open(body = `<rock-field id="a" ${SMALL}></rock-field><script>listenTo(a)</script>`, { painted = true, ...options } = {}) {
  html = page0(body);
  const opened = await session.open('element.html', options);
  if (painted)
    await opened.page.evaluate(() => customElements.whenDefined('rock-field').then(() => document.querySelector('rock-field').ready));
  return opened;
}

const pause = (page, ms) => page.waitForTimeout(ms);

/** Software rendering takes its time, more of it on a busy machine: wait for what is to come, not for a while. */
const until = (page, test) => page.waitForFunction(test);

/** Waits until no frame has been asked for in 800 ms, nor is to come, however late; gives the number of frames so far. */
function quiet(page) {
  return page.evaluate(async () => {
    for (let last = -1; last !== counts.frames; ) {
      last = counts.frames;
      await frame();
      await new Promise((resolve) => setTimeout(resolve, 800));
    }
    return counts.frames;
  });
}

test('without any attribute it shows the first preset: one run, one load, then silence', async () => {
  const { page, errors, warnings, close } = await open('<rock-field id="a"></rock-field><script>listenTo(a)</script>');
  await until(page, () => a.shadowRoot.getElementById('description').textContent !== '');
  const state = await page.evaluate(() => ({
    preset: a.params.layers.length,
    rocks: a.field.stats.rocks,
    backend: a.backend,
    types: types(),
    label: a.shadowRoot.getElementById('description').textContent,
  }));
  assert.equal(state.preset, 3);
  assert.equal(state.backend, 'webgl');
  assert(Math.abs(state.rocks - 3100) < 180);
  assert.deepEqual(
    state.types.filter((type) => type !== 'progress'),
    ['generate', 'load'],
  );
  assert.match(state.label, /^3,\d\d\d rocks in three sizes, largest 1\.\d m, 8\d% covered$/);
  const before = await quiet(page);
  await pause(page, 1500);
  assert.equal(await page.evaluate(() => counts.frames), before, 'frames were asked for while nothing changed');
  assert.deepEqual(errors, []);
  assert.deepEqual(
    warnings.filter((text) => text.includes('rock-field')),
    [],
  );
  await close();
});

test('several assignments in one task are one run, and one frame', async () => {
  const { page, close } = await open();
  await quiet(page);
  const seen = await page.evaluate(async () => {
    heard.length = 0;
    const frames = counts.frames;
    for (let seed = 1; seed <= 5; seed += 1) a.params = { ...a.params, seed };
    a.setAttribute('view', 'wireframe');
    a.color = 'rock';
    const field = await a.getField();
    await frame();
    await frame();
    return { types: types(), seed: a.params.seed, view: a.view, color: a.color, same: a.field === field, frames: counts.frames - frames };
  });
  assert.deepEqual([seen.seed, seen.view, seen.color, seen.same], [5, 'wireframe', 'rock', true]);
  assert.deepEqual(
    seen.types.filter((type) => type !== 'progress'),
    ['generate'],
  );
  assert(seen.frames <= 3, `${seen.frames} frames`);
  await close();
});

test('the look is drawn at once and starts no run, by property, attribute, undo and panel alike', async () => {
  const { page, errors, close } = await open(
    '<rock-field id="a" preset="riverbed" image-width="256" image-height="256"></rock-field><script>listenTo(a)</script>',
  );
  await quiet(page);
  const seen = await page.evaluate(async () => {
    heard.length = 0;
    const field = await a.getField();
    const frames = counts.frames;
    a.dust = 0.9;
    a.material = a.material.map(() => 'slate');
    a.setAttribute('moss', '0.5');
    a.params = { ...a.params, sunElevation: 12 };
    await frame();
    await frame();
    const shared = new URL(a.shareURL()).hash;
    const set = [a.dust, a.moss, a.material.at(-1), a.sunElevation];
    const undone = a.undo();
    const kept = (await a.getField()) === field;
    return { shared, set, undone, dust: a.dust, kept, types: types(), frames: counts.frames - frames };
  });
  assert.deepEqual(seen.set, [0.9, 0.5, 'slate', 12]);
  assert.match(seen.shared, /&moss=0\.5&dust=0\.9&se=12&mat=slate(,slate)*$/);
  assert.deepEqual([seen.undone, seen.kept, seen.types], [true, true, []]);
  assert(seen.frames > 0 && seen.frames <= 3, `${seen.frames} frames`);
  // Rocks and look at once are a run.
  assert.deepEqual(
    await page.evaluate(async () => {
      a.params = { ...a.params, seed: 5, dust: 0.1 };
      await a.getField();
      return [types().filter((type) => type === 'generate').length, a.dust];
    }),
    [1, 0.1],
  );
  assert.deepEqual(errors, []);
  await close();
});

test("the colour is the preset's until one is chosen, and comes with its field", async () => {
  const { page, errors, close } = await open();
  const seen = await page.evaluate(async () => {
    const framings = [];
    const look = () => framings.push(JSON.stringify(a.defaultCamera));
    await a.getField();
    look();
    a.addEventListener('generate', look, { once: true });
    a.setAttribute('preset', 'shingle');
    a.params;
    look();
    const colors = ['layer', a.color];
    await a.getField();
    a.color = 'plain';
    a.setAttribute('preset', 'scree');
    await a.getField();
    colors.push(a.color, new URL(a.shareURL()).hash);
    a.color = null;
    // Another colour leaves the camera where it was, so the link has to tell it.
    colors.push(a.color, new URL(a.shareURL()).hash.replace(/=[\d.,]+$/, ''));
    a.setAttribute('preset', 'journal-fig11a');
    colors.push(a.color);
    a.setAttribute('color', 'natural');
    colors.push(a.color);
    await a.getField();
    colors.push(new URL(a.shareURL()).hash);
    return { colors, framings };
  });
  assert.deepEqual(seen.colors, [
    'layer',
    'natural',
    'plain',
    '#v=1&preset=scree&w=200&h=150&color=plain',
    'natural',
    '#v=1&preset=scree&w=200&h=150&camera',
    'layer',
    'natural',
    '#v=1&preset=journal-fig11a&w=200&h=150&color=natural',
  ]);
  const [before, pending, after] = seen.framings;
  assert.equal(pending, before, 'the old field is framed close up before the new one is there');
  assert.notEqual(after, before);
  assert.deepEqual(errors, []);
  await close();
});

test('a wrong value from code is thrown by name and changes nothing', async () => {
  const { page, close } = await open();
  const seen = await page.evaluate(() => {
    const before = JSON.stringify(a.params);
    const caught = [];
    for (const set of [() => (a.params = { ...a.params, packing: 2 }), () => (a.view = 'sideways'), () => (a.color = 3)]) {
      try {
        set();
      } catch (error) {
        caught.push([error.name, error.key]);
      }
    }
    return { caught, same: JSON.stringify(a.params) === before, view: a.view };
  });
  assert.deepEqual(seen, {
    caught: [
      ['OutOfRange', 'packing'],
      ['OutOfRange', 'view'],
      ['OutOfRange', 'color'],
    ],
    same: true,
    view: '3d',
  });
  await close();
});

test('params is a copy, both ways', async () => {
  const { page, close } = await open();
  assert(
    await page.evaluate(() => {
      const given = a.params;
      a.params = given;
      given.layers[0].taper[0] = 77;
      a.params.layers[0].height[0] = 77;
      return a.params.layers[0].taper[0] !== 77 && a.params.layers[0].height[0] !== 77;
    }),
  );
  await close();
});

test('properties set before the element was defined are taken over', async () => {
  const { page, close } = await open(
    `<rock-field id="a" ${SMALL}></rock-field><script>listenTo(a); a.view = 'diagrams'; a.theme = 'dark'; a.color = 'plain'</script>`,
  );
  assert.deepEqual(await page.evaluate(() => [a.view, a.theme, a.color, Object.hasOwn(a, 'view')]), ['diagrams', 'dark', 'plain', false]);
  await close();
});

test('attributes: valid ones are taken, malformed ones default with one notice that names them, changes touch nothing else', async () => {
  const { page, errors, warnings, close } = await open(
    `<rock-field id="a" preset="conference-fig9a" seed="-7" view="<img src=x onerror=alert(1)>" color="plain"></rock-field><script>listenTo(a)</script>`,
    // The words would go by themselves.
    { prepare: (page) => page.addInitScript(holdTimers) },
  );
  const first = await page.evaluate(() => ({
    params: a.params,
    view: a.view,
    color: a.color,
    notices: heard.filter(({ type }) => type === 'notice').map(({ detail }) => detail.message),
    images: a.shadowRoot.querySelectorAll('img').length,
    text: a.shadowRoot.querySelector('[part=message]').innerText,
  }));
  assert.deepEqual([first.params.notation, first.params.seed, first.view, first.color, first.images], ['relative', 0, '3d', 'plain', 0]);
  assert.equal(first.notices.length, 2);
  assert.match(first.notices[0], /^seed: "-7"/);
  assert.match(first.notices[1], /^view: "<img/);
  assert(first.text.includes('seed: "-7"'), 'the notice is not visible');
  assert.equal(warnings.filter((text) => text.includes('<rock-field>')).length, 2);

  await page.evaluate(() => {
    heard.length = 0;
    a.params = { ...a.params, packing: 0.3 };
    a.view = 'selection';
    a.setAttribute('seed', '12');
  });
  const second = await page.evaluate(async () => [
    (await a.getField()) && a.params.seed,
    a.params.packing,
    a.params.notation,
    a.view,
    types().filter((type) => type === 'notice').length,
  ]);
  assert.deepEqual(second, [12, 0.3, 'relative', 'selection', 0]);
  await page.evaluate(() => a.setAttribute('preset', 'journal-fig11a'));
  assert.deepEqual(await page.evaluate(() => [a.params.seed, a.params.packing, a.params.notation, a.params.layers.length]), [
    12,
    0.7,
    'px',
    1,
  ]);
  await page.evaluate(() => a.setAttribute('seed', 'nine'));
  assert.equal(await page.evaluate(() => a.getField().then(() => types().filter((type) => type === 'notice').length)), 1);
  assert.deepEqual(errors, []);
  await close();
});

test('src is a share link: everything is taken from it, what is wrong in it is named', async () => {
  const { page, errors, close } = await open(
    `<rock-field id="a" src="https://example.org/#v=1&amp;preset=journal-fig12a&amp;seed=9&amp;w=300&amp;h=200&amp;cd=5&amp;view=wireframe&amp;camera=1,0.5,200,150,100,0"></rock-field><script>listenTo(a)</script>`,
  );
  const state = await page.evaluate(() => ({
    params: a.params,
    view: a.view,
    camera: a.camera,
    framed: a.framed,
    notices: heard.filter(({ type }) => type === 'notice').map(({ detail }) => detail.message),
  }));
  assert.deepEqual(
    [state.params.seed, state.params.imageWidth, state.params.imageHeight, state.params.packing, state.view, state.framed],
    [9, 300, 200, 1, 'wireframe', false],
  );
  assert.deepEqual(state.camera, { azimuth: 1, elevation: 0.5, distance: 200, target: [150, 100, 0] });
  assert.equal(state.notices.length, 1);
  assert.match(state.notices[0], /^src: .*cd/);
  assert.deepEqual(errors, []);
  await close();
});

test('before the first picture one sees what the page has put behind the element, not a black canvas', async () => {
  const body = '<rock-field id="a" style="--rock-field-background: rgb(0 160 0)"></rock-field><script>listenTo(a)</script>';
  const { page, close } = await open(body, {
    painted: false,
    prepare: (page) => page.route('**/generator_bg-*', (route) => route.abort()),
  });
  await page.waitForFunction(() => types().includes('error') && a.shadowRoot.querySelector('.stage canvas'), undefined, { polling: 100 });
  const { data, width, channels } = decodePng(await page.screenshot({ scale: 'css', clip: { x: 0, y: 0, width: 400, height: 100 } }));
  assert.deepEqual([...data.subarray(channels * (50 * width + 200)).subarray(0, 3)], [0, 160, 0]);
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
  await page.evaluate(() => (a.hidden = true));
  await pause(page, 100);
  await page.evaluate(() => Object.assign(a, { hidden: false }) && Object.assign(a.style, { width: '200px', height: '0' }));
  await pause(page, 100);
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
        new IntersectionObserver((entries) => entries.at(-1).isIntersecting || resolve()).observe(a);
      }),
  );
  await pause(page, 300);
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
  const kept = await page.evaluate(async () => {
    heard.length = 0;
    const canvas = a.shadowRoot.querySelector('canvas');
    b.append(a);
    await frame();
    document.body.prepend(a);
    a.remove();
    await new Promise((resolve) => setTimeout(resolve, 200));
    document.body.append(a);
    await new Promise((resolve) => setTimeout(resolve, 1500));
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
  const seen = await page.evaluate(async () => {
    await customElements.whenDefined('rock-field');
    for (let round = 0; round < 20; round += 1) {
      const element = document.createElement('rock-field');
      document.body.append(element);
      if (round % 2 === 0) await frame();
      element.remove();
    }
    do await new Promise((resolve) => setTimeout(resolve, 3800));
    while (counts.workers !== counts.ended);
    return [counts.workers, counts.ended];
  });
  assert.equal(seen[0], seen[1], `${seen[0]} workers made, ${seen[1]} ended`);
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
  for (const reducedMotion of ['no-preference', 'reduce']) {
    const { page, errors, close } = await open(undefined, { reducedMotion });
    await page.locator('rock-field').hover();
    await page.mouse.down();
    await page.mouse.move(260, 160, { steps: 4 });
    await page.mouse.up();
    await page.keyboard.press('ArrowLeft');
    const moved = await page.evaluate(() => [
      a.framed,
      types().filter((type) => type === 'camera-change').length,
      JSON.stringify(a.camera) !== JSON.stringify(a.defaultCamera),
    ]);
    assert.deepEqual([moved[0], moved[2]], [false, true]);
    assert(moved[1] >= 3);
    const frames = await quiet(page);
    await page.evaluate(() => a.frameAll());
    await until(page, () => a.framed);
    const used = (await quiet(page)) - frames;
    if (reducedMotion === 'reduce') assert(used <= 2, `${used} frames`);
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
        .end(page0('<rock-field id="a" lang="ja"></rock-field><script>listenTo(a)</script>'));
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
      return [a.backend, a.shadowRoot.querySelector('[part=message]').innerText, colors.size, border.size];
    });
    assert.equal(seen[0], 'canvas2d');
    assert.match(seen[1], /平面図/);
    assert(seen[2] > 10, `a picture of ${seen[2]} colours`);
    assert.equal(seen[3], 1, 'the plan has a margin on all sides');
  } finally {
    await blind.close();
  }
});
