/** What the panel knows of its numbers before their controls are there: how they are written, and what is wrong with them. */

import type { Row } from '../table/row.ts';
import type { Kind } from '../table/table.ts';
import type { Store } from './store.ts';

/** Digits shown of a number; its value keeps all of them. */
const SHOWN_DIGITS = 7;

export function problemOf<K extends Kind>(store: Store<K>, spec: Row, item: number | null): string | null {
  const { problem } = store;
  const isHere = problem?.key === spec.key && problem.item === item && (problem.component ?? 0) === (spec.component ?? 0);
  return problem && isHere ? problem.text(store.language) : null;
}

/**
 * Puts the values into the number fields below `root`, but for the one being typed in: “1.” must not turn into “1” under the fingers.
 * Call it after every render.
 */
export function fillNumberFields(root: ParentNode): void {
  for (const field of root.querySelectorAll<HTMLInputElement>('.number-field')) {
    const { shown = '', typing } = field.dataset;
    if (typing === undefined && field.value !== shown) field.value = shown;
  }
}

export function shownNumber(value: number): string {
  return String(Number.isInteger(value) ? value : Number(value.toPrecision(SHOWN_DIGITS)));
}

/** `12.3%`: as both languages write it, but without `Intl`, which takes tens of milliseconds to begin with. */
export function percent(share: number): string {
  // Plus zero: an empty sum may be −0.
  return `${(100 * share + 0).toFixed(1)}%`;
}

/** `1,234`: a count, in the same way. */
export function counted(count: number): string {
  return String(count).replace(/\B(?=(\d{3})+$)/g, ',');
}
