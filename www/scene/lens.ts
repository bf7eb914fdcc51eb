/** Depth of field: what `aperture` and `focus` of a picture mean to the renderer. */

import { RockFieldError } from '../base/errors.ts';
import { tangentOf } from '../base/fov.ts';
import type { CameraState } from '../base/view.ts';
import type { Field } from '../data/field.ts';
import type { Lens, Wood } from '../renderer/renderer.ts';
import { cameraAxes } from './camera/camera.ts';
import { firstHit, rayThrough } from './camera/pick.ts';
import { isList, shown } from '../table/param-checks.ts';

export interface LensOptions {
  /**
   * Depth of field, with `samples`: the f-number of the lens, 0.1 … 128, of a camera with a full-frame sensor (24 mm high) and the field of view
   * of the picture. Lengths are those of `metres-per-pixel`. Left out, everything is sharp.
   */
  aperture?: number;
  /**
   * What is sharp, with `aperture`: how far away it is along the view, metres, or a point of the picture, `[right, down]` of its upper left
   * corner, 0 … 1. Left out, it is what is in the middle of the picture.
   */
  focus?: number | readonly [right: number, down: number];
}

/** f-numbers: below is a lens that nobody can build, which makes miniatures of fields; above, a pinhole. */
const APERTURE = { min: 0.1, max: 128 };
/** Metres. */
const FOCUS = { min: 1e-3, max: 1e6 };
const POINT = { min: 0, max: 1 };

/** Height of the sensor, metres. */
const SENSOR = 0.024;

/** Where nothing is seen, px: as good as infinitely far. */
const FAR_PX = 1e7;

/** @throws {RockFieldError} `OutOfRange` naming key, value and bounds. */
export function checkLens({ aperture, focus, samples }: LensOptions & { samples?: number | undefined }): void {
  if (aperture === undefined) {
    if (focus !== undefined) refuse('focus', focus, FOCUS, 'there is no depth of field without an aperture');
    return;
  }
  if (!isIn(APERTURE, aperture)) refuse('aperture', aperture, APERTURE, `it is an f-number between ${APERTURE.min} and ${APERTURE.max}`);
  if (samples === undefined) refuse('aperture', aperture, APERTURE, 'only the mean of samples has depth of field');
  if (focus === undefined || isIn(FOCUS, focus)) return;
  if (isList(focus) && focus.length === 2 && focus.every((share) => isIn(POINT, share))) return;
  const [bounds, what] = isList(focus)
    ? [POINT, 'a point of the picture is two numbers between 0 and 1']
    : [FOCUS, `it is a number of metres between ${FOCUS.min} and ${FOCUS.max}, or a point of the picture`];
  refuse('focus', focus, bounds, what);
}

/** Written so that NaN is none. */
function isIn({ min, max }: { min: number; max: number }, value: unknown): boolean {
  return typeof value === 'number' && value >= min && value <= max;
}

function refuse(key: string, value: unknown, bounds: { min: number; max: number }, why: string): never {
  throw new RockFieldError({ name: 'OutOfRange', key, value, ...bounds, message: `${key} is ${shown(value)}; ${why}` });
}

/** What is looked at, and how large it is. */
export interface InFront {
  camera: CameraState;
  aspect: number;
  field: Field | null;
  wood: Wood | null;
  metresPerPixel: number;
}

/** The lens of a picture, in px; undefined where everything is sharp. The options have been checked. */
export function lensOf({ aperture, focus }: LensOptions, scene: InFront): Lens | undefined {
  if (aperture === undefined) return undefined;
  const { camera, metresPerPixel } = scene;
  const focalLength = SENSOR / 2 / tangentOf(camera);
  const radius = focalLength / (2 * aperture) / metresPerPixel;
  if (typeof focus === 'number') return { radius, focus: focus / metresPerPixel };
  const [right, down] = focus ?? [0.5, 0.5];
  return { radius, focus: depthAt(scene, 2 * right - 1, 1 - 2 * down) };
}

/** How far away along the view is what a point of the picture shows, px. */
function depthAt({ camera, aspect, field, wood }: InFront, x: number, y: number): number {
  const ray = rayThrough(camera, x, y, aspect);
  const { forward } = cameraAxes(camera);
  const { from, along } = ray;
  let depth = from[2] > 0 && along[2] < 0 ? from[2] / -along[2] : FAR_PX;
  const meet = (positions: Float32Array, indices: Uint32Array, place: Wood['place']): void => {
    const own = from.map((value, k) => (value - place[k]!) / place[3]) as typeof from;
    const hit = firstHit({ from: own, along }, positions, indices);
    if (!hit) return;
    const away = hit.reduce((sum, value, k) => sum + forward[k]! * (value - own[k]!), 0);
    depth = Math.min(depth, away * place[3]);
  };
  if (field) meet(field.positions, field.indices, [0, 0, 0, 1]);
  if (wood) for (const { positions, indices } of [wood.colony.log, wood.colony]) meet(positions, indices, wood.place);
  return depth;
}
