// Still pictures of an element: those that toBlob gives, in sight or not, and the copy that is printed.
/** @import { Page } from 'playwright-core' */
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { ELEMENTS, launchPlaces, openPlace } from './places-page.mjs';

/** @type {import('./browser.mjs').Session} */
let session;

before(async () => {
  session = await launchPlaces();
});

after(() => session?.close());

const open = (body, options) => openPlace(session, body, options);

for (const [name, element] of Object.entries(ELEMENTS)) {
  test(`${name}: toBlob draws below the fold, lazy, without a box and in no visible tab, and settles by name elsewhere`, async () => {
    const { page, close } = await open(`<div style="height: 5000px"></div>${element.replace('>', ' loading="lazy">')}`, { ready: false });
    const seen = await page.evaluate(async () => {
      const size = async (blob) => {
        const { width, height } = await createImageBitmap(blob);
        return [width, height, (await colours(blob)) > 20];
      };
      const refused = (promise) =>
        promise.then(
          () => 'given',
          (error) => error.name,
        );
      const below = await size(await a.toBlob({ width: 100, height: 80 }));
      a.style.display = 'none';
      const boxless = await size(await a.toBlob({ width: 100, height: 80 }));
      const own = await size(await a.toBlob());
      const copy = () => /** @type {typeof a} */ (a.cloneNode(true));
      const other = copy();
      other.style.display = 'none';
      document.body.append(other);
      const never = await size(await other.toBlob({ width: 60, height: 50 }));
      const detached = await refused(copy().toBlob());
      const broken = copy();
      broken.setAttribute('backend', 'webgpu');
      document.body.append(broken);
      const withoutRenderer = await refused(broken.toBlob());
      return { below, boxless, own, never, detached, withoutRenderer, again: await refused(broken.toBlob()) };
    });
    assert.deepEqual(seen, {
      below: [100, 80, true],
      boxless: [100, 80, true],
      own: [300, 150, true],
      never: [60, 50, true],
      detached: 'NotConnected',
      withoutRenderer: 'NoRenderer',
      again: 'NoRenderer',
    });
    await close();
  });

  test(`${name}: toBlob settles when the element is taken out while nothing has arrived`, async () => {
    const prepare = (/** @type {Page} */ page) => page.route('**/*_bg*.wasm', () => {});
    const { page, close } = await open(element, { ready: false, prepare });
    const seen = await page.evaluate(() => {
      const waiting = a.toBlob().then(
        () => 'given',
        ({ name }) => name,
      );
      a.remove();
      return waiting;
    });
    assert.equal(seen, 'NotConnected');
    await close();
  });

  test(`${name}: a size that cannot be drawn is refused with key, value and bounds, and the picture stays`, async () => {
    const { page, errors, close } = await open(element);
    const seen = await page.evaluate(async () => {
      const canvas = a.shadowRoot.querySelector('canvas');
      const before = [canvas.width, canvas.height];
      /** @type {object[]} */
      const sizes = [
        { width: 17_000, height: 20 },
        { width: 20, height: 17_000 },
        { width: 0 },
        { height: NaN },
        { width: 10.5, height: 10 },
        { width: -5, height: 5 },
        { width: '20', height: 20 },
        { width: Infinity },
        { width: 100_000, height: 100_000 },
      ];
      const refused = [];
      for (const size of sizes)
        refused.push(
          await a.toBlob(size).then(
            () => 'given',
            ({ name, key, value, min, max }) => [name, key, String(value), min >= 1, max >= 8192],
          ),
        );
      const only = await createImageBitmap(await a.toBlob({ width: 200 }));
      return { refused, only: [only.width, only.height], same: String([canvas.width, canvas.height]) === String(before) };
    });
    const wrong = (key, value) => ['OutOfRange', key, value, true, true];
    assert.deepEqual(seen.refused, [
      wrong('width', '17000'),
      wrong('height', '17000'),
      wrong('width', '0'),
      wrong('height', 'NaN'),
      wrong('width', '10.5'),
      wrong('width', '-5'),
      wrong('width', '20'),
      wrong('width', 'Infinity'),
      wrong('width', '100000'),
    ]);
    assert.deepEqual([seen.only, seen.same, errors], [[200, 150], true, []]);
    await close();
  });
}

for (const webgpu of [false, true]) {
  test(`while the page is printed a copy of the picture stands over it, ${webgpu ? 'WebGPU' : 'WebGL2'}`, async () => {
    const own = await launchPlaces({ webgpu });
    const old = session;
    session = own;
    try {
      const { page, close } = await open(
        `${ELEMENTS['rock-field']}<div style="height: 5000px"></div><rock-field image-width="200" image-height="150"></rock-field>`,
      );
      const seen = await page.evaluate(async () => {
        const copies = () =>
          [...document.querySelectorAll('rock-field')].map((element) => element.shadowRoot.querySelectorAll('canvas')[1]);
        const [, below] = document.querySelectorAll('rock-field');
        await until(() => below.backend && below.field);
        dispatchEvent(new Event('beforeprint'));
        const many = await Promise.all(copies().map(async (canvas) => (await colours(canvas)) > 20));
        dispatchEvent(new Event('afterprint'));
        return [a.backend, many, copies()];
      });
      assert.deepEqual(seen, [webgpu ? 'webgpu' : 'webgl', [true, true], [null, null].map(() => undefined)]);
      await close();
    } finally {
      session = old;
      await own.close();
    }
  });
}
