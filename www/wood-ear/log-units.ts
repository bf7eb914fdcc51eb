/** In which units a log of one's own has been made: the one rule, for files and for meshes from code. */

/** cm. No log is shorter or longer: what is has been made in other units, and is shown `instead` cm long. */
export const LOG_LENGTH = { min: 20, max: 1000, instead: 200 };

/** Coordinates have been rounded to f32 by those that measure a second time. */
const ROUNDING = 1e-6;

/** What to multiply the coordinates of a log by whose longest level side measures so many cm. */
export function scaleOfLog(length: number): number {
  const { min, max, instead } = LOG_LENGTH;
  return length > 0 && length < Infinity && (length < min * (1 - ROUNDING) || length > max * (1 + ROUNDING)) ? instead / length : 1;
}
