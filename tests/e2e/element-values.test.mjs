// What is set on a <rock-field>, by property, attribute or link, and the runs and frames that it costs. Drawn by WebGL2.
/** @import { Page } from 'playwright-core' */
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { holdTimers, staysQuietFor } from './browser.mjs';
import { SMALL, launchElement, openElement, quiet, until } from './element-page.mjs';

/** @type {import('./browser.mjs').Session} */
let session;

before(async () => {
  session = await launchElement();
});

after(() => session?.close());

const open = (body, options) => openElement(session, body, options);

test('without any attribute it shows the first preset: one run, one load, then silence', async () => {
  const { page, errors, warnings, close } = await open('<rock-field id="a"></rock-field><script>listenTo(a)</script>');
  await until(page, () => a.shadowRoot.querySelector('#description').textContent !== '');
  const state = await page.evaluate(() => ({
    preset: a.params.layers.length,
    rocks: a.field.stats.rocks,
    backend: a.backend,
    types: types(),
    label: a.shadowRoot.querySelector('#description').textContent,
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
  await staysQuietFor(page, 1500);
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
    for (const wrong of [{ params: { ...a.params, packing: 2 } }, { view: 'sideways' }, { color: 3 }]) {
      try {
        Object.assign(a, wrong);
      } catch (error) {
        const { name, key } = /** @type {ErrorInfo} */ (error);
        caught.push([name, key]);
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
    { prepare: (/** @type {Page} */ page) => page.addInitScript(holdTimers) },
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
  assert.deepEqual(state.camera, { azimuth: 1, elevation: 0.5, distance: 200, target: [150, 100, 0], fov: 36 });
  assert.equal(state.notices.length, 1);
  assert.match(state.notices[0], /^src: .*cd/);
  assert.deepEqual(errors, []);
  await close();
});
