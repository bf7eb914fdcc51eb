// The page of wood ears, for tests that open it and ask what it shows.
import assert from 'node:assert/strict';

export const MESSAGE = 'stage-overlay > .message';
/** A small colony on a log of few triangles, in the colours of the thesis: a software GPU pays by the triangle, too. */
export const SMALL = '#preset=thesis-default&d=30&r=25&m=90&e=6&ls=6';

/** The page with its first picture. `options` are Playwright's context options. */
export async function openWoodEars(session, address = SMALL, options = {}) {
  const opened = await session.open(`wood-ear.html${address}`, { viewport: { width: 960, height: 640 }, locale: 'en-US', colorScheme: 'light', ...options });
  await opened.page.waitForFunction(() => document.querySelector('.summary') !== null, undefined, { polling: 100 });
  await opened.page.evaluate(() => document.querySelector('wood-ear-log').ready);
  return opened;
}

export const colony = (page) => page.evaluate(async () => (await document.querySelector('wood-ear-log').getColony()).stats);
export const params = (page) => page.evaluate(() => document.querySelector('wood-ear-log').params);
export const message = (page) => page.locator(`${MESSAGE} p`).first().textContent();

/** A hash (FNV-1a) of the colony of the present parameters, and of the rocks around it. */
export function hash(page) {
  return page.evaluate(async () => {
    const element = document.querySelector('wood-ear-log');
    const { positions, indices } = await element.getColony();
    let state = 0x811c9dc5;
    for (const array of [positions, indices, element.field.positions]) {
      const bytes = new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
      for (let k = 0; k < bytes.length; k += 1) state = Math.imul(state ^ bytes[k], 0x01000193);
    }
    return (state >>> 0).toString(16).padStart(8, '0');
  });
}

/** The middle of the picture's log, CSS px of the page: where its first base is. */
export function baseOnScreen(page, index = 0) {
  return page.evaluate((k) => {
    const box = document.querySelector('wood-ear-log').shadowRoot.querySelectorAll('.handle')[k].getBoundingClientRect();
    return [box.x + box.width / 2, box.y + box.height / 2];
  }, index);
}

export async function closeClean({ errors, close }, known = []) {
  assert.deepEqual(errors.filter((text) => !known.some((pattern) => pattern.test(text))), []);
  await close();
}
