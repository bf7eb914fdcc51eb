/** What is going on: a message that waits to be dismissed, a run with a button to cancel it. */

import { html, nothing } from 'lit';
import { icon } from './icons.ts';
import { iconButton } from './parts.ts';
import { percent } from './numbers.ts';
import type { TemplateResult } from 'lit';
import type { Kind } from '../table/table.ts';
import type { Store } from './store.ts';

/** Only text goes in here: much of it comes from links. */
export function messageLine<K extends Kind>(store: Store<K>): TemplateResult | typeof nothing {
  const { messages, language, remedy } = store;
  if (remedy) {
    return html`
      <div class="message is-remedy" role="alert">
        <p>${remedy.text(language)}</p>
        <button class="button" type="button" @click=${remedy.act}>${remedy.label(language)}</button>
        ${iconButton({ icon: 'close', label: store.text('dismiss'), action: () => store.setRemedy(null) })}
      </div>
    `;
  }
  const [first] = messages;
  if (!first) return nothing;
  return html`
    <div class=${first.isProblem ? 'message is-problem' : 'message'} role=${first.isProblem ? 'alert' : 'status'}>
      <p>${first.text(language)}</p>
      ${messages.length > 1 ? html`<span class="quiet">1 / ${messages.length}</span>` : nothing}
      ${iconButton({ icon: 'close', label: store.text('dismiss'), action: () => store.dismiss() })}
    </div>
  `;
}

export function progressLine<K extends Kind>(store: Store<K>, cancel: () => void): TemplateResult | typeof nothing {
  const { progress, offer } = store;
  if (!progress) return nothing;
  const share = percent(progress.fraction).replace(/\.\d/, '');
  const label = store.text('working', { stage: store.stageName(progress.stage), percent: share });
  return html`
    <div class="progress">
      <progress max="1" .value=${progress.fraction} aria-label=${label}></progress>
      <span class="progress-text">${label}</span>
      <button class="button cancel" type="button" @click=${cancel}>${icon('close')}${store.text('cancel')}</button>
      ${offer ? html`<div class="progress-offer"><p>${offer.text}</p><button class="button" type="button" @click=${offer.take}>${offer.label}</button></div>` : nothing}
    </div>
  `;
}
