// Workers that say nothing, end, or never arrive: the picture comes back, or a named error comes and the next run works.
/** @import { Page } from 'playwright-core' */
import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { dist } from '../../scripts/lib/env.mjs';
import { HEADLESS } from '../../scripts/lib/generators.mjs';
import { answer } from '../../scripts/lib/serve.mjs';
import { PATIENCE, holdTimers, launch, until } from './browser.mjs';

/** `heard` tells what the element said. `null` draws nothing: these tests are about the generators. */
const html = (element, script) => `<!doctype html><meta charset="utf-8"><title>deaths</title><link rel="icon" href="data:,">
<script>
  globalThis.heard = [];
  for (const type of ['generate', 'error']) document.addEventListener(type, ({ detail }) => heard.push({ type, name: detail.error?.name, message: detail.error?.message }), true);
</script>
${element}
<script type="module" src="/${script}"></script>`;

const PAGES = {
  '/drawn.html': html('<rock-field backend="canvas2d" image-width="200" image-height="200"></rock-field>', 'rock-field.js'),
  '/rocks.html': html('<rock-field backend="null" image-width="200" image-height="200"></rock-field>', 'rock-field.js'),
  '/wood-ears3d.html': html('<wood-ear-log range="20" density="2" ground=""></wood-ear-log>', 'wood-ear-log.js'),
  '/wood-ears.html': html('<wood-ear-log backend="null" ground="riverbed" range="20" density="2"></wood-ear-log>', 'wood-ear-log.js'),
};

/** @type {import('./browser.mjs').Session} */
let session;
/**
 * Answers requests in the server's stead: file → what to do with the response.
 *
 * @typedef {(response: import('node:http').ServerResponse) => unknown} Answer
 * @type {Record<string, Answer>}
 */
let broken = {};

before(async () => {
  session = await launch({
    intercept(request, response) {
      const { pathname } = new URL(request.url, 'http://localhost');
      const act = Object.entries(broken).find(([name]) => pathname.includes(name))?.[1];
      if (act) {
        act(response);
        return true;
      }
      if (!PAGES[pathname]) return false;
      response.writeHead(200, { 'content-type': 'text/html' }).end(PAGES[pathname]);
      return true;
    },
  });
});

after(() => session?.close());

/** @type {(text: string) => Answer} */
const script = (text) => (response) => response.writeHead(200, { 'content-type': 'text/javascript' }).end(text);
/** @type {(type: string, bytes: string) => Answer} */
const stalled = (type, bytes) => (response) => void response.writeHead(200, { 'content-type': type }).write(bytes);

/** In a page or a worker: timers of seconds end twenty times as soon, as long as `isHurried`. */
const HURRY = `globalThis.isHurried = true;
{
  const later = setTimeout;
  globalThis.setTimeout = (act, ms, ...rest) => later(act, globalThis.isHurried && ms >= 5000 ? ms / 20 : ms, ...rest);
}
`;
/** @type {(name: string) => Answer} a script of the build, in a hurry */
const hurried = (name) => {
  const file = readdirSync(dist).find((each) => each.startsWith(`${name}-`) && each.endsWith('.js'));
  return script(HURRY + readFileSync(path.join(dist, String(file)), 'utf8'));
};

const ROCKS = ['rocks.html', 'worker', 'generator_bg'];
const WOOD = ['wood-ears.html', 'wood-ear-worker', 'wood-ear_bg'];

/** @type {[what: string, files: string[], broken: { worker?: Answer, wasm?: Answer }, wanted: string][]} */
const BROKEN = [
  ['a script that is empty', WOOD, { worker: script('') }, 'WorkerUnavailable'],
  [
    'a page in the place of its script',
    WOOD,
    { worker: (response) => response.writeHead(200, { 'content-type': 'text/html' }).end('<!doctype html>') },
    'WorkerUnavailable',
  ],
  ['a script that throws', ROCKS, { worker: script('throw new Error("oh")') }, 'WorkerUnavailable'],
  ['a script that starts and ends', ROCKS, { worker: script('postMessage({ type: "started" }); self.close()') }, 'WorkerLost'],
  ['a script that stops arriving', ROCKS, { worker: stalled('text/javascript', '// ') }, 'WorkerUnavailable'],
  ['wasm that stops arriving', WOOD, { wasm: stalled('application/wasm', '\0asm') }, 'WasmUnavailable'],
  ['rocks whose wasm stops arriving', [WOOD[0], ROCKS[1], ROCKS[2]], { wasm: stalled('application/wasm', '\0asm') }, 'WasmUnavailable'],
];

for (const [what, [page, worker, wasm], files, wanted] of BROKEN) {
  test(`${page.replace('.html', '')}: ${what} is a named error, and the next run starts another worker`, async () => {
    broken = { [`/${worker}-`]: files.worker ?? hurried(worker), ...(files.wasm && { [wasm]: files.wasm }) };
    const opened = await session.open(page, { prepare: (its) => its.addInitScript(HURRY) });
    await opened.page.waitForFunction(() => heard.length > 0);
    const told = await opened.page.evaluate(() => heard);
    assert.deepEqual(
      told.map(({ name }) => name),
      [wanted],
      JSON.stringify(told),
    );
    broken = {};
    const name = await opened.page.evaluate(() => {
      globalThis.isHurried = false;
      return document
        .querySelector('rock-field, wood-ear-log')
        .generate()
        .then(
          () => 'made',
          (error) => error.name,
        );
    });
    assert.equal(name, 'made');
    await opened.close();
  });
}

test('messages that get lost on their way to the worker are asked again', async () => {
  const opened = await session.open('rocks.html', {
    prepare: (page) =>
      page.addInitScript(() => {
        const { postMessage } = Worker.prototype;
        let lost = 0;
        Worker.prototype.postMessage = function (/** @type {unknown} */ message, /** @type {any} */ transfer) {
          if (lost++ > 0) postMessage.call(this, message, transfer);
        };
      }),
  });
  await opened.page.waitForFunction(() => heard.length > 0);
  assert.deepEqual(await opened.page.evaluate(() => heard.map(({ type }) => type)), ['generate']);
  await opened.close();
});

test('an exception while drawing is told once, costs no device, and is over with the next good frame', async () => {
  broken = {};
  const opened = await session.open('drawn.html');
  await opened.page.waitForFunction(() => heard.length > 0);
  // One of the same name would be told later.
  await opened.page.evaluate(holdTimers);
  const outcome = await opened.page.evaluate(async () => {
    const element = document.querySelector('rock-field');
    await element.ready;
    const canvas = element.shadowRoot.querySelector('canvas');
    const { fillRect } = CanvasRenderingContext2D.prototype;
    heard.length = 0;
    CanvasRenderingContext2D.prototype.fillRect = () => {
      throw new Error('oh');
    };
    for (let frame = 0; frame < 90; frame += 1) {
      element.camera = { ...element.camera, distance: 500 + frame };
      await new Promise(requestAnimationFrame);
    }
    CanvasRenderingContext2D.prototype.fillRect = fillRect;
    element.camera = null;
    for (let round = 0; round < 3; round += 1) {
      await new Promise(requestAnimationFrame);
      passTime();
    }
    return { heard, same: canvas === element.shadowRoot.querySelector('canvas') };
  });
  assert.deepEqual(
    outcome.heard.map(({ name }) => name),
    ['RendererFailed'],
    JSON.stringify(outcome.heard),
  );
  assert.match(outcome.heard[0].message, /oh/);
  assert(outcome.same);
  await opened.close();
});

test('the plan is drawn again when the browser restores its canvas', async () => {
  const opened = await session.open('drawn.html');
  const isDrawn = await opened.page.evaluate(async () => {
    const element = document.querySelector('rock-field');
    await element.ready;
    const canvas = element.shadowRoot.querySelector('canvas');
    const context = canvas.getContext('2d');
    const pixel = () => [...context.getImageData(canvas.width / 2, canvas.height / 2, 1, 1).data].join();
    const before = pixel();
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.fillStyle = '#f0f';
    context.fillRect(0, 0, canvas.width, canvas.height);
    canvas.dispatchEvent(new Event('contextrestored'));
    return before === pixel();
  });
  assert(isDrawn);
  await opened.close();
});

/** @type {Answer} */
const missing = (response) => response.writeHead(404, { 'content-type': 'text/plain' }).end('gone');
/** Everything that is said over the picture, by the element and by the page. */
const boxes = (/** @type {Page} */ page) => page.locator('[part=message], stage-overlay .message').filter({ visible: true });

/** @type {[address: string, lang: string, file: string, words: RegExp, label: string][]} */
const MISSING = [
  ['index.html#preset=journal-fig1&w=200&h=200', 'en', '/worker-', /^the generator's worker could not be started/, 'Retry'],
  ['wood-ear.html#preset=thesis-default&d=5&r=20', 'ja', '/wood-ear-worker-', /^生成用のワーカーを起動できませんでした/, '再試行'],
  [
    'index.html#preset=journal-fig1&w=200&h=200',
    'ja',
    '/generator_bg-',
    /^generator_bg-\w+\.wasm を取得できませんでした：サーバーの応答は 404 です/,
    '再試行',
  ],
  ['wood-ears.html', 'en', '/generator_bg-', /^generator_bg-\w+\.wasm could not be fetched: the server answered 404/, 'Retry'],
  [
    'index.html#preset=journal-fig1&w=200&h=200',
    'en',
    '/renderer-webgl_bg-',
    /^The 3D renderer could not be loaded; the plan is shown instead/,
    'Retry',
  ],
  ['wood-ears3d.html', 'en', '/renderer-webgl_bg-', /^The 3D renderer could not be loaded; the plan is shown instead/, 'Retry'],
];

for (const [address, lang, file, words, label] of MISSING) {
  test(`${address.replace(/#.*/, '')} in ${lang} without ${file}…: one box that is true, whose button works once the file is there`, async () => {
    broken = { [file]: missing };
    // No new try comes by itself: it is the button that helps.
    const { page, close } = await session.open(address, { locale: lang, prepare: (page) => page.addInitScript(holdTimers) });
    await boxes(page).filter({ hasText: words }).waitFor();
    assert.equal(await boxes(page).count(), 1, (await boxes(page).allInnerTexts()).join(' | '));
    const button = boxes(page).getByRole('button', { name: label });
    await button.click();
    // Without the file it is said again, and may be tried again.
    await boxes(page).filter({ hasText: words }).locator('button:enabled').waitFor();
    broken = {};
    await boxes(page).getByRole('button', { name: label }).click();
    await page.waitForFunction(() => {
      const element = document.querySelector('rock-field, wood-ear-log');
      return element.field && /webgl|null/.test(String(element.backend));
    });
    // The second failure is told a second after the first: by now it is overcome.
    await page.evaluate(() => passTime());
    assert.deepEqual(await boxes(page).allInnerTexts(), []);
    await close();
  });
}

/** @type {[address: string, lang: string, words: RegExp][]} */
const SLOW = [
  ['index.html#preset=journal-fig1&w=200&h=200', 'en', /^Loading the renderer 40 %/],
  ['wood-ears3d.html', 'ja', /^3D 描画プログラムを読み込み中：40 %/],
];

for (const [address, lang, words] of SLOW) {
  test(`${address.replace(/#.*/, '')} in ${lang}: while a slow network brings the renderer, the plan and how much of it has come`, async () => {
    const file = wasmOf('renderer-webgl');
    const bytes = readFileSync(path.join(dist, file));
    let release = () => {};
    const held = new Promise((resolve) => (release = () => resolve(undefined)));
    broken = {
      [file]: async (response) => {
        let sent = Math.round(0.42 * bytes.length);
        response.writeHead(200, { 'content-type': 'application/wasm' }).write(bytes.subarray(0, sent));
        // A connection that brings nothing for long is given up.
        const drip = setInterval(() => {
          response.write(bytes.subarray(sent, sent + 100));
          sent += 100;
        }, 1000);
        await held;
        clearInterval(drip);
        response.end(bytes.subarray(sent));
      },
    };
    const { page, close } = await session.open(address, { locale: lang });
    if (lang === 'ja') await page.evaluate(() => (document.documentElement.lang = 'ja'));
    await boxes(page).filter({ hasText: words }).waitFor();
    await page.waitForFunction(() => {
      const canvas = document.querySelector('rock-field, wood-ear-log').shadowRoot.querySelector('[part=poster] canvas');
      const pixels = canvas?.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
      return pixels && new Set(new Uint32Array(pixels.buffer)).size > 3;
    });
    assert.equal(await boxes(page).count(), 1);
    release();
    await page.waitForFunction(() => document.querySelector('rock-field, wood-ear-log').backend === 'webgl');
    await page.waitForFunction(() => document.querySelector('rock-field, wood-ear-log').shadowRoot.querySelectorAll('canvas').length === 1);
    assert.deepEqual(await boxes(page).allInnerTexts(), []);
    await close();
  });
}

/** The one file of an artefact. */
function wasmOf(artefact) {
  const names = readdirSync(dist).filter((name) => name.startsWith(`${artefact}_bg-`) && name.endsWith('.wasm'));
  assert.equal(names.length, 1, `${artefact}: ${names}`);
  return names[0];
}

/** The one script of the page that has these words. */
function scriptWith(words) {
  // What works without a page is built apart, with copies of what it shares with the page.
  const headless = withImports(HEADLESS.map((name) => `${name}.js`));
  const names = readdirSync(dist).filter(
    (name) => /^chunk-\w+\.js$/.test(name) && !headless.includes(name) && readFileSync(path.join(dist, name), 'utf8').includes(words),
  );
  assert.equal(names.length, 1, `${words}: ${names}`);
  return names[0];
}

/** Scripts, and every script that they import at once. */
function withImports(names) {
  const all = new Set(names);
  for (const name of all) {
    const text = readFileSync(path.join(dist, name), 'utf8');
    for (const [, imported] of text.matchAll(/(?:from|import)"\.\/(chunk-\w+\.js)"/g)) all.add(imported);
  }
  return [...all];
}

const NO_RENDERER = /^The 3D renderer could not be loaded; the plan is shown instead/;
/** @type {[when: string, hanging: string[], words: RegExp, plan: string | null][]} */
const SILENT = [
  ['after its scripts', [], NO_RENDERER, 'canvas2d'],
  [
    'before the words about it',
    ['The 3D renderer could not be loaded'],
    /^a script could not be fetched \(it does not arrive\)/,
    'canvas2d',
  ],
  ['before what starts it', ['content security policy|unsafe-eval'], NO_RENDERER, 'canvas2d'],
  [
    'before the plan, too',
    ['#cd5e3c', 'content security policy|unsafe-eval', 'The 3D renderer could not be loaded'],
    /^a script could not be fetched \(it does not arrive\)/,
    null,
  ],
];

for (const [when, hanging, words, plan] of SILENT) {
  test(`a network that falls silent while it brings the renderer, ${when}: what can be drawn, true words and a button`, async () => {
    const parts = ['#cd5e3c', 'content security policy|unsafe-eval', 'The 3D renderer could not be loaded', 'WebGL2RenderingContext'];
    const silent = hanging.map(scriptWith);
    const arriving = withImports(parts.map(scriptWith).filter((name) => !silent.includes(name)));
    const renderer = wasmOf('renderer-webgl');
    const generator = wasmOf('generator');
    const send = (name, response) =>
      response
        .writeHead(200, { 'content-type': name.endsWith('.js') ? 'text/javascript' : 'application/wasm' })
        .end(readFileSync(path.join(dist, name)));
    const held = [];
    let rocks;
    broken = {
      ...Object.fromEntries(silent.map((name) => [name, (response) => held.push(() => send(name, response))])),
      [renderer]: (response) =>
        void response
          .writeHead(200, { 'content-type': 'application/wasm' })
          .write(readFileSync(path.join(dist, renderer)).subarray(0, 9000)),
      [generator]: (response) => (rocks = response),
    };
    const pending = new Set();
    const prepare = (/** @type {Page} */ page) => {
      page.on('request', (request) => pending.add(request.url()));
      page.on('requestfinished', (request) => pending.delete(request.url()));
      page.on('requestfailed', (request) => pending.delete(request.url()));
      return page.addInitScript(holdTimers);
    };
    const { page, close } = await session.open('index.html#preset=journal-fig1&w=200&h=200', { prepare });
    // Before the network falls silent everything has been asked for, and all but the silent files are there and have run: whatever else is
    // missing has words of its own. The description of the rocks is asked for with them.
    await page.waitForFunction(
      (names) => names.every((name) => performance.getEntriesByType('resource').some((entry) => entry.name.includes(name))),
      arriving,
    );
    await page.evaluate((names) => Promise.all(names.map((name) => import(`/${name}`))), [...arriving, scriptWith('largest')]);
    await until(() => rocks && held.length === silent.length, 'the silent scripts and the rocks have been asked for');
    await until(async () => {
      await page.evaluate(() => new Promise((resolve) => requestIdleCallback(resolve)));
      return [...pending].every((url) => [...silent, renderer, generator].some((name) => url.includes(name)));
    }, 'nothing else is on its way');
    // What is asked for from now on comes when the network is back.
    broken = { '/': (response) => held.push(() => answer(dist, response.req, response)) };
    send(generator, rocks);
    await page.waitForFunction(() => document.querySelector('rock-field').field);
    await page.evaluate(() => passTime());
    const said = boxes(page).filter({ hasText: words });
    await said.getByRole('button', { name: 'Retry' }).waitFor();
    assert.equal(await page.evaluate(() => document.querySelector('rock-field').backend), plan);
    assert.equal(await boxes(page).count(), 1, (await boxes(page).allInnerTexts()).join(' | '));
    broken = {};
    for (const give of held) give();
    await said.getByRole('button', { name: 'Retry' }).click();
    await page.waitForFunction(() => document.querySelector('rock-field').backend === 'webgl');
    await until(async () => (await boxes(page).count()) === 0);
    await close();
  });
}

test('colony and ground die each by itself, at random moments: every run ends with a result or a named error, and the next one works', async () => {
  broken = {};
  const { page, close } = await session.open('wood-ears.html');
  await page.waitForFunction(() => heard.some(({ type }) => type === 'generate'));
  let state = 20_131_211;
  const random = () => {
    state = (Math.imul(state, 1_664_525) + 1_013_904_223) >>> 0;
    return state / 2 ** 32;
  };
  for (let round = 0; round < 8; round += 1) {
    const run = page.evaluate((seed) => {
      const element = document.querySelector('wood-ear-log');
      element.params = { ...element.params, seed };
      return element.generate().then(
        () => 'made',
        (error) => error.name,
      );
    }, round + 1);
    await page.waitForTimeout(250 * random());
    const workers = page.workers();
    // One that computes hears of its end only afterwards: the run need not wait for that.
    workers[Math.floor(workers.length * random())]?.evaluate(() => self.close()).catch(() => undefined);
    const outcome = await Promise.race([run, page.waitForTimeout(PATIENCE)]);
    assert.match(String(outcome), /^(made|WorkerLost|WorkerUnavailable|Internal|AbortError)$/, `round ${round}`);
  }
  assert.equal(
    await page.evaluate(() =>
      document
        .querySelector('wood-ear-log')
        .generate()
        .then(
          () => 'made',
          (error) => error.name,
        ),
    ),
    'made',
  );
  await close();
});
