/** Where an error of the element is told. */

import { errorText } from './strings-later.ts';
import type { ErrorInfo } from '../base/errors.ts';
import type { Language } from '../base/language.ts';
import type { Kind } from '../table/table.ts';
import type { Store } from './store.ts';
import type { Circumstances } from './store-types.ts';

/**
 * Under the control whose value was refused; where the parameters stay what was refused, since there are none before them, under the control
 * to change; else on the line for the page.
 */
export function placeError<K extends Kind>(store: Store<K>, error: ErrorInfo, { params, isBack, wish }: Circumstances<K>): void {
  const { table } = store;
  const { key = '', layer } = error;
  const text = (language: Language) => errorText(language, error);
  const row = table.rows.find((candidate) => candidate.key === key && layer === undefined);
  const ofItem = row ? undefined : table.itemRows.find((candidate) => candidate.key === key);
  // Without a value the control is not there.
  if (wish && wish.value !== null && (store.valueOf(wish.row, wish.item) ?? null) !== null) {
    if (store.params === params)
      store.setProblem({ key: wish.row.key, item: wish.item, component: wish.row.component, text, refused: wish.value });
  } else if ((isBack || (!row && !ofItem)) && !store.listKeys.includes(key)) store.say(text, true);
  else if (store.params === params) store.setProblem({ key, item: ofItem ? (layer ?? store.itemAtFault()) : null, component: null, text });
}
