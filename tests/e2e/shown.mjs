// What either page shows, for tests that ask.
/** @import { Locator, Page } from 'playwright-core' */
/** @import { OpenOptions, Session } from './browser.mjs' */
import assert from 'node:assert/strict';

/** Not the element's own, which is inside it. */
export const MESSAGE = 'stage-overlay > .message';

/**
 * A page with its first picture, small: a software GPU pays by the pixel.
 *
 * @param {Session} session
 * @param {string} [address]
 * @param {OpenOptions} [options]
 */
export async function openPage(session, address = '', options = {}) {
  const opened = await session.open(address, { viewport: { width: 960, height: 640 }, locale: 'en-US', colorScheme: 'light', ...options });
  // By the clock, not by frames: those may be slow to come.
  await opened.page.waitForFunction(() => document.querySelector('.summary') !== null, undefined, { polling: 100 });
  await opened.page.evaluate(() => document.querySelector('rock-field, wood-ear-log').ready);
  return opened;
}

/** @param {Page} page */
export const message = async (page) => (await page.locator(`${MESSAGE} p`).first().textContent()) ?? '';
/** @param {Page} page */
export const params = (page) => page.evaluate(() => document.querySelector('rock-field, wood-ear-log').params);

/**
 * The hash (FNV-1a, by bytes) of the typed arrays that `arrays` resolves with in the page: eight hexadecimal digits.
 *
 * @param {Page} page
 * @param {() => Promise<ArrayBufferView[]>} arrays
 */
export async function hashOf(page, arrays) {
  const found = await page.evaluateHandle(arrays);
  const text = await found.evaluate((all) => {
    let state = 0x811c9dc5;
    for (const { buffer, byteOffset, byteLength } of all)
      for (const byte of new Uint8Array(buffer, byteOffset, byteLength)) state = Math.imul(state ^ byte, 0x01000193);
    return (state >>> 0).toString(16).padStart(8, '0');
  });
  await found.dispose();
  return text;
}

/**
 * Where something that is shown is, CSS px of the page.
 *
 * @param {Locator} locator
 */
export async function boxOf(locator) {
  const box = await locator.boundingBox();
  assert.ok(box, `not shown: ${locator}`);
  return box;
}

/**
 * Closes what was opened; fails if the page has said an error that matches none of the known patterns.
 *
 * @param {Pick<Awaited<ReturnType<Session['open']>>, 'errors' | 'close'>} opened
 * @param {RegExp[]} [known]
 */
export async function closeClean({ errors, close }, known = []) {
  const unknown = errors.filter((text) => !known.some((pattern) => pattern.test(text)));
  // Compared with an empty list, long ones would be cut short.
  assert.ok(unknown.length === 0, `the page has said ${unknown.length} errors:\n${unknown.join('\n')}`);
  await close();
}
