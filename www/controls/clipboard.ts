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

/** The classic script beside a file of the build, because it can start its workers from other pages' origins. */
const CDN = 'cdn.js';

/** The address of cdn.js beside panel.js. Null where a bundler has taken panel.js elsewhere: then nobody knows of a cdn.js. */
export function cdnBeside(panel: string): string | null {
  // Some bundlers write the path on the disk they were run on.
  return /^https?:.*\/panel\.js$/.test(panel) ? new URL(CDN, panel).href : null;
}

/** Two lines of HTML that show the field of `link` on any page. `page`: an address that cdn.js lies beside. */
export function embedCode(link: string, page: string): string {
  const script = new URL(CDN, page.replace(/[?#].*$/s, '')).href;
  return [
    `<script async src="${escaped(script)}"></script>`,
    `<rock-field src="${escaped(`#${link}`)}" style="width: 100%; height: 60vh"></rock-field>`,
  ].join('\n');
}

function escaped(text: string): string {
  return text.replaceAll('&', '&amp;').replaceAll('"', '&quot;').replaceAll('<', '&lt;');
}
