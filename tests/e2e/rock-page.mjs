// The page of rocks, for tests that open it and ask what it shows.
/** @import { Page } from 'playwright-core' */
import { hashOf } from './shown.mjs';

export { MESSAGE, boxOf, closeClean, message, openPage as openRocks, params } from './shown.mjs';

/**
 * A hash (FNV-1a, by bytes) of the field of the present parameters, once it is finished.
 *
 * @param {Page} page
 */
export function hash(page) {
  return hashOf(page, async () => {
    const { positions, indices, rockStarts, rockLayer } = await document.querySelector('rock-field').getField();
    return [positions, indices, rockStarts, rockLayer];
  });
}

/** @param {Page} page */
export const stats = (page) => page.evaluate(async () => (await document.querySelector('rock-field').getField()).stats);
/**
 * The address follows within half a second of the result, or when a slow picture has been painted.
 *
 * @param {Page} page
 * @param {RegExp} pattern
 */
export const address = async (page, pattern) => {
  await page.waitForURL(pattern);
  return page.url();
};

/**
 * Follows a link on the open page, and gives it the time for its rocks.
 *
 * @param {Page} page
 * @param {string} link
 */
export async function follow(page, link) {
  await page.evaluate(async (link) => {
    const followed = new Promise((resolve) => addEventListener('hashchange', resolve, { once: true }));
    location.hash = link;
    await followed;
    await document.querySelector('rock-field').getField();
  }, link);
}
