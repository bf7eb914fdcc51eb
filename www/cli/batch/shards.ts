/** The parts of a batch: shard K of N makes every Nth item, beginning with item K. Both are counted from 0, as Kubernetes and render farms count. */

import { misuse } from '../failures.ts';

export interface Shard {
  index: number;
  count: number;
}

/** More would be more shards than a batch has items. */
export const MOST_SHARDS = 1_000_000;
export const WHOLE: Shard = { index: 0, count: 1 };

/**
 * @param text `17/160`.
 * @throws {Ending} saying what it must be.
 */
export function shardOf(text: string): Shard {
  const [, first = '', second = ''] = /^(\d{1,9})\/(\d{1,9})$/.exec(text) ?? [];
  const [index, count] = [Number(first), Number(second)];
  if (first === '')
    throw misuse(`--shard is ${JSON.stringify(text)}; it must be like 17/160: a shard, counted from 0, and how many there are`);
  if (count === 0) throw misuse(`--shard is ${text}; there must be at least one shard: 0/1 is the whole batch`);
  if (count > MOST_SHARDS) throw misuse(`--shard is ${text}; there may be at most ${MOST_SHARDS} shards`);
  if (index >= count) throw misuse(`--shard is ${text}; shards are counted from 0, so that the last of ${count} is ${count - 1}/${count}`);
  return { index, count };
}

/** Neighbours in a list are often alike, so each shard takes items from all over it. */
export function isIn({ index, count }: Shard, item: number): boolean {
  return item % count === index;
}
