// Wood ears in natural colours look as they did: every natural preset on its log, small, as tiles of mean colours, beside those that were
// stored; and the same on WebGPU and WebGL2.
//
//   UPDATE=1 node --test tests/e2e/wood-ear-natural.test.mjs    stores what is drawn now; look at it first, in .cache/screenshots/
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { meanDifference } from '../../scripts/lib/pixels.mjs';
import { openStudio } from '../../scripts/pictures/studio.mjs';
import { tables } from '../../scripts/lib/tables.mjs';
import { BACKENDS, SIZE, storedPictures } from './stored-pictures.mjs';

/** As in natural.test.mjs; less than one colony is from another. */
const MOST = { stored: 1, backends: 1 };

const { WOOD_EARS } = await tables();
const names = WOOD_EARS.presets.filter(({ natural }) => natural).map(({ name }) => name);
const stored = await storedPictures('wood-ear-natural-golden.json', names, MOST);
let studio;

before(async () => {
  studio = await openStudio({ backends: BACKENDS, tag: 'wood-ear-log' });
});

after(async () => {
  await studio?.close();
  await stored.update();
});

/** From the side that the sun shines on, so near that a colony fills most of the picture. */
const beside = ([x, y]) => ({ azimuth: 0.2, elevation: 0.35, distance: 65, target: [x, y - 6, 16] });

async function picture(backend, attributes) {
  const { place } = await studio.show(backend, { color: 'natural', quality: 'high', ...attributes });
  return (await studio.take(backend, { ...SIZE, camera: beside(place) })).png;
}

for (const preset of names) {
  test(`${preset} looks as it did, on WebGPU and WebGL2 alike`, async () => {
    const drawn = [];
    for (const backend of BACKENDS) drawn.push(await picture(backend, { preset }));
    await stored.check(preset, drawn);
  });
}

test('every natural preset is stored, and each unlike the others by more than is allowed', { skip: Boolean(process.env.UPDATE) }, () => {
  assert.deepEqual(stored.names.sort(), [...names].sort());
  for (const [index, one] of names.entries()) {
    for (const other of names.slice(index + 1)) {
      const between = meanDifference(stored.of(one), stored.of(other));
      assert(between > 2 * MOST.stored, `${one} and ${other} are ${between.toFixed(2)} % apart`);
    }
  }
});
