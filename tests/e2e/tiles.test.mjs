// Pictures that are drawn in parts: larger than the device draws, or without the ground.
/** @import { Page } from 'playwright-core' */
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { PNG } from 'pngjs';
import { launch, pageOf } from './browser.mjs';
import { pageWith } from './element-page.mjs';

/** Width and height of a picture that a device of 2048 pixels in a row draws in two parts. */
const WIDE = { width: 2100, height: 24 };

/** @type {import('./browser.mjs').Session} */
let session;
let html = '';

before(async () => {
  session = await launch({ intercept: pageOf('element.html', () => html) });
});

after(() => session?.close());

/** A page with an element; `limit` is what its device says that it draws at most in a row. */
async function open(attributes, limit = 0) {
  html = pageWith(
    `<rock-field id="a" image-width="300" image-height="200" camera-orbit="20deg 60deg 60%" theme="light" ${attributes}></rock-field>`,
  );
  const prepare = (/** @type {Page} */ page) =>
    page.addInitScript((most) => {
      const { getParameter } = WebGL2RenderingContext.prototype;
      WebGL2RenderingContext.prototype.getParameter = function (name) {
        const isSize = name === this.MAX_TEXTURE_SIZE || name === this.MAX_RENDERBUFFER_SIZE;
        return most > 0 && isSize ? most : getParameter.call(this, name);
      };
    }, limit);
  const opened = await session.open('element.html', { prepare });
  await opened.page.evaluate(() => customElements.whenDefined('rock-field').then(() => document.querySelector('rock-field').ready));
  return opened;
}

/** The pixels that `toBlob` gives. */
async function pictureOf(page, options) {
  const bytes = await page.evaluate(async (given) => {
    const blob = await document.querySelector('rock-field').toBlob(given);
    return [...new Uint8Array(await blob.arrayBuffer())];
  }, options);
  return PNG.sync.read(Buffer.from(bytes));
}

/** Share of the pixels that differ by more than a step of 255, and by how much at most. */
function difference(one, other) {
  assert.deepEqual([one.width, one.height], [other.width, other.height]);
  let [count, most] = [0, 0];
  for (let at = 0; at < one.data.length; at += 4) {
    const steps = Math.max(...[0, 1, 2, 3].map((k) => Math.abs(one.data[at + k] - other.data[at + k])));
    if (steps > 1) count += 1;
    most = Math.max(most, steps);
  }
  return { share: count / (one.data.length / 4), most };
}

for (const [name, attributes] of Object.entries({
  natural: 'preset="riverbed"',
  "the papers'": 'preset="journal-fig1"',
  'of a plan': 'preset="journal-fig1" view="diagrams"',
})) {
  test(`a picture that is wider than the device draws is the one of a device that draws it whole: ${name}`, async () => {
    const whole = await open(attributes);
    const expected = await pictureOf(whole.page, WIDE);
    await whole.close();
    const { page, errors, close } = await open(attributes, 2048);
    const isLimited = await page.evaluate(
      (size) =>
        document
          .querySelector('rock-field')
          .toBlob({ ...size, type: 'image/jpeg' })
          .catch(({ key, max }) => `${key} ${max}`),
      WIDE,
    );
    assert.equal(isLimited, 'width 2048');
    const found = await pictureOf(page, WIDE);
    const { share, most } = difference(found, expected);
    assert.ok(share < 0.001, `${(100 * share).toFixed(3)} % of the pixels differ, by ${most} at most`);
    // Both parts have something to show.
    for (const x of [100, 2090]) assert.notDeepEqual([...found.data.subarray(4 * x, 4 * x + 3)], [0, 0, 0]);
    assert.deepEqual(errors, []);
    await close();
  });
}

test('a picture without the ground is opaque where rocks are and shows through elsewhere; on the ground they look as before', async () => {
  for (const attributes of ['preset="riverbed"', 'preset="journal-fig1"']) {
    const { page, errors, close } = await open(attributes);
    const size = { width: 160, height: 120 };
    const bare = await pictureOf(page, { ...size, ground: false });
    const whole = await pictureOf(page, size);
    const opacities = Array.from({ length: size.width * size.height }, (_, k) => bare.data[4 * k + 3]);
    const shareOf = (test) => opacities.filter(test).length / opacities.length;
    assert.ok(shareOf((a) => a === 255) > 0.05, 'rocks are opaque');
    assert.ok(shareOf((a) => a < 16) > 0.05, 'the ground is not there');
    assert.ok(shareOf((a) => a > 16 && a < 240) > 0.02, 'shadows are seen through');
    opacities.forEach((opacity, k) => {
      const [one, other] = [bare, whole].map(({ data }) => [...data.subarray(4 * k, 4 * k + 3)]);
      // Near the border, the rocks of the ground that goes on beyond it are not in a picture without the ground.
      const [x, y] = [(k % size.width) / size.width, Math.floor(k / size.width) / size.height];
      const isInside = Math.abs(x - 0.5) < 0.25 && Math.abs(y - 0.5) < 0.25;
      if (opacity === 255 && (isInside || attributes.includes('journal')))
        assert.ok(
          one.every((value, c) => Math.abs(value - other[c]) <= 1),
          `${k}: ${one}, ${other}`,
        );
      // What is seen through is black, which is premultiplied right, or the edge of a rock.
      if (opacity === 0) assert.deepEqual(one, [0, 0, 0]);
    });
    assert.deepEqual(errors, []);
    await close();
  }
});

test('what cannot be drawn in parts is refused with its numbers, an abort ends it, and the next picture is whole', async () => {
  const { page, errors, close } = await open('preset="journal-fig1"');
  const said = await page.evaluate(async () => {
    const element = document.querySelector('rock-field');
    const outcome = (options) =>
      element.toBlob(options).then(
        () => 'given',
        ({ name, key, value, max }) => [name, key, value, max].filter((part) => part !== undefined).join(' '),
      );
    const ending = new AbortController();
    const heard = [];
    const onProgress = (fraction) => {
      heard.push(fraction);
      if (heard.length === 2) ending.abort();
    };
    return [
      await outcome({ width: 16_385, height: 10 }),
      await outcome({ width: 10, height: 16_385, ground: false }),
      await outcome({ width: 10_000, height: 10_000, type: 'image/jpeg' }),
      await outcome({ width: 10, type: 'image/webp', ground: false }),
      await outcome({ width: 8, height: 2000, ground: false, signal: ending.signal, onProgress }),
      heard.length,
      await outcome({ width: 8, height: 1200, ground: false }),
    ];
  });
  assert.deepEqual(said, [
    'OutOfRange width 16385 16384',
    'OutOfRange height 16385 16384',
    'OutOfRange width 10000 8294400',
    'OutOfRange type image/webp',
    'AbortError',
    2,
    'given',
  ]);
  assert.deepEqual(errors, []);
  await close();
});
