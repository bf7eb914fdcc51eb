// The page of wood ears, for tests that open it and ask what it shows.
/** @import { Page } from 'playwright-core' */
/** @import { OpenOptions, Session } from './browser.mjs' */
import { hashOf, openPage } from './shown.mjs';

export { MESSAGE, boxOf, closeClean, message } from './shown.mjs';

/** A small colony on a log of few triangles, in the colours of the thesis: a software GPU pays by the triangle, too. */
export const SMALL = '#preset=thesis-default&d=30&r=25&m=90&e=6&ls=6';

/**
 * The page with its first picture.
 *
 * @param {Session} session
 * @param {string} [address]
 * @param {OpenOptions} [options]
 */
export const openWoodEars = (session, address = SMALL, options = {}) => openPage(session, `wood-ear.html${address}`, options);

/** @param {Page} page */
export const params = (page) => page.evaluate(() => document.querySelector('wood-ear-log').params);
/** @param {Page} page */
export const colony = (page) => page.evaluate(async () => (await document.querySelector('wood-ear-log').getColony()).stats);

/**
 * A hash (FNV-1a, by bytes) of the colony of the present parameters, and of the rocks around it.
 *
 * @param {Page} page
 */
export function hash(page) {
  return hashOf(page, async () => {
    const element = document.querySelector('wood-ear-log');
    const { positions, indices } = await element.getColony();
    return [positions, indices, element.field.positions];
  });
}

/**
 * The middle of the picture's log, CSS px of the page: where its first base is.
 *
 * @param {Page} page
 * @param {number} [index]
 */
export function baseOnScreen(page, index = 0) {
  return page.evaluate((k) => {
    const box = document.querySelector('wood-ear-log').shadowRoot.querySelectorAll('.handle')[k].getBoundingClientRect();
    return [box.x + box.width / 2, box.y + box.height / 2];
  }, index);
}
