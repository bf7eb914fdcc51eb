// The page and the element of wood ears in a real browser: first picture, sliders, bases by hand and by keys, links, undo, a phone, two languages.
// Drawn by WebGL2 (software) unless said otherwise, and mostly in the plain colours, which cost it little.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { violations } from './axe.mjs';
import { copied, hidePictures, launch, pageOf, screenshotPath, until } from './browser.mjs';
import { MESSAGE, SMALL, baseOnScreen, closeClean, colony, hash, message, openWoodEars, params } from './wood-ear-page.mjs';

/** @type {import('./browser.mjs').Session} */
let session;

before(async () => {
  session = await launch();
});

after(() => session?.close());

const open = (address, options, browser = session) => openWoodEars(browser, address, options);

for (const webgpu of [false, true]) {
  test(`the first picture is a fallen log among rocks, none of which grows through it, drawn with ${webgpu ? 'WebGPU' : 'WebGL2'}`, async () => {
    const browser = webgpu ? await launch({ webgpu }) : session;
    try {
      const opened = await open('', { viewport: { width: 720, height: 240 } }, browser);
      const { page } = opened;
      await hidePictures(page);
      const { individuals, crossingPairs } = await colony(page);
      assert.ok(individuals > 300);
      assert.equal(crossingPairs, 0);
      assert.equal(await page.locator('[data-backend]').textContent(), webgpu ? 'WebGPU' : 'WebGL2');
      assert.deepEqual(
        await page.evaluate(() => [document.querySelector('wood-ear-log').color, document.querySelector('#preset-name').textContent]),
        ['natural', 'Fallen log'],
      );
      assert.equal(await page.locator(MESSAGE).count(), 0);
      // No rock's ground lies under the middle of the log, where it touches the soil.
      const under = await page.evaluate(() => {
        const { field, scene } = document.querySelector('wood-ear-log');
        const [x, y] = scene.place;
        const inside = (from, to, vertices) => {
          let isIn = false;
          for (let k = from, before = to - 1; k < to; before = k, k += 1) {
            const [ax, ay, bx, by] = [vertices[2 * before], vertices[2 * before + 1], vertices[2 * k], vertices[2 * k + 1]];
            if (ay > y !== by > y && x < ((bx - ax) * (y - ay)) / (by - ay) + ax) isIn = !isIn;
          }
          return isIn;
        };
        return field.layers.flatMap(({ selected, cellStarts, cellVertices }) =>
          [...selected].filter((cell) => inside(cellStarts[cell], cellStarts[cell + 1], cellVertices)),
        ).length;
      });
      assert.equal(under, 0);
      assert.ok(await page.evaluate(() => document.querySelector('wood-ear-log').field.stats.rocks > 300));
      await closeClean(opened);
    } finally {
      if (webgpu) await browser.close();
    }
  });
}

test('every slider changes the colony or the picture, its number says so, and undo takes it back', async () => {
  const opened = await open('#preset=thesis-default&d=12&r=25&m=90&co=pressed&dr=0.3&th=0.1&ft=0.3&pi=0.5&w=60&lb=0.5');
  const { page } = opened;
  await hidePictures(page);
  await page.locator('.slider').first().waitFor({ state: 'attached' });
  await page.locator('details').evaluateAll((parts) => parts.forEach((part) => part.setAttribute('open', '')));
  const looks = ['sa', 'se'];
  const ids = (await page.locator('.slider').evaluateAll((sliders) => sliders.map(({ id }) => id))).filter((id) => !looks.includes(id));
  assert.ok(ids.length >= 18, ids.join());
  let last = await hash(page);
  for (const id of ids) {
    const slider = page.locator(`[id="${id}"]`);
    const shown = await page.locator(`[id="${id}-number"]`).inputValue();
    await slider.press('PageUp');
    assert.notEqual(await hash(page), last, `${id}: the same colony`);
    assert.notEqual(await page.locator(`[id="${id}-number"]`).inputValue(), shown, id);
    await page.keyboard.press('Control+z');
    assert.equal(await hash(page), last, `${id}: undone`);
    last = await hash(page);
  }
  await closeClean(opened);
});

test('a click on the log places a base, its ring is dragged along the log and removed by Delete, each a step of undo', async () => {
  const opened = await open();
  const { page } = opened;
  const [x, y] = await baseOnScreen(page);
  await page.mouse.click(x + 90, y + 4);
  await page.waitForFunction(() => document.querySelector('wood-ear-log').params.bases.length === 2);
  await colony(page);
  const placed = (await params(page)).bases[1];
  assert.equal(placed.range, null);
  await page.waitForFunction(() => document.querySelector('wood-ear-log').shadowRoot.querySelectorAll('.handle').length === 2);
  // It is drawn at the nearest vertex of the log, with a later frame.
  let hx, hy;
  await until(async () => {
    [hx, hy] = await baseOnScreen(page, 1);
    return Math.hypot(hx - (x + 90), hy - (y + 4)) < 30;
  }, 'the ring is where the log was clicked');
  await page.mouse.move(hx, hy);
  await page.mouse.down();
  for (const step of [20, 40, 60]) await page.mouse.move(hx + step, hy, { steps: 3 });
  await page.mouse.up();
  await colony(page);
  const moved = (await params(page)).bases[1];
  assert.notDeepEqual(moved.position, placed.position);
  await page.keyboard.press('Control+z');
  await page.waitForFunction(
    (wanted) => JSON.stringify(document.querySelector('wood-ear-log').params.bases[1]) === wanted,
    JSON.stringify(placed),
  );
  await page.evaluate(() => document.querySelector('wood-ear-log').shadowRoot.querySelectorAll('.handle')[1].focus());
  await page.keyboard.press('ArrowLeft');
  await page.waitForFunction(
    (wanted) => JSON.stringify(document.querySelector('wood-ear-log').params.bases[1]) !== wanted,
    JSON.stringify(placed),
  );
  await page.keyboard.press('Delete');
  await page.waitForFunction(() => document.querySelector('wood-ear-log').params.bases.length === 1);
  // The last one stays.
  await page.evaluate(() => document.querySelector('wood-ear-log').shadowRoot.querySelector('.handle').focus());
  await page.keyboard.press('Delete');
  assert.equal((await params(page)).bases.length, 1);
  // By keys alone: in the middle of the picture.
  await page.evaluate(() => document.querySelector('wood-ear-log').shadowRoot.querySelector('.stage').focus());
  await page.keyboard.press('Enter');
  await page.waitForFunction(() => document.querySelector('wood-ear-log').params.bases.length === 2);
  await closeClean(opened);
});

test('a base has a range of its own, from the panel', async () => {
  const opened = await open();
  const { page } = opened;
  await hidePictures(page);
  await page.getByRole('button', { name: 'Add base' }).click();
  await page.locator('[data-base="1"] .layer-toggle').click();
  await page.locator('[data-param="range-of-1"] input[value="own"]').check();
  await page.locator('[id="br-1"]').press('Home');
  await colony(page);
  assert.deepEqual(
    (await params(page)).bases.map(({ range }) => range),
    [null, 20],
  );
  await page.getByRole('button', { name: 'Remove base 1' }).click();
  assert.deepEqual(
    (await params(page)).bases.map(({ range }) => range),
    [20],
  );
  await closeClean(opened);
});

test('a shared link shows the same log on the same rocks elsewhere', async () => {
  const opened = await open(
    '#preset=wet-colony&d=20&r=25&seed=7&color=plain&bx=-30,20&by=-15,-15&bz=20,20&br=-,30&ground=preset%3Djournal-fig12a%26w%3D64%26h%3D64%26r%3D20',
  );
  const { page } = opened;
  await hidePictures(page);
  await page.locator('#ground').selectOption('shingle');
  await page.getByRole('button', { name: 'Other rocks' }).click();
  const here = await hash(page);
  await page.waitForURL(/ground=.*seed\.1/);
  const other = await open(new URL(page.url()).hash);
  assert.equal(await hash(other.page), here);
  assert.deepEqual(await params(other.page), await params(page));
  await closeClean(other);
  await closeClean(opened);
});

test('what is wrong with a link or a value is said, and something legal is shown', async () => {
  const opened = await open('#preset=thesis-default&r=25&d=900&moss=1&bx=1,2&by=3');
  const { page } = opened;
  await hidePictures(page);
  assert.match(await message(page), /^d: 900 must be between 0 and 100; using 100\.$/);
  assert.equal((await params(page)).density, 100);
  const number = page.locator('[id="m-number"]');
  await number.fill('400');
  await number.blur();
  assert.equal((await params(page)).moisture, 100);
  await page.locator('.control-problem').waitFor();
  await closeClean(opened);
});

test('the embed code shows the same log on another page', async () => {
  let html = '';
  const other = await launch({ intercept: pageOf('elsewhere.html', () => html) });
  try {
    const opened = await open(
      `${SMALL}&ground=preset%3Djournal-fig12a%26w%3D128%26h%3D128%26r%3D20`,
      { permissions: ['clipboard-read', 'clipboard-write'] },
      other,
    );
    const { page } = opened;
    const code = await copied(page, page.getByRole('button', { name: 'Copy embed code' }));
    html = `<!doctype html><title>Elsewhere</title><link rel="icon" href="data:,">${code}`;
    assert.match(
      html,
      /<script async crossorigin src="http:\/\/[^"]+\/wood-ear-cdn\.js"><\/script>\n<wood-ear-log src="#v=1&amp;preset=thesis-default/,
    );
    const expected = await hash(page);
    const there = await other.open('elsewhere.html', { viewport: { width: 500, height: 400 } });
    await there.page.waitForFunction(() => document.querySelector('wood-ear-log')?.scene, undefined, { polling: 100 });
    assert.equal(await hash(there.page), expected);
    await closeClean(there);
    await closeClean(opened);
  } finally {
    await other.close();
  }
});

test('of a drag the colony before its collisions is followed at once, and the newest is the last shown', async () => {
  const opened = await open('#preset=thesis-default');
  const { page } = opened;
  await hidePictures(page);
  const seen = await page.evaluate(async () => {
    const element = document.querySelector('wood-ear-log');
    const seen = [];
    element.addEventListener('generate', ({ detail }) =>
      seen.push([element.colony.stats.individuals, detail.isPreview, detail.superseded]),
    );
    // To and fro, until some of it has been seen.
    for (let step = 0; step < 20 || seen.filter(([, isPreview]) => isPreview).length < 2; step += 1) {
      element.density = 40 - 10 * Math.cos(step / 6);
      await new Promise((resolve) => setTimeout(resolve, 16));
    }
    await element.getColony();
    return seen;
  });
  assert.deepEqual(seen.at(-1).slice(1), [false, false]);
  await closeClean(opened);
});

test('a phone has the picture and a sheet of controls, and Japanese has all its words', async () => {
  const opened = await open(SMALL, { viewport: { width: 360, height: 720 }, deviceScaleFactor: 1, locale: 'ja-JP', hasTouch: true });
  const { page } = opened;
  assert.equal(await page.locator('html').getAttribute('lang'), 'ja');
  assert.match((await page.locator('.summary').textContent()) ?? '', /キクラゲ/);
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 360);
  await page.locator('.sheet-toggle').click();
  assert.equal(await page.locator('label[for="m"]').textContent(), '含水率');
  await page.screenshot({ path: screenshotPath('wood-ear-360') });
  await closeClean(opened);
});

test('a long run is told once, beside the offer of the other rule, clear of what the picture says, and until it ends', async () => {
  const opened = await open(`${SMALL}&co=thesis`, { viewport: { width: 1280, height: 800 }, locale: 'en-US' });
  const { page } = opened;
  // Its own run has to be over, or the news of that would come in between.
  await colony(page);
  const tell = (progress) => page.evaluate((given) => document.querySelector('wood-ear-log')['tellProgress'](given), progress);
  const box = page.locator('[part=message]');
  const offer = page.locator('.progress-offer');
  for (const [language, words] of [
    ['en', 'about 40 seconds'],
    ['ja', '約40 秒'],
  ]) {
    await page.locator(`input[name="language"][value="${language}"]`).evaluate((/** @type {HTMLInputElement} */ button) => button.click());
    await tell({ stage: 'collide', fraction: 0.31, secondsLeft: 40 });
    await offer.filter({ hasText: words }).waitFor();
    assert.ok(!(await box.innerText()).includes(words), 'it is said twice');
    // What the picture has to say for itself meanwhile, with its button.
    await page.evaluate(() =>
      document
        .querySelector('wood-ear-log')
        ['say']('Words of the picture itself, long enough to need a second line where the window is no wider than a phone.'),
    );
    for (const [width, height] of [
      [1280, 800],
      [844, 390],
      [360, 740],
      [320, 640],
    ]) {
      await page.setViewportSize({ width, height });
      const covered = await page.evaluate(() => {
        const boxes = [
          document.querySelector('.progress'),
          document.querySelector('wood-ear-log').shadowRoot.querySelector('[part=message]'),
        ].map((one) => one.getBoundingClientRect());
        const [a, b] = boxes;
        const isCovered = Math.min(a.bottom, b.bottom) > Math.max(a.top, b.top) && Math.min(a.right, b.right) > Math.max(a.left, b.left);
        return isCovered || boxes.some(({ top }) => top < 0) ? boxes.map(({ top, bottom }) => [top, bottom]) : false;
      });
      assert.equal(covered, false, `${language} at ${width} × ${height}`);
    }
    await tell(null);
  }
  // On another page the element says it by itself.
  const said = await page.evaluate(() => {
    document.body.innerHTML = '<wood-ear-log backend="null" density="4" collisions="thesis"></wood-ear-log>';
    const element = document.querySelector('wood-ear-log');
    const box = element.shadowRoot.querySelector('[part=message]');
    const words = () => (box.hidden ? '' : box.innerText);
    return element.getColony().then(() => {
      const heard = [];
      for (const progress of [
        { stage: 'collide', fraction: 0.31, secondsLeft: 40 },
        { stage: 'collide', fraction: 0.32, secondsLeft: 30 },
        null,
      ]) {
        element['tellProgress'](/** @type {import('../../www/generator/protocol.ts').Progress<'collide'> | null} */ (progress));
        heard.push(words());
      }
      return heard;
    });
  });
  assert.deepEqual([said[0] !== '', said[1] === said[0], said[2]], [true, true, '']);
  await opened.close();
});

for (const colorScheme of ['light', 'dark']) {
  test(`axe finds nothing to complain about in ${colorScheme} colours`, async () => {
    const opened = await open(SMALL, { colorScheme });
    await opened.page.locator('details').evaluateAll((parts) => parts.forEach((part) => part.setAttribute('open', '')));
    assert.deepEqual(await violations(opened.page), []);
    await closeClean(opened);
  });
}

test('an element on another page takes attributes, properties and its own panel', async () => {
  const opened = await session.open('wood-ear.html#preset=thesis-default', { viewport: { width: 800, height: 600 }, locale: 'en-US' });
  const { page } = opened;
  const state = await page.evaluate(async () => {
    document.body.innerHTML =
      '<wood-ear-log density="20" range="25" bases="0 -20 20, 30 -20 20 30" ground="none" controls="open" style="width: 700px; height: 500px"></wood-ear-log>';
    const element = document.querySelector('wood-ear-log');
    await element.ready;
    const before = (await element.getColony()).stats.individuals;
    element.density = 60;
    element.logLength = 120;
    const after = (await element.getColony()).stats.individuals;
    let thrown;
    try {
      element.params = { ...element.params, density: 900 };
    } catch (error) {
      const { name, key, value, max } = /** @type {ErrorInfo} */ (error);
      thrown = { name, key, value, max };
    }
    return { before, after, thrown, bases: element.bases.length, rocks: element.field.stats.rocks, length: element.params.log.length };
  });
  assert.ok(state.after > state.before);
  assert.deepEqual(
    { ...state, before: 0, after: 0 },
    { before: 0, after: 0, thrown: { name: 'OutOfRange', key: 'density', value: 900, max: 100 }, bases: 2, rocks: 0, length: 120 },
  );
  await page.waitForFunction(() =>
    document.querySelector('wood-ear-log').shadowRoot.querySelector('.controls-panel')?.shadowRoot.querySelector('[data-param="d"]'),
  );
  await closeClean(opened);
});
