// Pictures of presets as tiles of mean colours, beside those that are stored in tests/data/.
/** @import { Picture } from '../../scripts/lib/pixels.mjs' */
import assert from 'node:assert/strict';
import { readFile, writeFile } from 'node:fs/promises';
import { asPicture, asText, meanDifference, readPicture, tiles } from '../../scripts/lib/pixels.mjs';
import { screenshotPath } from './browser.mjs';

export const BACKENDS = ['webgpu', 'webgl'];
export const SIZE = { width: 320, height: 200 };
/** @type {[columns: number, rows: number]} */
const TILES = [32, 20];

/**
 * The pictures in a file of tests/data/, by preset.
 *
 * @param {string} name of the file
 * @param {string[]} presets those that have to be in it
 * @param {{ stored: number, backends: number }} most mean absolute errors over all channels, per cent of full scale: from what is stored, and
 *   between the backends
 */
export async function storedPictures(name, presets, most) {
  const file = new URL(`../data/${name}`, import.meta.url);
  const stored = JSON.parse(await readFile(file, 'utf8').catch(() => '{}'));
  const found = {};
  return {
    /** The presets of the file. */
    names: Object.keys(stored),
    /** @returns {Picture} the tiles of a preset */
    of: (preset) => asPicture(stored[preset], ...TILES),

    /**
     * Compares what each backend drew with each other, and with what is stored unless that is being updated. The pictures lie in
     * .cache/screenshots/ afterwards.
     *
     * @param {string} preset
     * @param {Buffer[]} drawn a PNG for each of `BACKENDS`
     */
    async check(preset, drawn) {
      const files = BACKENDS.map((backend) => screenshotPath(`natural-${preset}-${backend}`));
      for (const [index, png] of drawn.entries()) await writeFile(files[index], png);
      const pictures = drawn.map(readPicture);
      const between = meanDifference(pictures[0], pictures[1]);
      const seen = pictures.map((picture) => tiles(picture, ...TILES));
      found[preset] = asText(seen[0]);
      const errors = process.env.UPDATE ? [] : seen.map((picture) => meanDifference(picture, this.of(preset)));
      console.log(
        `${preset}: backends ${between.toFixed(3)} % apart, ${errors.map((error) => error.toFixed(3)).join(' and ')} % from what is stored`,
      );
      assert(between < most.backends, `WebGPU and WebGL2 are ${between.toFixed(2)} % apart: ${files.join(' and ')}`);
      errors.forEach((error, index) =>
        assert(error < most.stored, `${files[index]} is ${error.toFixed(2)} % from what is stored; if it is right, UPDATE=1 stores it`),
      );
    },

    /** With `UPDATE`, stores what was drawn; presets that were not drawn keep what they have. */
    async update() {
      if (!process.env.UPDATE) return;
      const entries = presets.map((preset) => [preset, found[preset] ?? stored[preset]]);
      await writeFile(file, `${JSON.stringify(Object.fromEntries(entries), null, 1)}\n`);
    },
  };
}
