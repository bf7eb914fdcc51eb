/** What of a mesh lies under a point of the picture, and where a point of the world is in the picture. */

import { tangentOf } from '../../base/fov.ts';
import { cameraAxes } from './camera.ts';
import type { CameraState } from '../../base/view.ts';

type Vector = [number, number, number];

/** From the eye through (x, y) of the picture, which run from -1 to 1, x right, y up. */
export function rayThrough(camera: CameraState, x: number, y: number, aspect: number): { from: Vector; along: Vector } {
  const { eye, right, up, forward } = cameraAxes(camera);
  const tan = tangentOf(camera);
  return { from: eye, along: forward.map((value, k) => value + x * tan * aspect * right[k]! + y * tan * up[k]!) as Vector };
}

/** Where a point of the world is in the picture; null behind the eye. */
export function project(camera: CameraState, point: Vector, aspect: number): [number, number] | null {
  const { eye, right, up, forward } = cameraAxes(camera);
  const from = point.map((value, k) => value - eye[k]!) as Vector;
  const depth = dot(forward, from);
  const half = depth * tangentOf(camera);
  return depth > 0 ? [dot(right, from) / (half * aspect), dot(up, from) / half] : null;
}

/** The nearest point of the triangles on the ray; null where it misses them all. Möller & Trumbore 1997. */
export function firstHit({ from, along }: { from: Vector; along: Vector }, positions: Float32Array, indices: Uint32Array): Vector | null {
  const [ox, oy, oz] = from;
  const [dx, dy, dz] = along;
  let nearest = Infinity;
  for (let i = 0; i + 2 < indices.length; i += 3) {
    const [a, b, c] = [3 * indices[i]!, 3 * indices[i + 1]!, 3 * indices[i + 2]!];
    const [ax, ay, az] = [positions[a]!, positions[a + 1]!, positions[a + 2]!];
    const [ux, uy, uz] = [positions[b]! - ax, positions[b + 1]! - ay, positions[b + 2]! - az];
    const [vx, vy, vz] = [positions[c]! - ax, positions[c + 1]! - ay, positions[c + 2]! - az];
    const [px, py, pz] = [dy * vz - dz * vy, dz * vx - dx * vz, dx * vy - dy * vx];
    const determinant = ux * px + uy * py + uz * pz;
    // From the back, or along the triangle.
    if (determinant < 1e-12) continue;
    const [tx, ty, tz] = [ox - ax, oy - ay, oz - az];
    const s = tx * px + ty * py + tz * pz;
    if (s < 0 || s > determinant) continue;
    const [qx, qy, qz] = [ty * uz - tz * uy, tz * ux - tx * uz, tx * uy - ty * ux];
    const t = dx * qx + dy * qy + dz * qz;
    if (t < 0 || s + t > determinant) continue;
    const steps = (vx * qx + vy * qy + vz * qz) / determinant;
    if (steps > 0 && steps < nearest) nearest = steps;
  }
  return nearest < Infinity ? [ox + nearest * dx, oy + nearest * dy, oz + nearest * dz] : null;
}

function dot(a: Vector, b: Vector): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
