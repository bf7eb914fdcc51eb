// The page of rocks, for tests that open it and ask what it shows.
import assert from 'node:assert/strict';

/** Not the element's own, which is inside it. */
export const MESSAGE = 'stage-overlay > .message';

/** The page with its first picture, small: a software GPU pays by the pixel. `options` are Playwright's context options. */
export async function openRocks(session, address = '', options = {}) {
  const opened = await session.open(address, { viewport: { width: 960, height: 640 }, locale: 'en-US', colorScheme: 'light', ...options });
  // By the clock, not by frames: those may be slow to come.
  await opened.page.waitForFunction(() => document.querySelector('.summary') !== null, undefined, { polling: 100 });
  await opened.page.evaluate(() => document.querySelector('rock-field').ready);
  return opened;
}

/** A hash (FNV-1a, by words) of the field of the present parameters, once it is finished. */
export function hash(page) {
  return page.evaluate(async () => {
    const { positions, indices, rockStarts, rockLayer } = await document.querySelector('rock-field').getField();
    let state = 0x811c9dc5;
    for (const array of [positions, indices, rockStarts, rockLayer]) {
      const bytes = new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
      for (let k = 0; k < bytes.length; k += 1) state = Math.imul(state ^ bytes[k], 0x01000193);
    }
    return (state >>> 0).toString(16).padStart(8, '0');
  });
}

export const stats = (page) => page.evaluate(async () => (await document.querySelector('rock-field').getField()).stats);
export const params = (page) => page.evaluate(() => document.querySelector('rock-field').params);
export const message = (page) => page.locator(`${MESSAGE} p`).first().textContent();
/** The address follows within half a second of the result, or when a slow picture has been painted. */
export const address = async (page, pattern) => {
  await page.waitForURL(pattern);
  return page.url();
};

export async function closeClean({ errors, close }, known = []) {
  assert.deepEqual(errors.filter((text) => !known.some((pattern) => pattern.test(text))), []);
  await close();
}
