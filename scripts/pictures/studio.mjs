// A page of nothing but an element, to take pictures of it.
//
//   const studio = await openStudio({ backends: ['webgpu', 'webgl'] });
//   const scene = await studio.show('webgl', { preset: 'riverbed', color: 'natural' });
//   const { png, ms } = await studio.take('webgl', { width: 1600, height: 1000, camera: null });
//   await studio.close();
import { launch, pageOf } from '../../tests/e2e/browser.mjs';
import { GENERATORS } from '../lib/generators.mjs';
import { Failure } from '../lib/run.mjs';

const pageWith = (tag) => `<!doctype html><html lang="en"><meta charset="utf-8"><title>studio</title><link rel="icon" href="data:,">
<style>body { margin: 0 } ${tag} { width: 64px; height: 40px } ${tag}[hidden] { display: none }</style><script type="module" src="./${tag}.js"></script>`;

/** tan of half the vertical field of view, as in www/base/fov.ts. */
const TAN = Math.tan(Math.PI / 10);

/** Looking straight down: `across` pixels of the ground fill the height of the picture. */
export function fromAbove([x, y], across) {
  return { azimuth: 0, elevation: Math.PI / 2, distance: across / 2 / TAN, target: [x, y, 0] };
}

/** What an element shows until it is asked for more: little. */
const SMALL = Object.fromEntries(GENERATORS.map(({ tag, small }) => [tag, small]));

/**
 * Opens a page for each backend, in one browser. `tag` is the element's.
 *
 * `show` sets attributes, takes all others away, and waits for the field; `take` draws what is shown, at the best quality. `camera` is
 * the element's, null where it frames the field by itself.
 */
export async function openStudio({ backends, ratio = 1, tag = 'rock-field' }) {
  const session = await launch({ webgpu: backends.includes('webgpu'), intercept: pageOf('studio.html', () => pageWith(tag)) });
  try {
    const opened = {};
    for (const backend of backends) {
      opened[backend] = await session.open('studio.html', { deviceScaleFactor: ratio, colorScheme: 'light' });
      await opened[backend].page.evaluate(setUp, { tag, attributes: { backend, ...SMALL[tag] } });
    }
    const on = async (backend, work, argument) => {
      const { page, errors } = opened[backend];
      const result = await page.evaluate(work, argument);
      if (errors.length > 0) throw new Failure(`${backend}: ${errors.join('\n')}`);
      return result;
    };
    return {
      browser: session.browser,
      show: (backend, attributes) => on(backend, show, attributes),
      async take(backend, picture) {
        const { base64, ms } = await on(backend, take, picture);
        return { png: Buffer.from(base64, 'base64'), ms };
      },
      close: () => session.close(),
    };
  } catch (error) {
    await session.close();
    throw error;
  }
}

/**
 * A page as a picture: what is laid out, not what fits the screen.
 *
 * @param {import('playwright-core').Browser} browser
 * @param {string} address of a file, or the page itself
 * @param {{ width: number, type?: 'png' | 'jpeg', quality?: number }} options
 */
export async function photograph(browser, address, { width, type = 'png', quality }) {
  const context = await browser.newContext({ viewport: { width, height: 200 } });
  try {
    const page = await context.newPage();
    if (address.startsWith('file:')) await page.goto(address, { waitUntil: 'load' });
    else await page.setContent(address, { waitUntil: 'load' });
    return await page.screenshot({ fullPage: true, type, quality });
  } finally {
    await context.close();
  }
}

// In the page.

/** @typedef {HTMLElementTagNameMap['rock-field']} Rocks */
/** @typedef {HTMLElementTagNameMap['wood-ear-log']} WoodEars */

/** Once it has shown a picture the element is hidden: it draws those that are taken, and no frame for a screen beside them. */
async function setUp({ tag, attributes }) {
  await customElements.whenDefined(tag);
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  document.body.append(element);
  await element.ready;
  const { backend } = attributes;
  if (element.backend !== backend) throw new Error(`${element.backend} draws in the stead of ${backend}`);
  element.hidden = true;
}

async function show(attributes) {
  const element = /** @type {Rocks | WoodEars} */ (document.body.firstElementChild);
  for (const name of element.getAttributeNames())
    if (!(name in attributes) && !['backend', 'hidden'].includes(name)) element.removeAttribute(name);
  for (const [name, value] of Object.entries(attributes)) if (element.getAttribute(name) !== value) element.setAttribute(name, value);
  if ('getColony' in element) {
    const { stats } = await element.getColony();
    return { place: element.scene?.place, individuals: stats.individuals, triangles: stats.triangles };
  }
  const { imageWidth, imageHeight, layers, stats } = await element.getField();
  const middle = [imageWidth / 2, imageHeight / 2];
  // The largest rocks there are, and the one of them in the middle.
  const coarse = layers.filter(({ selected }) => selected.length > 0).sort((a, b) => b.radius - a.radius)[0];
  const sites = [...(coarse?.selected ?? [])].map((site) => [coarse.sites[2 * site], coarse.sites[2 * site + 1]]);
  const away = (/** @type {number[]} */ [x, y]) => Math.hypot(x - middle[0], y - middle[1]);
  const [rock = middle] = sites.sort((a, b) => away(a) - away(b));
  const radius = coarse?.radius ?? imageWidth / 10;
  return {
    imageWidth,
    imageHeight,
    middle,
    rock,
    radius,
    metresPerPixel: element.metresPerPixel,
    rocks: stats.rocks,
    triangles: stats.triangles,
  };
}

async function take({ camera, samples, ...options }) {
  const element = /** @type {Rocks | WoodEars} */ (document.body.firstElementChild);
  element.camera = camera;
  const start = performance.now();
  const blob = await element.toBlob({ ...options, ...(samples && { samples }) });
  const ms = performance.now() - start;
  const url = await new Promise((resolve) => {
    const reader = new FileReader();
    reader.onload = () => resolve(reader.result);
    reader.readAsDataURL(blob);
  });
  return { base64: url.slice(url.indexOf(',') + 1), ms };
}
