// `npm run textures`: rocks with their baked textures in three.js beside our own picture, under the same sun and sky, into .cache/textures/.
//
//   npm run textures                                        riverbed, 2k
//   npm run textures -- --preset moraine --textures 4k --webgl
//
// It takes half a minute and more without a GPU. It fails where the two differ by more than 6 % on average over the rocks.
import { mkdir, writeFile } from 'node:fs/promises';
import path from 'node:path';
import { parseArgs } from 'node:util';
import * as esbuild from 'esbuild';
import { PNG } from 'pngjs';
import { launch, pageOf } from '../../tests/e2e/browser.mjs';
import { root } from '../lib/env.mjs';
import { readPicture } from '../lib/pixels.mjs';
import { Failure, isMain, main, say } from '../lib/run.mjs';

/** Mean over all pixels of rocks and all channels, per cent of full scale. */
const MOST_DIFFERENT = 6;
const [WIDTH, HEIGHT] = [800, 600];
/** Of the field, pixels. Rocks near its border sink in our picture, and not in the file: the eye looks at the middle. */
const IMAGE = [300, 240];
const CAMERA = { azimuth: 0.5, elevation: 0.65, distance: 150, target: [150, 110, 4] };
const METRES_PER_PIXEL = 0.01;
/** Pixels from the rim of a rock in which what is behind it shows through. */
const RIM = 2;

async function pictures({ preset, textures, backend }) {
  const element = `<rock-field preset="${preset}" seed="5" image-width="${IMAGE[0]}" image-height="${IMAGE[1]}" color="natural" quality="high" backend="${backend}"></rock-field>`;
  const html = `<!doctype html><html lang="en"><meta charset="utf-8"><title>textures</title><link rel="icon" href="data:,">${element}<script type="module" src="./rock-field.js"></script>`;
  const session = await launch({ webgpu: backend === 'webgpu', intercept: pageOf('textures.html', () => html) });
  try {
    const { page } = await session.open('textures.html');
    await page.waitForFunction(() => customElements.get('rock-field'));
    const { outputFiles } = await esbuild.build({
      entryPoints: [path.join(root, 'scripts', 'pictures', 'in-three.mjs')],
      bundle: true,
      format: 'iife',
      globalName: 'three',
      write: false,
    });
    await page.addScriptTag({ content: outputFiles[0].text });
    return await page.evaluate(drawBoth, { textures, camera: CAMERA, width: WIDTH, height: HEIGHT, image: IMAGE, unit: METRES_PER_PIXEL });
  } finally {
    await session.close();
  }
}

// In the page.
async function drawBoth({ textures, ...scene }) {
  const element = document.querySelector('rock-field');
  const file = await element.exportFile({ textures, mesh: 'one', metresPerPixel: scene.unit });
  await element.ready;
  element.camera = scene.camera;
  const blob = await element.toBlob({ width: scene.width, height: scene.height });
  const ours = await new Promise((resolve) => {
    const reader = new FileReader();
    reader.onload = () => resolve(/** @type {string} */ (reader.result));
    reader.readAsDataURL(blob);
  });
  const { sunAzimuth, sunElevation, ground } = element.params;
  const { inThree } = /** @type {any} */ (globalThis).three;
  const bytes = new Uint8Array(await file.arrayBuffer());
  return { ours, ...(await inThree(bytes, { ...scene, sun: [sunAzimuth, sunElevation], ground })) };
}

/** Mean difference over what `mask` shows as rock, but for its rims; and a picture of it. */
function compare(ours, theirs, mask) {
  const { width, height } = ours;
  const apart = new PNG({ width, height });
  let [sum, count] = [0, 0];
  const isRock = (x, y) => mask.data[4 * (y * width + x)] === 255;
  for (let y = RIM; y < height - RIM; y++) {
    for (let x = RIM; x < width - RIM; x++) {
      const at = 4 * (y * width + x);
      apart.data[at + 3] = 255;
      if (![-RIM, 0, RIM].every((dy) => [-RIM, 0, RIM].every((dx) => isRock(x + dx, y + dy)))) continue;
      for (let c = 0; c < 3; c++) {
        const difference = Math.abs(ours.data[at + c] - theirs.data[at + c]);
        apart.data[at + c] = Math.min(255, 4 * difference);
        sum += difference / 3;
      }
      count += 1;
    }
  }
  return { percent: (100 * sum) / count / 255, share: count / width / height, apart };
}

if (isMain(import.meta)) {
  await main(async () => {
    const { values } = parseArgs({
      options: { preset: { type: 'string', default: 'riverbed' }, textures: { type: 'string', default: '2k' }, webgl: { type: 'boolean' } },
    });
    const { preset, textures, webgl } = values;
    const urls = await pictures({ preset, textures, backend: webgl ? 'webgl' : 'webgpu' });
    const [ours, theirs, mask] = [urls.ours, urls.picture, urls.mask].map((url) => Buffer.from(url.slice(url.indexOf(',') + 1), 'base64'));
    const { percent, share, apart } = compare(readPicture(ours), readPicture(theirs), readPicture(mask));
    const out = path.join(root, '.cache', 'textures');
    await mkdir(out, { recursive: true });
    for (const [name, png] of [
      ['ours', ours],
      ['three', theirs],
      ['apart', PNG.sync.write(apart)],
    ]) {
      await writeFile(path.join(out, `${preset}-${name}.png`), png);
    }
    say(
      `${preset}, ${textures}: ${percent.toFixed(2)} % apart over the rocks, which are ${(100 * share).toFixed(0)} % of the picture; see ${out}`,
    );
    if (percent > MOST_DIFFERENT) throw new Failure(`they may be ${MOST_DIFFERENT} % apart`);
  });
}
