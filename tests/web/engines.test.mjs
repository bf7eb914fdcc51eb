// What the tests of the engines are made of: saying what two pictures have in common, talking to Firefox.
import assert from 'node:assert/strict';
import { EventEmitter } from 'node:events';
import { test } from 'node:test';
import { marionette } from '../engines/firefox.mjs';
import { differences, faults, statistics } from '../engines/statistics.mjs';

const WHITE = [255, 255, 255];
const STONE = [
  [176, 108, 90],
  [198, 165, 106],
  [112, 138, 155],
];
const SKY = [200, 209, 217];

/** 40 × 40 pixels in a page two pixels larger on every side: a band of sky, then one per layer, each in many shades. */
function painting(shift = (color, _row, _column) => color) {
  const side = 44;
  const data = new Uint8Array(side * side * 4).fill(255);
  for (let row = 0; row < 40; row += 1) {
    for (let column = 0; column < 40; column += 1) {
      const band = [SKY, ...STONE][Math.floor(row / 10)];
      const shade = band === SKY ? 1 : 0.6 + column / 100;
      data.set(
        shift(
          band.map((value) => Math.round(value * shade)),
          row,
          column,
        ),
        4 * ((row + 2) * side + column + 2),
      );
    }
  }
  return { width: side, height: side, data };
}

/** A picture from its last pixel to its first. */
const turnedByHalf = (data) => new Uint8Array(new Uint32Array(data.buffer).reverse().buffer);

const BOX = { x: 2, y: 2, width: 40, height: 40 };
const seen = (shift) => statistics(painting(shift), BOX, WHITE);

test('layers are told apart by hue in light and shade, and the sky is none', () => {
  const { covered, layers, quarters } = seen();
  assert.equal(covered, 1);
  assert.deepEqual(
    layers.map(({ share }) => share),
    [0.25, 0.25, 0.25],
  );
  assert(Math.abs(layers[0].mean[0] - 176 * 0.795) < 1);
  assert(quarters[0][2] > quarters[2][0], 'sky above, stone below');
});

test('a picture that is blank, or of one layer, has faults', () => {
  const blank = faults(seen(() => WHITE));
  assert.match(blank[0], /only 0\.00 % of the element/);
  assert.equal(blank.length, 5);
  const one = faults({ ...seen(), colors: 1000, layers: [{ share: 0.5 }, { share: 0 }, { share: 0.1 }] });
  assert.deepEqual(one, ['rocks of layer 1 take only 0.00 % of it']);
});

test('pictures may differ as devices do, and no more', () => {
  const own = seen();
  assert.deepEqual(differences(own, own), []);
  const noisy = seen((color, row, column) => color.map((value) => value + ((row + column) % 3) - 1));
  assert.deepEqual(differences(own, { ...noisy, colors: own.colors }), []);
  const gamma = seen((color) => color.map((value) => Math.round(255 * (value / 255) ** 0.8)));
  assert(differences(own, gamma).some((text) => /mean colour of layer 0: rgb\(.+\) and rgb\(.+\)/.test(text)));
  const turned = statistics({ ...painting(), data: turnedByHalf(painting().data) }, BOX, WHITE);
  assert(differences(own, turned).some((text) => text.startsWith('mean colour of quarter 0')));
  const emptier = seen((color, row) => (row < 3 ? WHITE : color));
  assert(differences(own, emptier).some((text) => text.startsWith('covered: 100.00 % and 92.50 %')));
});

/** A socket that keeps what is written. */
class Socket extends EventEmitter {
  written = [];
  write(text) {
    this.written.push(text);
  }
}

test('answers of Firefox find their questions, however the bytes arrive', async () => {
  const socket = new Socket();
  const send = marionette(socket);
  const first = send('WebDriver:ExecuteScript', { script: '"岩"' });
  const second = send('WebDriver:Navigate', {});
  // Its length counts bytes, not characters.
  const [length, ...rest] = socket.written[0].split(':');
  assert.equal(Number(length), Buffer.byteLength(rest.join(':')));
  assert.deepEqual(JSON.parse(rest.join(':')), [0, 1, 'WebDriver:ExecuteScript', { script: '"岩"' }]);
  const frame = (message) => `${Buffer.byteLength(JSON.stringify(message))}:${JSON.stringify(message)}`;
  const bytes = Buffer.from(
    frame({ marionetteProtocol: 3 }) +
      frame([1, 2, { error: 'timeout', message: 'too late' }, null]) +
      frame([1, 1, null, { value: '岩' }]),
  );
  for (const byte of bytes) socket.emit('data', Buffer.from([byte]));
  await assert.rejects(second, /timeout: too late/);
  assert.deepEqual(await first, { value: '岩' });
  const third = send('WebDriver:TakeScreenshot', {});
  socket.emit('close', false);
  await assert.rejects(third, /Firefox is gone/);
});
