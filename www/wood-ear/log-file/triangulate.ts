/** The triangles of a face with any number of corners. A convex one is cut into a fan, another one by ears. */

import earcut from 'earcut';

type Vector = [number, number, number];

/** Cutting ears takes the square of the corners' number, at worst. */
const MOST_EARS = 10_000;
/** A corner that turns back by less than this share is straight. */
const STRAIGHT = 1e-9;

/**
 * Calls `emit` with three indices for each triangle; the winding is the face's.
 *
 * @throws What `tooRagged` gives for a face that is not convex and has more corners than are cut.
 */
export function triangulated(
  positions: Float64Array,
  corners: Uint32Array,
  emit: (a: number, b: number, c: number) => void,
  tooRagged: (corners: number, max: number) => Error,
): void {
  const ears = corners.length < 4 ? [] : earsOf(positions, corners, tooRagged);
  for (let k = 0; k < ears.length; k += 3) emit(corners[ears[k]!]!, corners[ears[k + 1]!]!, corners[ears[k + 2]!]!);
  // A fan suits faces that are convex, or so thin that the cutter finds nothing.
  for (let k = 2; ears.length === 0 && k < corners.length; k += 1) emit(corners[0]!, corners[k - 1]!, corners[k]!);
}

/** Three places among the corners for each triangle, in the winding of the face; empty for a convex face and where nothing can be cut. */
function earsOf(positions: Float64Array, corners: Uint32Array, tooRagged: (corners: number, max: number) => Error): number[] {
  const normal = normalOf(positions, corners);
  if (isConvex(positions, corners, normal)) return [];
  if (corners.length > MOST_EARS) throw tooRagged(corners.length, MOST_EARS);
  const [u, v] = plane(normal);
  const flat = Array.from(corners).flatMap((corner) => [positions[3 * corner + u]!, positions[3 * corner + v]!]);
  const ears = earcut(flat);
  // Ears come in the winding of the cutter, not of the face.
  const isTurned = doubleArea(flat, ears, 3) < 0 !== doubleArea(flat, [...corners.keys()], corners.length) < 0;
  if (isTurned) for (let k = 0; k + 2 < ears.length; k += 3) [ears[k + 1], ears[k + 2]] = [ears[k + 2]!, ears[k + 1]!];
  return ears;
}

/** By Newell's method; its length is twice the area. */
function normalOf(positions: Float64Array, corners: Uint32Array): Vector {
  const normal: Vector = [0, 0, 0];
  const o = at(positions, corners[0]!);
  let before = from(o, at(positions, corners[corners.length - 1]!));
  for (const corner of corners) {
    const here = from(o, at(positions, corner));
    const add = cross(before, here);
    for (let k = 0; k < 3; k += 1) normal[k]! += add[k]!;
    before = here;
  }
  return normal;
}

function isConvex(positions: Float64Array, corners: Uint32Array, normal: Vector): boolean {
  const count = corners.length;
  const least = -STRAIGHT * dot(normal, normal);
  let turned = 0;
  for (let k = 0; k < count; k += 1) {
    const [a, b, c] = [k, k + 1, k + 2].map((n) => at(positions, corners[n % count]!)) as [Vector, Vector, Vector];
    const [along, on] = [from(a, b), from(b, c)];
    const turn = dot(cross(along, on), normal);
    if (turn < least) return false;
    turned += Math.sign(turn) * angle(along, on);
  }
  // A star turns the same way at all its corners, and around more than once.
  return turned < 3 * Math.PI;
}

function angle(a: Vector, b: Vector): number {
  const turn = cross(a, b);
  return Math.atan2(Math.sqrt(dot(turn, turn)), dot(a, b));
}

/** The two axes that a face is seen along from where it is largest. */
function plane([x, y, z]: Vector): [number, number] {
  const [ax, ay, az] = [Math.abs(x), Math.abs(y), Math.abs(z)];
  if (ax >= ay && ax >= az) return [1, 2];
  return ay >= az ? [0, 2] : [0, 1];
}

/** Of polygons of `size` corners each, seen along the plane's normal; negative where they go round clockwise. */
function doubleArea(flat: readonly number[], list: readonly number[], size: number): number {
  let area = 0;
  for (let start = 0; start < list.length; start += size) {
    for (let k = 0; k < size; k += 1) {
      const [a, b] = [list[start + k]!, list[start + ((k + 1) % size)]!];
      area += flat[2 * a]! * flat[2 * b + 1]! - flat[2 * b]! * flat[2 * a + 1]!;
    }
  }
  return area;
}

function at(positions: Float64Array, corner: number): Vector {
  return [positions[3 * corner]!, positions[3 * corner + 1]!, positions[3 * corner + 2]!];
}

function from([ax, ay, az]: Vector, [bx, by, bz]: Vector): Vector {
  return [bx - ax, by - ay, bz - az];
}

function cross([ax, ay, az]: Vector, [bx, by, bz]: Vector): Vector {
  return [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];
}

function dot([ax, ay, az]: Vector, [bx, by, bz]: Vector): number {
  return ax * bx + ay * by + az * bz;
}
