/** The page's address, which tells what is shown, and what the next visit begins with. */

import { rememberPage } from '../controls/site.ts';
import { isLink } from '../table/link.ts';
import type { OpenedLink, Store } from '../controls/store.ts';
import type { Link } from '../table/link.ts';
import type { Kind } from '../table/table.ts';

/** A drag makes some 60 edits a second; Safari allows 100 changes of the address in 30 s. */
const ADDRESS_DELAY_MS = 300;

/** How links are read and written. */
export interface Links<K extends Kind> {
  readLink: (text: string) => OpenedLink<K>;
  encode: (state: Link<K>) => string;
}

export class Address<K extends Kind> {
  readonly #store: Store<K>;
  readonly #links: Links<K>;
  /** Undefined while the address is as it is to be. */
  #timer: ReturnType<typeof setTimeout> | undefined;

  /** Keeps the address of the page from now on. `open` shows another link that has been put there. */
  constructor(store: Store<K>, links: Links<K>, open: (link: OpenedLink<K>) => void) {
    this.#store = store;
    this.#links = links;
    // Whoever leaves the page finds it again as it was left. A click comes before the page is left, a closed window does not.
    document.addEventListener('click', () => this.#writeScheduled(), true);
    window.addEventListener('pagehide', () => {
      this.#writeScheduled();
      if (!store.isSettled) rememberPage(this.#wanted());
    });
    if (isLink(store.table, location.hash)) rememberPage(this.link());
    window.addEventListener('hashchange', ({ newURL }) => {
      // Not the present address: an edit may have been written to it since, which is older than what was put there.
      const { hash } = new URL(newURL);
      // A place on the page, not a link: what is shown stays.
      if (hash !== '' && !isLink(store.table, hash)) return;
      clearTimeout(this.#timer);
      open(links.readLink(hash));
    });
  }

  /** The link of what is shown. */
  link(): string {
    return this.#links.encode(this.#store.shown);
  }

  /** What a page that is opened in place of this one begins with: also what this one has not made. */
  #wanted(): string {
    const { wanted, params, preset, view, chosenColor, camera } = this.#store;
    return this.#links.encode({ view, color: chosenColor, camera, ...(wanted ?? { params, preset }) });
  }

  /** Writes what is shown in a moment; many calls, one change of the address. */
  schedule(): void {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.write(), ADDRESS_DELAY_MS);
  }

  #writeScheduled(): void {
    if (this.#timer !== undefined) this.write();
  }

  /** Writes what is shown now. */
  write(): void {
    clearTimeout(this.#timer);
    this.#timer = undefined;
    // What a run has not made yet may be refused.
    if (this.#store.isSettled) put(this.link());
  }

  /** Writes what is wanted, for the page that is opened in place of this one. */
  leave(): void {
    put(this.#wanted());
  }
}

function put(link: string): void {
  // Without the `?…` it may have been opened with: one link, not two.
  try {
    history.replaceState(null, '', `${location.pathname}#${link}`);
  } catch {
    // A frame without an address of its own, or a browser that has counted too many changes. Links are made without it.
  }
  rememberPage(link);
}
