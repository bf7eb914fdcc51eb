/**
 * `camera-orbit="45deg 55deg 120%"`, as in model-viewer: azimuth, angle from straight above, and distance, which is a share of the
 * distance that frames the whole field, or metres, or pixels.
 */

import { CAMERA_BOUNDS } from '../../table/camera-bounds.ts';
import type { CameraState } from '../../base/view.ts';

/** One pixel of the image is a centimetre. */
export const METRES_PER_PIXEL = 0.01;

export interface Orbit {
  /** Radians; null: as the whole field is framed. */
  azimuth: number | null;
  elevation: number | null;
  distance: { value: number; unit: '%' | 'm' | 'px' } | null;
}

/** As far down as the camera goes by hand: 5° above the ground. */
const MAX_POLAR = (85 * Math.PI) / 180;
const ANGLE = /^([+-]?(?:\d+\.?\d*|\.\d+))(deg|rad)$/;
/** Of a length or a share: what is smaller or larger shows nothing of any field. */
const [MIN_LENGTH, MAX_LENGTH] = [1e-3, 1e6];
const LENGTH = /^((?:\d+\.?\d*|\.\d+))(%|m|px)$/;

/** Null where the text is no orbit. */
export function parseOrbit(text: string): Orbit | null {
  const [theta = '', phi = '', radius = '', ...rest] = text.trim().split(/\s+/);
  const azimuth = angle(theta);
  const polar = angle(phi);
  const distance = length(radius);
  if (azimuth === undefined || polar === undefined || distance === undefined || rest.length > 0) return null;
  const elevation = polar === null ? null : Math.PI / 2 - Math.min(MAX_POLAR, Math.max(0, polar));
  return { azimuth, elevation, distance };
}

/** Null for `auto`, undefined for what is no angle. */
function angle(text: string): number | null | undefined {
  if (text === 'auto') return null;
  const [, value, unit] = ANGLE.exec(text) ?? [];
  if (value === undefined) return undefined;
  const radians = unit === 'deg' ? (Number(value) * Math.PI) / 180 : Number(value);
  return Math.abs(radians) <= CAMERA_BOUNDS[0]!.max ? radians : undefined;
}

function length(text: string): Orbit['distance'] | undefined {
  if (text === 'auto') return null;
  const [, number, unit] = LENGTH.exec(text) ?? [];
  const value = Number(number);
  return value >= MIN_LENGTH && value <= MAX_LENGTH ? { value, unit: unit as '%' | 'm' | 'px' } : undefined;
}

/** The camera at `orbit`, where `framing` shows the whole field, whose middle is `centre`. */
export function orbitCamera(framing: CameraState, orbit: Orbit, centre: [number, number], metresPerPixel: number): CameraState {
  const azimuth = orbit.azimuth ?? framing.azimuth;
  const elevation = orbit.elevation ?? framing.elevation;
  const { value, unit } = orbit.distance ?? { value: 100, unit: '%' as const };
  const wanted = unit === '%' ? (framing.distance * value) / 100 : unit === 'm' ? value / metresPerPixel : value;
  const { min, max } = CAMERA_BOUNDS[2]!;
  const distance = Math.min(max, Math.max(min, wanted));
  // What the framing shifts along the view to centre the picture goes round with the view.
  const [x, y] = turned(framing.target, centre, azimuth - framing.azimuth);
  const target: CameraState['target'] = orbit.elevation === null ? [x, y, framing.target[2]] : [...centre, 0];
  return { ...framing, azimuth, elevation, distance, target };
}

/** A camera carried round the vertical axis through `centre`. */
export function turnCamera(camera: CameraState, centre: [number, number], by: number): CameraState {
  const [x, y] = turned(camera.target, centre, by);
  return { ...camera, azimuth: camera.azimuth + by, target: [x, y, camera.target[2]] };
}

function turned([x, y]: readonly number[], [cx, cy]: [number, number], by: number): [number, number] {
  const [dx, dy] = [(x ?? 0) - cx, (y ?? 0) - cy];
  const [sin, cos] = [Math.sin(by), Math.cos(by)];
  return [cx + cos * dx - sin * dy, cy + sin * dx + cos * dy];
}
