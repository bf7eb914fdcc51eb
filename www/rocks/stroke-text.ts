/** Painted strokes as text, the form in which parameters and links have them. `strokes.ts` reads and writes it. */

import { checkNumber, wrongType } from '../table/param-checks.ts';

/** Characters of all strokes together, so that a link with the most of them can still be read. */
export const MAX_STROKES_LENGTH = 12_288;

/** A number: digits of five bits, the lowest first; all but the last are of the other half of the digits. */
const NUMBER = '[g-z0-9~-]{0,6}[A-Za-f]';
/** Of each stroke: what it does, its layer, its width, and two numbers for each of its points. */
const STROKES = new RegExp(`^(?:[A-D](?:(?:${NUMBER}){2}){2,}(?:\\.(?=.)|$))*$`);

/** Whether this is a text of strokes; the empty one is none of them. */
export function isStrokes(text: string): boolean {
  return text.length <= MAX_STROKES_LENGTH && STROKES.test(text);
}

/** @throws {RockFieldError} naming the value, and the bounds of the length of what is too long. */
export function checkStrokes(value: unknown): string {
  if (typeof value === 'string') {
    if (isStrokes(value)) return value;
    checkNumber('strokes', value.length, { min: 0, max: MAX_STROKES_LENGTH }, false, undefined, 'the length of strokes');
  }
  throw wrongType('strokes', value, 'strokes as links have them');
}
