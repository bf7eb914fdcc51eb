// What browsers do with whole pages: they keep one that is left, and give it back; they print.
import assert from 'node:assert/strict';
import { after, before, describe, test } from 'node:test';
import { inflateSync } from 'node:zlib';
import { launch } from './browser.mjs';

const ARTICLE = `<!doctype html><html lang="en"><meta charset="utf-8"><title>article</title><link rel="icon" href="data:,"><p>Before</p>
<rock-field image-width="200" image-height="200" style="width: 100%; height: 20rem"></rock-field><p>Between</p>
<wood-ear-log density="2" range="20" ground="none" style="width: 100%; height: 20rem"></wood-ear-log>
<script type="module" src="/rock-field.js"></script><script type="module" src="/wood-ear-log.js"></script>`;
const PAGES = {
  '/article.html': ARTICLE,
  '/elsewhere.html': '<!doctype html><title>elsewhere</title><link rel="icon" href="data:,"><p>Elsewhere',
};
const ROCKS = 'index.html#preset=journal-fig1&w=200&h=200';
const WOOD = 'wood-ear.html#preset=thesis-default&d=2&r=20';

async function open(session, address) {
  const opened = await session.open(address, { viewport: { width: 900, height: 600 }, locale: 'en-US' });
  await opened.page.waitForFunction(
    () => {
      globalThis.scenes = [...document.querySelectorAll('rock-field, wood-ear-log')];
      return scenes.length > 0 && scenes.every((scene) => scene.backend && (scene.field ?? scene.scene));
    },
    undefined,
    { polling: 100 },
  );
  await opened.page.evaluate(() => Promise.all(scenes.map(({ ready }) => ready)));
  return opened;
}

/** How many colours each large picture in a PDF has. */
function picturesOf(pdf) {
  const text = pdf.toString('latin1');
  return [...text.matchAll(/<<([^>]*\/Subtype\s*\/Image[^>]*\/FlateDecode[^>]*)>>\s*stream\r?\n/g)].map((match) => {
    const from = match.index + match[0].length;
    const bytes = inflateSync(pdf.subarray(from, text.indexOf('endstream', from)));
    return new Set(Array.from({ length: Math.floor(bytes.length / 3) }, (_, k) => bytes.readUIntBE(3 * k, 3))).size;
  });
}

for (const [backend, address] of [
  ['webgl', ROCKS],
  ['webgpu', WOOD],
]) {
  describe(backend, () => {
    let session;
    let opened;
    before(async () => {
      session = await launch({
        webgpu: backend === 'webgpu',
        backForwardCache: true,
        intercept({ url }, response) {
          const html = PAGES[new URL(url, 'http://localhost').pathname];
          if (html) response.writeHead(200, { 'content-type': 'text/html' }).end(html);
          return html !== undefined;
        },
      });
      opened = await open(session, address);
    });
    after(() => session?.close());

    test('a page that is left and come back to has its picture, its worker and its panel', async () => {
      const { page, errors } = opened;
      await page.evaluate(() => {
        const given = [];
        Object.assign(globalThis, { given });
        addEventListener('pageshow', ({ persisted }) => given.push(persisted));
      });
      await page.goto(`${session.url}elsewhere.html`);
      await page.evaluate(() => history.back()).catch(() => undefined);
      await page.waitForFunction(
        () => (globalThis.given ?? []).length > 0 || (!globalThis.given && document.querySelector('rock-field, wood-ear-log')?.ready),
        undefined,
        { polling: 100 },
      );
      assert.deepEqual(await page.evaluate(() => globalThis.given ?? []), [true], 'it was loaded anew: this test shows nothing');
      const colours = await page.evaluate(async () => {
        const bitmap = await createImageBitmap(await scenes[0].toBlob());
        const sheet = new OffscreenCanvas(bitmap.width, bitmap.height);
        const context = /** @type {OffscreenCanvasRenderingContext2D} */ (sheet.getContext('2d'));
        context.drawImage(bitmap, 0, 0);
        return new Set(new Uint32Array(context.getImageData(0, 0, bitmap.width, bitmap.height).data.buffer)).size;
      });
      assert.ok(colours > 200, String(colours));
      await page.getByRole('button', { name: 'Next seed' }).click();
      await page.waitForFunction(() => location.hash.includes('seed=1') && scenes[0].params.seed === 1, undefined, { polling: 100 });
      assert.deepEqual([await page.evaluate(() => scenes[0].backend), errors], [backend, []]);
    });

    test('what is printed has the picture of every scene, in its own proportions', async () => {
      const article = await open(session, 'article.html');
      for (const { page, errors } of [opened, article]) {
        const count = await page.evaluate(() => scenes.length);
        const pictures = picturesOf(await page.pdf()).filter((colours) => colours > 200);
        assert.ok(pictures.length >= count, `${page.url()}: ${pictures}`);
        // Paper has other proportions than the window.
        await page.emulateMedia({ media: 'print' });
        assert.deepEqual(
          await page.evaluate(() => scenes.map((scene) => getComputedStyle(scene.shadowRoot.querySelector('canvas')).objectFit)),
          Array(count).fill('contain'),
        );
        await page.emulateMedia({ media: null });
        assert.deepEqual(errors, []);
      }
      await article.close();
    });
  });
}
