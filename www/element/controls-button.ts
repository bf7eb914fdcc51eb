/**
 * The button in the corner of an element with `controls`, and what comes and goes behind it: the panel, loaded when it is first
 * wanted. Of the panel itself this file knows nothing but that it can be opened, told of changes and closed.
 */

import type { ControlledElement, OpenPanel, PanelOwner } from './panel-owner.ts';
import type { Kind } from '../table/table.ts';
import { addStyles } from '../base/document-styles.ts';

const WORDS = {
  controls: { en: 'Controls', ja: '設定' },
  failed: {
    en: 'The controls could not be loaded. Press their button to try again.',
    ja: '設定を読み込めませんでした。もう一度ボタンを押してください。',
  },
} as const;

const SVG = 'http://www.w3.org/2000/svg';
/** Two sliders. */
const ICON = 'M2 4.5h6m4 0h2M8 4.5a2 2 0 1 0 4 0a2 2 0 1 0-4 0M2 11.5h2m4 0h6M4 11.5a2 2 0 1 0 4 0a2 2 0 1 0-4 0';

const STYLES = `
.controls-button {
  position: absolute; inset-block-start: 8px; inset-inline-end: 8px; width: 32px; height: 32px; padding: 0; display: grid; place-items: center;
  border: 0; border-radius: 6px; cursor: pointer; color-scheme: light dark;
  color: #1e2124; background: rgb(250 250 248 / .92); box-shadow: 0 0 0 1px rgb(128 128 128 / .4);
}
@supports (color: light-dark(red, red)) {
  .controls-button { color: light-dark(#1e2124, #e8e8e6); background: light-dark(rgb(250 250 248 / .92), rgb(29 31 34 / .9)) }
}
.controls-button[data-theme=light] { color-scheme: light }
.controls-button[data-theme=dark] { color-scheme: dark }
.controls-button:hover:enabled { box-shadow: 0 0 0 1px currentcolor }
.controls-button:focus-visible { outline: 2px solid var(--rock-field-accent, Highlight); outline-offset: 2px }
.controls-button:disabled { opacity: .5; cursor: default }
.controls-button path { fill: none; stroke: currentcolor; stroke-width: 1.4; stroke-linecap: round }
.controls-button[aria-busy=true] svg { animation: controls-wait 1s infinite alternate }
@keyframes controls-wait { to { opacity: .3 } }
@media (pointer: coarse) { .controls-button { width: 40px; height: 40px } }
`;

export class ControlsButton<K extends Kind, Owner extends ControlledElement> {
  readonly #button = document.createElement('button');
  readonly #owner: PanelOwner<K, Owner>;
  #panel: OpenPanel | undefined;
  /** Counts openings and closings: what has loaded meanwhile may no longer be wanted. */
  #turn = 0;
  #attribute: string | null = null;
  #hasFailed = false;

  constructor(owner: PanelOwner<K, Owner>) {
    this.#owner = owner;
    const button = this.#button;
    button.type = 'button';
    button.className = 'controls-button';
    button.setAttribute('part', 'controls-button');
    button.setAttribute('aria-expanded', 'false');
    button.addEventListener('click', () => (this.#isLoading ? this.close() : void this.open(true)));
    const icon = document.createElementNS(SVG, 'svg');
    icon.setAttribute('viewBox', '0 0 16 16');
    icon.setAttribute('width', '16');
    icon.setAttribute('aria-hidden', 'true');
    icon.append(document.createElementNS(SVG, 'path'));
    icon.firstElementChild?.setAttribute('d', ICON);
    button.append(icon);
  }

  get #isLoading(): boolean {
    return this.#button.ariaBusy === 'true';
  }

  /** The element has an attribute more or less, or has come into a document. */
  update(): void {
    const { element, root } = this.#owner;
    const attribute = element.getAttribute('controls');
    addStyles(root, STYLES);
    this.#button.disabled = element.hasAttribute('disabled');
    if (attribute === null || this.#button.disabled) this.close();
    if (attribute === null) this.#button.remove();
    else if (!this.#button.isConnected) root.append(this.#button);
    const isNew = attribute !== this.#attribute;
    this.#attribute = attribute;
    if (isNew) this.begin();
    this.sync();
  }

  /** Opens the panel where the attribute asks for it; the focus stays where it is. */
  begin(): void {
    if (this.#attribute === 'open') void this.open(false);
  }

  async open(takeFocus: boolean): Promise<void> {
    const { isOpen, say, language } = this.#owner;
    if (this.#panel || this.#isLoading || this.#button.disabled || !isOpen()) return;
    const turn = ++this.#turn;
    this.#button.ariaBusy = 'true';
    try {
      const { openPanel } = await this.#owner.loadPanel();
      if (turn !== this.#turn) return;
      this.#panel = openPanel(this.#owner, () => this.close());
      this.#button.hidden = true;
      this.#hasFailed = false;
      if (takeFocus) this.#panel.focus();
    } catch (thrown) {
      console.warn(thrown);
      if (turn !== this.#turn) return;
      this.#hasFailed = true;
      say(WORDS.failed[language()]);
    }
    this.#button.ariaBusy = 'false';
    this.sync();
  }

  /** Also gives a panel up that has not come yet. */
  close(): void {
    const panel = this.#panel;
    this.#turn += 1;
    this.#panel = undefined;
    this.#button.ariaBusy = 'false';
    this.#button.hidden = false;
    if (panel?.hasFocus) this.#button.focus();
    panel?.dispose();
  }

  sync(): void {
    const { element, language } = this.#owner;
    const label = WORDS[this.#hasFailed ? 'failed' : 'controls'][language()];
    this.#button.dataset.theme = element.theme;
    this.#button.ariaLabel = label;
    this.#button.title = label;
    this.#panel?.sync();
  }
}
