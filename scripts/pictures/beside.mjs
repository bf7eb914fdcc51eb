// `npm run gallery -- --beside PHOTO.png[@METRES] …`: for each photograph, taken from straight above, a render of the same size in metres and in
// pixels. `--only` names a preset for each of them, in order, or one for all.
//
// METRES is how much of the ground the photograph is across, 4 if it is not said. `--only quarry-rubble@0.8` lets the render be as many metres
// across as it says instead, by the element's own scale. PRESET-beside.png has both at 100 %, PRESET-above.png the render alone.
import { existsSync } from 'node:fs';
import { readFile, writeFile } from 'node:fs/promises';
import path from 'node:path';
import { root } from '../lib/env.mjs';
import { Failure, needed, say } from '../lib/run.mjs';
import { fromAbove, openStudio, photograph } from './studio.mjs';
import { tables } from '../lib/tables.mjs';

const METRES = 4;
const PRESET = 'riverbed';
const TYPES = { '.png': 'image/png', '.jpg': 'image/jpeg', '.jpeg': 'image/jpeg', '.webp': 'image/webp' };

export async function besides({ photos, presets = [PRESET], backend, attributes, out }) {
  const pairs = await pairUp(photos, presets);
  const studio = await openStudio({ backends: [backend] });
  try {
    for (const { file, preset, metres } of pairs) {
      const photo = await readPhoto(studio.browser, file);
      const { middle, metresPerPixel } = await studio.show(backend, { preset, ...attributes });
      // As a photograph is cropped to a square, so is its width in metres.
      const across = ((metres / metresPerPixel) * photo.side) / photo.width;
      const { png, ms } = await studio.take(backend, { width: photo.side, height: photo.side, camera: fromAbove(middle, across) });
      const above = path.join(out, `${preset}-above.png`);
      const beside = path.join(out, `${preset}-beside.png`);
      await writeFile(above, png);
      await writeFile(beside, await layOut(studio.browser, png, photo));
      say(
        `✓ ${path.relative(root, beside)}, ${path.relative(root, above)}: ${((metres * photo.side) / photo.width).toFixed(2)} m across, ${ms.toFixed(0)} ms`,
      );
    }
  } finally {
    await studio.close();
  }
}

async function pairUp(photos, presets) {
  const known = (await tables()).PRESETS.map(({ name }) => name);
  if (presets.length !== 1 && presets.length !== photos.length)
    throw new Failure(`${photos.length} photographs and ${presets.length} presets: one for each, or one for all`);
  const pairs = photos.map((photo, index) => {
    const [file, metres = METRES] = split(photo);
    const [preset, own = metres] = split(presets[index] ?? presets[0]);
    if (!existsSync(file)) throw new Failure(`there is no photograph ${file}`);
    if (!TYPES[path.extname(file).toLowerCase()]) throw new Failure(`${file} is none of ${Object.keys(TYPES).join(', ')}`);
    if (!known.includes(preset)) throw new Failure(`there is no preset called ${preset}; there are: ${known.join(', ')}`);
    return { file: path.resolve(file), preset, metres: own };
  });
  const twice = pairs.find(({ preset }, index) => pairs.findIndex((pair) => pair.preset === preset) < index);
  if (twice) throw new Failure(`${twice.preset} is laid beside two photographs, whose sheets would have one name`);
  return pairs;
}

/**
 * `NAME@METRES`; the number may be missing.
 *
 * @returns {[name: string, metres?: number]}
 */
function split(text) {
  const [, name, metres] = needed(/^(.*?)(?:@(\d*\.?\d+))?$/.exec(text), `name in ${text}`);
  return metres === undefined ? [name] : [name, Number(metres)];
}

/** `side` is that of the square in its middle. */
async function readPhoto(browser, file) {
  const url = `data:${TYPES[path.extname(file).toLowerCase()]};base64,${(await readFile(file)).toString('base64')}`;
  const page = await browser.newPage();
  const [width, height] = await page.evaluate(async (address) => {
    const image = new Image();
    image.src = address;
    await image.decode();
    return [image.naturalWidth, image.naturalHeight];
  }, url);
  await page.close();
  return { url, width, side: Math.min(width, height) };
}

function layOut(browser, png, { url, side }) {
  const gap = 8;
  const html = `<!doctype html><meta charset="utf-8"><style>
    body { margin: 0; background: #fff; display: flex; gap: ${gap}px } img { width: ${side}px; height: ${side}px; object-fit: none; display: block }
  </style><img src="data:image/png;base64,${png.toString('base64')}" alt=""><img src="${url}" alt="">`;
  return photograph(browser, html, { width: 2 * side + gap });
}
