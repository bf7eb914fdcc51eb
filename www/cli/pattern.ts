/** Names of files with places for what differs: `{preset}-{seed:4}.{format}`. */

import path from 'node:path';
import { misuse } from './failures.ts';
import { didYouMean } from './suggest.ts';

/** What can stand in a pattern, and what it stands for. */
export const PLACES = {
  preset: 'the preset that the scene began with',
  seed: 'its seed',
  index: 'its number in this run, from 1 on',
  map: 'the map that the file shows',
  target: 'the program that the file is for',
  format: 'the ending of the file, without the point',
} as const;

export type Place = keyof typeof PLACES;
export type Values = Record<Place, string | number>;

const BRACES = /\{([^{}:]*)(?::([^{}]*))?\}/g;
/** The most digits that a number is filled up to. */
const MOST_DIGITS = 20;

/** @throws {Ending} naming a place that there is not. */
export function checkPattern(pattern: string): void {
  for (const [whole, place = '', digits] of pattern.matchAll(BRACES)) {
    if (!Object.hasOwn(PLACES, place))
      throw misuse(
        `--out ${pattern}: there is no ${whole}; it may be ${Object.keys(PLACES)
          .map((name) => `{${name}}`)
          .join(', ')}.${didYouMean(place, Object.keys(PLACES), (word) => `{${word}}`)}`,
      );
    const isNumber = place === 'seed' || place === 'index';
    if (digits !== undefined && !(isNumber && /^\d{1,2}$/.test(digits) && Number(digits) <= MOST_DIGITS))
      throw misuse(`--out ${pattern}: digits are written as {seed:4} or {index:4}, and not as ${whole}`);
  }
}

/** The pattern with values in its places. */
export function filledPattern(pattern: string, values: Values): string {
  return pattern.replace(BRACES, (_, place: Place, digits?: string) => String(values[place]).padStart(Number(digits ?? 0), '0'));
}

/**
 * Where the files are going to be.
 *
 * @throws {Ending} where two would be written to one file.
 */
export function filesOf(pattern: string, all: readonly Values[]): string[] {
  checkPattern(pattern);
  const files = all.map((values) => filledPattern(pattern, values));
  const taken = new Map<string, number>();
  files.forEach((file, index) => {
    // Some systems take Rocks.glb and rocks.glb for one file.
    const key = path.resolve(file).toLowerCase();
    const other = taken.get(key);
    if (other !== undefined) throw misuse(sameFile(pattern, file, all[other]!, all[index]!));
    taken.set(key, index);
  });
  return files;
}

function sameFile(pattern: string, file: string, one: Values, other: Values): string {
  const differing = (Object.keys(PLACES) as Place[]).filter((place) => place !== 'index' && one[place] !== other[place]);
  const missing = differing.find((place) => !pattern.includes(`{${place}`)) ?? 'index';
  const { dir, name, ext } = path.parse(pattern);
  const better = path.join(dir, `${name}-{${missing}}${ext}`);
  return `numbers ${one.index} and ${other.index} of ${'these'} would both be written to ${file}: put {${missing}} into it, as in --out ${better}`;
}
