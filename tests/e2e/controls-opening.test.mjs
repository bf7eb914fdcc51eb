// The panel of an element with `controls`: how it is loaded, opened and closed, by mouse, keyboard or code, and what is left when it is gone.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { dist } from '../../scripts/lib/env.mjs';
import { plainName } from '../../scripts/build/hashed-names.mjs';
import { serve } from '../../scripts/lib/serve.mjs';
import { holdTimers, until } from './browser.mjs';
import { SMALL, button, focused, launchControls, openControls, openPanel, panel } from './controls-page.mjs';
import { boxOf, closeClean } from './shown.mjs';

/** Answers requests for panel.js in the server's stead. */
let panelFile = /** @type {import('./controls-page.mjs').PanelFile | null} */ (null);

/** @type {import('./browser.mjs').Session} */
let session;

before(async () => {
  session = await launchControls({ panelFile: (response) => panelFile?.(response) });
});

after(() => session?.close());

const open = (body, options) => openControls(session, body, options);

test('nothing of the panel is fetched before it is wanted; it opens beside the picture and gives it back', async () => {
  const opened = await open();
  const { page, requests } = opened;
  const stage = () => boxOf(page.locator('rock-field .stage'));
  const whole = await stage();
  assert.ok(!requests.includes('panel.js'));
  assert.deepEqual(
    await button(page).evaluate((/** @type {HTMLElement} */ at) => [
      at.ariaLabel,
      at.ariaExpanded,
      at.offsetWidth >= 24 && at.offsetHeight >= 24,
    ]),
    ['Controls', 'false', true],
  );
  await openPanel(page);
  assert.ok(requests.includes('panel.js'));
  assert.equal(await focused(page), 'panel');
  const [side, rest] = [await boxOf(panel(page)), await stage()];
  assert.deepEqual([rest.x + rest.width, side.x + side.width, side.height], [side.x, whole.x + whole.width, whole.height]);
  const texts = await panel(page).innerText();
  for (const word of ['Preset', 'Layers', 'Ground and method', 'Statistics', 'WebGL2', 'Copy embed code'])
    assert.ok(texts.includes(word), word);
  for (const word of ['Language', 'Keys and gestures']) assert.ok(!texts.includes(word), word);
  assert.deepEqual(
    requests.filter((name) => name === 'icon.svg' || name.endsWith('.css')),
    ['host.css'],
    'nothing of the page',
  );
  await panel(page).getByRole('button', { name: 'Close' }).click();
  assert.equal(await panel(page).count(), 0);
  assert.deepEqual([await focused(page), await stage()], ['controls-button', whole]);
  await closeClean(opened);
});

test('by keyboard alone: after the picture comes the button, Escape brings the focus back to it', async () => {
  const opened = await open();
  const { page } = opened;
  const seed = () => page.evaluate(() => a.seed);
  await page.keyboard.press('Tab');
  assert.equal(await focused(page), 'stage');
  await page.keyboard.press('Tab');
  assert.equal(await focused(page), 'controls-button');
  await page.keyboard.press('Enter');
  await panel(page).locator('.panel-body').waitFor();
  const names = [];
  for (let presses = 0; presses < 12 && names.at(-1) !== 'seed-number'; presses += 1) {
    await page.keyboard.press('Tab');
    names.push(
      await page.evaluate(() => {
        const focused = a.shadowRoot.activeElement?.shadowRoot?.activeElement;
        return focused?.id || focused?.ariaLabel;
      }),
    );
  }
  // Undo and redo have nothing to do yet.
  assert.deepEqual(names, ['Reset to the preset', 'Randomise', 'Share', 'Close', 'preset', 'seed-number']);
  await page.keyboard.type('7');
  assert.equal(await seed(), 7);
  await page.keyboard.press('Control+z');
  assert.equal(await seed(), 0);
  await page.keyboard.press('Control+Shift+z');
  assert.equal(await seed(), 7);
  await page.keyboard.press('Escape');
  assert.equal(await focused(page), 'controls-button');
  await closeClean(opened);
});

test('a panel that cannot be loaded is said, and comes when it is asked for again', async () => {
  panelFile = (response) => {
    panelFile = null;
    response.writeHead(404).end();
    return true;
  };
  const opened = await open();
  const { page } = opened;
  // The words would go by themselves.
  await page.evaluate(holdTimers);
  await button(page).click();
  const message = page.locator('rock-field [part=message]');
  await message.waitFor();
  assert.match(await message.innerText(), /could not be loaded.*try again/);
  assert.deepEqual(
    [
      await button(page).evaluate((/** @type {HTMLElement} */ at) => at.title === at.ariaLabel && /try again/.test(at.title)),
      await page.evaluate(() => eventCounts.notice),
    ],
    [true, 1],
  );
  await openPanel(page);
  await panel(page).getByRole('button', { name: 'Close' }).click();
  assert.equal(await button(page).evaluate((/** @type {HTMLElement} */ at) => at.title), 'Controls');
  await closeClean(opened, [/404/]);
});

test('while it loads the button says so, and a second press, or removal, gives it up', async () => {
  let letGo;
  panelFile = async () => {
    panelFile = null;
    await new Promise((resolve) => (letGo = resolve));
    return false;
  };
  const opened = await open();
  const { page } = opened;
  await button(page).click();
  await page.waitForFunction(() => a.shadowRoot.querySelector('.controls-button').ariaBusy === 'true');
  await button(page).click();
  assert.equal(await button(page).evaluate((at) => at.ariaBusy), 'false');
  await button(page).click();
  await page.evaluate(() => a.removeAttribute('controls'));
  const arrived = page.waitForEvent('requestfinished', (request) => plainName(new URL(request.url()).pathname) === '/panel.js');
  letGo();
  // As soon as it has run, it would open.
  const address = (await arrived).url();
  await page.evaluate((panel) => import(panel).then(() => new Promise((resolve) => requestAnimationFrame(resolve))), address);
  assert.deepEqual([await panel(page).count(), await button(page).count()], [0, 0]);
  await page.evaluate(() => (a.controls = true));
  await openPanel(page);
  await closeClean(opened);
});

test('open begins open without taking the focus; disabled and removal close it', async () => {
  const opened = await open(`<rock-field controls="open" ${SMALL}></rock-field>`);
  const { page } = opened;
  await panel(page).locator('.panel-body').waitFor();
  assert.equal(await page.evaluate(() => document.activeElement?.localName), 'body');
  await page.evaluate(() => {
    a.disabled = true;
    a.setAttribute('disabled', '');
  });
  assert.deepEqual([await panel(page).count(), await button(page).isDisabled()], [0, true]);
  await page.evaluate(() => a.removeAttribute('disabled'));
  await openPanel(page);
  // Moving it keeps the panel.
  await page.evaluate(() => document.body.append(a));
  assert.equal(await panel(page).locator('.panel-body').count(), 1);
  assert.deepEqual(
    await page.evaluate(() => {
      const told = [a.controls];
      a.controls = false;
      told.push(a.hasAttribute('controls'));
      a.controls = 'open';
      return [...told, a.getAttribute('controls')];
    }),
    [true, false, 'open'],
  );
  await panel(page).locator('.panel-body').waitFor();
  await closeClean(opened);
});

test('an element that is removed leaves no panel and no listener behind', async () => {
  const opened = await open();
  const { page } = opened;
  await openPanel(page);
  const slider = panel(page).locator('#cd');
  await slider.scrollIntoViewIfNeeded();
  await slider.click();
  assert.ok(await page.evaluate(() => listeners.size > 0), 'the element listens while it is there');
  await page.evaluate(() => {
    globalThis.gone = ['.controls-panel', '.stage'].map((name) => new WeakRef(a.shadowRoot.querySelector(name)));
    gone[0] = new WeakRef(a.shadowRoot.querySelector('.controls-panel').shadowRoot.querySelector('.panel'));
    a.remove();
  });
  await page.waitForFunction(() => a.shadowRoot.querySelector('.controls-panel') === null);
  assert.deepEqual(await page.evaluate(() => [...listeners.values()]), []);
  const session = await page.context().newCDPSession(page);
  await until(async () => {
    // What the mouse was pressed on last is the browser's for as long.
    await page.locator('h1').click();
    await session.send('HeapProfiler.collectGarbage');
    return page.evaluate(() => gone[0].deref() === undefined);
  }, 'the panel is collected');
  // And it comes back.
  await page.evaluate(() => document.querySelector('main').append(a));
  await openPanel(page);
});

test('under a strict policy, and from another origin as a classic script, the panel comes as well', async () => {
  const csp =
    "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self'; connect-src 'self'; style-src 'self'; img-src data:";
  const strict = await open(undefined, { csp });
  await openPanel(strict.page);
  assert.equal(await panel(strict.page).evaluate((at) => getComputedStyle(at).display), 'flex');
  await strict.page.evaluate(() => a.getField());
  await closeClean(strict);
  const elsewhere = await serve(dist, {
    intercept: (_request, response) => {
      response.setHeader('access-control-allow-origin', '*');
      return false;
    },
  });
  try {
    const address = elsewhere.url.replace('localhost', '127.0.0.1');
    const foreign = await open(undefined, { script: `${address}cdn.js`, kind: '' });
    const asked = [];
    foreign.page.on('request', (request) => asked.push(plainName(request.url())));
    await openPanel(foreign.page);
    assert.deepEqual(asked, [`${address}panel.js`]);
    await closeClean(foreign);
  } finally {
    await elsewhere.close();
  }
});
