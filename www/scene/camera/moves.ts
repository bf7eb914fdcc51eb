/** The moves of the orbit camera as pure functions: orbiting, zooming, panning. The conventions are those of `camera.ts`. */

import { groundPoint, MIN_DISTANCE_PX } from './camera.ts';
import { tangentOf } from '../../base/fov.ts';
import type { CameraState } from '../../base/view.ts';

const MIN_ELEVATION = (5 * Math.PI) / 180;
const MAX_ELEVATION = Math.PI / 2;
/** A dozen times what frames the largest image. */
const MAX_DISTANCE_PX = 250_000;

/** Turned by angles in radians; the elevation stays between 5° and 90°, and is raised where it is lower without a jump. */
export function orbit(camera: CameraState, azimuth: number, elevation: number): CameraState {
  const turned = (camera.azimuth + azimuth) % (2 * Math.PI);
  const raised = Math.min(MAX_ELEVATION, Math.max(Math.min(MIN_ELEVATION, camera.elevation), camera.elevation + elevation));
  return { ...camera, azimuth: turned, elevation: raised };
}

/** `factor` below 1 comes closer. The ground under `about` (picture coordinates) stays where it is. */
export function zoom(
  camera: CameraState,
  factor: number,
  about: readonly [number, number] = [0, 0],
  aspect = 1,
  plan = false,
): CameraState {
  const wanted = camera.distance * factor;
  const distance = Math.min(MAX_DISTANCE_PX, Math.max(MIN_DISTANCE_PX, wanted));
  const scale = distance / camera.distance;
  const point = groundPoint(camera, about[0], about[1], aspect, plan);
  const [x, y, z] = camera.target;
  // Near the horizon the ground runs away to infinity; a pointer there zooms about the middle.
  if (!point || Math.hypot(point[0] - x, point[1] - y) > 4 * camera.distance) {
    return { ...camera, distance };
  }
  return {
    ...camera,
    distance,
    target: [point[0] + (x - point[0]) * scale, point[1] + (y - point[1]) * scale, z * scale],
  };
}

/**
 * Dragged by (dx, dy) pixels of a picture `heightPx` high, dy down: the ground at the target follows the
 * pointer.
 */
export function pan(camera: CameraState, dx: number, dy: number, heightPx: number, plan = false): CameraState {
  const perPixel = (2 * camera.distance * tangentOf(camera)) / Math.max(heightPx, 1);
  const azimuth = plan ? 0 : camera.azimuth;
  // Seen at a grazing angle a pixel spans much ground; beyond a third the drag would run away.
  const foreshortening = plan ? 1 : Math.max(Math.sin(camera.elevation), 1 / 3);
  const across = -dx * perPixel;
  const along = (dy * perPixel) / foreshortening;
  const [sin, cos] = [Math.sin(azimuth), Math.cos(azimuth)];
  const [x, y, z] = camera.target;
  return {
    ...camera,
    target: [x + cos * across - sin * along, y + sin * across + cos * along, z],
  };
}
