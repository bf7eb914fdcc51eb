/** Where a camera can be: what is assigned and what links hold lies within these, so that every link can be read again. */

import { FOV_BOUNDS } from '../base/fov.ts';
import { checkNumber, isList, objectOf, wrongType } from './param-checks.ts';
import type { CameraState } from '../base/view.ts';

/** px: nothing of the largest field is to be seen from farther away; hands reach 250,000. */
const REACH = 1e6;

/** Radians and px, in the order of links: azimuth, elevation, distance, target. The least distance is the last digit of a link. */
export const CAMERA_BOUNDS: readonly { min: number; max: number }[] = [
  { min: -1e5, max: 1e5 },
  // π, rounded as it is in links.
  { min: -3.1416, max: 3.1416 },
  { min: 0.1, max: REACH },
  ...[0, 1, 2].map(() => ({ min: -REACH, max: REACH })),
];

/**
 * A camera from code; null where there is none.
 *
 * @throws {RockFieldError} naming key, value and bounds.
 */
export function checkCamera(camera: unknown): CameraState | null {
  if (camera === null || camera === undefined) return null;
  const given = objectOf(camera, 'camera');
  const place = given['target'];
  const at = { name: 'the camera' };
  if (!isList(place) || place.length !== 3) throw wrongType('target', place, 'a list of three numbers', at);
  const [azimuth, elevation, distance, x, y, z] = CAMERA_BOUNDS.map((bounds, k) => {
    const key = ['azimuth', 'elevation', 'distance'][k] ?? 'target';
    return checkNumber(key, k < 3 ? given[key] : place[k - 3], bounds, false, at, k < 3 ? key : `target[${k - 3}]`);
  }) as [number, number, number, number, number, number];
  const fov = given['fov'];
  return {
    azimuth,
    elevation,
    distance,
    target: [x, y, z],
    ...(fov !== undefined && { fov: checkNumber('fov', fov, FOV_BOUNDS, false, at) }),
  };
}
