// The documentation as a reader finds it: every page, every link, every example, by hand, by keyboard, by screen reader and without a network.
/** @import { Page } from 'playwright-core' */
import assert from 'node:assert/strict';
import { readdirSync } from 'node:fs';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { dist } from '../../scripts/lib/env.mjs';
import { COLOR_RULES, violations } from './axe.mjs';
import { PATIENCE, launch, staysQuietFor, until } from './browser.mjs';

/** What the recipes say the documentation needs: scripts of examples are modules from blobs, their styles are inline. */
const POLICY =
  "default-src 'none'; script-src 'self' 'wasm-unsafe-eval' blob:; worker-src 'self'; connect-src 'self'; img-src 'self' data: blob:; style-src 'self' 'unsafe-inline'; manifest-src 'self'";
const PAGES = readdirSync(path.join(dist, 'docs')).filter((name) => name.endsWith('.html'));
/** As many as the documentation lets live; see keeper.ts. */
const MAX_ALIVE = 10;
/** The page with few rocks. */
const SMALL = '#preset=journal-fig1&w=256&h=256';

/** @type {import('./browser.mjs').Session} */
let session;
/** Without 3D, for what does not look at pictures: dozens of fields take a software GPU minutes. */
let flat;
let down = false;

before(async () => {
  const intercept = (request, response) => {
    if (down) request.socket.destroy();
    else if (request.url.startsWith('/docs/')) response.setHeader('content-security-policy', POLICY);
    return down;
  };
  session = await launch({ intercept });
  flat = await launch({ intercept, gpu: false });
});

after(async () => {
  await session?.close();
  await flat?.close();
});

/** What every page has: anchors, by its address, and links. */
const ids = new Map();
/** @type {{ name: string, url: URL }[]} */
const links = [];

for (const name of PAGES) {
  // One page for all three, since opening one costs more than most of them have to do.
  test(name, { timeout: 10 * PATIENCE }, async (t) => {
    const asked = new Set();
    const prepare = (/** @type {Page} */ page) => void page.context().on('request', (request) => asked.add(new URL(request.url()).origin));
    // Each attribute is changed in 3D by attributes.test.mjs.
    const { page, errors, warnings, close } = await (name === 'attributes.html' ? flat : session).open(`docs/${name}`, {
      prepare,
      viewport: { width: 360, height: 740 },
    });
    const { origin } = new URL(page.url());

    await t.test('opens without an error or a foreign request, and fits a phone', async () => {
      await page.evaluate(() => Promise.all(['live-example', 'rock-field'].map((tag) => customElements.whenDefined(tag))));
      const found = await page.evaluate(() => ({
        lang: document.documentElement.lang,
        width: document.documentElement.scrollWidth,
        headings: document.querySelectorAll('h1').length,
        ids: [...document.querySelectorAll('[id]')].map(({ id }) => id),
        links: [...document.querySelectorAll('a')].filter((link) => link.hasAttribute('href')).map(({ href }) => href),
      }));
      assert.deepEqual([found.lang, found.headings], ['en', 1]);
      assert.ok(found.width <= 360, `it is ${found.width} px wide on a screen of 360`);
      assert.equal(new Set(found.ids).size, found.ids.length, 'an id is there twice');
      assert.deepEqual(
        [...asked].filter((one) => one !== 'null' && one !== origin),
        [],
      );
      assert.deepEqual([errors, warnings], [[], []]);
      ids.set(`/docs/${name}`, found.ids);
      links.push(...found.links.map((href) => ({ name, url: new URL(href) })));
    });

    await page.setViewportSize({ width: 1280, height: 800 });

    await t.test('a screen reader finds nothing wrong, in light and in dark', async () => {
      for (const colorScheme of /** @type {const} */ (['dark', 'light'])) {
        await page.emulateMedia({ colorScheme });
        assert.deepEqual(await violations(page, colorScheme === 'light' ? null : COLOR_RULES), [], colorScheme);
      }
    });

    await t.test('every example runs, and everything in it can be used, without an error', async () => {
      for (const example of await page.locator('live-example').all()) {
        const title = await example.getAttribute('data-name');
        await example.scrollIntoViewIfNeeded();
        await until(() => example.evaluate(isSettled), `${title} shows its rocks or says why not`);
        // Of 16 million pixels a software GPU takes ten seconds for each picture, of which the example has had one of its own.
        if (/imageWidth: 4096/.test(await example.locator('textarea').inputValue())) await example.evaluate(hideRocks);
        await example.evaluate(useEverything);
        await until(() => example.evaluate(isSettled), `${title} shows its rocks after it was used`);
        const said = await example.evaluate((element) => ({
          message: element.querySelector('.example-message').textContent,
          waiting: [...element.querySelector('.result').shadowRoot.querySelectorAll('output')].filter(({ value }) => value === '…').length,
        }));
        assert.deepEqual([said, errors], [{ message: '', waiting: 0 }, []], title);
      }
      if (name === 'gallery.html') await page.waitForFunction(() => document.querySelectorAll('.stage rock-field').length > 0);
      assert.deepEqual(errors, []);
    });

    await close();
  });
}

test('every link leads somewhere', () => {
  for (const { name, url } of links) {
    const file = url.pathname.endsWith('/') ? `${url.pathname}index.html` : url.pathname;
    assert.ok(
      [session, flat].some(({ url: own }) => url.origin === new URL(own).origin),
      `${name}: ${url}`,
    );
    const isPage = ['/index.html', '/wood-ear.html', '/THIRD-PARTY-LICENSES.txt'].includes(file);
    assert.ok(isPage || ids.has(file), `${name} links to ${url}, which is not there`);
    assert.ok(isPage || url.hash === '' || ids.get(file).includes(url.hash.slice(1)), `${name} links to ${url}, which has no such anchor`);
  }
  assert.ok(links.length > 300);
});

test('the result follows the editor, a mistake is named, Reset brings the example back, and Tab leads out', async () => {
  const { page, errors, close } = await session.open('docs/attributes.html#attribute-seed', { viewport: { width: 1280, height: 800 } });
  const example = page.locator('#attribute-seed ~ live-example');
  const editor = example.locator('textarea');
  const shown = () =>
    example.evaluate((element) => {
      const field = element.querySelector('.result').shadowRoot?.querySelector('rock-field');
      return field ? { seed: field.seed, layers: field.layers.length, rocks: field.field?.stats.rocks ?? 0 } : { seed: NaN };
    });
  const original = await editor.inputValue();
  await until(async () => (await shown()).seed === 7, 'the example is alive');
  await editor.fill('<rock-field seed="4321" radius="60 20"></rock-field>');
  await until(async () => {
    const { seed, layers, rocks } = await shown();
    return seed === 4321 && layers === 2 && rocks > 0;
  }, 'the result is what was written');
  await editor.fill('<p>Nothing</p>\n<script type="module">\n  nonsense();\n</script>');
  await until(
    async () => /nonsense is not defined/.test((await example.locator('.example-message').textContent()) ?? ''),
    'the mistake is named',
  );
  await editor.press('End');
  await editor.press('Tab');
  assert.notEqual(await page.evaluate(() => document.activeElement?.tagName), 'TEXTAREA');
  await example.getByRole('button', { name: 'Reset' }).click();
  assert.equal(await editor.inputValue(), original);
  await until(async () => (await shown()).seed === 7, 'the example is as it was');
  assert.equal(await example.locator('.example-message').textContent(), '');
  assert.deepEqual(errors, []);
  await close();
});

test('only what is near the screen is alive, however far one scrolls', { timeout: 5 * PATIENCE }, async () => {
  for (const name of ['gallery.html', 'attributes.html']) {
    const { page, errors, close } = await flat.open(`docs/${name}`, { viewport: { width: 1280, height: 800 } });
    const alive = () =>
      page.evaluate(() =>
        [document, ...[...document.querySelectorAll('.result')].map(({ shadowRoot }) => shadowRoot)].reduce(
          (sum, root) => sum + (root?.querySelectorAll('rock-field').length ?? 0),
          0,
        ),
      );
    const height = await page.evaluate(() => document.documentElement.scrollHeight);
    let most = 0;
    for (let y = 0; y < height; y += height / 10) {
      await page.evaluate((top) => scrollTo(0, top), y);
      await staysQuietFor(page, 300);
      most = Math.max(most, await alive());
    }
    assert.ok(most > 0 && most <= MAX_ALIVE, `${most} of ${name}`);
    await page.evaluate(() => scrollTo(0, 0));
    await until(async () => (await alive()) > 0, 'back at the top something lives again');
    assert.deepEqual(errors, []);
    await close();
  }
});

test('what was read once can be read without a network', async () => {
  const { page, close } = await session.open(SMALL, { serviceWorkers: 'allow' });
  await page.evaluate(() => navigator.serviceWorker.ready);
  await page.goto(`${session.url}docs/methods.html`);
  const isKept = async (file) => {
    for (const name of await caches.keys()) {
      const kept = await (await caches.open(name)).keys();
      if (kept.some(({ url }) => new RegExp(`${file}$`).test(url))) return true;
    }
    return false;
  };
  for (const file of ['docs/methods.html', 'docs/docs-\\w+.js', 'docs/docs-\\w+.css', '/rock-field.js'])
    await until(() => page.evaluate(isKept, file), `${file} is kept`);
  down = true;
  try {
    await page.reload();
    assert.equal(await page.locator('h1').textContent(), 'Methods');
    await page.evaluate(() => Promise.all(['live-example', 'rock-field'].map((tag) => customElements.whenDefined(tag))));
    await page.goto(session.url);
    assert.equal(await page.title(), 'rock-field – ground covered with rocks of various sizes');
  } finally {
    down = false;
  }
  await close();
});

/** In the page: whether an example's fields are painted, and what has no picture says why. */
async function isSettled(example) {
  const root = example.querySelector('.result').shadowRoot;
  const fields = [...(root?.querySelectorAll('rock-field') ?? [])];
  const later = new Promise((resolve) => setTimeout(resolve, 50, false));
  // A run that was cancelled is done too.
  const run = (field) =>
    field.getField().then(
      () => true,
      ({ name }) => name === 'AbortError',
    );
  const isDone = async (field) =>
    !field.shadowRoot.querySelector('[part=message]').hidden || Promise.race([later, field.ready.then(() => run(field))]);
  return fields.length > 0 && (await Promise.all(fields.map(isDone))).every(Boolean);
}

/** In the page: from here on nothing is drawn in this example. */
function hideRocks(example) {
  for (const field of example.querySelector('.result').shadowRoot.querySelectorAll('rock-field')) field.style.display = 'none';
}

/** In the page: presses every button, moves every slider, makes every choice. */
async function useEverything(example) {
  const root = example.querySelector('.result').shadowRoot;
  const pause = () => new Promise((resolve) => setTimeout(resolve, 100));
  for (const control of root.querySelectorAll('button, select, input')) {
    if (control.type === 'range') control.value = String((Number(control.min) + Number(control.value)) / 2);
    if (control.type === 'range') control.dispatchEvent(new Event('input', { bubbles: true }));
    else if (control.localName === 'select') control.selectedIndex = 1;
    else control.click();
    if (control.localName === 'select') control.dispatchEvent(new Event('change', { bubbles: true }));
    await pause();
  }
}
