// Masks of an element: pictures in every form, what is refused, and what is left then.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { launch, pageOf } from './browser.mjs';

/** @type {import('./browser.mjs').Session} */
let session;
/** @type {import('./browser.mjs').Opened} */
let opened;

before(async () => {
  const html =
    '<!doctype html><html lang="en"><meta charset="utf-8"><title>mask</title><link rel="icon" href="data:,"><script type="module" src="/rock-field.js"></script><rock-field backend="null" image-width="200" image-height="200" radius="20 8" area-fraction="0.3 1"></rock-field>';
  session = await launch({ intercept: pageOf('mask.html', () => html) });
  opened = await session.open('mask.html');
});

after(() => session?.close());

test('a mask of pixels, a file or an address thins the rocks out, and null takes it away', async () => {
  const counts = await opened.page.evaluate(async () => {
    await customElements.whenDefined('rock-field');
    const field = /** @type {import('../../www/entries/element.ts').RockFieldElement} */ (document.querySelector('rock-field'));
    const count = async (/** @type {Parameters<typeof field.setMask>[0]} */ mask) => {
      await field.setMask(mask);
      return (await field.getField()).stats.rocks;
    };
    const picture = (/** @type {string} */ color, type = 'image/png') => {
      const canvas = document.createElement('canvas');
      [canvas.width, canvas.height] = [30, 600];
      const context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d'));
      context.fillStyle = color;
      context.fillRect(0, 0, 30, 600);
      return new Promise((/** @type {(blob: Blob) => void} */ resolve) =>
        canvas.toBlob((blob) => resolve(/** @type {Blob} */ (blob)), type),
      );
    };
    const white = await picture('#fff');
    const read = (/** @type {Blob} */ blob) =>
      new Promise((/** @type {(url: string) => void} */ resolve) => {
        const reader = new FileReader();
        reader.onload = () => resolve(String(reader.result));
        reader.readAsDataURL(blob);
      });
    return {
      free: (await field.getField()).stats.rocks,
      white: await count(white),
      address: await count(await read(white)),
      grey: await count(await picture('#808080')),
      jpeg: await count(await picture('#808080', 'image/jpeg')),
      clear: await count(await picture('#fff0')),
      black: await count(new ImageData(2, 2)),
      none: await count(null),
      newest: await Promise.all([field.setMask(new ImageData(2, 2)), field.setMask(null)]).then(
        async () => (await field.getField()).stats.rocks,
      ),
    };
  });
  const { free, grey, jpeg } = counts;
  assert.ok(free > 50 && grey < 0.75 * free && grey > 0.25 * free, JSON.stringify(counts));
  assert.deepEqual(counts, { free, white: free, address: free, grey, jpeg, clear: 0, black: 0, none: free, newest: free });
  assert.ok(Math.abs(jpeg - grey) <= 0.05 * free);
});

test('what is no mask is refused with a reason, and the mask of before stays', async () => {
  const refused = await opened.page.evaluate(async () => {
    const field = /** @type {import('../../www/entries/element.ts').RockFieldElement} */ (document.querySelector('rock-field'));
    await field.setMask({ width: 1, height: 1, data: Uint8Array.of(0) });
    const header = new Uint8Array(40);
    new DataView(header.buffer).setUint32(0, 0x89504e47);
    new DataView(header.buffer).setUint32(16, 20000);
    new DataView(header.buffer).setUint32(20, 10);
    const masks = /** @type {Parameters<typeof field.setMask>[0][]} */ ([
      'nowhere.png',
      'https://elsewhere.invalid/mask.png',
      new Blob([Uint8Array.of(1, 2, 3)]),
      new Blob([header]),
      { width: 3, height: 1, data: Uint8Array.of(0) },
      /** @type {unknown} */ (5),
    ]);
    const errors = [];
    for (const mask of masks) {
      const { name, key, max } = await field.setMask(mask).then(
        () => ({ name: 'none', key: '', max: 0 }),
        (error) => error,
      );
      errors.push([name, key, max ?? null].join(' '));
    }
    return { errors, rocks: (await field.generate()).stats.rocks };
  });
  assert.deepEqual(refused, {
    errors: [
      'MaskUnreadable mask ',
      'MaskUnreadable mask ',
      'MaskUnreadable mask ',
      'OutOfRange mask 16384',
      'MalformedRequest mask 12',
      'WrongType mask ',
    ],
    rocks: 0,
  });
});
