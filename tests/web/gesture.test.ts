// What fingers mean, without any element: paths of touches in, meanings out.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Fingers } from '../../www/scene/camera/gesture.ts';

/** A short tap at (x, y). */
function tap(fingers: Fingers, x: number, y: number, time: number): boolean {
  fingers.down(1, x, y, time);
  return fingers.up(1, time + 60);
}

test('one finger: nothing is said for the first 10 px, then upright is the page, sideways the picture', () => {
  for (const [dx, dy, meaning] of [
    [0, 12, 'page'],
    [0, -12, 'page'],
    [8, 12, 'page'],
    [10, 10, 'page'],
    [12, 8, 'drag'],
    [-12, 0, 'drag'],
  ] as const) {
    const fingers = new Fingers();
    assert.equal(fingers.down(1, 100, 100, 0), 'wait');
    assert.equal(fingers.move(1, 100 + dx / 2, 100 + dy / 2), 'wait');
    assert.equal(fingers.holdsPage, false);
    assert.equal(fingers.move(1, 100 + dx, 100 + dy), meaning, `${dx}, ${dy}`);
    assert.equal(fingers.holdsPage, meaning === 'drag');
  }
});

test('what one finger means is decided once', () => {
  const fingers = new Fingers();
  fingers.down(1, 0, 0, 0);
  fingers.move(1, 15, 0);
  assert.equal(fingers.move(1, 15, 200), 'drag');
  fingers.up(1, 500);
  assert.equal(fingers.holdsPage, false);
  fingers.down(1, 0, 0, 1000);
  fingers.move(1, 0, 15);
  assert.equal(fingers.move(1, 200, 15), 'page');
});

test('a tap, then a drag: the picture in every direction, and the page is held from the first touch on', () => {
  for (const [dx, dy] of [
    [0, 40],
    [0, -40],
    [40, 0],
    [-20, 30],
  ] as const) {
    const fingers = new Fingers();
    assert.equal(tap(fingers, 100, 100, 0), false);
    assert.equal(fingers.down(1, 110, 95, 300), 'wait');
    assert.ok(fingers.holdsPage);
    assert.equal(fingers.move(1, 110 + dx, 95 + dy), 'drag');
    assert.ok(fingers.holdsPage);
    assert.equal(fingers.up(1, 400), false, 'with movement it is no double tap');
    assert.ok(!fingers.holdsPage);
  }
});

test('too late, too far, too long or moved: no tap went before', () => {
  const late = new Fingers();
  tap(late, 100, 100, 0);
  late.down(1, 100, 100, 361);
  assert.ok(!late.holdsPage);

  const far = new Fingers();
  tap(far, 100, 100, 0);
  far.down(1, 125, 120, 200);
  assert.ok(!far.holdsPage);

  const long = new Fingers();
  long.down(1, 100, 100, 0);
  long.up(1, 301);
  long.down(1, 100, 100, 400);
  assert.ok(!long.holdsPage);

  const moved = new Fingers();
  moved.down(1, 100, 100, 0);
  moved.move(1, 100, 120);
  moved.move(1, 100, 100);
  moved.up(1, 100);
  moved.down(1, 100, 100, 200);
  assert.ok(!moved.holdsPage);
});

test('two taps are a double tap, three are not two of them, four are', () => {
  const fingers = new Fingers();
  assert.deepEqual(
    [0, 200, 400, 600].map((time) => tap(fingers, 100, 100, time)),
    [false, true, false, true],
  );
  assert.equal(tap(new Fingers(), 100, 100, 0), false);
});

test('a double tap may tremble', () => {
  const fingers = new Fingers();
  tap(fingers, 100, 100, 0);
  fingers.down(1, 104, 100, 200);
  assert.equal(fingers.move(1, 104, 107), 'wait');
  assert.equal(fingers.up(1, 260), true);
});

test('two fingers are the picture at once; the one that stays drags on; none of it is a tap', () => {
  const fingers = new Fingers();
  assert.equal(fingers.down(1, 100, 100, 0), 'wait');
  assert.equal(fingers.down(2, 200, 100, 20), 'pinch');
  assert.ok(fingers.holdsPage);
  assert.equal(fingers.move(1, 100, 140), 'pinch');
  assert.equal(fingers.up(2, 100), false);
  assert.equal(fingers.move(1, 100, 180), 'drag');
  assert.ok(fingers.holdsPage);
  assert.equal(fingers.up(1, 120), false);
  fingers.down(1, 100, 100, 200);
  assert.ok(!fingers.holdsPage);
});

test('a second finger makes a pinch of what was the page’s', () => {
  const fingers = new Fingers();
  fingers.down(1, 100, 100, 0);
  fingers.move(1, 100, 130);
  assert.equal(fingers.down(2, 200, 100, 50), 'pinch');
  assert.ok(fingers.holdsPage);
});

test('a finger the browser takes before it is clear is the page’s; one that moved the camera is just gone', () => {
  const fingers = new Fingers();
  fingers.down(1, 100, 100, 0);
  assert.equal(fingers.cancel(1), true);
  assert.equal(fingers.cancel(1), false);
  fingers.down(2, 100, 100, 1000);
  fingers.move(2, 130, 100);
  assert.equal(fingers.cancel(2), false);
  assert.ok(!fingers.holdsPage);
  tap(fingers, 100, 100, 2000);
  fingers.down(3, 100, 100, 2100);
  assert.equal(fingers.cancel(3), false);
});

test('at once: no waiting, in any direction', () => {
  const fingers = new Fingers();
  assert.equal(fingers.down(1, 100, 100, 0, true), 'drag');
  assert.equal(fingers.move(1, 100, 103), 'drag');
  assert.ok(fingers.holdsPage);
  assert.equal(fingers.up(1, 50), false);
  fingers.down(1, 100, 100, 150, true);
  assert.equal(fingers.up(1, 200), true);
});

test('cleared, it has forgotten fingers and taps', () => {
  const fingers = new Fingers();
  tap(fingers, 100, 100, 0);
  fingers.down(1, 100, 100, 100);
  fingers.clear();
  assert.ok(!fingers.holdsPage);
  assert.equal(fingers.up(1, 150), false);
  fingers.down(1, 100, 100, 200);
  assert.ok(!fingers.holdsPage);
});
