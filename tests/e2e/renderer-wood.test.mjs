// The renderer's artefact itself, without an element: a log and its colony are replaced as one step, or not at all; and the ground
// hides what is below it.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { root } from '../../scripts/lib/env.mjs';
import { launch, pageOf } from './browser.mjs';

const PAGE = '<!doctype html><meta charset="utf-8"><title>artefact</title><link rel="icon" href="data:,">';

/** @type {import('./browser.mjs').Session} */
let session;

before(async () => {
  session = await launch({ webgpu: true, folder: root, intercept: pageOf('artefact.html', () => PAGE) });
});

after(() => session?.close());

test('a colony that is refused leaves the log and the colony that were there', async () => {
  const { page, errors, close } = await session.open('artefact.html');
  const seen = await page.evaluate(draw);
  assert.notEqual(seen.wood, seen.bare, 'a log is seen');
  assert.match(seen.refused, /malformed/);
  assert.equal(seen.after, seen.wood);
  assert.notEqual(seen.replaced, seen.wood, 'a larger log is another picture');
  assert.equal(seen.cleared, seen.bare);
  assert.deepEqual(errors, []);
  await close();
});

for (const backend of ['webgl', 'webgpu']) {
  test(`what is below the ground is hidden in every style (${backend})`, async () => {
    const { page, errors, close } = await session.open('artefact.html');
    await page.addScriptTag({ content: String(pyramid) });
    const seen = await page.evaluate(drawSkirts, backend);
    assert.equal(seen.length, 7);
    for (const { subject, style, shown, skirt } of seen) {
      assert(shown > 5, `${subject}, ${style}: what stands on the ground covers ${shown.toFixed(1)} % of the picture`);
      // The ground is pushed behind the rims of what stands on it, by little more than a pixel. In natural colours copies have such rims, too.
      const most = subject === 'rock' && style === 'natural' ? 4 : 1;
      assert(skirt < most, `${subject}, ${style}: ${skirt.toFixed(2)} % of the picture changes with what is below the ground`);
    }
    assert.deepEqual(errors, []);
    await close();
  });
}

/** In the page: what each step shows, as the picture's address. */
async function draw() {
  const module = await import('/pkg/renderer-webgl.js');
  await module.default({ module_or_path: await (await fetch('/pkg/renderer-webgl_bg.wasm')).arrayBuffer() });
  const canvas = document.createElement('canvas');
  document.body.append(canvas);
  const device = await module.Device.create(canvas, () => {});
  const renderer = new module.Renderer(device);
  const none = new Uint32Array();
  renderer.setField(100, 100, new Float32Array(), new Float32Array(), none, new Uint32Array(1), new Uint32Array(1), none, none);
  renderer.setStyle(0, 2, false);
  renderer.setCamera(0.3, 0.5, 120, 50, 50, 5, 0.63);
  renderer.resize(64, 48, 1);
  const place = Float32Array.of(50, 50, 0, 1);
  const picture = () => {
    renderer.render();
    const copy = document.createElement('canvas');
    [copy.width, copy.height] = [64, 48];
    copy.getContext('2d')?.drawImage(canvas, 0, 0, 64, 48, 0, 0, 64, 48);
    return copy.toDataURL();
  };
  // A tent over the middle of the field.
  /** @returns {[Float32Array, Float32Array, Uint32Array]} */
  const tent = (size) => [
    Float32Array.of(-size, -size, 0, size, -size, 0, 0, size, 0, 0, 0, size),
    Float32Array.of(-0.6, -0.6, 0.5, 0.6, -0.6, 0.5, 0, 0.9, 0.5, 0, 0, 1),
    Uint32Array.of(0, 1, 3, 1, 2, 3, 2, 0, 3),
  ];
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
    refused = /** @type {Error} */ (error).message;
  }
  const after = picture();
  setLog(25);
  setColony(Uint32Array.of(1));
  const replaced = picture();
  renderer.clearWood();
  return { bare, wood, refused, after, replaced, cleared: picture() };
}

/** In the page: a pyramid without its top, in rings of four corners: `[half the side, height]`, from above. */
function pyramid(rings) {
  const corners = [
    [-1, -1],
    [1, -1],
    [1, 1],
    [-1, 1],
  ];
  const positions = rings.flatMap(([half, z]) => corners.flatMap(([x, y]) => [50 + half * x, 50 + half * y, z]));
  const normals = rings.flatMap(() => corners.flatMap(([x, y]) => [0.6 * x, 0.6 * y, 0.53]));
  const sides = rings.slice(1).flatMap((_, ring) =>
    corners.flatMap((_, k) => {
      const [above, next] = [4 * ring + k, 4 * ring + ((k + 1) % 4)];
      return [above, above + 4, next, next, above + 4, next + 4];
    }),
  );
  return [Float32Array.from(positions), Float32Array.from(normals), Uint32Array.from([0, 1, 2, 0, 2, 3, ...sides])];
}

/**
 * In the page: of a rock and of a log, in every style, how much of the picture shows it, and how much changes when it goes on below
 * the ground, where it gets wider; per cent.
 */
async function drawSkirts(backend) {
  const module = await import(`/pkg/renderer-${backend}.js`);
  await module.default({ module_or_path: await (await fetch(`/pkg/renderer-${backend}_bg.wasm`)).arrayBuffer() });
  const canvas = document.createElement('canvas');
  document.body.append(canvas);
  const device = await module.Device.create(canvas, () => {});
  const renderer = backend === 'webgpu' ? new module.Renderer(device, canvas) : new module.Renderer(device);
  const [width, height] = [96, 72];
  renderer.resize(width, height, 1);
  const none = new Uint32Array();
  const place = Float32Array.of(0, 0, 0, 1);
  const bare = () =>
    renderer.setField(100, 100, new Float32Array(), new Float32Array(), none, new Uint32Array(1), new Uint32Array(1), none, none);
  const subjects = {
    nothing: () => {
      bare();
      renderer.clearWood();
      return none;
    },
    rock: (mesh) => {
      renderer.setField(
        100,
        100,
        ...mesh,
        Uint32Array.of(0, mesh[0].length / 3),
        Uint32Array.of(0, mesh[2].length),
        Uint32Array.of(0),
        Uint32Array.of(0),
      );
      renderer.clearWood();
      return mesh[2];
    },
    log: (mesh) => {
      bare();
      renderer.setLog(...mesh, new Uint8Array(mesh[0].length / 3), place);
      renderer.setColony(new Float32Array(), new Float32Array(), none, none, 1, 4, place);
      return mesh[2];
    },
  };
  const styles = { 'by layer': [0, 0], plain: [0, 2], natural: [0, 3], wireframe: [1, 0] };
  const picture = (subject, rings) => {
    const indices = subjects[subject](pyramid(rings));
    if (renderer.needsEdges()) renderer.setEdges(subject === 'rock' ? indices : none);
    if (renderer.needsWoodEdges()) renderer.setWoodEdges(indices, none);
    renderer.render();
    const copy = document.createElement('canvas');
    [copy.width, copy.height] = [width, height];
    const context = /** @type {CanvasRenderingContext2D} */ (copy.getContext('2d'));
    context.drawImage(canvas, 0, 0, width, height, 0, 0, width, height);
    return context.getImageData(0, 0, width, height).data;
  };
  /** Pixels that can be told apart. */
  const apart = (a, b) => {
    let count = 0;
    for (let at = 0; at < a.length; at += 4) count += [0, 1, 2].some((channel) => Math.abs(a[at + channel] - b[at + channel]) > 24) ? 1 : 0;
    return (100 * count) / (width * height);
  };
  renderer.setCamera(0.3, 0.3, 100, 50, 50, 0, 0.63);
  const above = [
    [9, 14],
    [11, 0],
  ];
  const seen = [];
  for (const subject of ['rock', 'log']) {
    for (const [style, values] of Object.entries(styles)) {
      // In natural colours litter lies round a log, farther round a thicker one.
      if (subject === 'log' && style === 'natural') continue;
      renderer.setStyle(...values, false);
      const cut = picture(subject, above);
      const skirt = apart(cut, picture(subject, [...above, [25, -12]]));
      seen.push({ subject, style, shown: apart(cut, picture('nothing', above)), skirt });
    }
  }
  return seen;
}
