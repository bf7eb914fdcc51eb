// What the aperture and the focus of a picture mean.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { checkLens, lensOf } from '../../www/scene/lens.ts';
import type { InFront, LensOptions } from '../../www/scene/lens.ts';
import type { Field } from '../../www/data/field.ts';

/** A square of 40 px at a height of 30 px, seen from straight above from a height of 230 px, through 90°. */
const SCENE: InFront = {
  camera: { azimuth: 0, elevation: Math.PI / 2, distance: 230, target: [0, 0, 0], fov: 90 },
  aspect: 2,
  field: {
    positions: Float32Array.of(-20, -20, 30, 20, -20, 30, 20, 20, 30, -20, 20, 30),
    indices: Uint32Array.of(0, 1, 2, 0, 2, 3),
  } as Field,
  wood: null,
  metresPerPixel: 0.01,
};

function close(seen: number | undefined, wanted: number): void {
  assert(seen !== undefined && Math.abs(seen - wanted) < 1e-3 * wanted, `${seen} in place of ${wanted}`);
}

test('the lens is that of a full-frame camera with the field of view of the picture', () => {
  // 12 mm of focal length see 90° on a sensor of 24 mm: at f/2 the lens is 6 mm wide.
  close(lensOf({ aperture: 2 }, SCENE)?.radius, 0.3);
  close(lensOf({ aperture: 4 }, SCENE)?.radius, 0.15);
  close(lensOf({ aperture: 2 }, { ...SCENE, metresPerPixel: 0.1 })?.radius, 0.03);
  const long = { ...SCENE, camera: { ...SCENE.camera, fov: 2 * (180 / Math.PI) * Math.atan(0.12) } };
  close(lensOf({ aperture: 2 }, long)?.radius, 2.5);
  assert.equal(lensOf({}, SCENE), undefined);
});

test('what is in the middle is sharp, or a point of the picture, or a distance', () => {
  const focus = (options: LensOptions) => lensOf({ aperture: 2, ...options }, SCENE)?.focus;
  close(focus({}), 200);
  close(focus({ focus: 1.5 }), 150);
  close(focus({ focus: [0.5, 0.5] }), 200);
  // 20 px are 5 % of what is seen across at that height, and 10 % of what is seen down.
  close(focus({ focus: [0.52, 0.5] }), 200);
  close(focus({ focus: [0.53, 0.5] }), 230);
  close(focus({ focus: [0.5, 0.54] }), 200);
  close(focus({ focus: [0.5, 0.56] }), 230);
  const up = { ...SCENE, camera: { ...SCENE.camera, elevation: 0.1 } };
  assert(lensOf({ aperture: 2, focus: [0.5, 0] }, up)!.focus > 1e6, 'the sky is far away');
});

test('what is no aperture and no focus is refused with its bounds', () => {
  const cases: [LensOptions & { samples?: number }, string, number, number][] = [
    [{ aperture: 0, samples: 4 }, 'aperture', 0.1, 128],
    [{ aperture: NaN, samples: 4 }, 'aperture', 0.1, 128],
    [{ aperture: '2.8' as unknown as number, samples: 4 }, 'aperture', 0.1, 128],
    [{ aperture: 2.8 }, 'aperture', 0.1, 128],
    [{ focus: 2 }, 'focus', 1e-3, 1e6],
    [{ aperture: 2.8, samples: 4, focus: 0 }, 'focus', 1e-3, 1e6],
    [{ aperture: 2.8, samples: 4, focus: 'far' as unknown as number }, 'focus', 1e-3, 1e6],
    [{ aperture: 2.8, samples: 4, focus: [0.5, 1.1] }, 'focus', 0, 1],
    [{ aperture: 2.8, samples: 4, focus: [0.5] as unknown as [number, number] }, 'focus', 0, 1],
  ];
  for (const [options, key, min, max] of cases) {
    const value = options[key as 'aperture' | 'focus'];
    assert.throws(() => checkLens(options), { name: 'OutOfRange', key, value, min, max }, JSON.stringify(options));
  }
  for (const focus of [undefined, 3, [0, 1] as const]) checkLens({ aperture: 2.8, samples: 4, ...(focus !== undefined && { focus }) });
  checkLens({});
});
