/** Whether an element can be seen: near the screen, in a tab that shows. */

/** A little ahead of the edge, so that scrolling meets a picture. */
const MARGIN = '64px';

export class Visibility {
  #near = false;
  readonly #document: Document;

  /** Calls `changed` after every change until `signal` is aborted. */
  constructor(element: HTMLElement, changed: () => void, signal: AbortSignal) {
    const { ownerDocument } = element;
    this.#document = ownerDocument;
    const observer = new (ownerDocument.defaultView ?? window).IntersectionObserver(
      (entries) => {
        this.#near = entries.at(-1)?.isIntersecting ?? false;
        changed();
      },
      { rootMargin: MARGIN },
    );
    observer.observe(element);
    signal.addEventListener('abort', () => observer.disconnect());
    ownerDocument.addEventListener('visibilitychange', changed, { signal });
  }

  /** Near the screen, whether or not the tab shows. */
  get near(): boolean {
    return this.#near;
  }

  get visible(): boolean {
    return this.#near && this.#document.visibilityState === 'visible';
  }
}
