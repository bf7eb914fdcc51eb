// What a run refuses changes nothing: parameters, steps of undo, links, view and camera are those of the picture, and later edits work.
/** @import { Page } from 'playwright-core' */
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { copied, holdResults, launch, until } from './browser.mjs';

const element = (
  name,
  attributes,
) => `<!doctype html><html lang="en"><meta charset="utf-8"><title>refused</title><link rel="icon" href="data:,">
<${name} id="a" backend="null" ${attributes}></${name}>
<script>
  const heard = [];
  for (const type of ['generate', 'error', 'change']) a.addEventListener(type, () => heard.push({ type }));
</script>
<script type="module" src="/${name}.js"></script>`;

const PAGES = {
  '/rocks.html': element('rock-field', 'image-width="2048" image-height="2048" radius="200" area-fraction="0.3"'),
  '/logs.html': element('wood-ear-log', 'density="4" log-length="400" ground="v=1&preset=journal-fig1&r=200&a=0.3"'),
};

/** @type {import('./browser.mjs').Session} */
let session;

before(async () => {
  session = await launch({
    intercept({ url }, response) {
      const html = PAGES[new URL(url, 'http://localhost').pathname];
      if (html) response.writeHead(200, { 'content-type': 'text/html' }).end(html);
      return html !== undefined;
    },
  });
});

after(() => session?.close());

/** On a device of 4 GB, whose budget is 512 MiB. */
async function open(address, options = {}) {
  const opened = await session.open(address, {
    viewport: { width: 720, height: 320 },
    locale: 'en-US',
    colorScheme: 'light',
    ...options,
    prepare: async (page) => {
      await page.addInitScript(() => Object.defineProperty(Navigator.prototype, 'deviceMemory', { get: () => 4 }));
      await page.addInitScript(holdResults);
    },
  });
  await opened.page.waitForFunction(() => document.querySelector('rock-field, wood-ear-log')?.field, undefined, { polling: 100 });
  await opened.page.evaluate(() => {
    const a = document.querySelector('rock-field, wood-ear-log');
    const seen = () => JSON.stringify([a.params, a.shareURL(), a.view, a.color, a.camera, a.framed]);
    /** What an edit leaves, once `generate` has refused it. */
    globalThis.refused = async (edit) => {
      const [field, before] = [a.field, seen()];
      edit();
      const pending = a.shareURL() === JSON.parse(before)[1];
      const error = await a.generate().then(
        () => 'made',
        ({ name, key }) => `${name} ${key}`,
      );
      const now = await (a.getField ?? a.getColony).call(a).then(
        () => a.field === field,
        ({ name }) => name,
      );
      return { error, pending, same: seen() === before ? 'same' : seen(), now, steps: [a.undo(), a.redo()] };
    };
  });
  return opened;
}

const NOTHING = { pending: true, same: 'same', now: true, steps: [false, false] };

/** `setters` by what they set. */
async function refuses(/** @type {Page} */ page, wanted, setters) {
  for (const [what, edit] of Object.entries(setters)) {
    const outcome = await page.evaluate((source) => refused(new Function(`return ${source}`)()), String(edit));
    assert.deepEqual(outcome, { error: wanted, ...NOTHING }, what);
  }
}

test('rock-field: what code, a property, an attribute or a link sets and the generator refuses changes nothing', async () => {
  const { page, errors, close } = await open('rocks.html');
  await refuses(page, 'OverBudget radius', {
    params: () => Object.assign(a, { params: { ...a.params, seed: 3, layers: [{ radius: 1 }] } }),
    layers: () => (a.layers = [{ radius: 200 }, { radius: 1 }]),
    'a property': () => (a.radius = [1]),
    'an attribute': () => a.setAttribute('radius', '1'),
    'a link': () => (a.src = '#preset=riverbed&w=2048&h=2048&r=1&view=wireframe&color=plain&camera=1,0.5,300,9,9,0'),
  });
  // Nothing of what was refused is in what follows.
  const later = await page.evaluate(async () => {
    a.packing = 0.6;
    await a.getField();
    a.radius = [1];
    await a.generate().catch(() => undefined);
    a.setAttribute('seed', '7');
    const field = await a.getField();
    return [
      a.params.seed,
      a.params.packing,
      a.params.layers.map(({ radius }) => radius),
      field.layers[0].radius,
      new URL(a.shareURL()).hash,
    ];
  });
  assert.deepEqual(later, [7, 0.6, [200], 200, '#v=1&preset=journal-fig1&seed=7&w=2048&h=2048&cd=0.6&r=200&a=0.3']);
  assert.deepEqual(errors, []);
  await close();
});

test('an edit whose run has not ended survives the refusal of the next one, also within one step; what is set in one task is refused together', async () => {
  const { page, close } = await open('rocks.html');
  const seen = await page.evaluate(async () => {
    const { now } = performance;
    const outcomes = [];
    for (const { later, isSameTask } of [
      { later: 5000, isSameTask: true },
      { later: 0, isSameTask: false },
      { later: 0, isSameTask: true },
    ]) {
      a.seed = 5;
      // The run begins at the end of the task; its result cannot be here yet.
      if (!isSameTask) for (let k = 0; k < 3; k += 1) await undefined;
      // What follows closely is the same step.
      performance.now = () => now.call(performance) + later;
      a.radius = [1];
      await a.generate().catch(() => undefined);
      performance.now = now;
      const { layers } = await a.getField();
      outcomes.push([a.seed, a.radius, layers[0].radius, a.undo(), a.seed, a.undo()]);
      await a.getField();
    }
    return outcomes;
  });
  assert.deepEqual(seen, [
    [5, [200], 200, true, 0, false],
    [5, [200], 200, true, 0, false],
    [0, [200], 200, false, 0, false],
  ]);
  await close();
});

test('before the first picture a refused edit gives way to what was to be shown', async () => {
  const { page, close } = await open('rocks.html');
  const seen = await page.evaluate(async () => {
    const b = /** @type {typeof a} */ (a.cloneNode());
    b.removeAttribute('id');
    document.body.append(b);
    Object.assign(b, { params: { ...b.params, layers: [{ radius: 1 }] } });
    const error = await b.generate().catch(({ name }) => name);
    return [error, (await b.getField()).layers[0].radius, b.params.layers.length];
  });
  assert.deepEqual(seen, ['OverBudget', 200, 1]);
  await close();
});

test('cancel gives the parameters up with their run, and keeps a look that was edited before', async () => {
  const { page, close } = await open('rocks.html');
  const seen = await page.evaluate(async () => {
    a.sunAzimuth = 90;
    a.radius = [8];
    const run = a.generate().catch(({ name }) => name);
    a.cancel();
    const field = await a.getField();
    return [await run, a.radius, a.sunAzimuth, field.layers[0].radius, /sa=90/.test(a.shareURL())];
  });
  assert.deepEqual(seen, ['AbortError', [200], 90, 200, true]);
  await close();
});

test('wood-ear-log: what code, a property, an attribute or a link sets and either generator refuses changes nothing', async () => {
  const { page, errors, close } = await open('logs.html');
  await refuses(page, 'OverBudget ground', {
    'an attribute': () => a.setAttribute('ground', 'v=1&preset=journal-fig1&r=1,1,1,1,1,1,1,1'),
    'a property': () => Object.assign(a, { ground: 'v=1&preset=journal-fig1&r=1,1,1,1,1,1,1,1&seed=2' }),
    params: () => Object.assign(a, { params: { ...a.params, density: 5, ground: 'v=1&preset=journal-fig1&r=1,1,1,1,1,1,1,1' } }),
    'a link': () =>
      (a.src = '#preset=wrinkled&d=4&ll=400&view=wireframe&camera=1,0.5,300,9,9,0&ground=preset=journal-fig1%26r=1,1,1,1,1,1,1,1'),
  });
  // A mesh is refused at once, before any run.
  const atOnce = await page.evaluate(() => {
    const seen = () => JSON.stringify([a.params, a.shareURL(), heard]);
    const before = seen();
    try {
      Object.assign(a, { params: { ...a.params, mesh: { positions: [0, 0, 0, 1, 1, 1, 2, 2, 2], indices: [0, 1, 2] } } });
      return 'taken';
    } catch (error) {
      const { name, key } = /** @type {ErrorInfo} */ (error);
      return [name, key, seen() === before, a.undo()];
    }
  });
  assert.deepEqual(atOnce, ['LogNoArea', 'log', true, false]);
  const later = await page.evaluate(async () => {
    Object.assign(a, { ground: 'v=1&preset=journal-fig1&r=1,1,1,1,1,1,1,1' });
    await a.generate().catch(() => undefined);
    a.density = 6;
    await a.getColony();
    return [a.density, a.ground, a.field.layers[0].radius];
  });
  assert.deepEqual(later, [6, 'v=1&preset=journal-fig1&r=200&a=0.3', 200]);
  assert.deepEqual(errors, []);
  await close();
});

test('a bad camera is refused with key, value and bounds, and nothing moves', async () => {
  for (const address of ['rocks.html', 'logs.html']) {
    const { page, close } = await open(address);
    const seen = await page.evaluate(() => {
      a.camera = { azimuth: 1, elevation: 0.5, distance: 300, target: [5, 6, 7] };
      const before = JSON.stringify(a.camera);
      const bad = [{ distance: -1 }, { azimuth: NaN }, { elevation: 9 }, { target: [0, 0] }, { target: [0, 0, 2e6] }];
      const told = bad.map((part) => {
        try {
          Object.assign(a, { camera: { ...a.camera, ...part } });
          return 'taken';
        } catch (error) {
          const { name, key, value, min, max } = /** @type {ErrorInfo} */ (error);
          return [name, key, String(value), min ?? null, max ?? null];
        }
      });
      return [told, JSON.stringify(a.camera) === before, a.framed, heard.filter(({ type }) => type !== 'generate')];
    });
    assert.deepEqual(seen, [
      [
        ['OutOfRange', 'distance', '-1', 0.1, 1e6],
        ['OutOfRange', 'azimuth', 'NaN', -1e5, 1e5],
        ['OutOfRange', 'elevation', '9', -3.1416, 3.1416],
        ['WrongType', 'target', '0,0', null, null],
        ['OutOfRange', 'target', '2000000', -1e6, 1e6],
      ],
      true,
      false,
      [],
    ]);
    await close();
  }
});

// The page.

const hash = (/** @type {Page} */ page) => page.evaluate(() => location.hash);
const params = (/** @type {Page} */ page) => page.evaluate(() => document.querySelector('rock-field, wood-ear-log').params);
const LINK = '#v=1&preset=journal-fig1&w=2048&h=2048&r=200&a=0.3';
const isUndoDisabled = (/** @type {Page} */ page) => page.getByRole('button', { name: 'Undo' }).isDisabled();
/** Waits for words on the line of messages, by the clock: frames may be slow to come. */
const says = (/** @type {Page} */ page, words) =>
  page.waitForFunction((text) => document.querySelector('stage-overlay > .message')?.innerText.includes(text), words, { polling: 100 });
/** What Share copies. */
const shared = async (/** @type {Page} */ page) => new URL(await copied(page, page.getByRole('button', { name: 'Share' }))).hash;

test('a control keeps the value that was refused, with its message; address, Share, undo and later edits do not', async () => {
  const { page, errors, close } = await open(LINK, { permissions: ['clipboard-read', 'clipboard-write'] });
  const problem = page.locator('[data-param="r-0"] .control-problem');
  for (const undone of [false, true]) {
    await page.locator('[id="r-0-number"]').fill('1');
    await problem.waitFor();
    assert.match((await problem.textContent()) ?? '', /MiB.*MiB/);
    await page.locator('[id="r-0-number"]').blur();
    assert.deepEqual(
      [await page.locator('[id="r-0-number"]').inputValue(), await page.locator('[id="r-0"]').getAttribute('aria-valuetext')],
      ['1', '1 px'],
    );
    assert.deepEqual([(await params(page)).layers[0].radius, await hash(page), await isUndoDisabled(page)], [200, LINK, true]);
    assert.equal(await shared(page), LINK);
    // The next edit is of its own parameter alone.
    if (undone) break;
    await page.getByRole('button', { name: 'Next seed' }).click();
    await page.waitForURL(/seed=1/);
    assert.deepEqual([(await params(page)).seed, (await params(page)).layers[0].radius, await problem.count()], [1, 200, 0]);
    assert.equal(await page.locator('[id="r-0-number"]').inputValue(), '200');
    await page.keyboard.press('Control+z');
    await page.waitForURL((url) => url.hash === LINK);
  }
  assert.deepEqual(errors, []);
  await close();
});

test("a control of an element's own panel keeps the value that was refused, with its message, and the picture stays", async () => {
  const { page, errors, close } = await open('rocks.html');
  // `control` is what the panel calls the parameter `key`.
  const refuses = async ({ control, key, refusable, kept, taken }) => {
    await page.evaluate(() => (a.controls = 'open'));
    const number = page.locator(`[id="${control}-number"]`);
    const problem = page.locator(`[data-param="${control}"] .control-problem`);
    const before = await page.evaluate((name) => {
      globalThis.before = a[name];
      return [JSON.stringify(a.params), a.shareURL()];
    }, kept);
    await number.fill(refusable);
    await problem.waitFor();
    assert.match((await problem.textContent()) ?? '', /MiB.*MiB/);
    await number.blur();
    assert.equal(await number.inputValue(), refusable);
    assert.deepEqual(await page.evaluate((name) => [JSON.stringify(a.params), a.shareURL(), a[name] === before], kept), [...before, true]);
    const panel = page.locator('[part=panel]');
    assert.ok(await panel.getByRole('button', { name: 'Undo' }).isDisabled());
    // The next edit is of its own parameter alone, and the message goes.
    await panel.getByRole('button', { name: 'Next seed' }).click();
    await page.waitForFunction((name) => a[name] !== before, kept, { polling: 100 });
    assert.deepEqual(
      [await number.inputValue(), await problem.count(), await page.evaluate((name) => [a.seed, a[name]], key)],
      [taken, 0, [1, key === 'radius' ? [Number(taken)] : Number(taken)]],
    );
  };
  await page.evaluate(() => (a.style.cssText = 'display: block; width: 700px; height: 300px'));
  await refuses({ control: 'r-0', key: 'radius', refusable: '1', kept: 'field', taken: '200' });
  await page.evaluate(async () => {
    await import('/wood-ear-log.js');
    a.outerHTML =
      '<wood-ear-log id="a" backend="null" density="4" range="100" rings="24" meridians="64" log-spacing="1.5" collisions="off" style="display: block; width: 700px; height: 300px"></wood-ear-log>';
    await a.getColony();
  });
  await refuses({ control: 'd', key: 'density', refusable: '100', kept: 'colony', taken: '4' });
  assert.deepEqual(errors, []);
  await close();
});

test('a link that is refused leaves the picture, its view, colour and camera, and the address goes back to them', async () => {
  const { page, errors, close } = await open(`${LINK}&camera=1,0.5,900,900,900,0`);
  const seen = () =>
    page.evaluate(() => {
      const { params, view, color, camera } = document.querySelector('rock-field');
      return [params, view, color, camera, ...[...document.querySelectorAll('.overlay-start input:checked')].map(({ value }) => value)];
    });
  const [before, address] = [await seen(), await hash(page)];
  await page.evaluate(() => (location.hash = '#preset=riverbed&w=2048&h=2048&r=1&view=wireframe&color=plain&camera=0,1,300,9,9,0'));
  await says(page, 'MiB');
  assert.deepEqual(await seen(), before);
  await page.waitForFunction((wanted) => location.hash === wanted, address, { polling: 100 });
  assert.ok(await isUndoDisabled(page));
  // Layers that code adds are no control's.
  await page.evaluate(() => (document.querySelector('rock-field').layers = [{ radius: 1 }, { radius: 1 }]));
  await says(page, '1 / 2');
  assert.deepEqual([await seen(), await hash(page), await page.locator('.layers > .layer').count()], [before, address, 1]);
  assert.deepEqual(errors, []);
  await close();
});

test('a ground that is refused leaves the log on the old one, on the page and in its address', async () => {
  const link = '#v=1&preset=thesis-default&d=4&ll=400&ground=v.1_preset.journal-fig1_r.200_a.0.3';
  const { page, errors, close } = await open(`wood-ear.html${link}`);
  const before = await params(page);
  await page.evaluate((text) => (location.hash = text), link.replace('r.200_a.0.3', 'r.1,1,1,1,1,1,1,1').replace('d=4', 'd=9'));
  await says(page, 'MiB');
  assert.deepEqual(await params(page), before);
  await page.waitForFunction((wanted) => location.hash === wanted, link, { polling: 100 });
  await page.locator('[id="d"]').press('PageUp');
  await page.waitForFunction(() => /d=(?!4)\d+.*r\.200/.test(location.hash), undefined, { polling: 100 });
  assert.deepEqual(errors, []);
  await close();
});

test('an undo while the run of an edit is under way takes it back before it is seen', async () => {
  const { page, errors, close } = await open(LINK);
  const [before, address] = [await params(page), await hash(page)];
  await page.evaluate(() => results.hold());
  await page.locator('[id="r-0-number"]').fill('60');
  await until(() => page.evaluate(() => results.held > 0), 'the edit has been run');
  assert.equal(await hash(page), address, 'not shown yet');
  await page.keyboard.press('Control+z');
  assert.deepEqual(await params(page), before);
  await page.evaluate(() => results.release());
  assert.equal(await page.evaluate(async () => (await document.querySelector('rock-field').getField()).layers[0].radius), 200);
  assert.deepEqual([await hash(page), await isUndoDisabled(page)], [address, true]);
  assert.deepEqual(errors, []);
  await close();
});
