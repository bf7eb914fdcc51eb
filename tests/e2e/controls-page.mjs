// A page with elements that have a panel; the page around them is the guest's, with its own styles, and its listeners are counted.
/** @import { Locator, Page } from 'playwright-core' */
import { plainName } from '../../scripts/build/hashed-names.mjs';
import { launch, pageOf } from './browser.mjs';

export const SMALL = 'image-width="256" image-height="192" radius="40 16" area-fraction="0.2 0.3"';

let html = '';
let headers = {};

/**
 * A browser that is served the page, by the name `controls.html`. `panelFile` may answer a request for panel.js in the server's stead.
 *
 * @typedef {(response: import('node:http').ServerResponse) => unknown} PanelFile
 * @param {{ panelFile?: PanelFile }} [options]
 */
export function launchControls({ panelFile } = {}) {
  const page = pageOf('controls.html', () => html);
  return launch({
    args: ['--js-flags=--expose-gc'],
    async intercept(request, response) {
      if (request.url.startsWith('/controls.html')) for (const [name, value] of Object.entries(headers)) response.setHeader(name, value);
      if (plainName(request.url).startsWith('/panel.js') && (await panelFile?.(response))) return true;
      return page(request, response);
    },
  });
}

/**
 * A page with this body, whose first element is `a`; `eventCounts` has the numbers of its events by type.
 *
 * @param {import('./browser.mjs').Session} session
 * @param {string} [body]
 * @param {import('./browser.mjs').OpenOptions & { lang?: string, size?: number[], script?: string, kind?: string, csp?: string }} [options]
 */
export async function openControls(
  session,
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
  const eventCounts = {};
  for (const type of ['generate', 'error', 'notice', 'progress', 'camera-change']) a.addEventListener(type, () => (eventCounts[type] = (eventCounts[type] ?? 0) + 1));
`;

/**
 * @param {Page} page
 * @param {Locator} [element]
 */
export const button = (page, element = page.locator('rock-field').first()) => element.locator('[part=controls-button]');
/**
 * @param {Page} page
 * @param {Locator} [element]
 */
export const panel = (page, element = page.locator('rock-field').first()) => element.locator('.panel');

/**
 * @param {Page} page
 * @param {Locator} [element]
 */
export async function openPanel(page, element) {
  await button(page, element).click();
  await panel(page, element).locator('.panel-body').waitFor();
}

/**
 * The class of the innermost element that has the focus.
 *
 * @param {Page} page
 */
export const focused = (page) =>
  page.evaluate(() => {
    let at = document.activeElement;
    while (at?.shadowRoot?.activeElement) at = at.shadowRoot.activeElement;
    return at?.className ?? '';
  });
