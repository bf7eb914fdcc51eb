// The renderer's artefact itself, without an element: a log and its colony are replaced as one step, or not at all.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { root } from '../../scripts/env.mjs';
import { launch, pageOf } from './browser.mjs';

const PAGE = '<!doctype html><meta charset="utf-8"><title>artefact</title><link rel="icon" href="data:,">';

test('a colony that is refused leaves the log and the colony that were there', async () => {
  const session = await launch({ folder: root, intercept: pageOf('artefact.html', () => PAGE) });
  try {
    const { page, errors } = await session.open('artefact.html');
    const seen = await page.evaluate(draw);
    assert.notEqual(seen.wood, seen.bare, 'a log is seen');
    assert.match(seen.refused, /malformed/);
    assert.equal(seen.after, seen.wood);
    assert.notEqual(seen.replaced, seen.wood, 'a larger log is another picture');
    assert.equal(seen.cleared, seen.bare);
    assert.deepEqual(errors, []);
  } finally {
    await session.close();
  }
});

/** In the page: what each step shows, as the picture's address. */
async function draw() {
  const module = await import('/pkg/renderer-webgl.js');
  await module.default({ module_or_path: await (await fetch('/pkg/renderer-webgl_bg.wasm')).arrayBuffer() });
  const canvas = document.createElement('canvas');
  document.body.append(canvas);
  const device = await module.Device.create(canvas, () => {});
  const renderer = new module.Renderer(device);
  const none = new Uint32Array();
  renderer.setField(100, 100, new Float32Array(), new Float32Array(), none, new Uint32Array(1), none, none);
  renderer.setStyle(0, 2, false);
  renderer.setCamera(0.3, 0.5, 120, 50, 50, 5);
  renderer.resize(64, 48, 1);
  const place = Float32Array.of(50, 50, 0, 1);
  const picture = () => {
    renderer.render();
    const copy = document.createElement('canvas');
    [copy.width, copy.height] = [64, 48];
    copy.getContext('2d').drawImage(canvas, 0, 0, 64, 48, 0, 0, 64, 48);
    return copy.toDataURL();
  };
  // A tent over the middle of the field.
  const tent = (size) => [Float32Array.of(-size, -size, 0, size, -size, 0, 0, size, 0, 0, 0, size), Float32Array.of(-0.6, -0.6, 0.5, 0.6, -0.6, 0.5, 0, 0.9, 0.5, 0, 0, 1), Uint32Array.of(0, 1, 3, 1, 2, 3, 2, 0, 3)];
  const setLog = (size) => renderer.setLog(...tent(size), new Uint8Array(4), place);
  const setColony = (keys) => renderer.setColony(...tent(2), keys, 1, 4, place);
  const bare = picture();
  setLog(15);
  setColony(Uint32Array.of(1));
  const wood = picture();
  setLog(25);
  let refused = '';
  try {
    // Of three individuals each would have a vertex and a third.
    setColony(Uint32Array.of(1, 2, 3));
  } catch (error) {
    refused = error.message;
  }
  const after = picture();
  setLog(25);
  setColony(Uint32Array.of(1));
  const replaced = picture();
  renderer.clearWood();
  return { bare, wood, refused, after, replaced, cleared: picture() };
}
