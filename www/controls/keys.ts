/** The page's own keys. The picture has keys too, while it has the focus. */

import { isDialogOpen } from './parts.ts';
import type { Kind } from '../table/table.ts';
import type { Store } from './store.ts';

export interface PageActions {
  frameAll: () => void;
  help: () => void;
}

export function listenToKeys<K extends Kind>(store: Store<K>, actions: PageActions): void {
  window.addEventListener('keydown', (event) => {
    if (event.defaultPrevented || event.isComposing || isDialogOpen(document.body)) return;
    const handled = travel(store, event) || (!hasModifier(event) && !isTyping(event) && press(store, event.key, actions));
    if (handled) event.preventDefault();
  });
}

/** Undo and redo are the page's, or the panel's, even inside a number field: what was typed there has long been applied. */
export function travel<K extends Kind>(store: Store<K>, event: KeyboardEvent): boolean {
  const key = event.key.toLowerCase();
  if (event.altKey || !(event.ctrlKey || event.metaKey) || (key !== 'z' && key !== 'y')) return false;
  if (event.target instanceof HTMLElement) delete event.target.dataset.typing;
  if (key === 'y' || event.shiftKey) store.redo();
  else store.undo();
  return true;
}

/** With one of these a key is the browser's or the system's. */
export function hasModifier({ altKey, ctrlKey, metaKey }: KeyboardEvent): boolean {
  return altKey || ctrlKey || metaKey;
}

function press<K extends Kind>(store: Store<K>, key: string, { frameAll, help }: PageActions): boolean {
  const view = store.table.views[Number(key) - 1];
  if (view) store.setView(view);
  else if (key === '?') help();
  else if (key === 'f' || key === 'F') frameAll();
  else if (key === '[' || key === ']') store.setSeed(store.params.seed + (key === ']' ? 1 : -1));
  else return false;
  return true;
}

/** Whether the key means something to the control that has the focus: text, numbers, the letters of a menu. */
function isTyping({ target }: Event): boolean {
  if (target instanceof HTMLInputElement) return target.type !== 'range' && target.type !== 'radio';
  return target instanceof HTMLSelectElement || target instanceof HTMLTextAreaElement;
}
