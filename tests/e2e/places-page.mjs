// A page with whatever elements a test puts there; the first of them is `a`.
import { PATIENCE, launch, pageOf } from './browser.mjs';

/** One of each kind, small. */
export const ELEMENTS = {
  'rock-field': '<rock-field image-width="200" image-height="150" radius="30 10"></rock-field>',
  'wood-ear-log': '<wood-ear-log ground="none" density="10" log-spacing="6"></wood-ear-log>',
};

let html = '';

/**
 * A browser that is served the page, by the name `places.html`.
 *
 * @param {Parameters<typeof launch>[0]} [options]
 */
export const launchPlaces = (options) => launch({ ...options, intercept: pageOf('places.html', () => html) });

/**
 * The page with this body, in which `until` and `colours` are there for tests; waits for the first picture unless `ready` is false.
 *
 * @param {import('./browser.mjs').Session} session
 * @param {string} body
 * @param {import('./browser.mjs').OpenOptions & { lang?: string, ready?: boolean }} [options]
 */
export async function openPlace(session, body, { lang = 'en', ready = true, ...options } = {}) {
  html = `<!doctype html><html lang="${lang}"><meta charset="utf-8"><title>places</title><link rel="icon" href="data:,">
<style>body { margin: 0 } rock-field, wood-ear-log { display: block; width: 400px; height: 300px }</style>${body}
<script>
  globalThis.until = async (test) => {
    for (const end = performance.now() + ${PATIENCE}; !test(); await new Promise((resolve) => setTimeout(resolve, 20))) if (performance.now() > end) throw new Error('waited in vain: ' + test);
  };
  globalThis.colours = async (picture) => {
    const bitmap = await createImageBitmap(picture);
    const sheet = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
    sheet.drawImage(bitmap, 0, 0);
    return new Set(new Uint32Array(sheet.getImageData(0, 0, bitmap.width, bitmap.height).data.buffer)).size;
  };
</script>
<script type="module" src="/rock-field.js"></script><script type="module" src="/wood-ear-log.js"></script>`;
  // Of as many pixels as it says, since that is what is looked at; the elements are small.
  const opened = await session.open('places.html', { deviceScaleFactor: 1, ...options });
  await opened.page.evaluate(async (ready) => {
    await Promise.all([customElements.whenDefined('rock-field'), customElements.whenDefined('wood-ear-log')]);
    globalThis.a = document.querySelector('rock-field, wood-ear-log');
    if (ready && a) await a.ready;
  }, ready);
  return opened;
}
