// How well a scene is drawn, by what its frames took: the rule, and the frames that the rule asks for.
import assert from 'node:assert/strict';
import { afterEach, beforeEach, test } from 'node:test';
import { FramePacer } from '../../www/scene/frame-pacer.ts';
import { AutoQuality } from '../../www/renderer/quality.ts';
import type { Pieces } from '../../www/renderer/renderer.ts';
import { CutPictures } from '../../www/scene/cut-pictures.ts';
import type { Quality } from '../../www/base/view.ts';

const STAGE = [800, 600] as const;

/** A motion of frames that take as long as the level's entry says, and its levels in the order they came. */
function move(auto: AutoQuality, frames: number, ms: Record<Quality, number>, from = 0): { levels: Quality[]; end: number } {
  const levels: Quality[] = [auto.moving];
  let now = from;
  for (let frame = 0; frame < frames; frame += 1) {
    auto.frame(now);
    if (auto.moving !== levels.at(-1)) levels.push(auto.moving);
    now += ms[auto.moving];
  }
  return { levels, end: now };
}

test('it begins in the middle, or where it is told to', () => {
  assert.deepEqual([new AutoQuality().moving, new AutoQuality('low').moving], ['medium', 'low']);
});

test('a motion that does not flow goes down, each step on evidence of its own', () => {
  const auto = new AutoQuality();
  assert.deepEqual(move(auto, 8, { low: 12, medium: 40, high: 90 }).levels, ['medium', 'low']);
  const slow = new AutoQuality();
  assert.deepEqual(move(slow, 7, { low: 60, medium: 60, high: 60 }).levels, ['medium'], 'seven frames have six intervals');
  assert.deepEqual(move(slow, 30, { low: 60, medium: 60, high: 60 }, 420).levels, ['medium', 'low'], 'there is nothing below the lowest');
});

test('a few late frames are no slow motion', () => {
  const auto = new AutoQuality();
  for (let frame = 0, now = 0; frame < 60; frame += 1) {
    now += frame % 3 === 0 ? 80 : 16.7;
    auto.frame(now);
    assert.equal(auto.moving, 'medium');
  }
});

test('a motion that flows goes up, on a screen of 60 Hz and on a faster one', () => {
  for (const ms of [16.7, 8.3]) {
    const auto = new AutoQuality();
    assert.deepEqual(move(auto, 40, { low: ms, medium: ms, high: ms }).levels, ['medium']);
    assert.deepEqual(move(auto, 60, { low: ms, medium: ms, high: ms }, 1000).levels, ['medium', 'high']);
  }
});

test('between 19 and 25 ms nothing changes', () => {
  assert.deepEqual(move(new AutoQuality(), 500, { low: 10, medium: 22, high: 40 }).levels, ['medium']);
});

test('a level that did not flow is tried again, at longer and longer intervals', () => {
  const auto = new AutoQuality();
  const times: number[] = [];
  let before: Quality = auto.moving;
  for (let now = 0; now < 120_000; now += auto.moving === 'high' ? 40 : 16) {
    auto.frame(now);
    if (auto.moving === 'high' && before !== 'high') times.push(now);
    before = auto.moving;
  }
  const waits = times.slice(1).map((time, index) => time - times[index]!);
  assert(times.length >= 4 && times.length <= 6, times.join(', '));
  waits.forEach((wait, index) => assert(wait >= 4000 * 2 ** index && wait < 4000 * 2 ** index + 1500, waits.join(', ')));
});

test('a pause is no interval', () => {
  const auto = new AutoQuality();
  for (let now = 0; now < 60_000; now += 2000) {
    auto.frame(now);
    auto.frame(now + 17);
    auto.rest();
  }
  assert.equal(auto.moving, 'medium');
});

// The frames, with a clock and a screen of our own.

let frames: FrameRequestCallback[] = [];
let clock = 0;
const real = { request: globalThis.requestAnimationFrame, cancel: globalThis.cancelAnimationFrame };

beforeEach((context) => {
  frames = [];
  clock = 0;
  globalThis.requestAnimationFrame = (callback) => frames.push(callback);
  globalThis.cancelAnimationFrame = (handle) => {
    frames[handle - 1] = () => {};
  };
  if ('mock' in context) context.mock.timers.enable({ apis: ['setTimeout'] });
});

afterEach(() => {
  globalThis.requestAnimationFrame = real.request;
  globalThis.cancelAnimationFrame = real.cancel;
});

/** The screen asks for its next picture. */
function present(ms = 16): void {
  clock += ms;
  const due = frames;
  frames = [];
  for (const callback of due) callback(clock);
}

function setUp({ graded = true, moves = 0, pieces = undefined as Pieces | undefined } = {}) {
  const drawn: (Quality | null)[] = [];
  const scene = { visible: true, graded, moves, level: null as Quality | null, error: null as unknown };
  const pacer = new FramePacer({
    view: () => globalThis as unknown as Window,
    canDraw: () => scene.visible,
    isGraded: () => scene.graded,
    advance: () => {
      scene.moves -= 1;
      return scene.moves >= 0;
    },
    draw: (level) => void drawn.push(level),
    pieces: () => pieces && { pieces, size: STAGE },
    prepare: (level) => {
      scene.level = level;
      return (show) => {
        try {
          show();
        } catch (thrown) {
          scene.error = thrown;
        }
      };
    },
  });
  return { drawn, scene, pacer };
}

test('one picture, and 150 ms later the still; then nothing', ({ mock }) => {
  const { drawn, pacer } = setUp();
  pacer.invalidate();
  pacer.invalidate();
  present();
  assert.deepEqual(drawn, ['medium']);
  mock.timers.tick(149);
  assert.deepEqual(frames, []);
  mock.timers.tick(1);
  present();
  assert.deepEqual(drawn, ['medium', 'high']);
  // Two empty frames tell what the still took.
  for (let frame = 0; frame < 5; frame += 1) present();
  mock.timers.tick(1000);
  assert.deepEqual([drawn.length, frames.length], [2, 0]);
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

test('what the pointer did while the GPU was busy comes with the frame, and is no rest', ({ mock }) => {
  const { drawn, pacer } = setUp();
  pacer.invalidate();
  present();
  for (let move = 0; move < 8; move += 1) {
    mock.timers.tick(900);
    pacer.invalidate();
    present(900);
  }
  assert.deepEqual(drawn, [...Array(7).fill('medium'), 'low', 'low'], 'such frames count as slow');
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

// Pictures in pieces, on a device of our own: it draws so many pixels in a millisecond.

class Device implements Pieces {
  /** What was shown, one line each: its size, and `rough` if it was so. */
  readonly shown: string[] = [];
  readonly pieces: number[] = [];
  begun = 0;
  width = 0;
  #picture = '';
  #left = 0;
  #under: { pixels: number }[] = [];
  readonly #speed: number;

  constructor(speed: number) {
    this.#speed = speed;
  }

  begin(width: number, height: number, isRough: boolean): void {
    this.begun += 1;
    this.width = width;
    this.#picture = `${width}×${height}${isRough ? ' rough' : ''}`;
    this.#left = width * height;
    this.#under = [];
  }

  draw(pixels: number): boolean {
    const size = Math.min(pixels, this.#left);
    this.#left -= size;
    this.pieces.push(size);
    this.#under.push({ pixels: size });
    return this.#left > 0;
  }

  underWay(): number {
    return this.#under.length;
  }

  show(): void {
    this.shown.push(this.#picture);
  }

  end(): void {}

  pass(ms: number): void {
    let pixels = ms * this.#speed;
    for (const piece of this.#under) {
      const done = Math.min(pixels, piece.pixels);
      piece.pixels -= done;
      pixels -= done;
    }
    this.#under = this.#under.filter((piece) => piece.pixels > 0);
  }
}

type Mock = { timers: { tick(ms: number): void }; method: typeof import('node:test').mock.method };

/** The time goes on, in steps of a screen's frames. */
async function pass(mock: Mock, device: Device, ms: number): Promise<void> {
  for (let at = 0; at < ms; at += 4) {
    mock.timers.tick(4);
    clock += 4;
    device.pass(4);
    if (at % 16 === 0) present(0);
    await settled();
  }
}

/** What waits for nothing but promises, and scripts that are imported, is done. */
async function settled(): Promise<void> {
  for (let k = 0; k < 4; k += 1) await new Promise((resolve) => setImmediate(resolve));
}

const SWIFTSHADER = 'webgl ANGLE (Google, Vulkan 1.3.0 (SwiftShader Device (Subzero)), SwiftShader driver)';

async function setUpSoftware(mock: Mock, speed: number) {
  mock.method(performance, 'now', () => clock);
  const device = new Device(speed);
  const set = setUp({ pieces: device });
  set.pacer.renew(SWIFTSHADER);
  await settled();
  return { ...set, device };
}

test('on a software GPU a motion is small and low, and then there is a whole picture, and the best one, and nothing', async ({ mock }) => {
  const { device, drawn, pacer, scene } = await setUpSoftware(mock, 1000);
  pacer.invalidate();
  await pass(mock, device, 100);
  assert.deepEqual([device.shown, scene.level], [['179×134 rough'], 'low']);
  await pass(mock, device, 5000);
  assert.deepEqual([device.shown, scene.level], [['179×134 rough', '800×600 rough', '800×600'], 'high']);
  const { begun } = device;
  await pass(mock, device, 1000);
  assert.deepEqual([device.begun, frames.length, drawn], [begun, 0, []]);
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
  assert.deepEqual([device.begun, frames.length], [3, 0], 'one of a motion and two stills');
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
  mock.method(performance, 'now', () => clock);
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

test('a piece of a still takes the device some 30 ms, whatever it is', async ({ mock }) => {
  mock.method(performance, 'now', () => clock);
  for (const speed of [200, 1000, 5000]) {
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
