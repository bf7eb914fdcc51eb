/** Copying, and what is copied. */

/** Whether `text` is in the clipboard now. */
export async function copyText(text: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    // No permission, no secure context, or an old browser: the way of old browsers may still work.
    return copyBySelection(text);
  }
}

function copyBySelection(text: string): boolean {
  const focused = document.activeElement;
  const field = document.createElement('textarea');
  field.className = 'visually-hidden';
  field.readOnly = true;
  field.value = text;
  document.body.append(field);
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

/** Two lines of HTML that show the field of `link` on any page. `page` is this page's address. */
export function embedCode(link: string, page: string): string {
  // The classic script, because it can start its workers from other pages' origins.
  const script = new URL('cdn.js', page.replace(/[?#].*$/s, '')).href;
  return [
    `<script async src="${escaped(script)}"></script>`,
    `<rock-field src="${escaped(`#${link}`)}" style="width: 100%; height: 60vh"></rock-field>`,
  ].join('\n');
}

function escaped(text: string): string {
  return text.replaceAll('&', '&amp;').replaceAll('"', '&quot;').replaceAll('<', '&lt;');
}
