// Links of the page of rocks: shared and embedded, wrong ones, ones that show next to nothing, and those from one scene to the other.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { copied, hidePictures, launch } from './browser.mjs';
import { MESSAGE, address, closeClean, follow, hash, message, openRocks, params, stats } from './rock-page.mjs';

/** @type {import('./browser.mjs').Session} */
let session;

before(async () => {
  session = await launch();
});

after(() => session?.close());

const open = (address, options) => openRocks(session, address, options);

test('a shared link shows the same rocks elsewhere', async () => {
  const opened = await open('#seed=7&w=700&h=500', { permissions: ['clipboard-read', 'clipboard-write'] });
  const { page } = opened;
  await page.locator('[id="h2-0-number"]').fill('33.3');
  await page.locator('[data-param="view"] input[value="wireframe"]').check();
  const link = await copied(page, page.getByRole('button', { name: 'Share' }));
  assert.equal(link, page.url());
  assert.match(link, /#v=1&preset=journal-fig1&seed=7&w=700&h=500&h2=33\.3,5,2&view=wireframe$/);
  const expected = await hash(page);
  const other = await open(new URL(link).hash);
  assert.equal(await hash(other.page), expected);
  assert.ok(await other.page.locator('[data-param="view"] input[value="wireframe"]').isChecked());
  await closeClean(other);
  // The same link by the address bar of a page that is open already, and back; also where the page writes its own address before it hears of the new one.
  await page.evaluate(() => {
    const { href } = location;
    location.hash = '#seed=8&w=300';
    history.replaceState(null, '', href);
  });
  await page.waitForFunction(() => document.querySelector('rock-field').params.seed === 8);
  assert.equal((await params(page)).imageHeight, 1024);
  await page.keyboard.press('Control+z');
  assert.equal(await hash(page), expected);
  await closeClean(opened);
});

test('the embed code shows the same rocks', async () => {
  const opened = await open('#seed=5&w=256&h=256', { permissions: ['clipboard-read', 'clipboard-write'] });
  const { page } = opened;
  await hidePictures(page);
  const code = await copied(page, page.getByRole('button', { name: 'Copy embed code' }));
  const expected = await hash(page);
  const source = await page.evaluate(
    (html) => new DOMParser().parseFromString(html, 'text/html').querySelector('rock-field').getAttribute('src'),
    code,
  );
  const shown = await page.evaluate(async (src) => {
    const element = document.createElement('rock-field');
    element.setAttribute('backend', 'null');
    element.setAttribute('src', src ?? '');
    document.body.append(element);
    const { params } = element;
    element.remove();
    return params;
  }, source);
  assert.deepEqual(shown, await params(page));
  assert.equal(await hash(page), expected);
  assert.match(code, /<script async crossorigin src="http:\/\/[^"]+\/cdn\.js"><\/script>/);
  // Where the browser refuses to change the address, the link is copied all the same.
  await page.evaluate(() => {
    history.replaceState = () => {
      throw new DOMException('refused', 'SecurityError');
    };
  });
  await page.getByRole('button', { name: 'Next seed' }).click();
  await hash(page);
  assert.match(await copied(page, page.getByRole('button', { name: 'Share' })), /#v=1&preset=journal-fig1&seed=6&w=256&h=256$/);
  await closeClean(opened);
});

/** @type {[what: string, link: string, pattern: RegExp][]} */
const BAD_LINKS = [
  ['an unknown key', '#seed=1&nonsense=1', /nonsense/],
  ['text for a number', '#w=abc', /w: “abc”/],
  ['NaN', '#seed=NaN', /seed: “NaN”/],
  ['out of range', '#r=90,30,99999', /r: 99999 .* 8192/],
  ['200 kB', `#w=256&${'x=1&'.repeat(50_000)}`, /20\d{4} characters/],
  ['markup in a value', `#preset=${encodeURIComponent('<img src=x onerror="globalThis.injected=1">')}`, /img src=x/],
  ['an unknown version', '#v=99&seed=1', /version 99/],
  ['lists of different lengths', '#r=90,30&a=0.2', /r: 2, a: 1/],
  ['too many layers', '#r=9,9,9,9,9,9,9,9,9', /9 layers/],
];

test('of a bad link there is one notice for each thing that is wrong, which names it, and the page works', async () => {
  const opened = await open(BAD_LINKS[0][1]);
  const { page } = opened;
  await hidePictures(page);
  for (const [what, link, pattern] of BAD_LINKS) {
    if (link !== BAD_LINKS[0][1]) await follow(page, link);
    await page.locator(MESSAGE).waitFor();
    const notices = [await message(page)];
    const count = /\/ (\d+)/.exec((await page.locator(MESSAGE).textContent()) ?? '')?.[1] ?? '1';
    for (let k = 1; k < Number(count); k += 1) {
      await page.locator(`${MESSAGE} button`).click();
      notices.push(await message(page));
    }
    assert.equal(notices.filter((text) => pattern.test(text)).length, 1, `${what}: ${notices.join('\n')}`);
    await page.locator(`${MESSAGE} button`).click();
    assert.equal(await page.locator(MESSAGE).count(), 0, what);
    assert.equal(await page.evaluate(() => globalThis.injected), undefined);
    assert.equal(await page.locator('img[src="x"]').count(), 0);
    const before = await hash(page);
    await page.getByRole('button', { name: 'Next seed' }).click();
    assert.notEqual(await hash(page), before, what);
  }
  await closeClean(opened);
});

// Small where the rocks cover each other many times over: a software GPU would take minutes.
const DEGENERATE = [
  '#r=',
  '#r=8192',
  '#w=1&h=1',
  '#w=1024&h=1',
  '#w=64&h=64&r=1&w2=0&w3=0&h1=1&h2=1&h3=0',
  '#a=0,0,0',
  '#a=1,1,1',
  '#cd=0',
  '#w=32&h=32&w1=-500,-500,-500',
  '#n=0,-,5',
];

test('links that leave hardly anything to be seen have a picture and no error', async () => {
  const opened = await open(DEGENERATE[0]);
  const { page } = opened;
  for (const link of DEGENERATE) {
    if (link !== DEGENERATE[0]) await follow(page, link);
    assert.equal(await page.locator(`${MESSAGE}, .control-problem`).count(), 0, link);
    const { coveredFraction } = await stats(page);
    assert.ok(coveredFraction >= 0 && coveredFraction <= 1, link);
    assert.doesNotMatch(await page.locator('.panel').innerText(), /NaN|undefined|-0\.0/, link);
  }
  await closeClean(opened);
});

test('each scene is found as it was left, and the log can be laid on the rocks that were edited', async () => {
  const opened = await open('#preset=journal-fig1&w=64&h=64&r=20', { viewport: { width: 720, height: 280 } });
  const { page } = opened;
  const ready = (name) =>
    page.waitForFunction((element) => document.querySelector(element) && document.querySelector('.summary'), name, { polling: 100 });
  const tab = (name) => page.getByRole('navigation').getByRole('link', { name });
  // The address tells of a seed when it is shown.
  const nextSeed = async (shown) => {
    await page.getByRole('button', { name: 'Next seed' }).click();
    await address(page, shown);
  };
  await nextSeed(/seed=1/);
  await page.goto(
    new URL('wood-ear.html#preset=thesis-default&d=8&ground=preset%3Djournal-fig12a%26w%3D64%26h%3D64%26r%3D20', session.url).href,
  );
  await ready('wood-ear-log');
  await nextSeed(/seed=1/);
  await tab('Rocks').click();
  await ready('rock-field');
  assert.match(page.url(), /#v=1&preset=journal-fig1&seed=1&w=64&h=64/);
  await tab('Wood ears').click();
  await ready('wood-ear-log');
  assert.match(page.url(), /preset=thesis-default&seed=1&d=8/);
  await page.goBack();
  await ready('rock-field');
  assert.match(page.url(), /#v=1&preset=journal-fig1&seed=1&w=64&h=64/);
  await page.goForward();
  await ready('wood-ear-log');
  assert.match(page.url(), /preset=thesis-default&seed=1&d=8/);
  assert.equal(await page.getByRole('link', { name: 'Lay the log on these rocks' }).count(), 0);
  await page.getByRole('link', { name: 'Edit these rocks' }).click();
  await ready('rock-field');
  assert.match(page.url(), /preset=journal-fig12a&w=64&h=64&r=20/);
  await nextSeed(/seed=1/);
  await page.getByRole('link', { name: 'Lay the log on these rocks' }).click();
  await ready('wood-ear-log');
  const { seed, density, ground } = await page.evaluate(() => document.querySelector('wood-ear-log').params);
  assert.deepEqual([seed, density], [1, 8]);
  assert.match(ground, /preset=journal-fig12a&seed=1&w=64&h=64&r=20/);
  await closeClean(opened);
});
