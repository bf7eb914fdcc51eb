// How well a scene is drawn, by what its frames took: the rule, and the frames that the rule asks for.
import assert from 'node:assert/strict';
import { afterEach, beforeEach, test } from 'node:test';
import { FramePacer } from '../../www/scene/frame-pacer.ts';
import { AutoQuality } from '../../www/renderer/quality.ts';
import type { Quality } from '../../www/base/view.ts';

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

test('it begins in the middle, with stills at their best', () => {
  const auto = new AutoQuality();
  assert.deepEqual([auto.moving, auto.still], ['medium', 'high']);
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

test('stills go down when two in a row hang the page, and never below what moves', () => {
  const auto = new AutoQuality();
  auto.stillTook(3000);
  auto.stillTook(300);
  auto.stillTook(3000);
  assert.equal(auto.still, 'high', 'one alone made its pipelines');
  auto.stillTook(3000);
  assert.equal(auto.still, 'medium');
  for (let still = 0; still < 9; still += 1) auto.stillTook(3000);
  assert.equal(auto.still, 'medium', 'medium still moves');
  move(auto, 20, { low: 60, medium: 60, high: 60 });
  assert.equal(auto.still, 'low');
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

function setUp({ graded = true, moves = 0 } = {}) {
  const drawn: (Quality | null)[] = [];
  const scene = { visible: true, graded, moves };
  const pacer = new FramePacer({
    view: () => globalThis as unknown as Window,
    canDraw: () => scene.visible,
    isGraded: () => scene.graded,
    advance: () => {
      scene.moves -= 1;
      return scene.moves >= 0;
    },
    draw: (level) => void drawn.push(level),
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

test('a still that twice took long is not drawn again', ({ mock }) => {
  const { drawn, pacer } = setUp();
  const clocked = mock.method(performance, 'now', () => clock);
  for (let motion = 0; motion < 3; motion += 1) {
    pacer.invalidate();
    present();
    mock.timers.tick(150);
    present();
    present(700);
    present(700);
  }
  clocked.mock.restore();
  assert.deepEqual(drawn, ['medium', 'high', 'medium', 'high', 'medium']);
});
