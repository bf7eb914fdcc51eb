/** Painted strokes as objects and as text. */

import { checkNumber, isList, objectOf, rejectUnknown, shown, wrongType } from '../table/param-checks.ts';
import type { Place } from '../table/param-checks.ts';
import { DIGITS, numbersOf, UNITS } from './stroke-numbers.ts';
import { checkStrokes } from './stroke-text.ts';

/** In the order of their numbers. */
export const STROKE_MODES = ['add', 'erase', 'path', 'restore'] as const;

/**
 * `add`: every cell whose site lies on the stroke may be a rock, however few its layer asks for. `erase`: none of them. `path`: no cell that
 * the stroke touches, so that the way is free. `restore`: as if nothing had been painted there.
 */
export type StrokeMode = (typeof STROKE_MODES)[number];

/** A line with round ends, painted on the ground. Its numbers are kept to a 4096th of the image's width. */
export interface Stroke {
  mode: StrokeMode;
  /** The id of the layer that it concerns; all of them where this is absent or `null`. */
  layer?: number | null | undefined;
  /** In widths of the image, above 0 … 16. */
  width: number;
  /** x, y, x, y … in widths of the image, −16 … 16, from its lower left corner seen from above; y points up. One point is a dot. */
  points: readonly number[];
}

/** How far from the image a point may be, in its widths. */
export const FARTHEST = 16;
const MAX_ID = 0xffff_ffff;
const KEYS = ['mode', 'layer', 'width', 'points'];

/**
 * Strokes as text, for parameters and links; text stays as it is, and none at all is the empty one.
 *
 * @throws {RockFieldError} naming key, value and bounds.
 */
export function strokesToText(strokes: string | readonly Stroke[] | undefined): string {
  if (typeof strokes === 'string' || strokes === undefined) return checkStrokes(strokes ?? '');
  if (!Array.isArray(strokes)) throw wrongType('strokes', strokes, 'a list of strokes');
  const parts: string[] = [];
  let length = -1;
  for (const [index, given] of Array.from(strokes as readonly unknown[]).entries()) {
    const part = strokeText(given, { index, name: `stroke ${index}` });
    length += 1 + part.length;
    // What is too long is not made longer: this says so.
    parts.push(part);
    if (length > 2 ** 20) break;
  }
  return checkStrokes(parts.join('.'));
}

function strokeText(given: unknown, at: Place): string {
  const stroke = objectOf(given, 'strokes', at);
  rejectUnknown(stroke, (key) => KEYS.includes(key), at);
  const mode = STROKE_MODES.indexOf(stroke['mode'] as StrokeMode);
  if (mode < 0) throw wrongType('mode', stroke['mode'], STROKE_MODES.map(shown).join(' or '), at);
  const layer = stroke['layer'] ?? null;
  const id = layer === null ? 0 : 1 + checkNumber('layer', layer, { min: 0, max: MAX_ID }, true, at);
  const width = units(checkNumber('width', stroke['width'], { min: 1 / UNITS, max: FARTHEST }, false, at));
  return [mode, id, width, ...steps(pointsOf(stroke['points'], at)).map(signed)].map(digits).join('');
}

function pointsOf(points: unknown, at: Place): number[] {
  if (!isList(points) || points.length < 2 || points.length % 2 === 1) throw wrongType('points', points, 'a list of x, y, x, y …', at);
  return Array.from(points, (value, k) =>
    units(checkNumber('points', value, { min: -FARTHEST, max: FARTHEST }, false, at, `points[${k}]`)),
  );
}

/** Half is rounded up, on both sides of 0. */
function units(value: number): number {
  return Math.floor(value * UNITS + 0.5);
}

/** The first point, the step to the second, and then how each step differs from the one before: hands move evenly. */
function steps(points: readonly number[]): number[] {
  const step = (k: number) => (k < 2 ? 0 : points[k]! - points[k - 2]!);
  return points.map((value, k) => (k < 2 ? value : step(k) - (k < 4 ? 0 : step(k - 2))));
}

function signed(value: number): number {
  return value < 0 ? -2 * value + 1 : 2 * value;
}

function digits(number: number): string {
  let text = '';
  let rest = number;
  while (rest > 31) {
    text += DIGITS.charAt(32 + (rest % 32));
    rest = Math.floor(rest / 32);
  }
  return text + DIGITS.charAt(rest);
}

/**
 * Strokes as objects.
 *
 * @throws {RockFieldError} for what is no text of strokes.
 */
export function strokesOfText(text: string): Stroke[] {
  return numbersOf(checkStrokes(text)).map(([mode = 0, layer = 0, width = 0, ...points]) => ({
    mode: STROKE_MODES[mode]!,
    layer: layer === 0 ? null : layer - 1,
    width: width / UNITS,
    points: points.map((value) => value / UNITS),
  }));
}
