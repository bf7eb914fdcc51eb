/** A short flight from one camera to another: the short way round, distances in equal factors, gently off and gently on. */

import { FOV } from '../../base/fov.ts';
import type { CameraState } from '../../base/view.ts';

const FLIGHT_MS = 350;

export class CameraFlight {
  readonly #from: CameraState;
  readonly #to: CameraState;
  readonly #begin: number;

  constructor(from: CameraState, to: CameraState, begin: number) {
    this.#from = from;
    this.#to = to;
    this.#begin = begin;
  }

  /** Where it is at a time; null once it has landed. */
  at(now: number): CameraState | null {
    const t = Math.max(0, (now - this.#begin) / FLIGHT_MS);
    return t >= 1 ? null : between(this.#from, this.#to, t * t * (3 - 2 * t));
  }
}

function between(from: CameraState, to: CameraState, t: number): CameraState {
  const mix = (a: number, b: number) => a + (b - a) * t;
  const turn = ((((to.azimuth - from.azimuth) % (2 * Math.PI)) + 3 * Math.PI) % (2 * Math.PI)) - Math.PI;
  return {
    azimuth: from.azimuth + turn * t,
    elevation: mix(from.elevation, to.elevation),
    distance: from.distance * (to.distance / from.distance) ** t,
    target: [mix(from.target[0], to.target[0]), mix(from.target[1], to.target[1]), mix(from.target[2], to.target[2])],
    fov: mix(from.fov ?? FOV, to.fov ?? FOV),
  };
}
