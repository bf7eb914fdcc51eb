// Launches the browser of the browser tests, with dist/ served beside it.
//
//   const session = await launch({ webgpu: true });
//   const { page, errors } = await session.open('?seed=7');
//   …
//   assert.deepEqual(errors, []);
//   await session.close();
import assert from 'node:assert/strict';
import { mkdirSync } from 'node:fs';
import path from 'node:path';
import { chromium } from 'playwright-core';
import { findBrowser } from '../../scripts/lib/browser.mjs';
import { dist, root } from '../../scripts/lib/env.mjs';
import { serve } from '../../scripts/lib/serve.mjs';

/**
 * The last list of features wins, so this one repeats what Playwright switches off for all pages and adds the first two: the popups of the
 * address bar, which Chromium loads for every window, are a third of what a page costs.
 */
const FEATURES_OFF = [
  ...['WebUIOmniboxPopup', 'WebUIOmniboxAimPopup'],
  ...[
    'AvoidCorsURLLoaderRestartOnRedirect',
    'AvoidUnnecessaryBeforeUnloadCheckSync',
    'DestroyProfileOnBrowserClose',
    'HttpsFirstBalancedModeAutoEnable',
  ],
  ...['HttpsUpgrades', 'MediaRouter', 'OptimizationHints', 'PaintHolding', 'ThirdPartyStoragePartitioning'],
];
const QUIET = [
  ...['--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync'],
  `--disable-features=${FEATURES_OFF.join(',')}`,
  // Most pages show one small field: wasm is optimised once it has run ten times as long as the browser would wait for.
  '--js-flags=--wasm-tiering-budget=130000000',
];
// SwiftShader, a software GPU, so that the tests see the same device on every machine. With the first set alone
// `navigator.gpu` exists and its adapter is null: the case the WebGL2 fallback is for.
const WEBGL = ['--use-angle=swiftshader', '--enable-unsafe-swiftshader'];
// The page itself is put together without that GPU, which makes a page a third cheaper. WebGPU's canvases are white in screenshots then.
const WEBGL_ALONE = ['--disable-gpu-compositing'];
const WEBGPU = [
  '--enable-unsafe-webgpu',
  '--use-webgpu-adapter=swiftshader',
  '--enable-features=Vulkan,WebGPU',
  '--use-vulkan=swiftshader',
];
// Said by the browser because of how it is started here, whatever the page does: no adapter, no service worker, WebGL pictures that are read back.
const EXPECTED_WARNINGS = /^(No available adapters\.|Service Worker registration blocked by Playwright)|GPU stall due to ReadPixels/;
/**
 * How long a test waits for what has to come, ms: the default of every wait of Playwright in a page that `open` has opened, too. A busy machine
 * with a software GPU may be twenty times slower than a desk, and nothing here is about time.
 */
export const PATIENCE = 120_000;

/** How long a page may be open: Playwright lets an `evaluate` wait for ever, so a test that hangs in one loses its page, and is told by name. */
const OPEN_MS = 5 * PATIENCE;

const NO_GPU = ['--disable-gpu', '--disable-3d-apis', '--disable-software-rasterizer'];

/**
 * A browser with a server for `folder`.
 *
 * @param {object} options
 * @param {boolean} [options.webgpu] true: WebGPU and WebGL2; false (default): WebGL2 alone
 * @param {boolean} [options.gpu] false: neither
 * @param {string} [options.folder] what is served, default dist/
 * @param {number} [options.port] default: any free one
 * @param {import('../../scripts/lib/serve.mjs').Intercept} [options.intercept] may answer a request in the server's stead
 * @param {string[]} [options.args] more flags for the browser
 * @param {boolean} [options.backForwardCache] whether pages that are left are kept; Playwright switches that off
 *
 * @typedef {Awaited<ReturnType<typeof launch>>} Session
 * @typedef {Awaited<ReturnType<Session['open']>>} Opened
 */
export async function launch({ webgpu = false, gpu = true, folder = dist, port = 0, intercept, args = [], backForwardCache = false } = {}) {
  const executablePath = await findBrowser();
  if (!executablePath) throw new Error('no Chrome or Chromium found; npm test installs one');
  const asRoot = process.platform === 'linux' && process.getuid?.() === 0;
  const server = await serve(folder, { port, intercept });
  const flags = [...QUIET, ...(gpu ? [...WEBGL, ...(webgpu ? WEBGPU : WEBGL_ALONE)] : NO_GPU), ...args];
  try {
    const browser = await chromium.launch({
      executablePath,
      headless: true,
      chromiumSandbox: !asRoot,
      args: flags,
      ignoreDefaultArgs: backForwardCache ? ['--disable-back-forward-cache'] : [],
    });
    const close = async () => {
      await browser.close();
      await server.close();
    };
    /** @type {(address?: string, options?: OpenOptions) => ReturnType<typeof open>} */
    const openWith = (address, options) => open(browser, server.url, address, options);
    return { browser, server, url: server.url, open: openWith, close };
  } catch (error) {
    await server.close();
    throw error;
  }
}

/**
 * Opens an address, relative to the server's root, in a context of its own.
 *
 * `errors` fills with every console error and uncaught exception of the page and its workers, `warnings` with the console
 * warnings. Service workers are blocked unless asked for, so that a test never sees another's files.
 * A software GPU pays by the pixel: pictures have a sixteenth of them, unless a test that looks at one asks for `deviceScaleFactor: 1`.
 * The other options are Playwright's context options (viewport, colorScheme, locale …).
 *
 * @typedef {import('playwright-core').Page} Page
 * @typedef {import('playwright-core').BrowserContextOptions & { prepare?: (page: Page) => unknown }} OpenOptions
 * @param {import('playwright-core').Browser} browser
 * @param {string} base
 * @param {string} [address]
 * @param {OpenOptions} [options]
 */
async function open(browser, base, address = '', { serviceWorkers = 'block', prepare, deviceScaleFactor = 0.25, ...context } = {}) {
  const owner = await browser.newContext({ serviceWorkers, deviceScaleFactor, ...context });
  owner.setDefaultTimeout(PATIENCE);
  const guard = setTimeout(
    () => owner.close({ reason: `the page was open for ${OPEN_MS / 60_000} minutes: something in this test waits for ever` }),
    OPEN_MS,
  );
  owner.once('close', () => clearTimeout(guard));
  const page = await owner.newPage();
  /** @type {string[]} */
  const errors = [];
  /** @type {string[]} */
  const warnings = [];
  owner.on('console', (message) => {
    const from = `${message.text()} (${message.location().url})`;
    if (message.type() === 'error') errors.push(from);
    if (message.type() === 'warning' && !EXPECTED_WARNINGS.test(message.text())) warnings.push(from);
  });
  owner.on('weberror', (event) => errors.push(String(event.error()?.stack ?? event.error())));
  await prepare?.(page);
  await page.goto(new URL(address, base).href);
  return { page, context: owner, errors, warnings, close: () => owner.close() };
}

/**
 * Waits until `condition` comes true or resolves with something true; unlike Playwright's waitForFunction it waits for what a promise becomes.
 *
 * @param {() => unknown} condition
 * @param {unknown} [what]
 */
export async function until(condition, what = condition) {
  const end = performance.now() + PATIENCE;
  while (!(await condition())) {
    assert.ok(performance.now() < end, `still not so after ${PATIENCE / 1000} s: ${what}`);
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
}

/**
 * The same of a condition in the page.
 *
 * @param {Page} page
 * @param {() => unknown} condition
 */
export const untilIn = (page, condition) => until(() => page.evaluate(condition), condition);

/**
 * In the page, by `addInitScript` or `evaluate`: from then on timers of `least` ms and more do not fire. `passTime()` fires those that are
 * held and goes on holding; `releaseTimers()` fires them and holds no more.
 *
 * @param {number | void} [least]
 */
export function holdTimers(least = 1000) {
  const { setTimeout: later, clearTimeout: clear } = globalThis;
  const held = new Map();
  let lastId = 0;
  const passTime = () => {
    const acts = [...held.values()];
    held.clear();
    for (const act of acts) act();
  };
  Object.assign(globalThis, {
    setTimeout: (act, ms, ...rest) => {
      if (!(ms >= least)) return later(act, ms, ...rest);
      lastId -= 1;
      held.set(lastId, () => act(...rest));
      return lastId;
    },
    clearTimeout: (id) => held.delete(id) || clear(id),
    passTime,
    releaseTimers: () => {
      globalThis.setTimeout = later;
      passTime();
    },
  });
}

/**
 * In the page, by `addInitScript`: after `results.hold()` what workers have made does not reach the page before `results.release()`, so that a
 * run is under way for as long as a test needs. `results.held` of them wait. Everything else that workers say comes through.
 */
export function holdResults() {
  /** @type {(() => void)[] | null} */
  let held = null;
  globalThis.Worker = class extends Worker {
    constructor(/** @type {ConstructorParameters<typeof Worker>} */ ...args) {
      super(...args);
      // The first listener is the first to hear.
      this.addEventListener('message', (event) => {
        if (!held || !['result', 'preview'].includes(event.data?.type)) return;
        event.stopImmediatePropagation();
        held.push(() => this.dispatchEvent(new MessageEvent('message', { data: event.data })));
      });
    }
  };
  globalThis.results = {
    hold() {
      held ??= [];
    },
    release() {
      const acts = held ?? [];
      held = null;
      for (const act of acts) act();
    },
    get held() {
      return held?.length ?? 0;
    },
  };
}

/**
 * For tests that something does not happen: lets the time go by in which it would. On a machine that is slower than that a fault may pass; no
 * test fails that should not. Whatever has to happen is waited for instead.
 *
 * @param {Page} page
 * @param {number} ms
 */
export const staysQuietFor = (page, ms) => page.waitForTimeout(ms);

/**
 * What a button copies to the clipboard, which the page must be allowed to read. The words that say so go by themselves: nothing
 * waits for those.
 *
 * @param {Page} page
 * @param {import('playwright-core').Locator} button
 */
export async function copied(page, button) {
  await page.evaluate(() => navigator.clipboard.writeText(''));
  await button.click();
  let text = '';
  await until(async () => {
    text = await page.evaluate(() => navigator.clipboard.readText());
    return text !== '';
  }, 'something is copied');
  return text;
}

/**
 * From here on nothing is drawn: a software GPU takes up to a second for a picture, and this test looks at none.
 *
 * @param {Page} page
 */
export const hidePictures = (page) => page.addStyleTag({ content: 'rock-field, wood-ear-log { display: none !important }' });

/** Where a test's screenshot goes (not under version control): `.cache/screenshots/<name>.png`. */
export function screenshotPath(name) {
  const folder = path.join(root, '.cache', 'screenshots');
  mkdirSync(folder, { recursive: true });
  return path.join(folder, `${name}.png`);
}

/**
 * An `intercept` that answers `name` with whatever page `html` gives at that moment.
 *
 * @param {string} name
 * @param {() => string} html
 * @returns {import('../../scripts/lib/serve.mjs').Intercept}
 */
export function pageOf(name, html) {
  return (request, response) => {
    if (!request.url.startsWith(`/${name}`)) return false;
    response.writeHead(200, { 'content-type': 'text/html' }).end(html());
    return true;
  };
}
