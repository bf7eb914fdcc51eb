// Natural grounds look as they did: every natural preset, small, as tiles of mean colours, beside those that were stored; and the same on
// WebGPU and WebGL2.
//
//   UPDATE=1 node --test --test-name-pattern=riverbed tests/e2e/natural.test.mjs    stores a preset as it is drawn now, all without the
//   pattern; look at it first, with `npm run gallery`
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { openStudio } from '../../scripts/pictures/studio.mjs';
import { tables } from '../../scripts/lib/tables.mjs';
import { BACKENDS, SIZE, storedPictures } from './stored-pictures.mjs';

/**
 * Devices differ at edges and in the last bits of noise, which tiles level out; a light, a colour or a layer that is wrong moves most tiles.
 */
const MOST = { stored: 2, backends: 2 };

const { PRESETS, presetParams } = await tables();
const names = PRESETS.filter(({ natural }) => natural).map(({ name }) => name);
const stored = await storedPictures('natural-golden.json', names, MOST);
let studio;

before(async () => {
  studio = await openStudio({ backends: BACKENDS });
});

after(async () => {
  await studio?.close();
  await stored.update();
});

for (const preset of names) {
  test(`${preset} looks as it did, on WebGPU and WebGL2 alike`, async () => {
    const drawn = [];
    // A quarter of the ground, since a software GPU is slow with triangles.
    const side = String(presetParams(preset).imageWidth / 2);
    for (const backend of BACKENDS) {
      await studio.show(backend, { preset, color: 'natural', quality: 'high', 'image-width': side, 'image-height': side });
      drawn.push((await studio.take(backend, { ...SIZE, camera: null })).png);
    }
    await stored.check(preset, drawn);
  });
}

test('every natural preset is stored, and nothing else', { skip: Boolean(process.env.UPDATE) }, () => {
  assert.deepEqual(stored.names.sort(), [...names].sort());
});
