// Textures of an element that nobody sees: its stone without light, by the renderer's own hand; called off while they are drawn.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { PNG } from 'pngjs';
import { launch, pageOf } from './browser.mjs';
import { pageWith } from './element-page.mjs';

/** All of one stone, clean and dry, so that its mean colour is known. */
const PLAIN = 'variation="0" dust="0" moss="0" wetness="0" material="sandstone sandstone sandstone"';
const FIELD = `<rock-field id="a" style="display: none" preset="riverbed" seed="5" image-width="90" image-height="60" ${PLAIN}></rock-field>`;
/** Of sandstone in stone.wgsl, linear. */
const SANDSTONE = [0.27, 0.227, 0.174];

let session;

before(async () => {
  session = await launch({ intercept: pageOf('element.html', () => pageWith(`${FIELD}<script>listenTo(a)</script>`)) });
});

after(() => session?.close());

const linear = (byte) => (byte <= 10 ? byte / 255 / 12.92 : ((byte / 255 + 0.055) / 1.055) ** 2.4);

/** Means of red, green and blue, 0 … 1. */
function meansOf({ data }, read = (byte) => byte / 255) {
  const sums = [0, 0, 0];
  for (let at = 0; at < data.length; at += 4) for (let channel = 0; channel < 3; channel++) sums[channel] += read(data[at + channel]);
  return sums.map((sum) => sum / (data.length / 4));
}

test('an element that is not seen draws textures of its stone without light; while they are drawn they can be called off', async () => {
  const { page, errors, close } = await session.open('element.html');
  await page.waitForFunction(() => customElements.get('rock-field'));
  const { names, images, progress } = await page.evaluate(async () => {
    const stop = new AbortController();
    const stopped = a.exportFile({ textures: '8k' }, { signal: stop.signal, onProgress: (fraction) => fraction > 0.1 && stop.abort() });
    const name = await stopped.then(
      () => 'done',
      (error) => error.name,
    );
    const fractions = [];
    const file = await a.exportFile({ textures: '1k' }, { onProgress: (fraction) => fractions.push(fraction) });
    const bytes = await file.arrayBuffer();
    const length = new DataView(bytes).getUint32(12, true);
    const json = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 20, length)));
    const base64 = (view) => {
      const { byteOffset, byteLength } = json.bufferViews[view];
      let text = '';
      for (const byte of new Uint8Array(bytes, 28 + length + byteOffset, byteLength)) text += String.fromCharCode(byte);
      return btoa(text);
    };
    return { names: [name, file.name], images: json.images.map(({ bufferView }) => base64(bufferView)), progress: fractions };
  });
  assert.deepEqual(names, ['AbortError', 'riverbed-5.glb']);
  assert.ok(progress.length > 3 && progress.every((fraction, k) => fraction >= (progress[k - 1] ?? 0) && fraction <= 1), progress.join());
  const [color, normal, surface] = images.map((image) => PNG.sync.read(Buffer.from(image, 'base64')));
  const albedo = meansOf(color, linear);
  // Edges are worn, hollows are darker, and beds have their colours: the mean is that of the stone nevertheless.
  for (const [channel, value] of albedo.entries()) assert.ok(Math.abs(value / SANDSTONE[channel] - 1) < 0.15, `albedo ${albedo}`);
  const [right, up, out] = meansOf(normal);
  assert.ok(Math.abs(right - 0.5) < 0.03 && Math.abs(up - 0.5) < 0.03 && out > 0.9, `normal ${[right, up, out]}`);
  const [open, rough, metal] = meansOf(surface);
  assert.ok(open > 0.3 && open < 0.95 && Math.abs(rough - 0.82) < 0.02 && metal === 0, `surface ${[open, rough, metal]}`);
  // Every texel has something in it, also between the rocks.
  assert.ok(color.data.every((byte) => byte > 0));
  assert.deepEqual(errors, []);
  await close();
});
