/** The pages, one for each generator, and what each of them showed last in this tab of the browser. */

export const PAGES = [
  { name: 'scene-rocks', href: './' },
  { name: 'scene-wood-ears', href: 'wood-ear.html' },
] as const;

/** What the log lies on is being edited on the page of rocks. */
const GROUND = 'ground';

/** Per page and per copy of the site: an origin may have several. */
function keyOf(href: string): string {
  return `rock-field:${new URL(href, location.href).pathname.replace(/index\.html$/, '')}`;
}

function read(key: string): string | null {
  try {
    return sessionStorage.getItem(key);
  } catch {
    // Storage may be off: then the page begins anew.
    return null;
  }
}

function write(key: string, value: string): void {
  try {
    sessionStorage.setItem(key, value);
  } catch {
    // As above.
  }
}

/** Keeps what this page shows. */
export function rememberPage(link: string): void {
  write(keyOf(location.pathname), link);
}

/** The address of a page as it was left. */
export function pageAddress(href: string): string {
  const link = read(keyOf(href));
  return link === null ? href : `${href}#${link}`;
}

/** From now on the page of rocks offers to go back to the log. */
export function beginGroundEdit(): void {
  write(keyOf(GROUND), '');
}

export function isGroundEdited(): boolean {
  return read(keyOf(GROUND)) !== null;
}

/** The address of the page of wood ears as it was left, with its log on the rocks of `link`. */
export function addressOnGround(link: string): string {
  const { href } = PAGES[1];
  const left = (read(keyOf(href)) ?? '').replace(/(^|&)ground=[^&]*/, '');
  return `${href}#${left || 'preset=fallen-log'}&ground=${encodeURIComponent(link)}`;
}
