// The frames that a scene is drawn in: when, how well, and in what pieces.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { CutPictures } from '../../www/scene/cut-pictures.ts';
import { Device, pass, present, screen, settled, setUp, setUpSoftware, STAGE } from './fake-screen.ts';
import type { Mock } from './fake-screen.ts';

test('one picture, and 150 ms later the still; then nothing', ({ mock }) => {
  const { drawn, pacer } = setUp();
  pacer.invalidate();
  pacer.invalidate();
  present();
  assert.deepEqual(drawn, ['medium']);
  mock.timers.tick(149);
  assert.deepEqual(screen.frames, []);
  mock.timers.tick(1);
  present();
  assert.deepEqual(drawn, ['medium', 'high']);
  // Two empty frames tell what the still took.
  for (let frame = 0; frame < 5; frame += 1) present();
  mock.timers.tick(1000);
  assert.deepEqual([drawn.length, screen.frames.length], [2, 0]);
});

test('a motion is drawn as it flows, and the still waits for its end', ({ mock }) => {
  const { drawn, pacer } = setUp({ moves: 5 });
  pacer.invalidate();
  for (let frame = 0; frame < 6; frame += 1) {
    present();
    mock.timers.tick(100);
  }
  mock.timers.tick(150);
  present();
  assert.deepEqual(drawn, [...Array(6).fill('medium'), 'high']);
});

test('what the pointer did while the GPU was busy comes with the frame, and is no rest', async ({ mock }) => {
  const { drawn, pacer } = setUp();
  pacer.invalidate();
  present();
  await settled();
  for (let move = 0; move < 8; move += 1) {
    mock.timers.tick(900);
    pacer.invalidate();
    present(900);
  }
  assert.deepEqual(drawn, [...Array(8).fill('medium'), 'low'], 'such frames count as slow');
});

test('a named quality is drawn as it is, without a second picture', ({ mock }) => {
  const { drawn, pacer } = setUp();
  pacer.wanted = 'low';
  present();
  mock.timers.tick(1000);
  present();
  assert.deepEqual([drawn, pacer.best], [['low'], 'low']);
  pacer.wanted = 'auto';
  assert.equal(pacer.best, 'high');
});

test('where quality makes no difference there is one picture and no level', ({ mock }) => {
  const { drawn, pacer } = setUp({ graded: false });
  pacer.invalidate();
  present();
  mock.timers.tick(1000);
  present();
  assert.deepEqual([drawn, pacer.best], [[null], null]);
});

test('out of sight nothing is drawn, and back in sight what was missing is', ({ mock }) => {
  const { drawn, scene, pacer } = setUp();
  pacer.invalidate();
  present();
  scene.visible = false;
  mock.timers.tick(150);
  present();
  assert.deepEqual(drawn, ['medium']);
  scene.visible = true;
  pacer.look(false);
  present();
  mock.timers.tick(150);
  present();
  assert.deepEqual(drawn, ['medium', 'medium', 'high']);
});

test('a size that changes within a motion does not end it', () => {
  const { drawn, pacer } = setUp({ moves: 3 });
  pacer.invalidate();
  present();
  pacer.drawNow();
  present();
  assert.equal(drawn.length, 3);
});

test('a picture that was taken gives the screen its own back, by the frame that comes anyway if there is one', ({ mock }) => {
  const { drawn, scene, pacer } = setUp();
  pacer.invalidate();
  pacer.redraw();
  assert.deepEqual(drawn, []);
  present();
  mock.timers.tick(150);
  present();
  pacer.redraw();
  assert.deepEqual(drawn, ['medium', 'high', 'high']);
  scene.visible = false;
  pacer.redraw();
  scene.visible = true;
  pacer.look(false);
  present();
  assert.equal(drawn.length, 4, 'what could not be drawn is drawn later');
});

test('on a software GPU a motion is small and low, and then there is a whole picture, and the best one, and nothing', async ({ mock }) => {
  const { device, drawn, pacer, scene } = await setUpSoftware(mock, 1000);
  pacer.invalidate();
  await pass(mock, device, 100);
  assert.deepEqual([device.shown, scene.level], [['179×134 rough'], 'low']);
  await pass(mock, device, 5000);
  assert.deepEqual([device.shown, scene.level], [['179×134 rough', '800×600 rough', '800×600'], 'high']);
  const { begun } = device;
  await pass(mock, device, 1000);
  assert.deepEqual([device.begun, screen.frames.length, drawn], [begun, 0, []]);
});

test('where quality makes no difference, the whole picture is the best one', async ({ mock }) => {
  const { device, pacer, scene } = await setUpSoftware(mock, 1000);
  scene.graded = false;
  pacer.invalidate();
  await pass(mock, device, 4000);
  assert.deepEqual([device.shown, scene.level], [['179×134 rough', '800×600'], null]);
});

test('a touch ends a still at once, and is answered by a small picture', async ({ mock }) => {
  const { device, pacer } = await setUpSoftware(mock, 100);
  pacer.invalidate();
  await pass(mock, device, 2000);
  const { shown, begun } = device;
  assert.deepEqual(shown, ['179×134 rough']);
  assert.equal(begun, 2, 'the still is under way');
  pacer.invalidate();
  await pass(mock, device, 24);
  assert.equal(device.begun, 3);
  await pass(mock, device, 400);
  assert.deepEqual(device.shown, ['179×134 rough', '179×134 rough']);
});

test('a still that nobody wants any more keeps no other waiting, though its window has no more frames', async ({ mock }) => {
  const still = { size: STAGE, isMoving: false, isRough: true, prepare: () => {} };
  const closed = { requestAnimationFrame: () => 0 } as unknown as Window;
  let isClosed = false;
  void new CutPictures(0).draw({ ...still, pieces: new Device(1000), view: closed, isOver: () => isClosed }, 'low');
  const device = new Device(1000);
  const view = globalThis as unknown as Window;
  let isDone = false;
  void new CutPictures(0).draw({ ...still, pieces: device, view, isOver: () => false }, 'low').then(() => (isDone = true));
  await pass(mock, device, 2000);
  assert.deepEqual([device.pieces, isDone], [[], false]);
  isClosed = true;
  await pass(mock, device, 2000);
  assert.equal(isDone, true);
});

test('the pictures of a motion follow each other, and each is shown', async ({ mock }) => {
  const { device, pacer } = await setUpSoftware(mock, 1000);
  for (let move = 0; move < 60; move += 1) {
    pacer.invalidate();
    await pass(mock, device, 16);
  }
  assert(device.shown.length > 15, String(device.shown.length));
  assert(device.begun - device.shown.length <= 1);
});

test('a quality that is named is drawn at that quality, whatever its size', async ({ mock }) => {
  const { device, pacer, scene } = await setUpSoftware(mock, 1000);
  pacer.wanted = 'medium';
  await pass(mock, device, 100);
  assert.deepEqual([device.shown.at(-1), scene.level], ['179×134 rough', 'medium']);
  await pass(mock, device, 5000);
  assert.deepEqual([device.shown.at(-1), scene.level], ['800×600', 'medium']);
});

test('a picture that cannot be drawn in pieces is told, and not tried again and again', async ({ mock }) => {
  const { device, pacer, scene } = await setUpSoftware(mock, 1000);
  mock.method(device, 'begin', () => {
    device.begun += 1;
    throw new Error('no memory');
  });
  pacer.invalidate();
  await pass(mock, device, 2000);
  assert.match(String(scene.error), /no memory/);
  assert.deepEqual([device.begun, screen.frames.length], [3, 0], 'one of a motion and two stills');
});

test('what gives light to a still is drawn before its pieces, and as they are: no more than two at a time', async ({ mock }) => {
  const device = new Device(1000);
  device.lights = 9;
  let piecesWithoutLight = 0;
  const { draw } = device;
  mock.method(device, 'draw', (pixels: number) => {
    if (device.lights > 0) piecesWithoutLight += 1;
    return draw.call(device, pixels);
  });
  const view = globalThis as unknown as Window;
  const cut = new CutPictures(0);
  const picture = { pieces: device, view, size: STAGE, isMoving: false, isRough: true, prepare: () => {}, isOver: () => false };
  let isDone = false;
  void cut.draw(picture, 'low').then((isWhole) => (isDone = isWhole));
  for (let k = 0; k < 200 && !isDone; k += 1) await pass(mock, device, 16);
  assert.deepEqual([isDone, device.lights, piecesWithoutLight, device.most], [true, 0, 0, 2]);
});

async function motion(cut: CutPictures, device: Device, mock: Mock, pictures: number): Promise<void> {
  for (let k = 0; k < pictures; k += 1) {
    const picture = { pieces: device, view: globalThis as unknown as Window, size: STAGE, isMoving: true, isRough: false };
    const done = cut.draw({ ...picture, prepare: () => {}, isOver: () => false }, 'low');
    let isDone = false;
    void done.then(() => (isDone = true));
    while (!isDone) await pass(mock, device, 4);
    device.show();
  }
}

test('the size of a motion is what the device draws in time, and never less than a fifth of the side', async ({ mock }) => {
  mock.method(performance, 'now', () => screen.clock);
  for (const [speed, least, most] of [
    [100, 0.2, 0.2],
    [1000, 0.3, 0.5],
    [3000, 0.5, 0.9],
    [100_000, 1, 1],
  ] as const) {
    const cut = new CutPictures(0);
    const device = new Device(speed);
    await motion(cut, device, mock, 12);
    const scale = device.width / STAGE[0];
    assert(scale >= least && scale <= most, `${speed}: ${scale}`);
    assert.equal(cut.isNeedless, speed === 100_000);
  }
});

test('a piece of a still takes the device some 40 ms, unless it draws less than 300 pixels a ms', async ({ mock }) => {
  mock.method(performance, 'now', () => screen.clock);
  for (const speed of [300, 1000, 5000]) {
    const device = new Device(speed);
    const cut = new CutPictures(0);
    const size = [2000, 2000] as const;
    const picture = { pieces: device, view: globalThis as unknown as Window, size, isMoving: false, isRough: false };
    let isDone = false;
    void cut.draw({ ...picture, prepare: () => {}, isOver: () => isDone }, 'high').then(() => (isDone = true));
    for (let k = 0; k < 120 && !isDone; k += 1) await pass(mock, device, 16);
    isDone = true;
    const [typical] = device.pieces
      .slice(-20, -1)
      .sort((a, b) => a - b)
      .slice(9);
    assert(typical! / speed > 8 && typical! / speed < 50, `${speed} pixels a ms: ${typical! / speed} ms`);
  }
});
