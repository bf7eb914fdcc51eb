/** Style sheets of shadow roots. They are constructed, since a strict content security policy refuses `<style>`, and belong to one document. */

/** What a page without a browser (jsdom, happy-dom) lacks in part: there the elements do nothing, as on a server. */
export const CAN_SHOW =
  ['Worker', 'ResizeObserver', 'IntersectionObserver', 'matchMedia'].every((name) => name in globalThis) &&
  'replaceSync' in (globalThis.CSSStyleSheet?.prototype ?? {});

const sheets = new WeakMap<Document, Map<string, CSSStyleSheet>>();

/** Adds styles to a root, once; to be called again when the root has come into another document, which takes them away. */
export function addStyles(root: ShadowRoot, text: string): void {
  const sheet = sheetOf(root.ownerDocument, text);
  if (sheet && !root.adoptedStyleSheets.includes(sheet)) root.adoptedStyleSheets.push(sheet);
}

export function removeStyles(root: ShadowRoot, text: string): void {
  const sheet = sheetOf(root.ownerDocument, text);
  root.adoptedStyleSheets = root.adoptedStyleSheets.filter((other) => other !== sheet);
}

/** One for all roots of a document; none where the document is in no window. */
function sheetOf(document: Document, text: string): CSSStyleSheet | undefined {
  const view = document.defaultView;
  if (!view || !CAN_SHOW) return undefined;
  const own = sheets.get(document) ?? new Map<string, CSSStyleSheet>();
  sheets.set(document, own);
  let sheet = own.get(text);
  if (!sheet) {
    sheet = new view.CSSStyleSheet();
    sheet.replaceSync(text);
    own.set(text, sheet);
  }
  return sheet;
}
