/** `<stage-overlay>`: what lies on the picture: how it is drawn, what is known of it, what is going on. */

import { LitElement, html, nothing } from 'lit';
import { COLORS, VIEWS } from '../url-codec.ts';
import { icon } from './icons.ts';
import { iconButton, segments } from './parts.ts';
import { percent, summary } from './statistics.ts';
import type { TemplateResult } from 'lit';
import type { Store } from './store.ts';

export interface StageActions {
  cancel: () => void;
  frameAll: () => void;
  toggleFullScreen: () => void;
}

export class StageOverlay extends LitElement {
  static override properties = { store: { attribute: false }, actions: { attribute: false } };

  declare store: Store;
  declare actions: StageActions;

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
      ${this.#message()}
      <div class="overlay-start">
        ${segments({
          name: 'view',
          label: store.text('view'),
          hideLabel: true,
          options: VIEWS.map((value) => ({ value, label: store.text(`view-${value}`) })),
          value: store.view,
          action: (view) => store.setView(view),
        })}
        ${segments({
          name: 'color',
          label: store.text('color'),
          hideLabel: true,
          options: COLORS.map((value) => ({ value, label: store.text(`color-${value}`) })),
          value: store.color,
          action: (color) => store.setColor(color),
        })}
      </div>
      <div class="overlay-end">
        ${iconButton({ icon: 'frame', label: `${store.text('frameAll')} (F)`, action: actions.frameAll, kind: 'on-picture' })}
        ${document.fullscreenEnabled
          ? iconButton({
              icon: isFull ? 'leaveFullScreen' : 'fullScreen',
              label: store.text(isFull ? 'leaveFullScreen' : 'fullScreen'),
              action: actions.toggleFullScreen,
              kind: 'on-picture',
            })
          : nothing}
      </div>
      ${store.field ? html`<p class="summary" aria-hidden="true">${summary(store)}</p>` : nothing} ${this.#progress()}
    `;
  }

  /** Only text goes in here: much of it comes from links. */
  #message(): TemplateResult | typeof nothing {
    const { messages, language } = this.store;
    const [first] = messages;
    if (!first) return nothing;
    return html`
      <div class="message" role="alert">
        <p>${first(language)}</p>
        ${messages.length > 1 ? html`<span class="quiet">1 / ${messages.length}</span>` : nothing}
        ${iconButton({ icon: 'close', label: this.store.text('dismiss'), action: () => this.store.dismiss() })}
      </div>
    `;
  }

  #progress(): TemplateResult | typeof nothing {
    const { progress } = this.store;
    if (!progress) return nothing;
    const share = percent(this.store, progress.fraction).replace(/[.,]\d/, '');
    const label = this.store.text('working', { stage: this.store.text(`stage-${progress.stage}`), percent: share });
    return html`
      <div class="progress">
        <progress max="1" .value=${progress.fraction} aria-label=${label}></progress>
        <span class="progress-text">${label}</span>
        <button class="button cancel" type="button" @click=${this.actions.cancel}>${icon('close')}${this.store.text('cancel')}</button>
      </div>
    `;
  }
}

customElements.define('stage-overlay', StageOverlay);

declare global {
  interface HTMLElementTagNameMap {
    'stage-overlay': StageOverlay;
  }
}
