/** What appears for a moment: the list of keys, a text to copy by hand, a toast. Each is made in its place when it is first needed. */

import { html, render } from 'lit';
import { copyText } from './clipboard.ts';
import { iconButton } from './parts.ts';
import type { Place } from './parts.ts';
import type { TemplateResult } from 'lit';
import { later, LATER } from './strings-later.ts';
import type { LaterKey } from './strings-later.ts';
import type { StringKey } from './strings.en.ts';
import type { Kind } from '../table/table.ts';
import type { Store } from './store.ts';

const TOAST_MS = 2500;
/** For a sentence more. */
const LONG_TOAST_MS = 7000;

const PICTURE_KEYS: readonly [LaterKey, LaterKey][] = [
  ['orbit', 'orbitBy'],
  ['pan', 'panBy'],
  ['zoom', 'zoomBy'],
  ['walk', 'walkBy'],
];

const PAGE_KEYS: readonly [StringKey | LaterKey, LaterKey][] = [
  ['frameAll', 'frameBy'],
  ['view', 'viewsBy'],
  ['seeds', 'seedsBy'],
  ['undo', 'undoBy'],
  ['redo', 'redoBy'],
  ['sliders', 'slidersBy'],
  ['help', 'helpBy'],
];

export function showKeys<K extends Kind>(store: Store<K>, place: Place): void {
  const words = (key: StringKey | LaterKey) => (key in LATER ? later(store.language, key as LaterKey) : store.text(key as StringKey));
  const rows = (keys: typeof PAGE_KEYS) => html`
    <dl class="keys">${keys.map(([what, how]) => html`<div><dt>${words(what)}</dt><dd>${words(how)}</dd></div>`)}</dl>
  `;
  const content = html`
    <h3>${later(store.language, 'keysPicture')}</h3>
    ${rows(PICTURE_KEYS)}
    <h3>${later(store.language, 'keysPage')}</h3>
    ${rows(PAGE_KEYS)}
  `;
  showDialog(store, place, store.text('help'), content);
}

/** Copies and says so; or, the last way when the browser gives no clipboard, shows the text. */
export async function copyOrShow<K extends Kind>(
  store: Store<K>,
  place: Place,
  text: string,
  done: LaterKey,
  heading: StringKey,
): Promise<void> {
  const said = [later(store.language, done), store.leftOut].filter(Boolean).join(store.language === 'ja' ? '。' : '. ');
  if (await copyText(text, place)) toast(place, said, store.leftOut ? LONG_TOAST_MS : TOAST_MS);
  else showText(store, place, store.text(heading), text);
}

function showText<K extends Kind>(store: Store<K>, place: Place, heading: string, text: string): void {
  showDialog(
    store,
    place,
    heading,
    html`<p>${later(store.language, 'copyByHand')} ${store.leftOut}</p><textarea class="copy-text" readonly rows="6" .value=${text} aria-label=${heading}></textarea>`,
  );
  place.querySelector<HTMLTextAreaElement>('.dialog .copy-text')?.select();
}

export function showDialog<K extends Kind>(store: Store<K>, place: Place, heading: string, content: TemplateResult): HTMLDialogElement {
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
  return dialog;
}

const toastTimers = new WeakMap<HTMLElement, ReturnType<typeof setTimeout>>();

/** Says that something was done; read out by screen readers. */
export function toast(place: Place, text: string, ms: number): void {
  const line = place.querySelector<HTMLElement>('.toast') ?? made(place, 'p', 'toast');
  line.setAttribute('role', 'status');
  line.textContent = text;
  line.classList.add('is-shown');
  clearTimeout(toastTimers.get(line));
  toastTimers.set(
    line,
    setTimeout(() => line.classList.remove('is-shown'), ms),
  );
}

function made<K extends 'dialog' | 'p'>(place: Place, name: K, className: string): HTMLElementTagNameMap[K] {
  const element = document.createElement(name);
  element.className = className;
  place.append(element);
  return element;
}
