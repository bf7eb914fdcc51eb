/** The cameras of scenes that are about one thing on the field. */

import type { CameraState } from '../../base/view.ts';
import { boxCamera } from './camera.ts';
import type { Box, Subject } from './camera.ts';

/** Seen from the side, and in tall pictures more along it, so low that it stands before what lies behind it. */
const SUBJECT = {
  elevation: [(34 * Math.PI) / 180, (25 * Math.PI) / 180],
  azimuth: [(64 * Math.PI) / 180, (22 * Math.PI) / 180],
  room: 0.86,
} as const;

/** The nearest camera that shows all of a subject. */
export function subjectCamera(box: Box, aspect: number, plan = false, fov?: number): CameraState {
  if (plan) return boxCamera(box, aspect, { azimuth: 0, elevation: Math.PI / 2, fov }, SUBJECT.room);
  const ratio = Number.isFinite(aspect) && aspect > 0 ? aspect : 1;
  const wide = Math.min(1, Math.max(0, (ratio - 0.6) / 0.9));
  const between = ([tall, flat]: readonly [number, number]): number => tall + (flat - tall) * wide;
  return boxCamera(box, ratio, { azimuth: between(SUBJECT.azimuth), elevation: between(SUBJECT.elevation), fov }, SUBJECT.room);
}

export function subjectOf(box: Box): Subject {
  return { ...box, camera: (aspect, plan, fov) => subjectCamera(box, aspect, plan, fov) };
}
