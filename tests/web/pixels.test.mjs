// What stored and drawn pictures are compared with: what a device may do differently passes, and what is planted is found.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { PNG } from 'pngjs';
import { asPicture, asText, changedShare, meanDifference, readPicture, tiles } from '../../scripts/lib/pixels.mjs';

const stored = JSON.parse(readFileSync(new URL('../data/natural-golden.json', import.meta.url), 'utf8'));

/** A small picture of every natural preset, as it is stored. */
const pictures = new Map(Object.entries(stored).map(([name, rows]) => [name, asPicture(rows, 32, 20)]));

/**
 * The same picture with other colours.
 *
 * @param {import('../../scripts/lib/pixels.mjs').Picture} picture
 * @param {(value: number, channel: number, pixel: number) => number} change
 */
const changed = ({ width, height, data }, change) => ({
  width,
  height,
  data: data.map((value, at) => (at % 4 === 3 ? value : change(value, at % 4, at >> 2))),
});

test('a picture survives a PNG file of either kind, and being stored as text', () => {
  for (const [name, { width, height, data }] of pictures) {
    const png = Object.assign(new PNG({ width, height }), { data: Buffer.from(data) });
    for (const colorType of /** @type {const} */ ([2, 6])) {
      const read = readPicture(PNG.sync.write(png, { colorType }));
      assert.deepEqual([read.width, read.height, [...read.data]], [32, 20, [...data]], name);
    }
    assert.deepEqual(asText({ width, height, data }), stored[name]);
  }
});

test('another light, another colour and a part that is missing are farther from what is stored than devices may be', () => {
  for (const [name, picture] of pictures) {
    assert.equal(meanDifference(picture, picture), 0);
    const planted = {
      darker: changed(picture, (value) => 0.9 * value),
      bluer: changed(picture, (value, channel) => (channel === 2 ? Math.min(255, value + 30) : value)),
      halved: changed(picture, (value, _, pixel) => (pixel < 320 ? value : 255)),
    };
    for (const [what, other] of Object.entries(planted)) {
      const apart = meanDifference(other, picture);
      assert(apart > 2, `${name}, ${what}: ${apart} %`);
    }
  }
});

test('noise of a device changes no pixel, a rock that is elsewhere changes its own', () => {
  const [picture] = pictures.values();
  const noisy = changed(picture, (value, channel, pixel) => value + ((pixel + channel) % 3));
  assert.equal(changedShare(picture, noisy), 0);
  const moved = changed(picture, (value, _, pixel) => (pixel % 32 < 8 ? (value + 128) % 256 : value));
  assert.equal(changedShare(picture, moved, { x: 0, y: 0, width: 16, height: 20 }), 0.5);
  assert.equal(changedShare(picture, moved, { x: 8, y: 5, width: 8, height: 10 }), 0);
});

test('pictures of different sizes are not compared', () => {
  const [picture] = pictures.values();
  assert.throws(() => meanDifference(picture, tiles(picture, 16, 20)), /32 × 20 pixels cannot be compared with 16 × 20/);
  assert.throws(() => changedShare(tiles(picture, 32, 10), picture), /cannot be compared/);
  assert.throws(() => asPicture(undefined, 32, 20), /UPDATE=1/);
});

test('a tile is the mean of its pixels', () => {
  const data = Uint8Array.from([10, 20, 30, 255, 30, 40, 50, 255, 100, 0, 0, 255, 0, 0, 0, 255]);
  assert.deepEqual([...tiles({ width: 2, height: 2, data }, 1, 2).data], [20, 30, 40, 255, 50, 0, 0, 255]);
});
