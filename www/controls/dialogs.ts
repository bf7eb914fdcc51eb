/** What appears for a moment: the list of keys, a text to copy by hand, a toast. Each is made in its place when it is first needed. */

import { html, render } from 'lit';
import { copyText } from './clipboard.ts';
import { iconButton } from './parts.ts';
import type { TemplateResult } from 'lit';
import type { StringKey } from '../strings.ts';
import type { Store } from './store.ts';

const TOAST_MS = 2500;

/** Where it appears: the page's body, or the root of an element's panel. */
export type Place = HTMLElement | ShadowRoot;

const PICTURE_KEYS: readonly [StringKey, StringKey][] = [
  ['orbit', 'orbitBy'],
  ['pan', 'panBy'],
  ['zoom', 'zoomBy'],
];

const PAGE_KEYS: readonly [StringKey, StringKey][] = [
  ['frameAll', 'frameBy'],
  ['view', 'viewsBy'],
  ['seeds', 'seedsBy'],
  ['undo', 'undoBy'],
  ['redo', 'redoBy'],
  ['sliders', 'slidersBy'],
  ['help', 'helpBy'],
];

export function showKeys(store: Store, place: Place): void {
  const rows = (keys: typeof PAGE_KEYS) => html`
    <dl class="keys">${keys.map(([what, how]) => html`<div><dt>${store.text(what)}</dt><dd>${store.text(how)}</dd></div>`)}</dl>
  `;
  const content = html`
    <h3>${store.text('keysPicture')}</h3>
    ${rows(PICTURE_KEYS)}
    <h3>${store.text('keysPage')}</h3>
    ${rows(PAGE_KEYS)}
  `;
  showDialog(store, place, store.text('help'), content);
}

/** Copies and says so; or, the last way when the browser gives no clipboard, shows the text. */
export async function copyOrShow(store: Store, place: Place, text: string, done: StringKey, heading: StringKey): Promise<void> {
  if (await copyText(text, place)) toast(place, store.text(done));
  else showText(store, place, store.text(heading), text);
}

function showText(store: Store, place: Place, heading: string, text: string): void {
  showDialog(store, place, heading, html`<p>${store.text('copyByHand')}</p><textarea class="copy-text" readonly rows="6" .value=${text} aria-label=${heading}></textarea>`);
  place.querySelector<HTMLTextAreaElement>('.dialog .copy-text')?.select();
}

export function isDialogOpen(place: Place): boolean {
  return place.querySelector('dialog[open]') !== null;
}

function showDialog(store: Store, place: Place, heading: string, content: TemplateResult): void {
  const dialog = place.querySelector<HTMLDialogElement>('.dialog') ?? made(place, 'dialog', 'dialog');
  dialog.setAttribute('aria-labelledby', 'dialog-heading');
  const close = () => dialog.close();
  const closeOnBackdrop = (event: Event) => event.target === dialog && dialog.close();
  render(
    html`
      <div class="dialog-content" @click=${(event: Event) => event.stopPropagation()}>
        <div class="section-head">
          <h2 id="dialog-heading">${heading}</h2>
          ${iconButton({ icon: 'close', label: store.text('close'), action: close })}
        </div>
        ${content}
      </div>
    `,
    dialog,
  );
  dialog.onclick = closeOnBackdrop;
  if (!dialog.open) dialog.showModal();
}

const toastTimers = new WeakMap<HTMLElement, ReturnType<typeof setTimeout>>();

/** Says that something was done; read out by screen readers. */
function toast(place: Place, text: string): void {
  const line = place.querySelector<HTMLElement>('.toast') ?? made(place, 'p', 'toast');
  line.setAttribute('role', 'status');
  line.textContent = text;
  line.classList.add('is-shown');
  clearTimeout(toastTimers.get(line));
  toastTimers.set(line, setTimeout(() => line.classList.remove('is-shown'), TOAST_MS));
}

function made<K extends 'dialog' | 'p'>(place: Place, name: K, className: string): HTMLElementTagNameMap[K] {
  const element = document.createElement(name);
  element.className = className;
  place.append(element);
  return element;
}
