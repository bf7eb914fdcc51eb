/** What a page has for hands once there is a picture: its keys, and the button that lets them walk. */

import { html, nothing } from 'lit';
import { lazily } from '../base/lazy.ts';
import type { GeneratorElement } from '../element/generator-element.ts';
import { isPlan } from '../scene/camera/camera.ts';
import type { Kind } from '../table/table.ts';
import { drawn } from './icons.ts';
import { listenToKeys } from './keys.ts';
import type { PageActions } from './keys.ts';
import type { StageOverlay } from './stage-overlay.ts';
import type { Store } from './store.ts';

/** Somebody who walks. */
const WALK = 'M9 2.8h.01M8.4 5 7.3 8.9l2.3 2.3.4 3M7.3 8.9l-.7 2.7-2.3 2.6M8.4 5 5.8 6.4l-.6 2.4M8.4 5l1.5 2.3 2.3.8';

export async function takeInHand<K extends Kind>(
  store: Store<K>,
  element: GeneratorElement<K>,
  overlay: StageOverlay,
  actions: PageActions,
): Promise<void> {
  listenToKeys(store, actions);
  await element.ready;
  const { later } = await lazily(() => import('./strings-later.ts'));
  const toggle = (): void => {
    element.navigation = element.navigation === 'walk' ? 'orbit' : 'walk';
  };
  overlay.more = () => {
    // There is nowhere to walk in a plan.
    if (isPlan(store.view) || element.backend === 'canvas2d') return nothing;
    const label = later(store.language, 'walk');
    return html`<button class="button icon-button on-picture" type="button" title=${label} aria-label=${label} aria-pressed=${element.navigation === 'walk'} @click=${toggle}>
      ${drawn(WALK)}
    </button>`;
  };
  // Escape ends a walk, and so does whatever else moves the camera.
  new MutationObserver(() => overlay.requestUpdate()).observe(element, { attributeFilter: ['navigation'] });
}
