/** Lists of seeds as they are typed: `1..1000`, `1,5,9..12`. */

import { misuse } from './failures.ts';

/** So many scenes can be asked for at once; more are for `rock-field batch`. */
export const MOST_SCENES = 1_000_000;

/** @throws {Ending} for what is no such list, for seeds that there are not, and for one that stands in it twice. */
export function seedsOf(text: string, { min, max }: { min: number; max: number }): number[] {
  const seeds: number[] = [];
  for (const part of text.split(',')) {
    const [, from = '', to = from] = /^\s*(\d+)\s*(?:\.\.\s*(\d+)\s*)?$/.exec(part) ?? [];
    const [first, last] = [Number(from), Number(to)];
    if (from === '' || last < first)
      throw misuse(`--seeds ${text}: write a range as 1..1000, or single seeds as 1,5,9; ${JSON.stringify(part.trim())} is neither`);
    if (first < min || last > max) throw misuse(`--seeds ${text}: a seed is a whole number from ${min} to ${max}`);
    if (seeds.length + last - first >= MOST_SCENES)
      throw misuse(`--seeds ${text}: these are more than ${MOST_SCENES} scenes; make them in several runs`);
    for (let seed = first; seed <= last; seed++) seeds.push(seed);
  }
  if (new Set(seeds).size < seeds.length) throw misuse(`--seeds ${text}: a seed stands in it twice`);
  return seeds;
}
