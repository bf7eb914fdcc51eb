// Mouse, touch, wheel and keys on a stage that is only pretended: what moves the camera, and what is left to the page.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { OrbitControls } from '../../www/scene/camera/orbit-controls.ts';
import type { CameraState, Interaction } from '../../www/base/view.ts';

const START: CameraState = { azimuth: 0.5, elevation: 0.6, distance: 1000, target: [500, 400, 0] };

/** As much of an element as the controls ask for: 400 × 300 px at the page's corner. */
class Stage extends EventTarget {
  style = { touchAction: 'manipulation' };
  clientWidth = 400;
  clientHeight = 300;
  root: { activeElement: unknown } = { activeElement: null };
  ownerDocument = { active: true, hasFocus: () => this.ownerDocument.active };
  captured = new Set<number>();
  getRootNode = () => this.root;
  contains = (other: unknown) => other === this;
  focus = () => {
    this.root.activeElement = this;
  };
  setPointerCapture = (id: number) => void this.captured.add(id);
  hasPointerCapture = (id: number) => this.captured.has(id);
  releasePointerCapture = (id: number) => void this.captured.delete(id);
  getBoundingClientRect = () => ({ left: 0, top: 0, width: 400, height: 300 });
}

/** Controls on a stage; `send` gives back whether the event was kept from the page. */
function setUp(interaction?: Interaction, isPlan = false) {
  const stage = new Stage();
  const seen = { camera: START, mode: interaction, moves: 0, framed: 0, refused: [] as string[] };
  const controls = new OrbitControls(
    stage as unknown as HTMLElement,
    () => seen.camera,
    (camera) => (seen.camera = camera),
    {
      onInteract: () => (seen.moves += 1),
      onFrameAll: () => (seen.framed += 1),
      isPlan: () => isPlan,
      ...(interaction && { interaction: () => seen.mode! }),
      onRefused: (gesture) => seen.refused.push(gesture),
    },
  );
  let time = 0;
  const send = (type: string, fields: object = {}, after = 10): boolean => {
    const event = Object.assign(new Event(type, { cancelable: true }), fields);
    time += after;
    Object.defineProperty(event, 'timeStamp', { value: time });
    stage.dispatchEvent(event);
    return event.defaultPrevented;
  };
  const wheel = (fields: object = {}, after = 10) =>
    send('wheel', { deltaX: 0, deltaY: 100, deltaMode: 0, clientX: 200, clientY: 150, ...fields }, after);
  const pointer =
    (pointerType: string) =>
    (type: string, clientX: number, clientY: number, fields: object = {}, after = 10) =>
      send(`pointer${type}`, { pointerType, pointerId: 1, buttons: 1, clientX, clientY, ...fields }, after);
  const mouse = pointer('mouse');
  const finger = pointer('touch');
  /** A finger's move as the browser tells it; true when the page was held. */
  const slide = (x: number, y: number, fields: object = {}) => {
    finger('move', x, y, fields);
    return send('touchmove');
  };
  const tap = (x: number, y: number, after = 10) => {
    finger('down', x, y, {}, after);
    finger('up', x, y, {}, 50);
  };
  const reset = () => void Object.assign(seen, { camera: START, moves: 0 });
  return { stage, seen, controls, send, wheel, mouse, finger, slide, tap, reset };
}

const MODES = ['cooperative', 'always'] as const;

test('touch-action follows the interaction, and is given back', () => {
  for (const [interaction, expected] of [
    [undefined, 'pan-y'],
    ['cooperative', 'pan-y'],
    ['always', 'none'],
    ['none', 'auto'],
  ] as const) {
    const { stage, controls } = setUp(interaction);
    assert.equal(stage.style.touchAction, expected);
    controls.dispose();
    assert.equal(stage.style.touchAction, 'manipulation');
  }
});

test('cooperative: the wheel scrolls the page until the picture has the focus', () => {
  const { stage, seen, wheel } = setUp();
  assert.equal(wheel(), false);
  assert.equal(seen.moves, 0);
  stage.focus();
  assert.equal(wheel(), true);
  assert.ok(seen.camera.distance > START.distance);
  // Another window, or the page round the frame the picture is in, has the keyboard.
  stage.ownerDocument.active = false;
  assert.equal(wheel(), false);
  assert.equal(seen.moves, 1);
});

test('cooperative: the wheel zooms with ctrl or meta, no other key', () => {
  for (const [key, zooms] of [
    ['ctrlKey', true],
    ['metaKey', true],
    ['shiftKey', false],
    ['altKey', false],
  ] as const) {
    const { seen, wheel } = setUp();
    assert.equal(wheel({ [key]: true }), zooms, key);
    assert.equal(seen.moves, zooms ? 1 : 0, key);
  }
});

test('a notch with ctrl zooms as far as one without; a pinch is finer', () => {
  const { seen, wheel, reset } = setUp('always');
  wheel();
  const notch = seen.camera.distance;
  reset();
  wheel({ ctrlKey: true });
  assert.ok(Math.abs(seen.camera.distance - notch) < 1e-6);
  reset();
  wheel({ ctrlKey: true, deltaY: -2.5 });
  assert.ok(seen.camera.distance < START.distance && seen.camera.distance > 0.95 * START.distance);
});

test('a refused wheel is told at most once a second', () => {
  const { seen, wheel } = setUp();
  for (let turns = 0; turns < 100; turns += 1) wheel({}, 25);
  assert.deepEqual(seen.refused, ['wheel', 'wheel', 'wheel']);
});

test('always: the wheel always zooms', () => {
  const { seen, wheel } = setUp('always');
  assert.equal(wheel(), true);
  assert.deepEqual([seen.moves, seen.refused], [1, []]);
});

test('cooperative: a finger that starts upright scrolls the page, which is told', () => {
  const { stage, seen, finger, slide } = setUp();
  finger('down', 200, 100);
  assert.equal(slide(201, 106), false);
  assert.equal(slide(202, 112), false);
  assert.equal(slide(300, 180), false);
  finger('cancel', 300, 180);
  assert.deepEqual([seen.moves, seen.refused, stage.root.activeElement], [0, ['touch'], null]);
});

test('cooperative: a scroll that the browser begins early is told as well', () => {
  const { seen, finger } = setUp();
  finger('down', 200, 100);
  finger('cancel', 200, 104);
  assert.deepEqual([seen.moves, seen.refused], [0, ['touch']]);
});

test('cooperative: a finger that starts sideways orbits, without a jump', () => {
  const { stage, seen, finger, slide } = setUp();
  finger('down', 200, 100);
  assert.equal(slide(190, 101), true);
  assert.equal(seen.camera, START);
  assert.equal(slide(180, 101), true);
  const step = (10 * Math.PI) / 300;
  assert.ok(Math.abs(seen.camera.azimuth - START.azimuth - step) < 1e-9);
  assert.equal(seen.camera.elevation, START.elevation);
  assert.equal(slide(180, 111), true);
  assert.ok(Math.abs(seen.camera.elevation - START.elevation - step) < 1e-9);
  assert.deepEqual([stage.root.activeElement, seen.refused], [stage, []]);
});

test('cooperative: a tap, then a drag orbits upright too, and the page stays', () => {
  const { seen, finger, slide, tap } = setUp();
  tap(200, 100);
  finger('down', 205, 102, {}, 250);
  assert.equal(slide(205, 106), true, 'held before the browser can scroll');
  slide(205, 120);
  slide(205, 140);
  assert.ok(seen.camera.elevation > START.elevation);
  assert.equal(seen.camera.azimuth, START.azimuth);
  finger('up', 205, 140);
  assert.deepEqual([seen.framed, seen.refused], [0, []]);
});

test('two taps frame all, once, with or without the browser’s dblclick; a tap and a drag do not', () => {
  for (const interaction of MODES) {
    const { seen, send, finger, slide, tap } = setUp(interaction);
    tap(200, 100);
    tap(204, 98, 150);
    send('dblclick');
    assert.equal(seen.framed, 1, interaction);
    tap(200, 100, 1000);
    finger('down', 200, 100, {}, 150);
    slide(200, 130);
    finger('up', 200, 130);
    assert.equal(seen.framed, 1, interaction);
  }
});

test('two fingers zoom and pan, and the page stays', () => {
  for (const interaction of MODES) {
    const { seen, finger, slide, reset } = setUp(interaction);
    finger('down', 150, 150);
    finger('down', 250, 150, { pointerId: 2 });
    assert.equal(slide(300, 150, { pointerId: 2 }), true);
    assert.ok(seen.camera.distance < START.distance, interaction);
    finger('move', 250, 150, { pointerId: 2 });
    reset();
    assert.equal(slide(150, 170), true);
    assert.equal(slide(250, 170, { pointerId: 2 }), true);
    assert.ok(Math.hypot(seen.camera.target[0] - 500, seen.camera.target[1] - 400) > 5, interaction);
    assert.equal(seen.camera.azimuth, START.azimuth);
    assert.deepEqual(seen.refused, []);
  }
});

test('always: one finger orbits at once, in every direction', () => {
  const { seen, finger, slide } = setUp('always');
  finger('down', 200, 100);
  assert.equal(slide(200, 103), true);
  assert.ok(seen.camera.elevation > START.elevation);
});

test('a plan is dragged by the fingers that would turn the rocks', () => {
  const { seen, finger, slide } = setUp('cooperative', true);
  finger('down', 200, 100);
  slide(215, 100);
  slide(235, 100);
  assert.ok(seen.camera.target[0] < 500);
  assert.equal(seen.camera.azimuth, START.azimuth);
});

test('the mouse: a drag orbits, with shift or another button it pans, and takes the focus', () => {
  for (const interaction of MODES) {
    const { stage, seen, mouse, reset } = setUp(interaction);
    mouse('down', 200, 150);
    mouse('move', 200, 152);
    assert.ok(seen.camera.elevation > START.elevation, interaction);
    assert.equal(stage.root.activeElement, stage);
    mouse('up', 200, 152);
    for (const fields of [{ shiftKey: true }, { buttons: 2 }, { buttons: 4 }]) {
      reset();
      mouse('down', 200, 150, fields);
      mouse('move', 220, 150, fields);
      mouse('up', 220, 150, fields);
      assert.equal(seen.camera.azimuth, START.azimuth);
      assert.notDeepEqual(seen.camera.target, START.target);
    }
    assert.deepEqual(seen.refused, []);
  }
});

test('a double click frames all; the right button has no menu, the middle one no scrolling', () => {
  const { seen, send, mouse } = setUp();
  mouse('down', 200, 150);
  mouse('up', 200, 150);
  assert.equal(send('dblclick'), true);
  assert.equal(seen.framed, 1);
  assert.equal(send('contextmenu'), true);
  assert.deepEqual(
    [0, 1, 2].map((button) => send('mousedown', { button })),
    [false, true, false],
  );
});

test('keys move the camera as ever; Tab, Escape and shortcuts are the page’s', () => {
  for (const interaction of MODES) {
    const { seen, send } = setUp(interaction);
    const keys = ['ArrowLeft', 'ArrowRight', 'ArrowUp', 'ArrowDown', '+', '=', '-', '_'];
    for (const key of keys) assert.equal(send('keydown', { key }), true, key);
    assert.equal(seen.moves, keys.length);
    for (const key of ['Home', 'f', 'F']) assert.equal(send('keydown', { key }), true, key);
    assert.equal(seen.framed, 3);
    for (const key of ['Tab', 'Escape', 'Enter', ' ', 'PageDown']) assert.equal(send('keydown', { key }), false, key);
    assert.equal(send('keydown', { key: '+', ctrlKey: true }), false);
    assert.deepEqual([seen.moves, seen.framed], [keys.length, 3]);
  }
});

test('none: nothing moves the camera and nothing is kept from the page', () => {
  const { stage, seen, send, wheel, mouse, finger, slide, tap } = setUp('none');
  const kept = [
    wheel(),
    wheel({ ctrlKey: true }),
    send('keydown', { key: 'ArrowLeft' }),
    send('keydown', { key: 'f' }),
    send('dblclick'),
    send('contextmenu'),
    send('mousedown', { button: 1 }),
  ];
  mouse('down', 100, 100);
  mouse('move', 150, 100);
  mouse('up', 150, 100);
  tap(100, 100);
  finger('down', 100, 100);
  finger('down', 200, 100, { pointerId: 2 });
  kept.push(slide(150, 100), slide(150, 150));
  assert.ok(kept.every((isKept) => !isKept));
  assert.deepEqual([seen.moves, seen.framed, seen.refused, stage.captured.size, stage.root.activeElement], [0, 0, [], 0, null]);
});

test('a cancelled pointer, and one whose capture is lost, end the gesture', () => {
  for (const end of ['cancel', 'lost']) {
    const { stage, seen, send, mouse } = setUp();
    mouse('down', 200, 150);
    assert.ok(stage.captured.has(1));
    if (end === 'cancel') mouse('cancel', 200, 150);
    else send('lostpointercapture', { pointerId: 1 });
    mouse('move', 250, 150);
    assert.equal(seen.moves, 0, end);
  }
});

test('a new interaction is taken by refresh, which ends a drag; the same one does not', () => {
  const { stage, seen, controls, wheel, mouse } = setUp('always');
  mouse('down', 200, 150);
  controls.refresh();
  mouse('move', 210, 150);
  assert.equal(seen.moves, 1);
  seen.mode = 'none';
  controls.refresh();
  mouse('move', 220, 150);
  assert.deepEqual([seen.moves, stage.captured.size, stage.style.touchAction, wheel()], [1, 0, 'auto', false]);
  seen.mode = 'cooperative';
  controls.refresh();
  assert.equal(stage.style.touchAction, 'pan-y');
  mouse('down', 200, 150);
  mouse('move', 210, 150);
  assert.equal(seen.moves, 2, 'heard once');
});

test('after dispose nothing is heard and no pointer is held', () => {
  const { stage, seen, controls, send, wheel, mouse, finger, slide } = setUp('always');
  mouse('down', 200, 150);
  finger('down', 100, 100, { pointerId: 2 });
  controls.dispose();
  assert.equal(stage.captured.size, 0);
  mouse('move', 250, 150);
  assert.deepEqual(
    [slide(120, 100, { pointerId: 2 }), wheel(), send('keydown', { key: 'f' }), send('contextmenu')],
    [false, false, false, false],
  );
  assert.deepEqual([seen.moves, seen.framed], [0, 0]);
});
