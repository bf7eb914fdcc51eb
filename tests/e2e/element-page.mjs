// A page with one <rock-field>, `a`, that counts what the element asks the browser for and hears what it says.
/** @import { Page } from 'playwright-core' */
import { launch, pageOf } from './browser.mjs';

/** Everything the element could leave behind is counted. */
const COUNTERS = `
  globalThis.heard = [];
  globalThis.counts = { frames: 0, workers: 0, ended: 0 };
  const raf = requestAnimationFrame;
  globalThis.requestAnimationFrame = (callback) => { counts.frames += 1; return raf(callback); };
  globalThis.frame = () => new Promise((resolve) => raf(resolve));
  globalThis.Worker = class extends Worker {
    constructor(...args) { super(...args); counts.workers += 1; }
    terminate() { counts.ended += 1; super.terminate(); }
  };
  // The device's own canvas stands nowhere.
  globalThis.contexts = [];
  const getContext = HTMLCanvasElement.prototype.getContext;
  HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
    const context = getContext.call(this, kind, ...rest);
    if (kind === 'webgl2' && context && !contexts.includes(context)) contexts.push(context);
    return context;
  };
  globalThis.loseContext = () => contexts.at(-1).getExtension('WEBGL_lose_context').loseContext();
  globalThis.listenTo = (element) => {
    // Not by its id, under which it is known only while it stands in the document.
    globalThis.a = element;
    for (const type of ['generate', 'error', 'load', 'notice', 'restored', 'camera-change', 'progress']) {
      element.addEventListener(type, ({ detail }) => heard.push({ type, detail }));
    }
    return element;
  };
  globalThis.types = () => heard.map(({ type }) => type);
`;

/** A small field: a software GPU pays by the triangle, too. */
export const SMALL = 'image-width="200" image-height="150"';

/** The page of these tests with this body. */
export const pageWith = (
  body,
) => `<!doctype html><html lang="en"><meta charset="utf-8"><title>element</title><link rel="icon" href="data:,">
<style>body { margin: 0 } rock-field { width: 400px; height: 300px }</style><script>${COUNTERS}</script>${body}
<script type="module" src="/rock-field.js"></script>`;

let html = '';

/** A browser that is served the page, by the name `element.html`. */
export const launchElement = () => launch({ intercept: pageOf('element.html', () => html) });

/**
 * A page with this body; waits for the first picture unless told otherwise.
 *
 * @param {import('./browser.mjs').Session} session
 * @param {string} [body]
 * @param {import('./browser.mjs').OpenOptions & { painted?: boolean }} [options]
 */
export async function openElement(
  session,
  body = `<rock-field id="a" ${SMALL}></rock-field><script>listenTo(a)</script>`,
  { painted = true, ...options } = {},
) {
  html = pageWith(body);
  const opened = await session.open('element.html', options);
  if (painted)
    await opened.page.evaluate(() => customElements.whenDefined('rock-field').then(() => document.querySelector('rock-field').ready));
  return opened;
}

/**
 * Software rendering takes its time, more of it on a busy machine: wait for what is to come, not for a while.
 *
 * @param {Page} page
 * @param {() => unknown} test
 */
export const until = (page, test) => page.waitForFunction(test);

/**
 * Waits until no frame has been asked for in 800 ms, nor is to come, however late; gives the number of frames so far.
 *
 * @param {Page} page
 * @returns {Promise<number>}
 */
export function quiet(page) {
  return page.evaluate(async () => {
    // A picture in pieces may wait for a device that is busy for longer than that.
    const isDrawing = () => [...document.querySelectorAll('*')].some(({ shadowRoot }) => shadowRoot?.querySelector('[data-drawing]'));
    // Between a small picture and the whole one there is a pause.
    for (let last = -1, calm = 0; calm < 2; calm += 1) {
      if (last !== counts.frames || isDrawing()) calm = 0;
      last = counts.frames;
      await frame();
      await new Promise((resolve) => setTimeout(resolve, calm === 0 ? 800 : 250));
    }
    return counts.frames;
  });
}
