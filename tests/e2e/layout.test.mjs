// Everything fits, in every window: both pages, both languages, a mouse and fingers.
/** @import { Page } from 'playwright-core' */
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { launch } from './browser.mjs';

/** Small scenes, with every section of the panel. */
const PAGES = ['index.html#preset=riverbed&w=64&h=64&r=20,10,8&color=plain', 'wood-ear.html#preset=thesis-default&d=4&color=plain'];
/** Widths from the narrowest phone on, phones held sideways, a window at 400 %, both sides of every breakpoint. */
const WINDOWS = [
  [320, 640],
  [320, 256],
  [360, 740],
  [390, 844],
  [480, 700],
  [568, 320],
  [640, 512],
  [700, 600],
  [701, 600],
  [768, 1024],
  [844, 390],
  [932, 430],
  [960, 600],
  [1024, 768],
  [1440, 900],
];

/** @type {import('./browser.mjs').Session} */
let session;

before(async () => {
  session = await launch();
});

after(() => session?.close());

/**
 * The page with its first picture. `fingers`: a touch screen.
 *
 * @param {string} address
 * @param {import('./browser.mjs').OpenOptions & { fingers?: boolean }} [options]
 */
async function open(address, { fingers = false, ...options } = {}) {
  const opened = await session.open(address, {
    viewport: { width: 960, height: 640 },
    locale: 'en-US',
    colorScheme: 'light',
    isMobile: fingers,
    hasTouch: fingers,
    ...options,
  });
  await opened.page.waitForFunction(() => document.querySelector('.summary') !== null, undefined, { polling: 100 });
  return opened;
}

/** What does not fit: the page or a part of it that can be moved, controls that are cut off, lie over one another or are too small for their text. */
function misfits(/** @type {Page} */ page) {
  return page.evaluate(async () => {
    await new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)));
    const found = [];
    const nameOf = (element) =>
      `${element.localName}.${element.className || element.id || element.getAttribute('aria-label') || element.textContent.trim()}`;
    const { innerWidth: width, innerHeight: height } = window;
    const isShown = (element) => element.checkVisibility({ visibilityProperty: true }) && element.getClientRects().length > 0;
    const everything = [...document.querySelectorAll('*')].filter(isShown);
    // Nothing moves sideways, and up and down only the panel's controls.
    const isScroller = (element) => !/^(visible|clip)/.test(getComputedStyle(element).overflow);
    for (const element of [document.documentElement, ...everything.filter(isScroller)]) {
      const before = [element.scrollLeft, element.scrollTop];
      element.scrollTo(1e4, element.matches('.panel-body') ? before[1] : 1e4);
      if ((element.scrollLeft !== 0 || element.scrollTop !== before[1]) && !element.matches('select, input, textarea'))
        found.push(`${nameOf(element)} scrolls to ${element.scrollLeft}, ${element.scrollTop}`);
      element.scrollTo(before[0], before[1]);
    }
    const seen = /** @type {VisualViewport} */ (visualViewport);
    if (seen.width < width - 1 || seen.pageLeft !== 0) found.push('the page pans');
    // The whole of every control is in the window, but for those that the panel's controls are scrolled to.
    const controls = everything.filter(
      (element) =>
        element.matches('button, select, summary, .slider, .number, .segment, a.button, .summary, .file-button') &&
        !element.matches('.skip-link'),
    );
    for (const element of controls) {
      const box = element.getBoundingClientRect();
      const scroller = element.closest('.panel-body');
      const isScrolled = scroller !== null;
      const bounds = (scroller ?? document.documentElement).getBoundingClientRect();
      if (box.left < bounds.left - 0.5 || box.right > bounds.right + 0.5)
        found.push(`${nameOf(element)} reaches from ${box.left} to ${box.right} of ${bounds.left} to ${bounds.right}`);
      if (!isScrolled && (box.top < -0.5 || box.bottom > height + 0.5))
        found.push(`${nameOf(element)} reaches down from ${box.top} to ${box.bottom} of ${height}`);
      if (
        element.scrollWidth > element.clientWidth + 1 &&
        getComputedStyle(element).display !== 'inline' &&
        !element.matches('.preset-button, .slider')
      )
        found.push(`${nameOf(element)} holds ${element.scrollWidth} in ${element.clientWidth}`);
      const icon = element.matches('.icon-button, .share') && Math.min(box.width, box.height);
      if (icon !== false && icon < 24) found.push(`${nameOf(element)} is ${box.width} × ${box.height}`);
      if (element.matches('.icon-button') && Math.abs(box.width - box.height) > 1)
        found.push(`${nameOf(element)} is drawn out to ${box.width} × ${box.height}`);
    }
    const apart = controls.map((element) => ({ element, box: element.getBoundingClientRect() }));
    for (const [index, { element: one, box: a }] of apart.entries()) {
      for (const { element: other, box: b } of apart.slice(index + 1)) {
        const overlap =
          Math.min(a.right, b.right) - Math.max(a.left, b.left) > 1 && Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 1;
        const inOneBox = (one.closest('.panel-body') === null) === (other.closest('.panel-body') === null);
        if (overlap && inOneBox && !one.contains(other)) found.push(`${nameOf(one)} and ${nameOf(other)} overlap`);
      }
    }
    return [...new Set(found)];
  });
}

for (const fingers of [false, true]) {
  test(`with ${fingers ? 'fingers' : 'a mouse'} everything fits at every width in both languages, and nothing but the panel's controls moves`, async () => {
    const found = [];
    for (const address of PAGES) {
      const { page, errors, close } = await open(address, { fingers });
      await page.locator('details').evaluateAll((parts) => parts.forEach((part) => part.setAttribute('open', '')));
      // A picture in every size would cost a software GPU minutes.
      await page.addStyleTag({ content: '.picture { display: none }' });
      for (const language of ['en', 'ja']) {
        await page
          .locator(`input[name="language"][value="${language}"]`)
          .evaluate((/** @type {HTMLInputElement} */ button) => button.click());
        await page.waitForFunction(
          (name) => document.querySelector('.share').getAttribute('aria-label') === name,
          language === 'ja' ? '共有' : 'Share',
        );
        for (const [width, height] of WINDOWS) {
          await page.setViewportSize({ width, height });
          const where = `${address.split('#')[0]} in ${language} at ${width} × ${height}`;
          found.push(...(await misfits(page)).map((what) => `${where}: ${what}`));
          const toggle = page.locator('.sheet-toggle');
          if (!(await toggle.isVisible())) continue;
          await toggle.click();
          found.push(...(await misfits(page)).map((what) => `${where}, the sheet open: ${what}`));
          await toggle.click();
        }
      }
      assert.deepEqual(errors, []);
      await close();
    }
    assert.deepEqual(found, []);
  });
}

test('what looks for hidden words, or brings them into view, moves the panel and not the page', async () => {
  for (const address of PAGES) {
    const { page, errors, close } = await open(address, { viewport: { width: 960, height: 500 } });
    await page.locator('details').evaluateAll((parts) => parts.forEach((part) => part.setAttribute('open', '')));
    const { moved, isSeen } = await page.evaluate(() => {
      const hidden = [...document.querySelectorAll('.panel-body .visually-hidden[id]')];
      for (const words of hidden) words.scrollIntoView({ block: 'center' });
      document.querySelector('.panel-body > :last-child').scrollIntoView({ block: 'start' });
      /** @type {Window & { find?: (words: string) => boolean }} */ (window).find?.('decides');
      const { top } = document.querySelector('.toolbar').getBoundingClientRect();
      const last = hidden[hidden.length - 1];
      last.scrollIntoView();
      const control = document.querySelector(`[aria-describedby~="${last.id}"]`).getBoundingClientRect();
      return {
        moved: [
          top,
          ...[document.documentElement, document.body, document.querySelector('.app'), document.querySelector('.panel')].map(
            ({ scrollTop }) => scrollTop,
          ),
        ],
        isSeen: control.bottom > 0 && control.top < innerHeight,
      };
    });
    assert.deepEqual(moved, [0, 0, 0, 0, 0], address);
    assert.ok(isSeen, 'the words of a control are where it is');
    assert.deepEqual(errors, []);
    await close();
  }
});
