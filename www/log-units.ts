/** In which units a log of one's own has been made: the one rule, for files and for meshes from code. */

/** cm. No log is shorter or longer: what is has been made in other units, and is shown `instead` cm long. */
export const LOG_LENGTH = { min: 20, max: 1000, instead: 200 };

/** What to multiply the coordinates of a log by whose longest level side measures so many cm. */
export function scaleOfLog(length: number): number {
  const { min, max, instead } = LOG_LENGTH;
  return length > 0 && length < Infinity && (length < min || length > max) ? instead / length : 1;
}
