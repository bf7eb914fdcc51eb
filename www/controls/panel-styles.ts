/** The styles of an element's panel, as constructed sheets: a strict content security policy refuses `<style>`. */

import css from '../styles/embedded.css';

/** Width of a panel that stands beside its picture, and height of one below. */
const INLINE_SIZE = '344px';
const BLOCK_SIZE = '58%';

/** Where panel and picture stand in the element. What is before the panel in the tree makes room for it. */
const LAYOUT = `
.controls-panel { position: absolute; inset: 0 }
.controls-panel[data-layout=beside] { inset-inline-start: auto; inline-size: ${INLINE_SIZE} }
.controls-panel[data-layout=below] { inset-block-start: auto; block-size: ${BLOCK_SIZE} }
:is(.stage, .poster, .progress, .message, .hint):has(~ .controls-panel[data-layout=beside]) { inset-inline-end: ${INLINE_SIZE} }
:is(.stage, .poster, .message):has(~ .controls-panel[data-layout=below]) { inset-block-end: ${BLOCK_SIZE} }
.hint:has(~ .controls-panel[data-layout=below]) { inset-block-start: calc((100% - ${BLOCK_SIZE}) / 2) }
.stage:has(~ .controls-panel) { inline-size: auto; block-size: auto }
.stage:has(~ .controls-panel[data-layout=over]) { visibility: hidden }
`;

let panelSheet: CSSStyleSheet | undefined;
let layoutSheet: CSSStyleSheet | undefined;

/** For the panel's own root. */
export function panelStyles(): CSSStyleSheet {
  return (panelSheet ??= sheetOf(rootFree(css)));
}

/** For the element's root, beside its own sheets. */
export function layoutStyles(): CSSStyleSheet {
  return (layoutSheet ??= sheetOf(LAYOUT));
}

/** Many pages set their root to 10 px; a panel for people to read takes the root's size only where it is larger than 16 px. */
function rootFree(text: string): string {
  return text.replace(/(-?[\d.]+)rem\b/g, 'calc($1*max(1rem,16px))');
}

function sheetOf(text: string): CSSStyleSheet {
  const sheet = new CSSStyleSheet();
  sheet.replaceSync(text);
  return sheet;
}
