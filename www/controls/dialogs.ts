/** What appears for a moment: the list of keys, a text to copy by hand, a toast. Each is made when it is first needed. */

import { html, render } from 'lit';
import { iconButton } from './parts.ts';
import type { TemplateResult } from 'lit';
import type { StringKey } from '../strings.ts';
import type { Store } from './store.ts';

const TOAST_MS = 2500;

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

export function showKeys(store: Store): void {
  const rows = (keys: typeof PAGE_KEYS) => html`
    <dl class="keys">${keys.map(([what, how]) => html`<div><dt>${store.text(what)}</dt><dd>${store.text(how)}</dd></div>`)}</dl>
  `;
  const content = html`
    <h3>${store.text('keysPicture')}</h3>
    ${rows(PICTURE_KEYS)}
    <h3>${store.text('keysPage')}</h3>
    ${rows(PAGE_KEYS)}
  `;
  showDialog(store, store.text('help'), content);
}

/** The last way to a link when the browser gives no clipboard. */
export function showText(store: Store, heading: string, text: string): void {
  showDialog(store, heading, html`<p>${store.text('copyByHand')}</p><textarea class="copy-text" readonly rows="6" .value=${text} aria-label=${heading}></textarea>`);
  document.querySelector<HTMLTextAreaElement>('.dialog .copy-text')?.select();
}

export function isDialogOpen(): boolean {
  return document.querySelector('dialog[open]') !== null;
}

function showDialog(store: Store, heading: string, content: TemplateResult): void {
  const dialog = document.querySelector<HTMLDialogElement>('.dialog') ?? made('dialog', 'dialog');
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

let toastTimer: ReturnType<typeof setTimeout> | undefined;

/** Says that something was done; read out by screen readers. */
export function toast(text: string): void {
  const line = document.querySelector<HTMLElement>('.toast') ?? made('p', 'toast');
  line.setAttribute('role', 'status');
  line.textContent = text;
  line.classList.add('is-shown');
  clearTimeout(toastTimer);
  toastTimer = setTimeout(() => line.classList.remove('is-shown'), TOAST_MS);
}

function made<K extends 'dialog' | 'p'>(name: K, className: string): HTMLElementTagNameMap[K] {
  const element = document.createElement(name);
  element.className = className;
  document.body.append(element);
  return element;
}
