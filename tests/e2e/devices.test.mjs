// Graphics devices that die: whenever and however often, the picture comes back without a reload, or true words with a button that works.
/** @import { Page } from 'playwright-core' */
/** @import { Opened } from './browser.mjs' */
import assert from 'node:assert/strict';
import { after, before, describe, test } from 'node:test';
import { PATIENCE, holdTimers, launch, pageOf } from './browser.mjs';

/** `faults` is what the device does wrong; `told` what the elements say, with the time. All elements of a page share one device. */
const SCRIPT = `
  globalThis.told = [];
  globalThis.faults = { gone: false, dropped: false, trap: false };
  const contexts = new Set();
  const devices = new Set();
  const { getContext } = HTMLCanvasElement.prototype;
  HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
    if (kind !== 'webgl2') return getContext.call(this, kind, ...rest);
    if (faults.gone) return null;
    const context = getContext.call(this, kind, ...rest);
    contexts.add(context);
    if (faults.dropped) queueMicrotask(lose);
    return context;
  };
  const trap = () => { faults.trap = false; throw new WebAssembly.RuntimeError('unreachable'); };
  for (const name of Object.keys(WebGL2RenderingContext.prototype).filter((name) => /^draw(Elements|Arrays)/.test(name))) {
    const draw = WebGL2RenderingContext.prototype[name];
    WebGL2RenderingContext.prototype[name] = function (...args) { return faults.trap ? trap() : draw.apply(this, args); };
  }
  if (globalThis.GPUAdapter) {
    const { requestAdapter } = GPU.prototype;
    GPU.prototype.requestAdapter = async function (...args) { return faults.gone ? null : requestAdapter.apply(this, args); };
    const { requestDevice } = GPUAdapter.prototype;
    GPUAdapter.prototype.requestDevice = async function (...args) {
      const device = await requestDevice.apply(this, args);
      devices.add(device);
      if (faults.dropped) queueMicrotask(lose);
      return device;
    };
    const { submit } = GPUQueue.prototype;
    GPUQueue.prototype.submit = function (...args) { return faults.trap ? trap() : submit.apply(this, args); };
  }
  globalThis.lose = () => {
    faults.dropped = false;
    for (const context of contexts) context.getExtension('WEBGL_lose_context')?.loseContext();
    for (const device of devices) device.destroy();
    contexts.clear();
    devices.clear();
  };
  globalThis.hide = (isHidden) => {
    Object.defineProperty(document, 'visibilityState', { value: isHidden ? 'hidden' : 'visible', configurable: true });
    document.dispatchEvent(new Event('visibilitychange'));
  };
  globalThis.all = () => [...document.querySelectorAll('rock-field, wood-ear-log')];
  for (const type of ['error', 'restored']) document.addEventListener(type, ({ target, detail }) => {
    if (target.matches?.('rock-field, wood-ear-log')) told.push({ type, of: all().indexOf(target), name: detail?.error.name, at: performance.now() });
  }, true);
  /** Whether a picture shows anything: a blank one has one colour. */
  globalThis.isPicture = async (blob) => {
    const bitmap = await createImageBitmap(blob);
    const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
    const context = canvas.getContext('2d');
    context.drawImage(bitmap, 0, 0);
    return new Set(new Uint32Array(context.getImageData(0, 0, canvas.width, canvas.height).data.buffer)).size > 3;
  };
  /** Every element of the page drew with \`backend\` since \`act\`. */
  globalThis.allBack = async (act, backend) => {
    const back = all().map((element) => new Promise((resolve) => element.addEventListener('restored', () => element.backend === backend && resolve())));
    await act();
    await Promise.race([Promise.all(back), new Promise((_, reject) => setTimeout(() => reject(new Error(all().map((element) => element.backend).join())), ${PATIENCE}))]);
  };
`;

const SMALL = 'image-width="200" image-height="200" radius="30"';
const HTML = `<!doctype html><html lang="en"><meta charset="utf-8"><title>devices</title><link rel="icon" href="data:,">
<style>body { margin: 0 } rock-field, wood-ear-log { width: 160px; height: 120px; display: inline-block }</style><script>${SCRIPT}</script>
<rock-field ${SMALL}></rock-field><rock-field ${SMALL} seed="2"></rock-field><wood-ear-log density="2" range="20" ground=""></wood-ear-log>
<script type="module" src="/rock-field.js"></script><script type="module" src="/wood-ear-log.js"></script>`;

const boxes = (/** @type {Page} */ page) => page.locator('[part=message]').filter({ visible: true });

/** The storm limit: of each element at most one error a second. */
async function calm(/** @type {Page} */ page) {
  const told = await page.evaluate(() => globalThis.told);
  for (const of of new Set(told.map((event) => event.of))) {
    const times = told.filter((event) => event.type === 'error' && event.of === of).map(({ at }) => at);
    times.forEach((at, k) => k > 0 && assert.ok(at - times[k - 1] > 950, JSON.stringify(told)));
  }
}

/** @type {import('./browser.mjs').Session} */
let session;
/** @type {Opened} */
let opened;
/** @type {Page} */
let page;
/** The two pages, once they are open. */
let scenes = [];

/** One loss at a time, on a page with elements. */
function losses(backend) {
  test('a device that is lost once costs nobody more than a moment, and no word', async () => {
    await page.evaluate((wanted) => allBack(lose, wanted), backend);
    assert.deepEqual(await page.evaluate(() => told.filter(({ type }) => type === 'error')), []);
    assert.equal(await boxes(page).count(), 0);
  });

  test('a picture that is taken while the device dies shows what it should', async () => {
    const isWhole = await page.evaluate(async () => {
      const [element] = all();
      const taken = element.toBlob();
      lose();
      const again = element.toBlob();
      return Promise.all([taken, again].map(async (blob) => isPicture(await blob)));
    });
    assert.deepEqual(isWhole, [true, true]);
  });

  test('a renderer whose wasm traps is replaced without a reload', async () => {
    await page.evaluate(
      (wanted) =>
        allBack(() => {
          faults.trap = true;
          all()[0].camera = null;
        }, wanted),
      backend,
    );
    assert.ok(await page.evaluate(async () => isPicture(await all()[0].toBlob())));
  });

  test('lost while the page is hidden and no device is given: 3D is there when the page is seen', async () => {
    await page.evaluate(() => {
      hide(true);
      faults.gone = true;
      lose();
    });
    await page.waitForFunction(() => all().every((element) => element.backend === 'canvas2d'));
    await page.evaluate(
      (wanted) =>
        allBack(() => {
          faults.gone = false;
          hide(false);
        }, wanted),
      backend,
    );
    assert.equal(await boxes(page).count(), 0);
  });

  test('no device for a while: the plan, true words and one button for each element; it works', async () => {
    // Nothing comes back by itself: it is the buttons that bring it.
    await page.evaluate(holdTimers);
    await page.evaluate(() => {
      faults.gone = true;
      lose();
    });
    const words = boxes(page).filter({ hasText: 'The graphics device was lost' });
    await words.nth(2).waitFor();
    assert.equal(await boxes(page).count(), 3);
    await page.evaluate(() => (faults.gone = false));
    for (const of of [0, 1, 2]) await page.evaluate((k) => all()[k].shadowRoot.querySelector('[part=message] button').click(), of);
    await page.waitForFunction((wanted) => all().every((element) => element.backend === wanted), backend);
    assert.equal(await boxes(page).count(), 0);
    await page.evaluate(() => releaseTimers());
  });

  test('a device that dies as soon as it is given leaves the plan with words, and then the picture', async () => {
    await page.evaluate(async (options) => {
      const removed = all();
      for (const element of removed) element.remove();
      // Each gives its part of the device back in its own time.
      while (removed.some((element) => element.backend !== null)) await new Promise((resolve) => setTimeout(resolve, 50));
      faults.dropped = true;
      document.body.insertAdjacentHTML(
        'beforeend',
        `<rock-field ${options}></rock-field><wood-ear-log density="2" range="20" ground=""></wood-ear-log>`,
      );
    }, SMALL);
    await page.waitForFunction((wanted) => all().every((element) => element.backend === wanted), backend);
    assert.ok(await page.evaluate(async () => isPicture(await all()[0].toBlob())));
  });
}

/** Loss after loss, on the two pages as well. */
function lossesInARow(backend) {
  test('on both pages, too, a device that is lost twice costs no more than a moment', async () => {
    for (const [address, element] of [
      ['index.html#preset=journal-fig1&w=200&h=200', 'rock-field'],
      ['wood-ear.html#preset=thesis-default&d=2&r=20', 'wood-ear-log'],
    ]) {
      const scene = await session.open(address, { locale: 'en-US', prepare: (fresh) => fresh.addInitScript(SCRIPT) });
      scenes.push(scene);
      await scene.page.evaluate((name) => customElements.whenDefined(name).then(() => all()[0].ready), element);
      for (let loss = 1; loss <= 2; loss += 1) await scene.page.evaluate((wanted) => allBack(lose, wanted), backend);
      assert.deepEqual(await scene.page.evaluate(() => told.filter(({ type }) => type === 'error')), [], address);
    }
  });

  test('every crash of the GPU process, four in a row, ends in a picture of every element and page: in 3D, or, where the browser gives none any more, in the plan with true words and a button', async () => {
    const devtools = await session.browser.newBrowserCDPSession();
    const pages = [page, ...scenes.map((scene) => scene.page)];
    for (let crash = 1; crash <= 4; crash += 1) {
      for (const each of pages) await each.evaluate(() => (told.length = 0));
      await devtools.send('Browser.crashGpuProcess');
      for (const each of pages) {
        await each.waitForFunction(
          (wanted) =>
            all().every(
              (element, of) =>
                element.backend === 'canvas2d' ||
                (element.backend === wanted && told.some((event) => event.type === 'restored' && event.of === of)),
            ),
          backend,
        );
        const lacking = await each.evaluate((wanted) => all().filter((element) => element.backend !== wanted).length, backend);
        if (lacking > 0)
          await boxes(each)
            .filter({ hasText: 'The graphics device was lost' })
            .getByRole('button', { name: 'Retry' })
            .nth(lacking - 1)
            .waitFor();
        // The plan too may be blank until the browser has got over the crash.
        const isBack = each.evaluate(async () => {
          for (const element of all()) while (!(await isPicture(await element.toBlob())));
          return true;
        });
        assert.ok(await Promise.race([isBack, each.waitForTimeout(PATIENCE)]), `crash ${crash}, ${each.url()}`);
      }
      for (const each of pages) await calm(each);
    }
  });

  test('afterwards every scene of the pages is made and shown as before', async () => {
    for (const { page: each } of scenes) {
      const isNew = await each.evaluate(async () => {
        const [element] = all();
        element.seed = 5;
        await element.generate();
        return isPicture(await element.toBlob());
      });
      assert.ok(isNew, each.url());
      await each.waitForURL(/seed=5/);
    }
  });

  test('through all of it there was never more than one error a second, and nothing uncaught', async () => {
    await calm(page);
    for (const { errors } of [opened, ...scenes])
      assert.deepEqual(
        errors.filter((error) => !/GPU|WebGL|context/i.test(error)),
        [],
      );
  });
}

for (const backend of ['webgl', 'webgpu']) {
  // The tests of a backend follow one another on the same pages.
  describe(backend, { timeout: 10 * PATIENCE }, () => {
    before(async () => {
      scenes = [];
      session = await launch({ webgpu: backend === 'webgpu', intercept: pageOf('devices.html', () => HTML) });
      opened = await session.open('devices.html');
      page = opened.page;
      await page.evaluate(() =>
        Promise.all(all().map((element) => customElements.whenDefined(element.localName).then(() => element.ready))),
      );
      assert.deepEqual(await page.evaluate(() => all().map((element) => element.backend)), [backend, backend, backend]);
    });
    after(() => session?.close());

    losses(backend);
    lossesInARow(backend);
  });
}
