/** What is known of the field that is shown, in a line. */

import { counted, percent } from '../../controls/numbers.ts';
import type { Store } from '../../controls/store.ts';
import type { Rocks } from '../table.ts';

export function rockCount(store: Store<Rocks>, n: number): string {
  return n === 1 ? store.text('oneRock') : store.text('someRocks', { n: counted(n) });
}

/** One line: `3,105 rocks · 48,930 triangles · 84.0 % covered`. */
export function summary(store: Store<Rocks>): string {
  const { result: field } = store;
  if (!field) return store.text('notYet');
  const { rocks, triangles, coveredFraction } = field.stats;
  return store.text('summary', {
    rocks: rockCount(store, rocks),
    triangles: counted(triangles),
    covered: percent(coveredFraction),
  });
}
