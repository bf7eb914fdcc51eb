/** The language of the page around an element: that of the nearest `lang`, across shadow roots. */

export function languageOf(element: Element): 'en' | 'ja' {
  const lang =
    rootsOf(element)
      .map(({ from }) => from.closest('[lang]'))
      .find(Boolean)
      ?.getAttribute('lang') ?? '';
  return lang.toLowerCase().startsWith('ja') ? 'ja' : 'en';
}

/** Calls `changed` after every change of a `lang` that may be the nearest one, until `signal` is aborted. */
export function watchLanguage(element: Element, changed: () => void, signal: AbortSignal): void {
  const observer = new MutationObserver(changed);
  for (const { root } of rootsOf(element)) observer.observe(root, { subtree: true, attributeFilter: ['lang'] });
  signal.addEventListener('abort', () => observer.disconnect());
}

/** The roots that an element stands in, from the inside out, each with the element in it: itself, then the hosts. */
function rootsOf(element: Element): { from: Element; root: Node }[] {
  const root = element.getRootNode();
  // A link has a `host` too, and may be the root where there is no document.
  const host = root.nodeType === Node.DOCUMENT_FRAGMENT_NODE ? (root as Partial<ShadowRoot>).host : undefined;
  return [{ from: element, root }, ...(host ? rootsOf(host) : [])];
}
