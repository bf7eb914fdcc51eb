// The page in a real browser: first picture, presets, views, keys, a phone, two languages.
// Drawn by WebGL2 (software) unless said otherwise.
/** @import { Page } from 'playwright-core' */
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { tables } from '../../scripts/lib/tables.mjs';
import { violations } from './axe.mjs';
import { hidePictures, holdResults, launch, screenshotPath, until } from './browser.mjs';
import { MESSAGE, address, boxOf, closeClean, follow, hash, openRocks, params, stats } from './rock-page.mjs';

/** @type {import('./browser.mjs').Session} */
let session;

before(async () => {
  session = await launch();
});

after(() => session?.close());

const open = (address, options, browser = session) => openRocks(browser, address, options);

/**
 * A page with natural colours, whose shaders a software GPU needs ten seconds for: the tests that need them follow one another's links on it. The
 * last one closes it.
 */
let natural;

/** Its first picture is drawn, and nothing after it: it is large. */
async function openNatural(browser = session) {
  const opened = await open(
    '',
    { viewport: { width: 720, height: 240 }, prepare: (/** @type {Page} */ page) => page.addInitScript(holdResults) },
    browser,
  );
  return { ...opened, hiding: await hidePictures(opened.page) };
}

async function followNatural(link) {
  natural ??= await openNatural();
  const { page, hiding } = natural;
  await page.setViewportSize({ width: 960, height: 640 });
  await follow(page, link);
  await hiding.evaluate((style) => style.parentNode?.removeChild(style));
  return natural;
}

for (const webgpu of [false, true]) {
  test(`the first picture is a riverbed in natural colours, drawn with ${webgpu ? 'WebGPU' : 'WebGL2'}`, async () => {
    const browser = webgpu ? await launch({ webgpu }) : session;
    try {
      const opened = await openNatural(browser);
      const { page, errors } = opened;
      assert.ok((await stats(page)).rocks > 1000);
      assert.deepEqual(
        await page.evaluate(() => [document.querySelector('rock-field').color, document.querySelector('#preset-name').textContent]),
        ['natural', 'Riverbed'],
      );
      assert.equal(await page.locator('[data-backend]').textContent(), webgpu ? 'WebGPU' : 'WebGL2');
      assert.deepEqual(await page.locator(MESSAGE).allInnerTexts(), []);
      assert.equal(await page.locator('.boot').count(), 0);
      assert.deepEqual(errors, []);
      if (!webgpu) natural = opened;
    } finally {
      if (webgpu) await browser.close();
    }
  });
}

test('what is only seen is drawn without a run, undone and shared like the rest; in other colours only the sun is there to set', async () => {
  const opened = await followNatural('#preset=riverbed&w=128&h=128&soil=soil&mat=mixed,mixed,mixed&r=30,12,6');
  const { page } = opened;
  const before = await hash(page);
  await page.evaluate(() => {
    globalThis.runs = 0;
    document.querySelector('rock-field').addEventListener('generate', () => (globalThis.runs += 1));
  });
  const looks = await page.locator('.section:has([id="sa"]) .slider').evaluateAll((found) => found.map(({ id }) => id));
  assert.deepEqual(looks, ['var', 'wet', 'moss', 'dust', 'snow', 'water', 'sa', 'se']);
  await page.locator('[id="sa"]').press('End');
  await page.getByRole('button', { name: 'Layer 1' }).first().click();
  await page.locator('[id="mat-0"]').selectOption('slate');
  await page.locator('[data-param="soil"] input[value="sand"]').check();
  await address(page, /&soil=sand&sa=360&r=30,12,6&mat=slate,mixed,mixed$/);
  await page.keyboard.press('Control+z');
  assert.deepEqual(
    await page.evaluate(() => {
      const { ground, sunAzimuth, material } = document.querySelector('rock-field');
      return [ground, sunAzimuth, material[0]];
    }),
    ['soil', 360, 'slate'],
  );
  assert.equal(await hash(page), before);
  assert.equal(await page.evaluate(() => globalThis.runs), 0, 'nothing is run');
  await page.locator('[data-param="color"] input[value="plain"]').check();
  assert.deepEqual(await page.locator('.section:has([id="sa"]) .slider').evaluateAll((found) => found.map(({ id }) => id)), ['sa', 'se']);
  assert.equal(await page.locator('[id="mat-0"]').count(), 0);
  assert.deepEqual(opened.errors, []);
});

test('the presets are chosen from a list, by keys or by hand, with pictures of the natural grounds', async () => {
  const opened = await followNatural('#preset=journal-fig1&w=256&h=256');
  const { page } = opened;
  const button = page.locator('#preset');
  const focused = () => page.evaluate(() => document.activeElement?.getAttribute('data-preset') ?? document.activeElement?.id);
  await button.focus();
  await page.keyboard.press('Enter');
  await page.getByRole('listbox').waitFor();
  assert.equal(await focused(), 'journal-fig1', 'it begins at what is chosen');
  assert.equal(await page.getByRole('option').count(), (await tables()).PRESETS.length);
  assert.deepEqual(await page.locator('.presets [role=group]').evaluateAll((groups) => groups.map(({ ariaLabel }) => ariaLabel)), [
    'Natural grounds',
    'Journal (2011)',
    'Conference (2010)',
  ]);
  await page.keyboard.press('Home');
  assert.equal(await focused(), 'riverbed');
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('ArrowDown');
  assert.equal(await focused(), 'dry-garden', 'five in a line');
  await page.keyboard.type('sh');
  assert.equal(await focused(), 'shingle');
  assert.deepEqual(await violations(page), []);
  const isDrawn = (name) =>
    page.evaluate((preset) => {
      const { data } = document
        .querySelector(/** @type {`${string}canvas`} */ (`[data-preset="${preset}"] canvas`))
        .getContext('2d')
        .getImageData(0, 0, 192, 128);
      return data.some((value) => value !== 0);
    }, name);
  await until(() => isDrawn('riverbed'), 'the picture of the riverbed');
  await page.keyboard.press('Escape');
  assert.equal(await page.getByRole('listbox').count(), 0);
  assert.equal(await focused(), 'preset');
  await page.waitForFunction(() => document.querySelectorAll('rock-field').length === 1);
  const hiding = await hidePictures(page);
  assert.match(page.url(), /preset=journal-fig1/, 'Escape chooses nothing');
  await button.click();
  assert.ok(await isDrawn('riverbed'), 'it is kept');
  const before = await params(page);
  await page.evaluate(() => results.hold());
  await page.locator('.preset[data-preset="scree"]').click();
  // Its field is still to come: the address does not tell of it, and an undo takes it back.
  await page.keyboard.press('Control+z');
  assert.deepEqual(await params(page), before);
  assert.match(page.url(), /preset=journal-fig1/);
  await page.evaluate(() => results.release());
  await page.keyboard.press('Control+Shift+z');
  await address(page, /#v=1&preset=scree$/);
  assert.deepEqual(await page.evaluate(() => document.querySelector('rock-field').color), 'natural');
  await page.keyboard.press('Control+z');
  await address(page, /preset=journal-fig1/);
  assert.deepEqual(await page.evaluate(() => document.querySelector('rock-field').color), 'layer');
  await hiding.evaluate((style) => style.parentNode?.removeChild(style));
  assert.deepEqual(opened.errors, []);
});

test('in plans there is no colour to choose; a chosen word is as wide as before; another colour does not move the camera', async () => {
  const opened = await followNatural('#preset=riverbed&w=128&h=128&r=30,12,6&view=selection');
  const { page } = opened;
  const colors = page.locator('[data-param="color"] input');
  assert.ok(await colors.evaluateAll((inputs) => inputs.every(({ disabled }) => disabled)));
  await page.locator('[data-param="view"] input[value="3d"]').check();
  assert.ok(await colors.evaluateAll((inputs) => inputs.every(({ disabled }) => !disabled)));
  const widths = () =>
    page.locator('.overlay-start .segment').evaluateAll((segments) => segments.map((segment) => segment.getBoundingClientRect().width));
  const before = [await widths(), await page.evaluate(() => document.querySelector('rock-field').camera)];
  await page.locator('[data-param="color"] input[value="plain"]').check();
  await address(page, /&color=plain&camera=/);
  assert.deepEqual([await widths(), await page.evaluate(() => document.querySelector('rock-field').camera)], before);
  await page.locator('[data-param="color"] input[value="natural"]').check();
  await page.waitForFunction(() => !/color|camera/.test(location.hash));
  await closeClean(opened);
});

test('the keyboard’s focus on the picture is seen', async () => {
  const opened = await open('#preset=journal-fig1&w=64&h=64&r=20', { deviceScaleFactor: 1 });
  const { page } = opened;
  await page.locator('rock-field .stage').evaluate((stage) => stage.focus());
  await page.keyboard.press('Shift');
  const box = await boxOf(page.locator('rock-field'));
  const shot = (await page.screenshot({ clip: { x: box.x, y: box.y + box.height / 2, width: 4, height: 1 } })).toString('base64');
  const edge = await page.evaluate(async (data) => {
    const image = await createImageBitmap(await (await fetch(`data:image/png;base64,${data}`)).blob());
    const context = /** @type {OffscreenCanvasRenderingContext2D} */ (new OffscreenCanvas(4, 1).getContext('2d'));
    context.drawImage(image, 0, 0);
    return [...context.getImageData(0, 0, 1, 1).data.slice(0, 3)];
  }, shot);
  const accent = [0x2a, 0x64, 0x88];
  assert.ok(
    edge.every((value, k) => Math.abs(value - accent[k]) < 12),
    `${edge}`,
  );
  await closeClean(opened);
});

test('views and colours change the picture, not the rocks; the link tells them', async () => {
  const opened = await open('#w=256&h=256');
  const { page } = opened;
  const before = await hash(page);
  let last = await page.locator('rock-field').screenshot();
  for (const [name, value] of [
    ['view', 'wireframe'],
    ['view', 'diagrams'],
    ['view', 'selection'],
    ['view', '3d'],
    ['color', 'rock'],
    ['color', 'plain'],
  ]) {
    await page.locator(`[data-param="${name}"] input[value="${value}"]`).check();
    // Another picture, which stays.
    let next = last;
    await until(async () => {
      const before = next;
      next = await page.locator('rock-field').screenshot({ path: screenshotPath(`page-${name}-${value}`) });
      return !next.equals(last) && next.equals(before);
    }, `another picture for ${value}`);
    last = next;
  }
  assert.equal(await hash(page), before);
  await address(page, /&color=plain$/);
  await closeClean(opened);
});

test('the page works by keyboard alone', async () => {
  const opened = await open('#w=256&h=256');
  const { page } = opened;
  // What comes later has come: nothing is passed by before it is there.
  await page.locator('#seed-number').waitFor();
  await page.keyboard.press('Tab');
  assert.equal(await page.evaluate(() => document.activeElement?.className), 'skip-link');
  await page.keyboard.press('Enter');
  assert.ok(await page.evaluate(() => document.activeElement?.localName === 'rock-field-panel'));
  assert.doesNotMatch(page.url(), /#controls/);
  // Everything that can be pressed or set is reached, in the order of the page, with a visible focus.
  const reached = new Set();
  for (let presses = 0; presses < 80; presses += 1) {
    await page.keyboard.press('Tab');
    const name = await page.evaluate(() => {
      const { activeElement: element } = document;
      if (!element?.closest('.panel')) return null;
      return `${element.id || element.getAttribute('aria-label') || element.getAttribute('name') || element.textContent.trim()}`;
    });
    if (name === null) break;
    reached.add(name);
  }
  for (const name of [
    'Share',
    'preset',
    'seed-number',
    'Fresh random seed',
    'r-0',
    'r-0-number',
    'h3-0',
    'w',
    'cd-number',
    'u',
    'border',
    'language',
    'theme',
  ]) {
    assert.ok(
      [...reached].some((seen) => seen === name),
      `${name} is not reached: ${[...reached].join(', ')}`,
    );
  }
  await page.locator('main.stage').evaluate((stage) => stage.querySelector('rock-field').shadowRoot.querySelector('[tabindex]').focus());
  await page.keyboard.press('ArrowLeft');
  await address(page, /&camera=/);
  await page.keyboard.press('f');
  await page.keyboard.press('f');
  await page.waitForFunction(() => !location.hash.includes('camera'));
  await page.keyboard.press('3');
  await address(page, /&view=diagrams$/);
  await page.keyboard.press(']');
  assert.equal((await params(page)).seed, 1);
  await page.keyboard.press('?');
  await page.getByRole('dialog').waitFor();
  await page.keyboard.press('Escape');
  assert.equal(await page.getByRole('dialog').count(), 0);
  await closeClean(opened);
});

for (const language of ['en', 'ja']) {
  test(`a phone of 360 px in ${language}: nothing is cut off, the picture stays visible, targets are large`, async () => {
    const opened = await open('#preset=journal-fig1&w=256&h=256', {
      viewport: { width: 360, height: 740 },
      deviceScaleFactor: 1,
      isMobile: true,
      hasTouch: true,
      locale: language === 'ja' ? 'ja-JP' : 'en-US',
      colorScheme: language === 'ja' ? 'dark' : 'light',
    });
    const { page } = opened;
    assert.equal(await page.evaluate(() => document.documentElement.lang), language);
    await page.screenshot({ path: screenshotPath(`page-phone-${language}`) });
    await page.locator('.sheet-toggle').tap();
    await page.screenshot({ path: screenshotPath(`page-phone-${language}-open`) });
    const { wide, small, picture } = await page.evaluate(() => {
      const targets = [...document.querySelectorAll('.panel button, .panel select, .panel .slider, .segment, .on-picture')].filter(
        (element) => element.checkVisibility(),
      );
      const boxes = targets.map((element) => ({ name: element.className || element.id, box: element.getBoundingClientRect() }));
      return {
        wide: boxes.filter(({ box }) => box.left < 0 || box.right > innerWidth).map(({ name }) => name),
        small: boxes.filter(({ box }) => box.height < 40 || box.width < 40).map(({ name, box }) => `${name} ${box.width}×${box.height}`),
        picture: document.querySelector('rock-field').getBoundingClientRect().height,
      };
    });
    assert.deepEqual(wide, []);
    assert.deepEqual(small, []);
    assert.ok(picture > 250, `${picture} px of picture`);
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
    await closeClean(opened);
  });
}

test('language and theme are switched in the panel and kept', async () => {
  const opened = await open('#w=256&h=256');
  const { page } = opened;
  await page.locator('[data-param="language"] input[value="ja"]').check();
  assert.equal(await page.evaluate(() => document.documentElement.lang), 'ja');
  await page.waitForFunction(() => /岩/.test(document.title));
  await page.getByRole('button', { name: '共有' }).waitFor();
  await page.locator('[data-param="theme"] input[value="dark"]').check();
  const background = await page.evaluate(() => getComputedStyle(document.querySelector('.panel')).backgroundColor);
  assert.match(background, /^rgb\((\d|[1-5]\d), /);
  assert.equal(await page.evaluate(() => document.querySelector('rock-field').theme), 'dark');
  await page.reload();
  await page.getByRole('button', { name: '共有' }).waitFor();
  assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), 'dark');
  await closeClean(opened);
});
