// Natural grounds look as they did: every natural preset, small, as tiles of mean colours, beside those that were stored; and the same on
// WebGPU and WebGL2.
//
//   UPDATE=1 node --test tests/e2e/natural.test.mjs    stores what is drawn now; look at it first, with `npm run gallery`
import assert from 'node:assert/strict';
import { readFile, writeFile } from 'node:fs/promises';
import { after, before, test } from 'node:test';
import { asPicture, asText, meanDifference, readPicture, tiles } from '../../scripts/lib/pixels.mjs';
import { openStudio } from '../../scripts/pictures/studio.mjs';
import { tables } from '../../scripts/lib/tables.mjs';

const STORED = new URL('../data/natural-golden.json', import.meta.url);
const BACKENDS = ['webgpu', 'webgl'];
const SIZE = { width: 320, height: 200 };
/** @type {[columns: number, rows: number]} */
const TILES = [32, 20];
/**
 * Mean absolute errors over all channels, per cent of full scale. Devices differ at edges and in the last bits of noise, which tiles
 * level out; a light, a colour or a layer that is wrong moves most tiles.
 */
const MOST = { stored: 2, backends: 2 };

const { PRESETS, presetParams } = await tables();
const names = PRESETS.filter(({ natural }) => natural).map(({ name }) => name);
const stored = JSON.parse(await readFile(STORED, 'utf8').catch(() => '{}'));
const found = {};
let studio;

before(async () => {
  studio = await openStudio({ backends: BACKENDS });
});

after(async () => {
  await studio?.close();
  if (process.env.UPDATE) await writeFile(STORED, `${JSON.stringify(found, null, 1)}\n`);
});

for (const preset of names) {
  test(`${preset} looks as it did, on WebGPU and WebGL2 alike`, async () => {
    const pictures = [];
    // A quarter of the ground, since a software GPU is slow with triangles.
    const side = String(presetParams(preset).imageWidth / 2);
    for (const backend of BACKENDS) {
      await studio.show(backend, { preset, color: 'natural', quality: 'high', 'image-width': side, 'image-height': side });
      pictures.push(readPicture((await studio.take(backend, { ...SIZE, camera: null })).png));
    }
    const between = meanDifference(pictures[0], pictures[1]);
    const seen = pictures.map((picture) => tiles(picture, ...TILES));
    found[preset] = asText(seen[0]);
    const errors = process.env.UPDATE ? [] : seen.map((picture) => meanDifference(picture, asPicture(stored[preset], ...TILES)));
    console.log(
      `${preset}: backends ${between.toFixed(3)} % apart, ${errors.map((error) => error.toFixed(3)).join(' and ')} % from what is stored`,
    );
    assert(between < MOST.backends, `WebGPU and WebGL2 are ${between.toFixed(2)} % apart`);
    errors.forEach((error, index) =>
      assert(
        error < MOST.stored,
        `on ${BACKENDS[index]} it is ${error.toFixed(2)} % from what is stored; if it is right, UPDATE=1 stores it`,
      ),
    );
  });
}

test('every natural preset is stored, and nothing else', { skip: Boolean(process.env.UPDATE) }, () => {
  assert.deepEqual(Object.keys(stored).sort(), [...names].sort());
});
