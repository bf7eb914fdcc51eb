/** What a log file may be, checked before the work that it would cost. */

/** Bytes. A log of 100,000 triangles has a tenth of this as text. */
export const MOST_BYTES = 48 * 2 ** 20;
/** As the generator has them (src/wood_ear/user_log.rs); a test compares the two. */
export const MOST_VERTICES = 200_000;
export const MOST_TRIANGLES = 400_000;
/** cm from the middle. Also the generator's. */
export const FARTHEST = 10_000;
/** Vertices before those at one place are merged: three for every triangle. */
export const MOST_LISTED = 3 * MOST_TRIANGLES;
