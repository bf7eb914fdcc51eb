/** The styles of an element's panel, as constructed sheets: a strict content security policy refuses `<style>`. */

import css from '../styles/embedded.css';

/** Width of a panel that stands beside its picture, and height of one below. */
const INLINE_SIZE = '344px';
const BLOCK_SIZE = '58%';
/** Height of a sheet over a small picture, of which a strip is always left to be seen. */
const SHEET_SIZE = 'max(62%, min(100% - 48px, 240px))';

/** For the element's root: where panel and picture stand in the element. What is before the panel in the tree makes room for it. */
export const LAYOUT_STYLES = `
.controls-panel { position: absolute; inset: 0 }
.controls-panel[data-layout=beside] { inset-inline-start: auto; inline-size: ${INLINE_SIZE} }
.controls-panel[data-layout=below] { inset-block-start: auto; block-size: ${BLOCK_SIZE} }
.controls-panel[data-layout=over] { inset-block-start: auto; block-size: ${SHEET_SIZE} }
:is(.stage, .poster, .progress, .message, .hint):has(~ .controls-panel[data-layout=beside]) { inset-inline-end: ${INLINE_SIZE} }
:is(.stage, .poster, .message):has(~ .controls-panel[data-layout=below]) { inset-block-end: ${BLOCK_SIZE} }
:is(.stage, .poster, .message):has(~ .controls-panel[data-layout=over]) { inset-block-end: ${SHEET_SIZE} }
.hint:has(~ .controls-panel[data-layout=below]) { inset-block-start: calc((100% - ${BLOCK_SIZE}) / 2) }
.hint:has(~ .controls-panel[data-layout=over]) { inset-block-start: calc((100% - ${SHEET_SIZE}) / 2) }
.stage:has(~ .controls-panel) { inline-size: auto; block-size: auto }
`;

/** Many pages set their root to 10 px; a panel for people to read takes the root's size only where it is larger than 16 px. */
function rootFree(text: string): string {
  return text.replace(/(-?[\d.]+)rem\b/g, 'calc($1*max(1rem,16px))');
}

/** For the panel's own root. */
export const PANEL_STYLES = rootFree(css);
