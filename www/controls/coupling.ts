/** What couples a store with the element whose history it shares, on a page as in a panel: each follows what the other changes. */

import { errorInfo } from '../base/errors.ts';
import type { GeneratorElement, ElementEventMap } from '../element/generator-element.ts';
import type { Kind } from '../table/table.ts';
import type { Store } from './store.ts';

/** Returns what adds a listener of an element's events, until `signal` is aborted. */
export function listensTo(element: HTMLElement, signal?: AbortSignal): <Event>(type: string, listener: (event: Event) => void) => void {
  return (type, listener) => element.addEventListener(type, listener as EventListener, signal && { signal });
}

/**
 * `result`: what the element shows. The element is listened to until `signal` is aborted.
 *
 * Returns what has to be called when the element has changed the history; it returns whether the camera of a refused link has to be taken
 * back, too.
 */
export function couple<K extends Kind>(
  store: Store<K>,
  element: GeneratorElement<K>,
  result: () => K['result'] | null,
  signal?: AbortSignal,
): () => boolean {
  /** The parameters that element and store agreed on last. */
  let agreed = store.params;
  store.subscribe((change) => {
    if (change === 'look') Object.assign(element, { view: store.view, color: store.chosenColor });
    if (change !== 'params' || store.params === agreed) return;
    agreed = store.params;
    try {
      // The preset is in the history, which both share.
      element.params = agreed;
    } catch (thrown) {
      store.refuse(errorInfo(thrown));
    }
  });

  const on = listensTo(element, signal);
  const showBackend = () => store.setBackend(element.backend);
  on('load', showBackend);
  on('restored', showBackend);
  on('generate', ({ detail }: CustomEvent<{ superseded: boolean }>) => {
    showBackend();
    const shown = result();
    if (shown) store.showResult(shown, detail.superseded);
  });
  on('progress', ({ detail }: ElementEventMap<K['stage']>['progress']) => store.setProgress(detail));
  on('error', (event: ElementEventMap<string>['error']) => {
    // The panel has words for it.
    event.preventDefault();
    const { error, shown: isSaid } = event.detail;
    if (isSaid) store.setProgress(null);
    else void store.fail(error);
  });

  return () => {
    if (store.params === agreed) return false;
    agreed = store.params;
    return store.sync();
  };
}
