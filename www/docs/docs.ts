/** The documentation's script: brings examples, the gallery and the buttons to life. The element comes from `rock-field.js`, as in any other page. */

import { copyButton } from './copy.ts';
import { keep } from './keeper.ts';
import { LiveExample } from './live-example.ts';
import type { KeepMessage } from '../pages/service-worker.ts';

customElements.define('live-example', LiveExample);

for (const figure of document.querySelectorAll('figure.code'))
  figure.append(copyButton(() => figure.querySelector('code')?.textContent ?? ''));

for (const preset of document.querySelectorAll('.preset')) {
  const stage = preset.querySelector('.stage');
  const field = stage?.firstElementChild;
  if (!stage || !field) continue;
  field.remove();
  keep({ box: stage, start: () => stage.append(field), stop: () => field.remove() });
  preset.querySelector('.preset-links')?.prepend(copyButton(() => preset.querySelector('pre')?.textContent ?? ''));
}

// Beside the text there is room for the contents; above it they would be in the way.
const contents = document.querySelector<HTMLDetailsElement>('.nav details');
const beside = matchMedia('(min-width: 62rem)');
const showContents = () => {
  if (contents) contents.open = beside.matches;
};
beside.addEventListener('change', showContents);
showContents();

// Where the page has made the site work offline, what was read here can be read again without a network.
void navigator.serviceWorker?.getRegistration('../').then((registration) => {
  const urls = [location.href, ...performance.getEntriesByType('resource').map(({ name }) => name)];
  registration?.active?.postMessage({ type: 'keep', urls } satisfies KeepMessage);
});
