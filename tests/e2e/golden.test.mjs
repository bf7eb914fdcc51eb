// The promise of a seed: every preset has its golden hash in Node and in a browser. The native and the wasm crate tests
// compare with the same file (tests/golden.rs).
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { test } from 'node:test';
import { generate, presets, woodEarPresets } from 'rock-field/core';
import { hashField } from './golden.mjs';
import { launch } from './browser.mjs';

const golden = JSON.parse(await readFile(new URL('../data/golden.json', import.meta.url), 'utf8'));
const colonies = JSON.parse(await readFile(new URL('../data/wood-ear-golden.json', import.meta.url), 'utf8'));
const names = /** @type {(keyof typeof presets)[]} */ (Object.keys(presets));

test('the file of golden hashes holds every preset and no other', () => {
  assert.deepEqual(Object.keys(golden).sort(), [...names].sort());
});

test('every preset has its golden hash in Node', async () => {
  for (const preset of names) assert.equal(await hashField(await generate({ preset })), golden[preset], preset);
});

test('every preset has its golden hash in a browser', async () => {
  const files = {
    '/golden.html': ['text/html', '<!doctype html><meta charset="utf-8"><title>golden</title><link rel="icon" href="data:,">'],
    '/golden.mjs': ['text/javascript', await readFile(new URL('./golden.mjs', import.meta.url), 'utf8')],
  };
  const session = await launch({
    intercept(request, response) {
      const file = files[new URL(request.url, 'http://localhost').pathname];
      if (file) response.writeHead(200, { 'content-type': file[0] }).end(file[1]);
      return Boolean(file);
    },
  });
  try {
    const { page, errors } = await session.open('golden.html');
    const grown = await page.evaluate(
      async (presets) => {
        const [{ createWoodEarGenerator }, { hashColony }] = await Promise.all([import('/core.js'), import('/golden.mjs')]);
        const generator = await createWoodEarGenerator();
        const hashes = {};
        for (const preset of presets) hashes[preset] = await hashColony(await generator.generate({ preset }));
        generator.dispose();
        return hashes;
      },
      /** @type {(keyof typeof woodEarPresets)[]} */ (Object.keys(woodEarPresets)),
    );
    assert.deepEqual(grown, colonies);
    const found = await page.evaluate(async (presets) => {
      const [{ createGenerator }, { hashField }] = await Promise.all([import('/core.js'), import('/golden.mjs')]);
      const generator = await createGenerator();
      const hashes = {};
      for (const preset of presets) hashes[preset] = await hashField(await generator.generate({ preset }));
      generator.dispose();
      return hashes;
    }, names);
    assert.deepEqual(found, golden);
    assert.deepEqual(errors, []);
  } finally {
    await session.close();
  }
});
