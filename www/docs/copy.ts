/** Buttons that copy. */

import { copyText } from '../controls/clipboard.ts';
import { word } from './words.ts';

const SAY_MS = 1600;

export function copyButton(text: () => string): HTMLButtonElement {
  const button = document.createElement('button');
  button.type = 'button';
  button.className = 'button';
  const label = document.createElement('span');
  label.setAttribute('aria-live', 'polite');
  label.textContent = word('copy');
  button.append(label);
  let saying: ReturnType<typeof setTimeout> | undefined;
  button.addEventListener('click', async () => {
    label.textContent = word((await copyText(text(), document.body)) ? 'copied' : 'notCopied');
    clearTimeout(saying);
    saying = setTimeout(() => (label.textContent = word('copy')), SAY_MS);
  });
  return button;
}
