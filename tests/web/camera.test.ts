// What the camera frames by itself.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { cameraAxes, defaultCamera, groundPoint } from '../../www/scene/camera/camera.ts';
import { orbit } from '../../www/scene/camera/moves.ts';
import { project, rayThrough } from '../../www/scene/camera/pick.ts';
import { SceneCamera } from '../../www/scene/camera/scene-camera.ts';
import { subjectOf } from '../../www/scene/camera/subject.ts';
import { FOV, FOV_BOUNDS, tangentOf } from '../../www/base/fov.ts';
import { checkCamera } from '../../www/table/camera-bounds.ts';
import type { CameraState } from '../../www/base/view.ts';

const SIZES = [
  [640, 640],
  [900, 300],
  [300, 900],
] as const;
const ASPECTS = [0.3, 0.5, 1, 1.6, 3];

test('close up, a picture of any shape shows the field to its edges and nothing beside it', () => {
  for (const [width, height] of SIZES) {
    for (const aspect of ASPECTS) {
      const camera = defaultCamera(width, height, aspect, false, true);
      const sides = [
        [-1, -1],
        [1, -1],
        [-1, 1],
        [1, 1],
      ].map(([x, y]) => groundPoint(camera, x!, y!, aspect));
      assert(
        sides.every((point) => point && point[0] > 0 && point[0] < width && point[1] > 0 && point[1] < height),
        `${width} × ${height} at ${aspect}`,
      );
      const spans = [0, 1].map(
        (axis) => Math.max(...sides.map((point) => point![axis]!)) - Math.min(...sides.map((point) => point![axis]!)),
      );
      assert(Math.max(spans[0]! / width, spans[1]! / height) > 0.9, 'it could be farther away');
    }
  }
});

test('plans are framed as they are, close up or not', () => {
  assert.deepEqual(defaultCamera(640, 480, 1.5, true, true), defaultCamera(640, 480, 1.5, true));
});

/** Where the corners of the field's box are in the picture, and how much of it they take. */
function seen(camera: CameraState, [width, height]: readonly [number, number], high: number, aspect: number): { reach: number } {
  const { eye, right, up, forward } = cameraAxes(camera);
  let reach = 0;
  const tan = tangentOf(camera);
  for (let corner = 0; corner < 8; corner += 1) {
    const from = [corner & 1 ? width : 0, corner & 2 ? height : 0, corner & 4 ? high : 0].map((value, k) => value - eye[k]!);
    const along = (axis: readonly number[]): number => axis.reduce((sum, value, k) => sum + value * from[k]!, 0);
    const depth = along(forward);
    assert(depth > 0, 'behind the eye');
    reach = Math.max(reach, Math.abs(along(right)) / (depth * tan * aspect), Math.abs(along(up)) / (depth * tan));
  }
  return { reach };
}

test('all of the field is framed with a margin in every window, from every side, in every colour; the second time as by default', () => {
  for (const size of [...SIZES, [8192, 8], [1, 1]] as const) {
    for (const aspect of [...ASPECTS, 0.1, 8]) {
      for (const closeUp of [false, true]) {
        for (const [azimuth, elevation] of [
          [0, 0.09],
          [0.5, 0.6],
          [2.5, 1.2],
          [-1, Math.PI / 2],
        ] as const) {
          const scene = new SceneCamera(() => ({ extent: [...size], aspect, plan: false, closeUp, subject: null, height: () => 40 }));
          scene.current = { azimuth, elevation, distance: 50, target: [0, 0, 0] };
          const to = scene.frameAll();
          assert.deepEqual(scene.current, to);
          assert.deepEqual([to.azimuth, to.elevation, scene.framed, scene.isDefault], [azimuth, elevation, true, false]);
          const { reach } = seen(to, size, 40, aspect);
          assert(reach <= 0.91 && reach > 0.6, `${size.join(' × ')} at ${aspect} from ${azimuth}, ${elevation}: ${reach}`);
          scene.frameAll();
          assert.deepEqual([scene.current, scene.isDefault], [scene.framing(), true]);
        }
      }
    }
  }
});

test('a plan shows all of a field, and of what stands on it, with a margin in every window', () => {
  for (const size of SIZES) {
    for (const aspect of [...ASPECTS, 0.1, 8]) {
      const subject = subjectOf({ low: [0.2 * size[0], 0.4 * size[1], 0], high: [0.7 * size[0], 0.6 * size[1], 60] });
      for (const what of [null, subject]) {
        const scene = new SceneCamera(() => ({ extent: [...size], aspect, plan: true, closeUp: true, subject: what, height: () => 40 }));
        const { low, high } = what ?? { low: [0, 0], high: size };
        const camera = scene.current;
        const { target, distance } = camera;
        // As plans are drawn: half the picture's height is distance · tan(fov / 2).
        const reaches = [0, 1].map((axis) => {
          const half = distance * tangentOf(camera) * (axis === 0 ? aspect : 1);
          return Math.max(target[axis]! - low[axis]!, high[axis]! - target[axis]!) / half;
        });
        const reach = Math.max(...reaches);
        assert(reach < 0.97 && reach > 0.3, `${size.join(' × ')} at ${aspect}, ${what ? 'a subject' : 'all'}: ${reach}`);
      }
    }
  }
});

test('plans are whole already: framing them is the default at once', () => {
  const scene = new SceneCamera(() => ({ extent: [640, 480], aspect: 1.5, plan: true, closeUp: true, subject: null, height: () => 40 }));
  assert.deepEqual(scene.frameAll(), scene.framing());
  assert.ok(scene.isDefault);
});

test('another colour does not move a camera that nobody moved, until another preset lets it go', () => {
  let closeUp = true;
  const scene = new SceneCamera(() => ({ extent: [640, 480], aspect: 1.5, plan: false, closeUp, subject: null, height: () => 40 }));
  const before = scene.current;
  scene.hold();
  closeUp = false;
  assert.deepEqual([scene.current, scene.isDefault], [before, false]);
  scene.hold();
  closeUp = true;
  assert.deepEqual([scene.current, scene.isDefault], [before, true]);
  scene.hold();
  closeUp = false;
  scene.release();
  assert.deepEqual([scene.current, scene.isDefault], [scene.framing(), true]);
  assert.notDeepEqual(scene.current, before);
});

/** How many degrees. */
const LENSES = [FOV_BOUNDS.min, 20, FOV, 75, FOV_BOUNDS.max];

test('whatever the field of view is, what is framed fills as much of the picture', () => {
  for (const fov of LENSES) {
    for (const aspect of ASPECTS) {
      const scene = new SceneCamera(() => ({ extent: [640, 480], aspect, plan: false, closeUp: false, subject: null, height: () => 40 }));
      scene.fov = fov;
      assert.equal(scene.current.fov, fov);
      const { reach } = seen(scene.frameAll(), [640, 480], 40, aspect);
      assert(reach <= 0.91 && reach > 0.6, `${fov}° at ${aspect}: ${reach}`);
      const plan = defaultCamera(640, 480, aspect, true, false, fov);
      const usual = defaultCamera(640, 480, aspect, true);
      assert(Math.abs(plan.distance * tangentOf(plan) - usual.distance * tangentOf(usual)) < 1e-9, `${fov}° at ${aspect}: the plan`);
    }
  }
});

test('a ray goes through the point of the picture where its points are shown, whatever the field of view is', () => {
  for (const fov of LENSES) {
    const camera: CameraState = { azimuth: 0.4, elevation: 0.7, distance: 300, target: [20, 30, 5], fov };
    for (const [x, y] of [
      [0.9, -0.8],
      [-0.3, 0.2],
    ] as const) {
      const { from, along } = rayThrough(camera, x, y, 1.5);
      const [right, up] = project(camera, from.map((value, k) => value + 7 * along[k]!) as [number, number, number], 1.5)!;
      assert(Math.hypot(right - x, up - y) < 1e-9, `${fov}°: ${right}, ${up}`);
    }
  }
});

test('a camera is seen through the field of view of its scene, or through its own until the scene is given another', () => {
  const scene = new SceneCamera(() => ({ extent: [640, 480], aspect: 1, plan: false, closeUp: true, subject: null, height: () => 40 }));
  const place: CameraState = { azimuth: 0, elevation: 1, distance: 100, target: [1, 2, 3] };
  scene.current = place;
  assert.deepEqual(scene.current, { ...place, fov: FOV });
  scene.current = { ...place, fov: 60 };
  assert.deepEqual([scene.fov, scene.current], [60, { ...place, fov: 60 }]);
  scene.fov = 20;
  assert.deepEqual([scene.fov, scene.current], [20, { ...place, fov: 20 }]);
  scene.current = null;
  assert.deepEqual([scene.fov, scene.isDefault], [20, false], 'a link would have to tell it');
});

test('a field of view out of its bounds is refused with them, and nothing else is', () => {
  const place = { azimuth: 0, elevation: 1, distance: 100, target: [1, 2, 3] };
  for (const fov of [4.9, 121, NaN, Infinity]) {
    assert.throws(() => checkCamera({ ...place, fov }), { name: 'OutOfRange', key: 'fov', value: fov, ...FOV_BOUNDS });
  }
  assert.throws(() => checkCamera({ ...place, fov: 'wide' }), { key: 'fov' });
  for (const fov of LENSES) assert.deepEqual(checkCamera({ ...place, fov }), { ...place, fov });
  assert.deepEqual(checkCamera(place), place);
});

test('a touch raises a camera near the ground without a jump', () => {
  const low: CameraState = { azimuth: 0, elevation: 0.01, distance: 100, target: [1, 2, 3] };
  assert.equal(orbit(low, 0.1, 0).elevation, 0.01);
  assert(Math.abs(orbit(low, 0, 0.05).elevation - 0.06) < 1e-12);
  assert.equal(orbit({ ...low, elevation: 0.5 }, 0, -1).elevation, (5 * Math.PI) / 180);
});
