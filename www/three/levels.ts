/** Which level of detail a rock is drawn with: the coarsest whose triangles are small enough on the screen. */

/** How long the edges of triangles may be, in pixels of the drawing buffer. */
const EDGE = 4;
/** The share of its limit by which a rock has to pass it before its level changes, so that none goes to and fro where a camera hardly moves. */
const SLACK = 0.15;

/**
 * The diameter on the screen, in pixels, up to which a level is fine enough.
 *
 * @param triangles of a rock at this level: as many edges lie across it as the root of that, more or less.
 */
export function limitOf(triangles: number): number {
  return EDGE * Math.sqrt(triangles);
}

/**
 * @param pixels the diameter on the screen.
 * @param present the level that the rock has.
 * @param limits of its levels, the finest first: none is larger than the one before.
 */
export function levelFor(pixels: number, present: number, limits: ArrayLike<number>): number {
  let level = present;
  while (level + 1 < limits.length && pixels < limits[level + 1]! * (1 - SLACK)) level += 1;
  while (level > 0 && pixels > limits[level]! * (1 + SLACK)) level -= 1;
  return level;
}
