// Walking at eye height: how high somebody stands, where they can go, and how a walk begins and ends.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { CameraState } from '../../www/base/view.ts';
import type { Field } from '../../www/data/field.ts';
import { cameraAxes } from '../../www/scene/camera/camera.ts';
import { CameraFlight } from '../../www/scene/camera/flight.ts';
import { Footing } from '../../www/scene/camera/footing.ts';
import type { Steered } from '../../www/scene/camera/steered.ts';
import { Walk } from '../../www/scene/camera/walk.ts';
import { eyeHeight, Walker } from '../../www/scene/camera/walker.ts';

const EYE = 160;

/** Pyramids on a field of 640 × 480 px: middle, half a side, height. */
const ROCKS = [
  [200, 200, 70, 120],
  [420, 300, 30, 60],
  [630, 470, 40, 90],
  [500, 100, 8, 12],
] as const;

const FIELD = fieldOf(ROCKS);

function fieldOf(rocks: readonly (readonly [number, number, number, number])[]): Field {
  const positions = rocks.flatMap(([x, y, half, top]) => [
    ...[x - half, y - half, 0, x + half, y - half, 0, x + half, y + half, 0, x - half, y + half, 0],
    ...[x, y, top],
  ]);
  const indices = rocks.flatMap((_, k) => [0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4].map((at) => 5 * k + at));
  return { imageWidth: 640, imageHeight: 480, positions: Float32Array.from(positions), indices: Uint32Array.from(indices) } as Field;
}

/** Of the rocks, px. */
function heightAt(x: number, y: number): number {
  return Math.max(0, ...ROCKS.map(([mx, my, half, top]) => top * (1 - Math.max(Math.abs(x - mx), Math.abs(y - my)) / half)));
}

test('whoever stands on rocks has their feet in none, is raised by no pebble, and comes to no step', () => {
  const footing = new Footing(FIELD, EYE);
  for (let y = -40; y <= 520; y += 7) {
    for (let x = -40; x <= 680; x += 7) {
      const isPebble = Math.hypot(x - 500, y - 100) < 20;
      const feet = footing.at(x, y);
      if (isPebble) assert.equal(feet, 0, `raised by a pebble at ${x}, ${y}`);
      else assert(feet >= heightAt(x, y) - 1e-3, `${feet} at ${x}, ${y}, in a rock of ${heightAt(x, y)}`);
      assert(feet <= 120 + 1e-3);
      const slope = Math.abs(footing.at(x + 1, y) - feet);
      assert(slope < 4, `a step of ${slope} at ${x}, ${y}`);
    }
  }
  assert.equal(footing.at(40, 440), 0, 'bare ground');
  assert.equal(footing.at(-1e6, 1e6), 0, 'beyond everything');
});

test('the eye is 1.6 m high, and on very small and very large fields as high as shows them', () => {
  assert.equal(eyeHeight([640, 640], 0.01), 160);
  assert.equal(eyeHeight([1024, 800], 0.02), 80);
  assert.equal(eyeHeight([640, 400], 1e-4), 120);
  assert.equal(eyeHeight([1024, 2000], 1), 5.12);
});

const FROM: CameraState = { azimuth: 0.7, elevation: 0.6, distance: 900, target: [320, 240, 0], fov: 50 };
const grounds = (footing = { at: (_x: number, _y: number) => 0 }) => ({ extent: [640, 480] as const, metresPerPixel: 0.01, footing });

function eyeOf(walker: Walker): [number, number, number] {
  return cameraAxes(walker.camera).eye;
}

test('the eye stays where somebody stands, whichever way they look, and looks neither straight up nor down', () => {
  const walker = new Walker(FROM, grounds({ at: () => 25 }));
  const [x, y, z] = eyeOf(walker);
  assert(Math.abs(z - (25 + walker.eye)) < 1e-9);
  for (const [left, down] of [
    [0.3, 0.2],
    [-7, 9],
    [100, -9],
  ] as const) {
    walker.look(left, down);
    const now = eyeOf(walker);
    assert(Math.hypot(now[0] - x, now[1] - y, now[2] - z) < 1e-6);
    assert(Math.abs(walker.camera.elevation) < 1.4);
  }
  assert.equal(walker.camera.fov, 50);
});

test('nobody leaves the field by more than its margin, however far they go', () => {
  const walker = new Walker({ ...FROM, distance: 1e6 }, grounds());
  for (let step = 0; step < 50; step += 1) {
    walker.go(step % 7 === 0 ? 1e9 : 333, step % 3 === 0 ? -1e9 : 77);
    walker.look(step, 0);
    const [x, y] = eyeOf(walker);
    assert(x >= -48.001 && x <= 688.001 && y >= -48.001 && y <= 528.001, `${x}, ${y}`);
  }
});

test('ahead is where the camera looks, and the way to a place leads there', () => {
  const walker = new Walker({ ...FROM, azimuth: 0, elevation: 0.1, distance: 1, target: [300, 200, 0] }, grounds());
  const [x, y] = eyeOf(walker);
  walker.go(30, 10);
  const there = eyeOf(walker);
  assert(Math.hypot(there[0] - x - 10, there[1] - y - 30) < 1e-9, 'at azimuth 0 +y is ahead, and +x to the right');
  walker.look(2, 0);
  walker.go(...walker.wayTo(123, 234));
  assert(Math.hypot(eyeOf(walker)[0] - 123, eyeOf(walker)[1] - 234) < 1e-9);
});

/** A scene without a browser: as much of it as a walk sees. */
class Scene extends EventTarget {
  style = { touchAction: 'pan-y' };
  clientHeight = 400;
  clientWidth = 600;
  now: CameraState = FROM;
  framed = false;
  left = 0;
  moves = 0;
  hints: string[] = [];
  readonly isStill: boolean;

  constructor(isStill = false) {
    super();
    this.isStill = isStill;
  }

  focus(): void {}
  setAttribute(): void {}
  removeAttribute(): void {}
  hasPointerCapture(): boolean {
    return false;
  }

  get steered(): Steered {
    const view = { navigator: {}, matchMedia: (query: string) => ({ matches: this.isStill && query.includes('reduced-motion') }) };
    return {
      tree: { stage: this, hint: (text: string) => this.hints.push(text) },
      language: () => 'en',
      view: () => view,
      camera: () => structuredClone(this.now),
      move: (camera: CameraState | null) => {
        this.now = camera ?? { ...FROM, azimuth: 9 };
      },
      moved: () => (this.moves += 1),
      invalidate() {},
      isFramed: () => this.framed,
      interaction: () => 'cooperative',
      leave: () => (this.left += 1),
      field: () => FIELD,
      metresPerPixel: () => 0.01,
    } as unknown as Steered;
  }

  key(type: 'keydown' | 'keyup', code: string, key = code): Event {
    const event = Object.assign(new Event(type, { cancelable: true }), { code, key });
    this.dispatchEvent(event);
    return event;
  }

  get eye(): [number, number, number] {
    return cameraAxes(this.now).eye;
  }
}

function walkIn(scene: Scene): { walk: Walk; frame: (ms?: number) => boolean } {
  let now = 0;
  const walk = new Walk(scene.steered, FIELD, (from, to) => new CameraFlight(from, to, now));
  const frame = (ms = 16): boolean => {
    now += ms;
    return walk.advance(now);
  };
  return { walk, frame };
}

test('a walk flies to the ground, goes while a key is held, rests without frames, and flies back to the very camera of before', () => {
  const scene = new Scene();
  const { walk, frame } = walkIn(scene);
  assert.equal(scene.hints.length, 1);
  assert(frame(100), 'on the way');
  assert(scene.eye[2] > 200);
  frame(2000);
  assert(scene.eye[2] > 143.9 && scene.eye[2] < 270, `at eye height: ${scene.eye[2]}`);
  assert.equal(frame(), false, 'no frames while nobody moves');
  const start = scene.eye;
  assert(scene.key('keydown', 'KeyW').defaultPrevented);
  frame();
  for (let k = 0; k < 10; k += 1) assert(frame(50));
  scene.key('keyup', 'KeyW');
  const gone = Math.hypot(scene.eye[0] - start[0], scene.eye[1] - start[1]);
  assert(gone > 50 && gone < 90, `half a second of walking goes ${gone} px`);
  frame();
  assert.equal(frame(), false);
  assert.equal(scene.key('keydown', 'KeyX').defaultPrevented, false, 'other keys are the page’s');
  scene.key('keydown', 'Escape');
  assert.equal(scene.left, 1);
  walk.end();
  assert(frame(100) && !walk.isOver);
  frame(2000);
  assert(walk.isOver);
  assert.deepEqual(scene.now, FROM);
  assert.equal(scene.style.touchAction, 'pan-y');
  assert.equal(scene.key('keydown', 'KeyW').defaultPrevented, false, 'its keys are not heard any more');
});

test('where the system asks for less motion there is no flight', () => {
  const scene = new Scene(true);
  const { walk, frame } = walkIn(scene);
  assert.equal(frame(), false);
  assert(scene.eye[2] < 300);
  walk.end();
  const { moves } = scene;
  assert.equal(frame(), false);
  assert(walk.isOver);
  assert.deepEqual([scene.now, scene.moves], [FROM, moves + 1], 'that it is back is told');
});

test('a camera that somebody else moves ends a walk, and stays', () => {
  const scene = new Scene();
  const { walk, frame } = walkIn(scene);
  frame(2000);
  frame();
  const elsewhere = { ...FROM, azimuth: 3 };
  scene.now = elsewhere;
  frame();
  assert.deepEqual([walk.isOver, scene.left, scene.now], [true, 1, elsewhere]);
});

test('a drag moves the picture with the pointer, and a second finger walks', () => {
  const scene = new Scene();
  const { frame } = walkIn(scene);
  frame(2000);
  frame();
  const pointer = (type: string, pointerId: number, clientX: number, clientY: number) =>
    scene.dispatchEvent(Object.assign(new Event(type), { pointerId, clientX, clientY, pointerType: 'touch' }));
  const before = scene.now;
  const eye = scene.eye;
  pointer('pointerdown', 1, 100, 100);
  pointer('pointermove', 1, 140, 100);
  frame();
  assert(
    Math.abs(scene.now.azimuth - before.azimuth - (50 * Math.PI) / 180 / 10) < 1e-9,
    'a tenth of the height turns a tenth of the view',
  );
  assert(Math.hypot(scene.eye[0] - eye[0], scene.eye[1] - eye[1]) < 1e-6);
  pointer('pointerdown', 2, 200, 100);
  pointer('pointermove', 1, 140, 180);
  pointer('pointermove', 2, 200, 180);
  frame();
  const { forward } = cameraAxes(scene.now);
  const ahead = (scene.eye[0] - eye[0]) * forward[0] + (scene.eye[1] - eye[1]) * forward[1];
  assert(ahead > 50, `pulled down, the ground comes nearer: ${ahead}`);
});
