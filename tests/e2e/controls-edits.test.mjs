// The panel of an element with `controls` edits the element, shows what else does, and reaches nothing but its own element.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { holdTimers, until } from './browser.mjs';
import { SMALL, launchControls, openControls, openPanel, panel } from './controls-page.mjs';
import { boxOf, closeClean } from './shown.mjs';

/** @type {import('./browser.mjs').Session} */
let session;

before(async () => {
  session = await launchControls();
});

after(() => session?.close());

const open = (body, options) => openControls(session, body, options);

test('panel and element have one history, and the panel shows what either of them changes', async () => {
  const opened = await open();
  const { page } = opened;
  await openPanel(page);
  const at = panel(page);
  const state = () => page.evaluate(() => ({ packing: a.packing, layers: a.layers.length, width: a.imageWidth }));
  await at.locator('#cd-number').fill('0.5');
  await at.locator('#r-0').focus();
  const before = await page.evaluate(() => a.radius[0]);
  await page.keyboard.press('ArrowRight');
  assert.ok((await page.evaluate(() => a.radius[0])) > before);
  await at.getByRole('button', { name: 'Add layer' }).click();
  assert.deepEqual(await state(), { packing: 0.5, layers: 3, width: 256 });
  await at.locator('#preset').click();
  await at.page().locator('rock-field').first().locator('.preset[data-preset="conference-fig1"]').click();
  assert.equal((await state()).width, 1024);
  const undone = await page.evaluate(() => [a.undo(), a.layers.length, a.undo(), a.layers.length, a.undo(), a.undo(), a.packing, a.undo()]);
  assert.deepEqual(undone, [true, 3, true, 2, true, true, 0.7, false]);
  await page.waitForFunction(
    () => a.shadowRoot.querySelector('.controls-panel').shadowRoot.querySelector('button[aria-label=Undo]').disabled,
  );
  assert.equal(await at.locator('#cd-number').inputValue(), '0.7');
  await at.getByRole('button', { name: 'Redo' }).click();
  assert.equal((await state()).packing, 0.5);
  // An edit by code is a step of the panel's.
  await page.evaluate(() => (a.packing = 0.25));
  await at.getByRole('button', { name: 'Undo' }).click();
  assert.equal((await state()).packing, 0.5);
  const [link, shown] = await page.evaluate(async () => {
    await a.getField();
    return [a.shareURL('https://example.org/'), JSON.stringify(a.params)];
  });
  assert.equal(
    await page.evaluate((src) => {
      const other = document.createElement('rock-field');
      other.setAttribute('src', src);
      return JSON.stringify(other.params);
    }, link),
    shown,
  );
  await page.evaluate(() => a.getField());
  assert.deepEqual(await page.evaluate(() => [eventCounts.error ?? 0, eventCounts.generate > 1]), [0, true]);
  await closeClean(opened);
});

test('the open panel hears of every edit by code, also of one that needs no run, and its next edit keeps it', async () => {
  // Nothing is drawn, so that no picture tells the panel to look again.
  const opened = await open(`<rock-field controls backend="null" color="natural" ${SMALL}></rock-field>`);
  const { page } = opened;
  await openPanel(page);
  const value = (id) => panel(page).locator(`#${id}-number`);
  const shows = (id, wanted) => until(async () => (await value(id).inputValue()) === wanted, `${id} is ${wanted}`);
  await value('cd').fill('0.5');
  await page.evaluate(() => a.getField());
  await page.evaluate(() => (a.sunAzimuth = 90));
  await shows('sa', '90');
  await value('se').fill('20');
  assert.deepEqual(await page.evaluate(() => [a.packing, a.sunAzimuth, a.sunElevation]), [0.5, 90, 20]);
  await page.evaluate(() => a.setAttribute('sun-azimuth', '200'));
  await shows('sa', '200');
  await value('se').fill('30');
  assert.deepEqual(await page.evaluate(() => [a.packing, a.sunAzimuth, a.sunElevation]), [0.5, 200, 30]);
  await closeClean(opened);
});

test('the same parameters again are no step of undo', async () => {
  const opened = await open();
  const { page } = opened;
  assert.deepEqual(
    await page.evaluate(() => {
      const { params } = a;
      a.params = params;
      a.seed = 0;
      return a.undo();
    }),
    false,
  );
  await closeClean(opened);
});

test('attributes and properties that change show in the open panel, and disturb no hand', async () => {
  const opened = await open();
  const { page } = opened;
  await openPanel(page);
  const at = panel(page);
  const checked = (name) => at.locator(`input[name=${name}]:checked`).inputValue();
  await page.evaluate(() => {
    a.setAttribute('seed', '11');
    a.setAttribute('view', 'diagrams');
    a.color = 'plain';
    a.border = 'drop';
  });
  await page.waitForFunction(
    () => a.shadowRoot.querySelector('.controls-panel').shadowRoot.querySelector('input#seed-number').value === '11',
  );
  assert.deepEqual([await checked('view'), await checked('color'), await checked('border')], ['diagrams', 'plain', 'drop']);
  await at.locator('input[name=view][value=wireframe]').check();
  assert.equal(await page.evaluate(() => a.view), 'wireframe');
  // A number on its way, and a slider that is held.
  await at.locator('#w-number').fill('');
  await at.locator('#w-number').pressSequentially('3');
  await page.evaluate(() => (a.seed = 12));
  await at.locator('#w-number').pressSequentially('00');
  assert.deepEqual([await at.locator('#w-number').inputValue(), await page.evaluate(() => a.imageWidth)], ['300', 300]);
  await at.locator('#cd').scrollIntoViewIfNeeded();
  const slider = await boxOf(at.locator('#cd'));
  const middle = slider.y + slider.height / 2;
  await page.mouse.move(slider.x + slider.width / 2, middle);
  await page.mouse.down();
  await page.mouse.move(slider.x + slider.width / 2 + 40, middle, { steps: 4 });
  const dragged = await page.evaluate(() => {
    a.seed = 13;
    return a.packing;
  });
  await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
  assert.equal(await at.locator('#cd').inputValue(), String(dragged));
  await page.mouse.move(slider.x + slider.width / 2 + 60, middle, { steps: 4 });
  await page.mouse.up();
  assert.ok((await page.evaluate(() => a.packing)) > dragged);
  // Language and theme are the element's.
  await page.evaluate(() => {
    document.documentElement.lang = 'ja';
    a.theme = 'dark';
  });
  await at.getByRole('heading', { name: '設定' }).waitFor();
  assert.deepEqual(
    await page.evaluate(() => [
      a.shadowRoot.querySelector('.controls-panel').lang,
      getComputedStyle(a.shadowRoot.querySelector('.controls-panel')).colorScheme,
    ]),
    ['ja', 'dark'],
  );
  await closeClean(opened);
});

test('keys, text and radio buttons in the panel reach neither the picture nor the page around it', async () => {
  const opened = await open();
  const { page } = opened;
  await openPanel(page);
  await page.evaluate(() => {
    globalThis.keys = [];
    for (const type of ['keydown', 'keyup', 'input', 'change'])
      document.addEventListener(type, (event) => keys.push(`${type} ${event.key ?? ''}`.trim()));
  });
  const at = panel(page);
  await at.locator('#seed-number').focus();
  await page.keyboard.type('4');
  await at.locator('#cd').focus();
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('f');
  await page.keyboard.press('Control+z');
  await at.locator('input[name=color]:checked').focus();
  await page.keyboard.press('ArrowRight');
  assert.deepEqual(await page.evaluate(() => [a.color, eventCounts['camera-change'] ?? 0, a.framed]), ['rock', 0, true]);
  assert.deepEqual(await page.evaluate(() => keys.filter((key) => !/Control/.test(key) && key !== 'keyup z')), []);
  await page.keyboard.press('Control+s');
  assert.ok(await page.evaluate(() => keys.includes('keydown s')), 'what is with Ctrl is the page’s');
  await closeClean(opened);
});

test('two elements on one page do not disturb each other', async () => {
  const opened = await open(
    `<form><rock-field controls ${SMALL}></rock-field></form><rock-field controls ${SMALL} lang="ja"></rock-field>`,
    { size: [700, 320] },
  );
  const { page } = opened;
  const [one, two] = [page.locator('rock-field').nth(0), page.locator('rock-field').nth(1)];
  await openPanel(page, one);
  await openPanel(page, two);
  await panel(page, one).locator('input[name=view][value=diagrams]').check();
  await panel(page, two).locator('input[name=view][value=selection]').check();
  await panel(page, one).locator('#cd-number').fill('0.3');
  assert.deepEqual(
    await page.evaluate(() => [a.view, b.view, a.packing, b.packing, b.undo(), [...new FormData(document.forms[0])].length]),
    ['diagrams', 'selection', 0.3, 0.7, false, 0],
  );
  assert.equal(await panel(page, one).locator('input[name=view]:checked').inputValue(), 'diagrams');
  // Without a clipboard the text is shown, each in its own element.
  await page.evaluate(() => {
    Object.defineProperty(navigator, 'clipboard', { value: undefined });
    document.execCommand = () => false;
  });
  await panel(page, two).getByRole('button', { name: '共有' }).click();
  const dialog = two.locator('dialog');
  await dialog.waitFor();
  assert.equal(await dialog.locator('textarea').inputValue(), await page.evaluate(() => b.shareURL()));
  assert.equal(await one.locator('dialog').count(), 0);
  await page.keyboard.press('Escape');
  await dialog.waitFor({ state: 'hidden' });
  assert.equal(await panel(page, two).count(), 1, 'Escape has closed the dialog alone');
  assert.equal(await page.evaluate(() => document.body.querySelector('dialog, .toast, textarea')), null);
  await closeClean(opened);
});

test('share and embed copy what shows this field, and say so in the element', async () => {
  const opened = await open();
  const { page, context } = opened;
  await context.grantPermissions(['clipboard-read', 'clipboard-write']);
  await openPanel(page);
  // The words that say so would go by themselves.
  await page.evaluate(holdTimers);
  const copied = () => page.evaluate(() => navigator.clipboard.readText());
  await panel(page).getByRole('button', { name: 'Share' }).click();
  await page.locator('rock-field .toast.is-shown').waitFor();
  assert.equal(await copied(), await page.evaluate(() => a.shareURL()));
  await panel(page).getByRole('button', { name: 'Copy embed code' }).click();
  await page.waitForFunction(async () => (await navigator.clipboard.readText()).includes('<script'));
  assert.ok((await copied()).includes(`src="${session.url}cdn.js"`));
  await closeClean(opened);
});
