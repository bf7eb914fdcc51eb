/** One layer of the list: its name and numbers in a line, its parameters (`layer-controls.ts`) below. */

import { html, nothing } from 'lit';
import { MAX_LAYERS } from '../params.ts';
import { LAYER_ROWS } from '../request.ts';
import { icon } from '../../controls/icons.ts';
import { problemOf, shownNumber } from '../../controls/numbers.ts';
import { iconButton } from '../../controls/parts.ts';
import { rockCount } from './summary.ts';
import type { TemplateResult } from 'lit';
import type { ParamSpec } from '../spec.ts';
import type { Layer } from '../params.ts';
import type { RockLater } from './deferred.ts';
import type { RockStore } from './store.ts';

/** Colours of the renderer's palette, repeated by layer id; page.css has them. */
const COLORS = 8;
export interface LayerCard {
  /** The card at this place, if there is one, takes the focus. */
  focus: (index: number) => void;
  store: RockStore;
  /** Its parameters come later. */
  later: RockLater | undefined;
  layer: Layer;
  index: number;
  isOpen: boolean;
  toggle: () => void;
}

export function layerCard({ store, later, layer, index, isOpen, toggle, focus }: LayerCard): TemplateResult {
  const n = index + 1;
  const bodyId = `layer-${index}`;
  const remove = (): void => {
    store.removeItem(index);
    focus(index);
  };
  return html`
    <li class="layer" data-layer=${index}>
      <div class="layer-head">
        <button class="layer-toggle" type="button" aria-expanded=${isOpen} aria-controls=${bodyId} @click=${toggle}>
          <span class="chip" data-color=${layer.id % COLORS}></span>
          <span class="layer-name">${store.text('layer', { n })}</span>
          <span class="layer-numbers">${numbers(store, layer)}</span>
          ${icon('down')}
        </button>
        ${iconButton({
          icon: 'duplicate',
          label: store.text('duplicateLayer', { n }),
          action: () => {
            store.duplicateLayer(index);
            focus(index + 1);
          },
          disabled: store.params.layers.length >= MAX_LAYERS,
        })}
        ${iconButton({ icon: 'remove', label: store.text('removeLayer', { n }), action: remove })}
      </div>
      <div class="layer-body" id=${bodyId} ?hidden=${!isOpen}>${isOpen && later ? later.layerControls(store, layer, index) : nothing}</div>
    </li>
  `;
}

/** `r 90 px · 19 rocks`. */
function numbers(store: RockStore, layer: Layer): string {
  const { notation } = store.params;
  const unit = LAYER_ROWS[0]?.unit[notation] ?? '';
  const made = store.field?.layers.find(({ id }) => id === layer.id);
  const count = made && rockCount(store, made.selected.length);
  return [`r ${shownNumber(layer.radius)}${notation === 'px' ? ` ${unit}` : ''}`, count].filter(Boolean).join(' · ');
}

/** Whether the layer has a control that something is wrong with: its card has to be open then. */
export function hasProblem(store: RockStore, index: number): boolean {
  return LAYER_ROWS.some((spec: ParamSpec) => problemOf(store, spec, index) !== null);
}
