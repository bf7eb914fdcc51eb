/**
 * The orbit camera as pure functions: its axes, and what it frames; `moves.ts` moves it. Nothing here draws or listens.
 *
 * At azimuth 0 the eye looks along +y; growing azimuth carries it counter-clockwise round the target.
 * Elevation π/2 looks straight down with +y up. Plans (`diagrams`, `selection`) are seen from straight
 * above with +y up whatever the angles; half their picture's height is `distance · tan(fov / 2)`, so
 * that a length at the target is as long on the screen as in the 3D view.
 * The picture's own coordinates run from -1 to 1, x right, y up.
 */

import { tangentOf } from '../../base/fov.ts';
import type { CameraState, View } from '../../base/view.ts';

/** Close enough to fill the picture with one small rock. */
export const MIN_DISTANCE_PX = 6;
/** Steeper in tall pictures, where 35° would leave a thin band of rocks. */
const ELEVATION_WIDE = (35 * Math.PI) / 180;
const ELEVATION_TALL = (58 * Math.PI) / 180;
const AZIMUTH_DEFAULT = (30 * Math.PI) / 180;
/** A natural ground fills the picture: seen from so high, with so much of the field's sides never in it. */
const CLOSE_UP = { elevation: (38 * Math.PI) / 180, margin: 0.04 };

type Vector = [number, number, number];

export interface CameraAxes {
  eye: Vector;
  right: Vector;
  up: Vector;
  forward: Vector;
}

/** True for the views that are seen from straight above whatever the camera's angles. */
export function isPlan(view: View): boolean {
  return view === 'diagrams' || view === 'selection';
}

/** Unit axes of the picture, and the eye, in the world. */
export function cameraAxes(camera: CameraState): CameraAxes {
  const [sa, ca] = [Math.sin(camera.azimuth), Math.cos(camera.azimuth)];
  const [se, ce] = [Math.sin(camera.elevation), Math.cos(camera.elevation)];
  const forward: Vector = [-sa * ce, ca * ce, -se];
  const [x, y, z] = camera.target;
  const d = camera.distance;
  return {
    eye: [x - forward[0] * d, y - forward[1] * d, z - forward[2] * d],
    right: [ca, sa, 0],
    up: [-sa * se, ca * se, ce],
    forward,
  };
}

/** Where the ray through (x, y) of the picture meets the ground z = 0; null above the horizon. */
export function groundPoint(camera: CameraState, x: number, y: number, aspect: number, plan = false): [number, number] | null {
  const tan = tangentOf(camera);
  if (plan) {
    const half = camera.distance * tan;
    return [camera.target[0] + x * half * aspect, camera.target[1] + y * half];
  }
  const { eye, right, up, forward } = cameraAxes(camera);
  const ray = [0, 1, 2].map((i) => forward[i]! + x * tan * aspect * right[i]! + y * tan * up[i]!) as Vector;
  if (ray[2] > -1e-4) return null;
  const steps = -eye[2] / ray[2];
  return [eye[0] + steps * ray[0], eye[1] + steps * ray[1]];
}

/**
 * The camera that frames a whole field: azimuth 30°, elevation 35°, steeper in tall pictures.
 * `plan` decides between the oblique picture, whose outermost corners may leave it, and the plan,
 * which is shown whole. With `closeUp` the oblique picture is as much ground as fills it.
 */
export function defaultCamera(
  imageWidth: number,
  imageHeight: number,
  aspect: number,
  plan = false,
  closeUp = false,
  fov?: number,
): CameraState {
  const middle: Vector = [imageWidth / 2, imageHeight / 2, 0];
  const ratio = Number.isFinite(aspect) && aspect > 0 ? aspect : 1;
  // 0 in a tall picture (a phone held upright), 1 in a wide one.
  const wide = Math.min(1, Math.max(0, (ratio - 0.6) / 0.9));
  const elevation = ELEVATION_TALL + (ELEVATION_WIDE - ELEVATION_TALL) * wide;
  const camera: CameraState = { azimuth: AZIMUTH_DEFAULT, elevation, distance: 1, target: middle, fov };
  const tan = tangentOf(camera);
  if (plan) {
    const half = Math.max(imageHeight, imageWidth / ratio) / 2;
    return { ...camera, distance: (half * 1.04) / tan };
  }
  if (closeUp) return fillingCamera(camera, imageWidth, imageHeight, ratio);
  // How far the outermost corners may lie outside, 1 = the picture's edge: filled rather than floating.
  const reach = 1.22 - 0.14 * wide;
  for (let round = 0; round < 8; round++) {
    camera.distance = fittingDistance(camera, imageWidth, imageHeight, ratio, reach);
    const [low, high] = heights(camera, imageWidth, imageHeight);
    // Perspective makes the near half taller: slide along the view until the field is centred.
    const slide = (((low + high) / 2) * camera.distance * tan) / Math.sin(elevation);
    camera.target = [camera.target[0] - Math.sin(camera.azimuth) * slide, camera.target[1] + Math.cos(camera.azimuth) * slide, 0];
  }
  return camera;
}

/** The farthest camera whose picture shows nothing but the field, with the ground it shows in the field's middle. */
function fillingCamera(from: CameraState, width: number, height: number, aspect: number): CameraState {
  const near: CameraState = { ...from, elevation: CLOSE_UP.elevation, distance: 1, target: [0, 0, 0] };
  const seen = [-1, 1].flatMap((x) => [-1, 1].flatMap((y) => [groundPoint(near, x, y, aspect) ?? []]));
  const [left, right, low, high] = [0, 1].flatMap((axis) => {
    const along = seen.map((point) => point[axis] ?? 0);
    return [Math.min(...along), Math.max(...along)];
  }) as [number, number, number, number];
  // What is seen grows with the distance.
  const room = 1 - 2 * CLOSE_UP.margin;
  const distance = Math.max(MIN_DISTANCE_PX, Math.min((room * width) / (right - left), (room * height) / (high - low)));
  return {
    ...near,
    distance,
    target: [(width - distance * (left + right)) / 2, (height - distance * (low + high)) / 2, 0],
  };
}

/** Which way a camera looks, and how much of it. */
export type Angles = Pick<CameraState, 'azimuth' | 'elevation' | 'fov'>;

/** px */
export interface Box {
  low: Vector;
  high: Vector;
}

/** What a picture is about, where it is not the whole field. */
export interface Subject extends Box {
  /** The camera that frames it. */
  camera(aspect: number, plan: boolean, fov: number): CameraState;
}

/** The nearest camera with the angles of `seen` whose picture shows all of a box in its inner part, `room` of 1, with the box's middle in its own. */
export function boxCamera({ low, high }: Box, aspect: number, seen: Angles, room: number): CameraState {
  const target = low.map((value, k) => (value + high[k]!) / 2) as Vector;
  const camera: CameraState = { ...seen, distance: MIN_DISTANCE_PX, target };
  const tan = tangentOf(camera);
  const { right, up, forward } = cameraAxes(camera);
  for (let corner = 0; corner < 8; corner += 1) {
    const from = low.map((value, k) => (corner & (1 << k) ? high[k]! : value) - target[k]!);
    const along = (axis: Vector): number => axis[0] * from[0]! + axis[1] * from[1]! + axis[2] * from[2]!;
    const reach = Math.max(Math.abs(along(right)) / (tan * aspect), Math.abs(along(up)) / tan) / room;
    camera.distance = Math.max(camera.distance, reach - along(forward));
  }
  return camera;
}

/** The image's corners relative to the target, along the camera's right, up and forward. */
function corners(camera: CameraState, width: number, height: number): Vector[] {
  const { right, up, forward } = cameraAxes(camera);
  return [0, 1, 2, 3].map((i) => {
    const from = [(i & 1 ? width : 0) - camera.target[0], (i & 2 ? height : 0) - camera.target[1], -camera.target[2]];
    const along = (axis: Vector): number => axis[0] * from[0]! + axis[1] * from[1]! + axis[2] * from[2]!;
    return [along(right), along(up), along(forward)];
  });
}

function fittingDistance(camera: CameraState, width: number, height: number, aspect: number, reach: number): number {
  let distance = MIN_DISTANCE_PX;
  const tan = tangentOf(camera);
  for (const [x, y, z] of corners(camera, width, height)) {
    distance = Math.max(distance, Math.abs(x) / (tan * aspect * reach) - z, Math.abs(y) / (tan * reach) - z);
  }
  return distance;
}

/** Lowest and highest corner in the picture. */
function heights(camera: CameraState, width: number, height: number): [number, number] {
  let [low, high] = [Infinity, -Infinity];
  for (const [, y, z] of corners(camera, width, height)) {
    const at = y / (tangentOf(camera) * Math.max(camera.distance + z, 1));
    low = Math.min(low, at);
    high = Math.max(high, at);
  }
  return [low, high];
}
