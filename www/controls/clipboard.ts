/** Copying, and what is copied. */

/** Whether `text` is in the clipboard now. `place`: where a field may stand for a moment, unseen. */
export async function copyText(text: string, place: HTMLElement | ShadowRoot): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    // No permission, no secure context, or an old browser: the way of old browsers may still work.
    return copyBySelection(text, place);
  }
}

function copyBySelection(text: string, place: HTMLElement | ShadowRoot): boolean {
  const focused = (place.getRootNode() as Document | ShadowRoot).activeElement;
  const field = document.createElement('textarea');
  field.className = 'visually-hidden';
  field.readOnly = true;
  field.value = text;
  place.append(field);
  field.select();
  let isCopied = false;
  try {
    isCopied = document.execCommand('copy');
  } catch {
    // Then by hand.
  }
  field.remove();
  if (focused instanceof HTMLElement) focused.focus();
  return isCopied;
}

/** The classic scripts beside a file of the build, by element: they can start their workers from other pages' origins. */
const CDN: Readonly<Record<string, string>> = { 'rock-field': 'cdn.js', 'wood-ear-log': 'wood-ear-cdn.js' };

/** The address of a panel's file, if its classic script lies beside it. Null where a bundler has taken the panel elsewhere. */
export function panelAddress(panel: string): string | null {
  // Some bundlers write the path on the disk they were run on.
  return /^https?:.*panel-[A-Z0-9]{8}\.js$/.test(panel) ? panel : null;
}

/** Two lines of HTML that show the scene of `link` on any page. `page`: an address that the classic scripts lie beside. */
export function embedCode(element: string, link: string, page: string): string {
  const script = new URL(CDN[element] ?? '', page.replace(/[?#].*$/s, '')).href;
  return [
    `<script async crossorigin src="${escaped(script)}"></script>`,
    `<${element} src="${escaped(`#${link}`)}" style="width: 100%; height: 60vh"></${element}>`,
  ].join('\n');
}

function escaped(text: string): string {
  return text.replaceAll('&', '&amp;').replaceAll('"', '&quot;').replaceAll('<', '&lt;');
}
