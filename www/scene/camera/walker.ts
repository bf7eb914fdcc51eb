/** Somebody who walks on the ground of a scene: where they stand, and where they look. Hears no events and draws nothing. */

import type { CameraState } from '../../base/view.ts';
import { cameraAxes } from './camera.ts';

/** Where somebody walks. */
export interface Grounds {
  /** Width and height of the field, px. */
  extent: readonly [number, number];
  metresPerPixel: number;
  /** How high the feet are, px. */
  footing: { at(x: number, y: number): number };
}

/** Metres. */
const EYE_METRES = 1.6;
/** As shares of the shorter side of the field: the eye is not so high that the field is at its feet, nor so low that it sees nothing of it. */
const EYE_SHARES = { least: 0.005, most: 0.3 };
/** How far beyond the field one can go, as a share of its shorter side. */
const MARGIN = 0.1;
/** Never straight up or down, where turning would be rolling. */
const STEEPEST = (80 * Math.PI) / 180;
/** Who comes down from above looks a little down. */
const FIRST_LOOK = (7 * Math.PI) / 180;
/** What the camera turns about when the walk is over, as a multiple of the height of the eye: away from it, ahead. */
const AHEAD = 3;

/** Height of the eye above the feet, px. */
export function eyeHeight([width, height]: readonly [number, number], metresPerPixel: number): number {
  const side = Math.min(width, height);
  return Math.min(EYE_SHARES.most * side, Math.max(EYE_SHARES.least * side, EYE_METRES / metresPerPixel));
}

export class Walker {
  /** Of the eye above the feet, px. */
  readonly eye: number;
  #grounds: Grounds;
  #x = 0;
  #y = 0;
  #azimuth: number;
  #elevation: number;
  readonly #fov: number | undefined;

  /** Stands below the eye of `camera`, or as near to that as the field is, and looks the same way. */
  constructor(camera: CameraState, grounds: Grounds) {
    this.#grounds = grounds;
    this.eye = eyeHeight(grounds.extent, grounds.metresPerPixel);
    this.#azimuth = camera.azimuth;
    this.#elevation = Math.min(FIRST_LOOK, camera.elevation);
    this.#fov = camera.fov;
    const [x, y] = cameraAxes(camera).eye;
    this.goTo(x, y);
  }

  /** The rocks are others now. */
  set grounds(grounds: Grounds) {
    this.#grounds = grounds;
    this.goTo(this.#x, this.#y);
  }

  /** Turns by radians: to the left, and down. */
  look(left: number, down: number): void {
    this.#azimuth = (this.#azimuth + left) % (2 * Math.PI);
    this.#elevation = Math.min(STEEPEST, Math.max(-STEEPEST, this.#elevation + down));
  }

  /** Goes so many px. */
  go(ahead: number, right: number): void {
    const [sin, cos] = [Math.sin(this.#azimuth), Math.cos(this.#azimuth)];
    this.goTo(this.#x - sin * ahead + cos * right, this.#y + cos * ahead + sin * right);
  }

  /** Stands at a place, or as near to it as the field is. */
  goTo(x: number, y: number): void {
    const { extent } = this.#grounds;
    const margin = MARGIN * Math.min(...extent);
    const [across, up] = [x, y].map((value, axis) => Math.min(extent[axis]! + margin, Math.max(-margin, value))) as [number, number];
    [this.#x, this.#y] = [across, up];
  }

  /** From here to a place, px: how far ahead, and how far to the right. */
  wayTo(x: number, y: number): [ahead: number, right: number] {
    const [dx, dy] = [x - this.#x, y - this.#y];
    const [sin, cos] = [Math.sin(this.#azimuth), Math.cos(this.#azimuth)];
    return [-sin * dx + cos * dy, cos * dx + sin * dy];
  }

  get camera(): CameraState {
    const [azimuth, elevation] = [this.#azimuth, this.#elevation];
    const distance = AHEAD * this.eye;
    const camera: CameraState = { azimuth, elevation, distance, target: [0, 0, 0], fov: this.#fov };
    const { forward } = cameraAxes(camera);
    const eye = [this.#x, this.#y, this.#grounds.footing.at(this.#x, this.#y) + this.eye];
    return { ...camera, target: eye.map((value, k) => value + distance * forward[k]!) as CameraState['target'] };
  }
}
