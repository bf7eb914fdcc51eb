// Panels can be used by everybody: in elements of every size, by touch, in light and dark colours, with what axe checks; the page's panel, too.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { violations } from './axe.mjs';
import { screenshotPath } from './browser.mjs';
import { button, launchControls, openControls, openPanel, panel } from './controls-page.mjs';
import { closeClean } from './shown.mjs';

/** @type {import('./browser.mjs').Session} */
let session;

before(async () => {
  session = await launchControls();
});

after(() => session?.close());

const open = (body, options) => openControls(session, body, options);

for (const touch of [false, true]) {
  test(`small, tall and wide${touch ? ', by touch' : ''}: the panel stays inside, every control can be reached, and the picture is where it can be seen`, async () => {
    const opened = await open(undefined, { size: [640, 640], ...(touch && { hasTouch: true, isMobile: true }) });
    const { page } = opened;
    for (const { width, height, layout } of [
      { width: 300, height: 150, layout: 'over' },
      { width: 360, height: 300, layout: 'over' },
      { width: 360, height: 640, layout: 'below' },
      { width: 640, height: 400, layout: 'beside' },
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

for (const lang of ['en', 'ja']) {
  test(`axe finds nothing, closed or open, in light and in dark colours: ${lang}`, async () => {
    const opened = await open(undefined, { lang });
    const { page } = opened;
    for (const colorScheme of /** @type {const} */ (['light', 'dark'])) {
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
    for (const colorScheme of /** @type {const} */ (['light', 'dark'])) {
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
