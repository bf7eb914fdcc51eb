// Wood ears in natural colours look as they did: every natural preset on its log, small, as tiles of mean colours, beside those that were
// stored; and the same on WebGPU and WebGL2.
//
//   UPDATE=1 node --test tests/e2e/wood-ear-natural.test.mjs    stores what is drawn now; look at it first
import assert from 'node:assert/strict';
import { readFile, writeFile } from 'node:fs/promises';
import { after, before, test } from 'node:test';
import { asPicture, asText, meanDifference, readPicture, tiles } from '../../scripts/lib/pixels.mjs';
import { openStudio } from '../../scripts/pictures/studio.mjs';
import { tables } from '../../scripts/lib/tables.mjs';

const STORED = new URL('../data/wood-ear-natural-golden.json', import.meta.url);
const BACKENDS = ['webgpu', 'webgl'];
const SIZE = { width: 320, height: 200 };
/** @type {[columns: number, rows: number]} */
const TILES = [32, 20];
/** As in natural.test.mjs: mean absolute errors over all channels, per cent of full scale. Less than one colony is from another. */
const MOST = { stored: 1, backends: 1 };

const { WOOD_EARS } = await tables();
const names = WOOD_EARS.presets.filter(({ natural }) => natural).map(({ name }) => name);
const stored = JSON.parse(await readFile(STORED, 'utf8').catch(() => '{}'));
const found = {};
let studio;

before(async () => {
  studio = await openStudio({ backends: BACKENDS, tag: 'wood-ear-log' });
});

after(async () => {
  await studio?.close();
  if (process.env.UPDATE) await writeFile(STORED, `${JSON.stringify(found, null, 1)}\n`);
});

/** From the side that the sun shines on, so near that a colony fills most of the picture. */
const beside = ([x, y]) => ({ azimuth: 0.2, elevation: 0.35, distance: 65, target: [x, y - 6, 16] });

async function picture(backend, attributes) {
  const { place } = await studio.show(backend, { color: 'natural', quality: 'high', ...attributes });
  return readPicture((await studio.take(backend, { ...SIZE, camera: beside(place) })).png);
}

for (const preset of names) {
  test(`${preset} looks as it did, on WebGPU and WebGL2 alike`, async () => {
    const pictures = [];
    for (const backend of BACKENDS) pictures.push(await picture(backend, { preset }));
    const between = meanDifference(pictures[0], pictures[1]);
    const seen = pictures.map((each) => tiles(each, ...TILES));
    found[preset] = asText(seen[0]);
    const errors = process.env.UPDATE ? [] : seen.map((each) => meanDifference(each, asPicture(stored[preset], ...TILES)));
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

test('every natural preset is stored, and each unlike the others by more than is allowed', { skip: Boolean(process.env.UPDATE) }, () => {
  assert.deepEqual(Object.keys(stored).sort(), [...names].sort());
  for (const [index, one] of names.entries()) {
    for (const other of names.slice(index + 1)) {
      const between = meanDifference(asPicture(stored[one], ...TILES), asPicture(stored[other], ...TILES));
      assert(between > 2 * MOST.stored, `${one} and ${other} are ${between.toFixed(2)} % apart`);
    }
  }
});
