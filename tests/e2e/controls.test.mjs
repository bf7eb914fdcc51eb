// The panel of an element with `controls`: opened and closed, two ways with the element, alone with its keys, in every size.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { dist } from '../../scripts/env.mjs';
import { plainName } from '../../scripts/hashed-names.mjs';
import { serve } from '../../scripts/serve.mjs';
import { violations } from './axe.mjs';
import { holdTimers, launch, pageOf, screenshotPath } from './browser.mjs';

const SMALL = 'image-width="256" image-height="192" radius="40 16" area-fraction="0.2 0.3"';

let session;
let html = '';
let headers = {};
/** Answers requests for panel.js in the server's stead. */
let panelFile = null;

before(async () => {
  const page = pageOf('controls.html', () => html);
  session = await launch({
    args: ['--js-flags=--expose-gc'],
    async intercept(request, response) {
      if (request.url.startsWith('/controls.html')) for (const [name, value] of Object.entries(headers)) response.setHeader(name, value);
      if (plainName(request.url).startsWith('/panel.js') && panelFile) return panelFile(response);
      return page(request, response);
    },
  });
});

after(() => session?.close());

/** A page with this body, whose first element is `a`; `heard` counts its events by type. */
async function open(
  body = `<rock-field controls ${SMALL}></rock-field>`,
  { lang = 'en', size = [1000, 560], script = '/rock-field.js', kind = 'module', csp, ...options } = {},
) {
  const [width, height] = size;
  headers = csp ? { 'content-security-policy': csp } : {};
  html = `<!doctype html><html lang="${lang}"><meta charset="utf-8"><title>controls</title><link rel="icon" href="data:,">
<meta name="viewport" content="width=device-width"><link rel="stylesheet" href="/host.css"><main><h1>Rocks</h1>${body}</main><script src="/host.js"></script><script ${kind && `type="${kind}"`} src="${script}"></script>`;
  const requests = [];
  const opened = await session.open('controls.html', {
    viewport: { width: Math.max(width + 40, 760), height: height + 140 },
    colorScheme: 'light',
    ...options,
    prepare: async (page) => {
      page.on('request', (request) => requests.push(plainName(new URL(request.url()).pathname.slice(1))));
      await page.route('**/host.css', (route) =>
        route.fulfill({
          contentType: 'text/css',
          body: `html { font-size: 62.5%; color-scheme: light dark } body { margin: 0; font: 16px sans-serif } button { text-transform: uppercase } rock-field { width: ${width}px; height: ${height}px }`,
        }),
      );
      await page.route('**/host.js', (route) => route.fulfill({ contentType: 'text/javascript', body: HOST }));
    },
  });
  await opened.page.evaluate(() => customElements.whenDefined('rock-field').then(() => a.ready));
  return { ...opened, requests };
}

const HOST = `
  const listeners = new Map();
  for (const target of [window, document]) {
    const [add, remove] = [target.addEventListener, target.removeEventListener];
    target.addEventListener = (type, listener, options) => {
      // The driver of the browser listens too.
      if (/chunk-|panel-\\w+\\.js/.test(new Error().stack)) listeners.set(listener, type);
      options?.signal?.addEventListener('abort', () => listeners.delete(listener));
      add.call(target, type, listener, options);
    };
    target.removeEventListener = (type, listener, options) => {
      listeners.delete(listener);
      remove.call(target, type, listener, options);
    };
  }
  const a = document.querySelector('rock-field');
  const b = document.querySelectorAll('rock-field')[1];
  const heard = {};
  for (const type of ['generate', 'error', 'notice', 'progress', 'camera-change']) a.addEventListener(type, () => (heard[type] = (heard[type] ?? 0) + 1));
`;

const button = (page, element = page.locator('rock-field').first()) => element.locator('[part=controls-button]');
const panel = (page, element = page.locator('rock-field').first()) => element.locator('.panel');

async function openPanel(page, element) {
  await button(page, element).click();
  await panel(page, element).locator('.panel-body').waitFor();
}

/** The innermost element that has the focus. */
const focused = (page) =>
  page.evaluate(() => {
    let at = document.activeElement;
    while (at?.shadowRoot?.activeElement) at = at.shadowRoot.activeElement;
    return at?.className ?? '';
  });

async function closeClean({ errors, close }, known = []) {
  assert.deepEqual(
    errors.filter((text) => !known.some((pattern) => pattern.test(text))),
    [],
  );
  await close();
}

test('nothing of the panel is fetched before it is wanted; it opens beside the picture and gives it back', async () => {
  const opened = await open();
  const { page, requests } = opened;
  const stage = () => page.locator('rock-field .stage').boundingBox();
  const whole = await stage();
  assert.ok(!requests.includes('panel.js'));
  assert.deepEqual(await button(page).evaluate((at) => [at.ariaLabel, at.ariaExpanded, at.offsetWidth >= 24 && at.offsetHeight >= 24]), [
    'Controls',
    'false',
    true,
  ]);
  await openPanel(page);
  assert.ok(requests.includes('panel.js'));
  assert.equal(await focused(page), 'panel');
  const [side, rest] = [await panel(page).boundingBox(), await stage()];
  assert.deepEqual([rest.x + rest.width, side.x + side.width, side.height], [side.x, whole.x + whole.width, whole.height]);
  const texts = await panel(page).innerText();
  for (const [word, is] of [
    ['Preset', true],
    ['Layers', true],
    ['Ground and method', true],
    ['Statistics', true],
    ['WebGL2', true],
    ['Copy embed code', true],
    ['Language', false],
    ['Keys and gestures', false],
  ]) {
    assert.equal(texts.includes(word), is, word);
  }
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
      await page.evaluate(
        () => a.shadowRoot.activeElement.shadowRoot.activeElement.id || a.shadowRoot.activeElement.shadowRoot.activeElement.ariaLabel,
      ),
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
  await page.waitForFunction(() => a.shadowRoot.querySelector('.controls-panel').shadowRoot.querySelector('[aria-label=Undo]').disabled);
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
  assert.deepEqual(await page.evaluate(() => [heard.error ?? 0, heard.generate > 1]), [0, true]);
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
  await page.waitForFunction(() => a.shadowRoot.querySelector('.controls-panel').shadowRoot.querySelector('#seed-number').value === '11');
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
  const slider = await at.locator('#cd').boundingBox();
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
  assert.deepEqual(await page.evaluate(() => [a.color, heard['camera-change'] ?? 0, a.framed]), ['rock', 0, true]);
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
    [await button(page).evaluate((at) => at.title === at.ariaLabel && /try again/.test(at.title)), await page.evaluate(() => heard.notice)],
    [true, 1],
  );
  await openPanel(page);
  await panel(page).getByRole('button', { name: 'Close' }).click();
  assert.equal(await button(page).evaluate((at) => at.title), 'Controls');
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
  letGo();
  await page.waitForTimeout(500);
  assert.deepEqual([await panel(page).count(), await button(page).count()], [0, 0]);
  await page.evaluate(() => (a.controls = true));
  await openPanel(page);
  await closeClean(opened);
});

test('open begins open without taking the focus; disabled and removal close it', async () => {
  const opened = await open(`<rock-field controls="open" ${SMALL}></rock-field>`);
  const { page } = opened;
  await panel(page).locator('.panel-body').waitFor();
  assert.equal(await page.evaluate(() => document.activeElement.localName), 'body');
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
    gone[0] = new WeakRef(gone[0].deref().shadowRoot.querySelector('.panel'));
    a.remove();
  });
  await page.waitForFunction(() => a.shadowRoot.querySelector('.controls-panel') === null);
  assert.deepEqual(await page.evaluate(() => [...listeners.values()]), []);
  // What the mouse was pressed on last is the browser's for as long.
  await page.locator('h1').click();
  await page.waitForFunction(
    () => {
      globalThis.gc();
      return gone[0].deref() === undefined;
    },
    undefined,
    { polling: 500 },
  );
  // And it comes back.
  await page.evaluate(() => document.querySelector('main').append(a));
  await openPanel(page);
});

for (const touch of [false, true]) {
  test(`small, tall and wide${touch ? ', by touch' : ''}: the panel stays inside, every control can be reached, and the picture is where it can be seen`, async () => {
    const opened = await open(undefined, { size: [640, 640], ...(touch && { hasTouch: true, isMobile: true }) });
    const { page } = opened;
    for (const [[width, height], layout] of [
      [[300, 150], 'over'],
      [[360, 300], 'over'],
      [[360, 640], 'below'],
      [[640, 400], 'beside'],
    ]) {
      const name = `${width}x${height}${touch ? ' touch' : ''}`;
      await page.setViewportSize({ width: touch ? width + 40 : 760, height: height + 140 });
      await page.evaluate((size) => Object.assign(a.style, size), { width: `${width}px`, height: `${height}px` });
      if (touch) await button(page).tap();
      else await button(page).click();
      await panel(page).locator('.panel-body').waitFor();
      assert.equal(await page.locator('rock-field .controls-panel').getAttribute('data-layout'), layout, name);
      assert.ok(await page.locator('rock-field .stage').isVisible(), name);
      const outside = await page.evaluate((least) => {
        const box = a.getBoundingClientRect();
        const root = a.shadowRoot.querySelector('.controls-panel').shadowRoot;
        return [...root.querySelectorAll('button, input, select, summary')]
          .filter((at) => at.checkVisibility())
          .flatMap((at) => {
            at.scrollIntoView({ block: 'nearest' });
            const { left, right, top, bottom, width, height } = at.getBoundingClientRect();
            const fits = left >= box.left && right <= box.right && top >= box.top - 0.5 && bottom <= box.bottom + 0.5;
            return fits && width >= least && height >= least
              ? []
              : [`${at.id || at.className || at.localName} ${[left, top, width, height].map(Math.round)}`];
          });
      }, 24);
      assert.deepEqual(outside, [], name);
      assert.ok(
        await page.locator('rock-field .panel-body').evaluate((at) => at.scrollWidth <= at.clientWidth),
        `${name}: nothing sideways`,
      );
      assert.deepEqual(await page.evaluate(() => [a.scrollTop, a.shadowRoot.querySelector('.controls-panel').scrollTop]), [0, 0]);
      await page.screenshot({ path: screenshotPath(`controls-${name.replace(' ', '-')}`) });
      await panel(page).getByRole('button', { name: 'Close' }).click();
    }
    await closeClean(opened);
  });
}

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

for (const lang of ['en', 'ja']) {
  test(`axe finds nothing, closed or open, in light and in dark colours: ${lang}`, async () => {
    const opened = await open(undefined, { lang });
    const { page } = opened;
    for (const colorScheme of ['light', 'dark']) {
      await page.emulateMedia({ colorScheme });
      assert.deepEqual(await violations(page), [], colorScheme);
      await openPanel(page);
      await panel(page).locator('.layer-table').waitFor();
      assert.deepEqual(await violations(page), [], `${colorScheme}, open`);
      await page.screenshot({ path: screenshotPath(`controls-${lang}-${colorScheme}`) });
      await panel(page)
        .getByRole('button', { name: { en: 'Close', ja: '閉じる' }[lang] })
        .click();
    }
    await closeClean(opened);
  });
}

test('axe finds nothing on the page, wide or narrow, light or dark', async () => {
  for (const viewport of [
    { width: 1440, height: 900 },
    { width: 360, height: 740 },
  ]) {
    const opened = await session.open('#w=256&h=192&r=40,16', { colorScheme: 'light', viewport, locale: 'en-US' });
    const { page } = opened;
    await page.locator('.summary').waitFor();
    for (const colorScheme of ['light', 'dark']) {
      await page.emulateMedia({ colorScheme });
      const name = `${colorScheme}, ${viewport.width} px`;
      assert.deepEqual(await violations(page), [], name);
      if (viewport.width > 360) continue;
      await page.locator('.sheet-toggle').click();
      assert.deepEqual(await violations(page), [], `${name}, sheet open`);
      await page.locator('.sheet-toggle').click();
    }
    await closeClean(opened);
  }
});
