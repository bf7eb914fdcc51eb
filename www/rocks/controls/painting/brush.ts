/** What a brush leaves on the ground: strokes out of the way it went, and where they are in a picture. Draws nothing and hears no events. */

import { project } from '../../../scene/camera/pick.ts';
import type { CameraState } from '../../../base/view.ts';
import { FARTHEST } from '../../strokes.ts';
import type { Stroke, StrokeMode } from '../../strokes.ts';

/** What is painted with. */
export interface Brush {
  mode: StrokeMode;
  /** The id of the layer that is painted; `null`: all of them. */
  layer: number | null;
  /** In widths of the image. */
  width: number;
}

/** In widths of the image: from a pebble's to half the field. */
export const BRUSH_WIDTH = { min: 0.005, max: 0.5, start: 0.04 };
/** What a brush's key changes its width by. */
export const BRUSH_STEP = 1.25;

/** How far a stroke may lie from the way that was painted, as a part of its width: nobody sees it, and links stay short. */
const TOLERANCE = 0.06;
/** A circle on the ground is drawn with so many corners. */
const CORNERS = 28;

/**
 * The stroke that a brush leaves which went along `way`: x, y, x, y … in widths of the image, whole numbers of points. Points that say
 * nothing are left out, and those that are too far away to be told are moved nearer.
 */
export function strokeAlong({ mode, layer, width }: Brush, way: readonly number[]): Stroke {
  const inside = way.map((value) => Math.min(FARTHEST, Math.max(-FARTHEST, value)));
  return { mode, layer, width, points: thinned(inside, TOLERANCE * width) };
}

/** Ramer 1972, Douglas & Peucker 1973: as few of the points as no other point lies farther than `tolerance` from the line through. */
export function thinned(points: readonly number[], tolerance: number): number[] {
  const last = points.length / 2 - 1;
  const kept = new Set([0, last]);
  const spans: [number, number][] = [[0, last]];
  for (let span = spans.pop(); span; span = spans.pop()) {
    const [from, to] = span;
    let farthest = tolerance;
    let at = -1;
    for (let k = from + 1; k < to; k += 1) {
      const distance = distanceTo(points, k, from, to);
      if (distance <= farthest) continue;
      farthest = distance;
      at = k;
    }
    if (at < 0) continue;
    kept.add(at);
    spans.push([from, at], [at, to]);
  }
  const thin = [...kept].sort((a, b) => a - b).flatMap((k) => [points[2 * k]!, points[2 * k + 1]!]);
  // A hand that rests leaves a dot.
  return thin.length === 4 && thin[0] === thin[2] && thin[1] === thin[3] ? thin.slice(0, 2) : thin;
}

/** From point `k` to the piece of line between two others. */
function distanceTo(points: readonly number[], k: number, from: number, to: number): number {
  const [x, y] = [points[2 * k]! - points[2 * from]!, points[2 * k + 1]! - points[2 * from + 1]!];
  const [dx, dy] = [points[2 * to]! - points[2 * from]!, points[2 * to + 1]! - points[2 * from + 1]!];
  const length = dx * dx + dy * dy;
  const share = length > 0 ? Math.min(1, Math.max(0, (x * dx + y * dy) / length)) : 0;
  return Math.hypot(x - share * dx, y - share * dy);
}

/** A camera with the shape of its picture. */
export interface Seen {
  camera: CameraState;
  /** Width by height. */
  aspect: number;
  isPlan: boolean;
}

/**
 * The ground that a stroke covers, as polygons in the picture (−1 … 1, x right, y up), all of which go round the same way: filled together they
 * are one shape. `imageWidth` in px. What is not in front of the eye is left out.
 */
export function shapeOf({ width, points }: Pick<Stroke, 'width' | 'points'>, imageWidth: number, seen: Seen): [number, number][][] {
  const radius = (width / 2) * imageWidth;
  const shapes: [number, number][][] = [];
  const add = (corners: [number, number][]): void => {
    const projected = corners.map((corner) => onPicture(corner, seen));
    if (projected.every((point) => point !== null)) shapes.push(projected);
  };
  for (let k = 0; k < points.length; k += 2) {
    const [x, y] = [points[k]! * imageWidth, points[k + 1]! * imageWidth];
    add(
      Array.from({ length: CORNERS }, (_, corner) => {
        const angle = (2 * Math.PI * corner) / CORNERS;
        return [x + radius * Math.cos(angle), y + radius * Math.sin(angle)];
      }),
    );
    if (k === 0) continue;
    const [fromX, fromY] = [points[k - 2]! * imageWidth, points[k - 1]! * imageWidth];
    const length = Math.hypot(x - fromX, y - fromY);
    if (length === 0) continue;
    const [nx, ny] = [(-(y - fromY) / length) * radius, ((x - fromX) / length) * radius];
    add([
      [fromX + nx, fromY + ny],
      [fromX - nx, fromY - ny],
      [x - nx, y - ny],
      [x + nx, y + ny],
    ]);
  }
  return shapes;
}

function onPicture([x, y]: [number, number], { camera, aspect, isPlan }: Seen): [number, number] | null {
  // A plan is seen from straight above, whatever the angles are, with no nearer and no farther: as what lies on the ground below the camera.
  return project(
    isPlan ? { ...camera, azimuth: 0, elevation: Math.PI / 2, target: [camera.target[0], camera.target[1], 0] } : camera,
    [x, y, 0],
    aspect,
  );
}
