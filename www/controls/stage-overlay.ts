/** `<stage-overlay>`: what lies on the picture: how it is drawn, what is known of it, what is going on. */

import { LitElement, html, nothing } from 'lit';
import { colorChoice, viewChoice } from './view-choice.ts';
import { iconButton } from './parts.ts';
import { messageLine, progressLine } from './status.ts';
import type { TemplateResult } from 'lit';
import type { Kind } from '../table/table.ts';
import type { Store } from './store.ts';

export interface StageActions {
  cancel: () => void;
  frameAll: () => void;
  toggleFullScreen: () => void;
}

export class StageOverlay extends LitElement {
  static override properties = { store: { attribute: false }, actions: { attribute: false }, more: { attribute: false } };

  declare store: Store<Kind>;
  declare actions: StageActions;
  /** Buttons that come after the first picture. */
  declare more: (() => unknown) | undefined;

  #stopListening: (() => void) | undefined;

  protected override createRenderRoot(): HTMLElement {
    return this;
  }

  override connectedCallback(): void {
    super.connectedCallback();
    const update = () => this.requestUpdate();
    const unsubscribe = this.store.subscribe(update);
    document.addEventListener('fullscreenchange', update);
    this.#stopListening = () => {
      unsubscribe();
      document.removeEventListener('fullscreenchange', update);
    };
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.#stopListening?.();
  }

  protected override render(): TemplateResult {
    const { store, actions } = this;
    const isFull = document.fullscreenElement !== null;
    return html`
      ${messageLine(store)}
      <div class="overlay-start">
        ${viewChoice(store, true)} ${colorChoice(store, true)}
      </div>
      <div class="overlay-end">
        ${this.more?.()}
        ${iconButton({ icon: 'frame', label: `${store.text('frameAll')} (F)`, action: actions.frameAll, kind: 'on-picture' })}
        ${
          document.fullscreenEnabled
            ? iconButton({
                icon: isFull ? 'leaveFullScreen' : 'fullScreen',
                label: store.text(isFull ? 'leaveFullScreen' : 'fullScreen'),
                action: actions.toggleFullScreen,
                kind: 'on-picture',
              })
            : nothing
        }
      </div>
      ${store.result ? html`<p class="summary" aria-hidden="true">${store.summary()}</p>` : nothing} ${progressLine(store, actions.cancel)}
    `;
  }
}

customElements.define('stage-overlay', StageOverlay);

declare global {
  interface HTMLElementTagNameMap {
    'stage-overlay': StageOverlay;
  }
}
