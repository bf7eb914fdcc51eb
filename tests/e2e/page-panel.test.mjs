// The panel of the page in a real browser: every control, undo, numbers, layers, progress, fingers and wheel, names and forced colours.
// Drawn by WebGL2 (software).
/** @import { Page } from 'playwright-core' */
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { hidePictures, holdResults, launch, until } from './browser.mjs';
import { address, boxOf, closeClean, hash, message, openRocks, params, stats } from './rock-page.mjs';

/** @type {import('./browser.mjs').Session} */
let session;

before(async () => {
  session = await launch();
});

after(() => session?.close());

const open = (address, options, browser = session) => openRocks(browser, address, options);

test('every slider moves something, and its number says so', async () => {
  // With some wear, since one kind of it needs another.
  const opened = await open('#w=256&h=256&r=40,20,8&we=0.5,0.5,0.5&ro=0.5,0.5,0.5&dt=20,20,20');
  const { page } = opened;
  await hidePictures(page);
  for (const name of ['Layer 2', 'Layer 3']) await page.getByRole('button', { name }).first().click();
  await page.locator('[data-param="fill-2"] input[value="count"]').check();
  await page.locator('details').evaluateAll((parts) => parts.forEach((part) => part.setAttribute('open', '')));
  const looks = ['sa', 'se'];
  const ids = (await page.locator('.slider').evaluateAll((sliders) => sliders.map(({ id }) => id))).filter((id) => !looks.includes(id));
  assert.equal(ids.length, 3 + 3 * 12);
  let last = await hash(page);
  for (const id of ids) {
    const slider = page.locator(`[id="${id}"]`);
    const number = page.locator(`[id="${id}-number"]`);
    const shown = await number.inputValue();
    // From 0.55 on, c_d asks for more sites than there is room for, and the count for more cells than are free.
    await slider.press(id === 'cd' || id === 'n-2' ? 'Home' : 'PageUp');
    const next = await hash(page);
    assert.notEqual(next, last, `${id}: the same rocks`);
    assert.notEqual(await number.inputValue(), shown, `${id}: the same number`);
    await page.keyboard.press('Control+z');
    assert.equal(await hash(page), last, `${id}: undone`);
    last = await hash(page);
  }
  await closeClean(opened);
});

test('a drag is one step of undo, and the picture follows it', async () => {
  const opened = await open('#w=256&h=256');
  const { page } = opened;
  const before = await hash(page);
  await page.evaluate(() => {
    globalThis.shown = 0;
    document.querySelector('rock-field').addEventListener('generate', () => (globalThis.shown += 1));
  });
  const slider = page.locator('[id="h1-0"]');
  await slider.scrollIntoViewIfNeeded();
  const box = await boxOf(slider);
  /** @type {(share: number) => [x: number, y: number]} */
  const at = (share) => [box.x + share * box.width, box.y + box.height / 2];
  await page.mouse.move(...at(0.2));
  await page.mouse.down();
  // To and fro, until some of it has been seen.
  let step = 0;
  await until(async () => {
    step += 1;
    await page.mouse.move(...at(0.55 - 0.35 * Math.cos(step / 5)));
    return step > 14 && (await page.evaluate(() => globalThis.shown)) > 2;
  }, 'three pictures while dragging');
  await page.mouse.move(...at(0.9));
  await page.mouse.up();
  const dragged = await hash(page);
  assert.notEqual(dragged, before);
  await page.keyboard.press('Control+z');
  assert.equal(await hash(page), before);
  await page.keyboard.press('Control+Shift+z');
  assert.equal(await hash(page), dragged);
  await closeClean(opened);
});

test('what is too large for the memory is said under the parameter to change; the picture stays', async () => {
  const opened = await open('#w=8192&h=8192&r=200');
  const { page } = opened;
  await hidePictures(page);
  const before = await hash(page);
  await page.locator('[id="r-0-number"]').fill('1');
  const problem = page.locator('[data-param="r-0"] .control-problem');
  await problem.waitFor();
  assert.match((await problem.textContent()) ?? '', /MiB.*MiB/);
  assert.equal(await page.locator('[id="r-0-number"]').getAttribute('aria-invalid'), 'true');
  await page.locator('[id="r-0-number"]').fill('200');
  await problem.waitFor({ state: 'detached' });
  assert.equal(await hash(page), before);
  await closeClean(opened);
});

test('a number out of bounds is said while it is typed, and clamped when it is left', async () => {
  const opened = await open('#w=256&h=256');
  const { page } = opened;
  await hidePictures(page);
  const field = page.locator('[id="r-0-number"]');
  await field.fill('99999');
  assert.match((await page.locator('[data-param="r-0"] .control-problem').textContent()) ?? '', /1 to 8192/);
  assert.equal((await params(page)).layers[0].radius, 90);
  await field.press('Tab');
  await page.waitForFunction(() => document.querySelector('rock-field').params.layers[0].radius === 8192);
  assert.equal(await field.inputValue(), '8192');
  await field.fill('');
  await field.press('Tab');
  assert.equal(await field.inputValue(), '8192');
  // A decimal point on its way is not taken away.
  await field.fill('');
  await field.pressSequentially('45.25');
  assert.equal((await params(page)).layers[0].radius, 45.25);
  await closeClean(opened);
});

test('a long run shows its progress and can be cancelled, back to what is shown', async () => {
  const opened = await open('#w=4096&h=4096&r=300&a=0.1', { prepare: (/** @type {Page} */ page) => page.addInitScript(holdResults) });
  const { page } = opened;
  const before = await hash(page);
  await page.evaluate(() => results.hold());
  await page.locator('[id="r-0-number"]').fill('3');
  await page.locator('stage-overlay .progress').waitFor();
  assert.match((await page.locator('.progress-text').textContent()) ?? '', /Generating: \w+, \d+%/);
  await page.getByRole('button', { name: 'Cancel' }).click();
  await page.locator('stage-overlay .progress').waitFor({ state: 'detached' });
  await page.evaluate(() => results.release());
  assert.equal((await params(page)).layers[0].radius, 300);
  assert.equal(await hash(page), before);
  assert.match(await message(page), /Cancelled/);
  assert.equal(await page.locator('.message.is-problem').count(), 0, 'it is no error');
  await closeClean(opened);
});

test('presets, seeds, reset and randomise', async () => {
  const opened = await open('#w=300&seed=4');
  const { page } = opened;
  await hidePictures(page);
  await page.locator('#preset').click();
  await page.locator('.preset[data-preset="conference-fig11c"]').click();
  await address(page, /preset=conference-fig11c&seed=4$/);
  assert.equal((await params(page)).notation, 'relative');
  await page.getByRole('button', { name: 'Previous seed' }).click();
  assert.equal((await params(page)).seed, 3);
  await page.getByRole('button', { name: 'Fresh random seed' }).click();
  await page.waitForFunction(() => document.querySelector('rock-field').params.seed > 3);
  const seed = (await params(page)).seed;
  await page.getByRole('button', { name: 'Randomise' }).click();
  await page.waitForFunction((old) => document.querySelector('rock-field').params.seed !== old, seed);
  const { rocks } = await stats(page);
  assert.ok(rocks > 0 && rocks < 60_000);
  await page.getByRole('button', { name: 'Reset to the preset' }).click();
  const kept = (await params(page)).seed;
  await address(page, new RegExp(`#v=1&preset=conference-fig11c&seed=${kept}$`));
  await closeClean(opened);
});

test('layers are added, duplicated, removed; a count takes the place of an area', async () => {
  const opened = await open('#w=256&h=256&r=90,30,10');
  const { page } = opened;
  await hidePictures(page);
  const before = await hash(page);
  await page.locator('[data-param="fill-0"] input[value="count"]').check();
  assert.equal(await hash(page), before, 'as many as there were');
  await page.getByRole('button', { name: 'Duplicate layer 1' }).click();
  assert.equal((await params(page)).layers.length, 4);
  for (let k = 0; k < 4; k += 1) await page.getByRole('button', { name: 'Add layer' }).click();
  await page.getByRole('button', { name: 'Add layer', disabled: true }).waitFor();
  for (let k = 0; k < 8; k += 1) await page.getByRole('button', { name: 'Remove layer 1' }).click();
  await address(page, /&r=$/);
  assert.equal((await stats(page)).rocks, 0);
  await closeClean(opened);
});

test('after a layer or a base is added, copied or removed, the focus is on the next or the new one', async () => {
  const opened = await open('#preset=journal-fig1&w=64&h=64&r=20,10');
  const { page } = opened;
  await hidePictures(page);
  const at = () =>
    page.evaluate(
      () => document.activeElement?.closest('.layer')?.getAttribute('data-layer') ?? document.activeElement?.textContent.trim(),
    );
  const press = async (name) => {
    await page.getByRole('button', { name, exact: true }).focus();
    await page.keyboard.press('Enter');
    await page.waitForFunction(() => document.activeElement !== document.body);
  };
  for (let n = 2; n < 8; n += 1) {
    await press('Add layer');
    await page.waitForFunction((index) => document.activeElement?.closest('.layer')?.getAttribute('data-layer') === String(index), n);
  }
  const colors = await page.locator('.layer .chip').evaluateAll((chips) => chips.map(({ dataset }) => dataset.color));
  assert.equal(new Set(colors).size, 8);
  await press('Remove layer 8');
  assert.equal(await at(), '6');
  await press('Remove layer 2');
  assert.equal(await at(), '1');
  await press('Duplicate layer 1');
  assert.equal(await at(), '1');
  await press('Duplicate layer 1');
  assert.equal(await at(), '1', 'the last that may be added');
  assert.equal(new Set(await page.locator('.layer .chip').evaluateAll((chips) => chips.map(({ dataset }) => dataset.color))).size, 8);
  for (let n = 8; n > 0; n -= 1) await press('Remove layer 1');
  assert.equal(await at(), 'Add layer');
  await closeClean(opened);
});

test('the radius takes height and taper with it, and back; a lock keeps them', async () => {
  const opened = await open('#preset=journal-fig1&w=256&h=256&r=40&a=0.2');
  const { page } = opened;
  await hidePictures(page);
  const layer = async () => (await params(page)).layers[0];
  const { taper, height } = await layer();
  const field = page.locator('[id="r-0-number"]');
  const radius = (value) =>
    page.waitForFunction((wanted) => document.querySelector('rock-field').params.layers[0].radius === wanted, value);
  await field.fill('');
  await field.pressSequentially('20');
  await radius(20);
  assert.deepEqual(
    [(await layer()).taper, (await layer()).height],
    [taper.map((value) => value / 2), height.map((value) => value / 2)],
    'digit by digit, nothing is rounded away',
  );
  await page.locator('[id="r-0"]').press('End');
  await page.locator('[id="r-0"]').press('Home');
  await field.fill('40');
  await radius(40);
  assert.deepEqual([(await layer()).taper, (await layer()).height], [taper, height]);
  await field.fill('8000');
  await page.locator('[data-param="r-0"] .control-problem').waitFor();
  assert.ok(Math.max(...(await layer()).height) <= 500);
  await field.fill('40');
  await radius(40);
  assert.deepEqual((await layer()).height, height);
  await page.getByRole('button', { name: 'Keep height and taper' }).click();
  await field.fill('10');
  await radius(10);
  assert.deepEqual([(await layer()).taper, (await layer()).height], [taper, height]);
  await closeClean(opened);
});

test('fingers take a slider by its thumb; a tap beside it and a scroll that begins on it change nothing and are no step of undo', async () => {
  const opened = await open('#preset=journal-fig1&w=64&h=64&r=20', { viewport: { width: 960, height: 640 }, hasTouch: true });
  const { page } = opened;
  const slider = page.locator('[id="cd"]');
  await slider.scrollIntoViewIfNeeded();
  const box = await boxOf(slider);
  const y = box.y + box.height / 2;
  const thumb = box.x + 10 + 0.7 * (box.width - 20);
  const state = async () => [
    (await params(page)).packing,
    await page.locator('[id="cd"]').inputValue(),
    await page.getByRole('button', { name: 'Undo' }).isDisabled(),
  ];
  const before = await state();
  await page.touchscreen.tap(box.x + 0.2 * box.width, y);
  assert.deepEqual(await state(), before, 'a tap');
  const touch = await page.context().newCDPSession(page);
  const finger = (type, x, at) => touch.send('Input.dispatchTouchEvent', { type, touchPoints: type === 'touchEnd' ? [] : [{ x, y: at }] });
  const body = () => page.locator('.panel-body').evaluate(({ scrollTop }) => scrollTop);
  const scrolled = await body();
  await finger('touchStart', thumb, y);
  for (let step = 1; step <= 10; step += 1) await finger('touchMove', thumb + step, y + (scrolled > 200 ? 1 : -1) * 15 * step);
  await finger('touchEnd');
  assert.deepEqual(await state(), before, 'a scroll');
  await slider.scrollIntoViewIfNeeded();
  const now = await boxOf(slider);
  await finger('touchStart', thumb, now.y + now.height / 2);
  for (let step = 1; step <= 10; step += 1) await finger('touchMove', thumb - 6 * step, now.y + now.height / 2);
  await finger('touchEnd');
  assert.ok((await state())[0] < before[0], 'a drag of the thumb');
  await page.getByRole('button', { name: 'Undo' }).click();
  assert.deepEqual(await state(), before, 'is one step');
  await closeClean(opened);
});

test('the wheel over a number that has the focus scrolls the panel and leaves the number; tapers can be typed with a minus', async () => {
  const opened = await open('#preset=journal-fig1&w=64&h=64&r=20');
  const { page } = opened;
  const field = page.locator('[id="h1-0-number"]');
  await field.click();
  const value = await field.inputValue();
  const scrolled = await page.locator('.panel-body').evaluate(({ scrollTop }) => scrollTop);
  await page.mouse.wheel(0, 120);
  await page.waitForFunction((top) => document.querySelector('.panel-body').scrollTop > top, scrolled);
  assert.equal(await field.inputValue(), value);
  assert.deepEqual(
    await page
      .locator('[id="w1-0-number"], [id="h1-0-number"], [id="w-number"]')
      .evaluateAll((fields) => fields.map((one) => one.getAttribute('inputmode')).sort()),
    ['decimal', 'numeric', 'text'],
  );
  await closeClean(opened);
});

test('another notation, the same rocks', async () => {
  const opened = await open('#w=512&h=512');
  const { page } = opened;
  await hidePictures(page);
  const before = await hash(page);
  // What converts the lengths is fetched when it is first needed.
  const taken = (notation) => page.waitForFunction((wanted) => document.querySelector('rock-field').params.notation === wanted, notation);
  await page.locator('[data-param="u"] input[value="relative"]').check();
  await taken('relative');
  assert.equal((await params(page)).layers[0].radius, 90 / 5.12);
  assert.equal(await hash(page), before);
  await page.locator('[data-param="u"] input[value="px"]').check();
  await taken('px');
  assert.equal(await hash(page), before);
  await closeClean(opened);
});

test('every control has a name, what describes it exists, and what is chosen can be read in forced colours', async () => {
  const opened = await open('#w=256&h=256');
  const { page } = opened;
  const nameless = await page.evaluate(() =>
    [...document.querySelectorAll('button, input, select')]
      .filter((element) => {
        const { labels } = /** @type {HTMLInputElement} */ (element);
        const name =
          element.getAttribute('aria-label') ||
          element.textContent.trim() ||
          [...(labels ?? [])].map(({ textContent }) => textContent.trim()).join('');
        return !name;
      })
      .map(({ outerHTML }) => outerHTML),
  );
  assert.deepEqual(nameless, []);
  const dangling = await page.evaluate(() =>
    [...document.querySelectorAll('[aria-describedby], [aria-labelledby], [aria-controls]')].flatMap((element) =>
      ['aria-describedby', 'aria-labelledby', 'aria-controls'].flatMap((name) =>
        (element.getAttribute(name) ?? '').split(' ').filter((id) => id && !document.getElementById(id)),
      ),
    ),
  );
  assert.deepEqual(dangling, []);
  const twice = await page.evaluate(() =>
    [...document.querySelectorAll('[id]')].map(({ id }) => id).filter((id, index, all) => all.indexOf(id) !== index),
  );
  assert.deepEqual(twice, []);
  await page.emulateMedia({ forcedColors: 'active' });
  const pale = await page.evaluate(async () => {
    await Promise.allSettled(document.getAnimations().map(({ finished }) => finished));
    const probe = document.body.appendChild(document.createElement('p'));
    Object.assign(probe.style, { forcedColorAdjust: 'none', background: 'Highlight', color: 'HighlightText' });
    const colours = (element) => [getComputedStyle(element).backgroundColor, getComputedStyle(element).color].join(' on ');
    return [...document.querySelectorAll('.segment input:checked + span')]
      .filter((chosen) => colours(chosen) !== colours(probe))
      .map((chosen) => `${chosen.textContent.trim()}: ${colours(chosen)}, not ${colours(probe)}`);
  });
  assert.deepEqual(pale, [], 'what is chosen can be read in forced colours');
  await closeClean(opened);
});
