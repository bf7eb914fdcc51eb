/** One layer of the list: its name and numbers in a line, its parameters below. */

import { html, nothing } from 'lit';
import { MAX_LAYERS } from '../params.ts';
import { LAYER_ROWS, readValue } from '../params-flat.ts';
import { icon } from './icons.ts';
import { paramControl, problemOf, shownNumber } from './param-control.ts';
import { iconButton, segments } from './parts.ts';
import { rockCount } from './summary.ts';
import type { TemplateResult } from 'lit';
import type { Layer, ParamSpec } from '../params.ts';
import type { Store } from './store.ts';

/** Colours of the renderer's palette, repeated by layer id; page.css has them. */
const COLORS = 8;
/** What a switch to counting starts from when nothing has been generated yet. */
const FALLBACK_COUNT = 20;

const COUNT = LAYER_ROWS.find(({ kind }) => kind === 'optional-integer');
const SIZE_ROWS = LAYER_ROWS.filter(({ stage }) => stage !== 'mesh' && stage !== 'look');
const SHAPE_ROWS = LAYER_ROWS.filter(({ component }) => component !== null);
const WEAR_ROWS = LAYER_ROWS.filter(({ stage, component }) => stage === 'mesh' && component === null);
const LOOK_ROWS = LAYER_ROWS.filter(({ stage }) => stage === 'look');

export interface LayerCard {
  store: Store;
  layer: Layer;
  index: number;
  isOpen: boolean;
  toggle: () => void;
}

export function layerCard({ store, layer, index, isOpen, toggle }: LayerCard): TemplateResult {
  const n = index + 1;
  const bodyId = `layer-${index}`;
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
          action: () => store.duplicateLayer(index),
          disabled: store.params.layers.length >= MAX_LAYERS,
        })}
        ${iconButton({ icon: 'remove', label: store.text('removeLayer', { n }), action: () => store.removeItem(index) })}
      </div>
      <div class="layer-body" id=${bodyId} ?hidden=${!isOpen}>${isOpen ? controls(store, layer, index) : nothing}</div>
    </li>
  `;
}

/** `r 90 px · 19 rocks`. */
function numbers(store: Store, layer: Layer): string {
  const { notation } = store.params;
  const unit = LAYER_ROWS[0]?.unit[notation] ?? '';
  const made = store.field?.layers.find(({ id }) => id === layer.id);
  const count = made && rockCount(store, made.selected.length);
  return [`r ${shownNumber(layer.radius)}${notation === 'px' ? ` ${unit}` : ''}`, count].filter(Boolean).join(' · ');
}

function controls(store: Store, layer: Layer, index: number): TemplateResult {
  const isNatural = store.color === 'natural';
  const isWorn = WEAR_ROWS.some((spec) => readValue(layer, spec) !== spec.default);
  const rows = (specs: readonly ParamSpec[]) => specs.map((spec) => paramControl(store, spec, index));
  return html`
    ${SIZE_ROWS.map((spec) => sizeControl(store, spec, layer, index))} ${isNatural ? rows(LOOK_ROWS) : nothing}
    ${part(store.text('shape'), !isWorn, rows(SHAPE_ROWS))} ${part(store.text('wear'), isWorn, rows(WEAR_ROWS))}
  `;
}

/** What shapes the rocks of the papers and what wears natural ones are seldom wanted at once. */
function part(name: string, isOpen: boolean, content: TemplateResult[]): TemplateResult {
  return html`
    <details class="part" ?open=${isOpen}>
      <summary>${name}${icon('down')}</summary>
      ${content}
    </details>
  `;
}

function sizeControl(store: Store, spec: ParamSpec, layer: Layer, index: number): TemplateResult | typeof nothing {
  const isCount = spec === COUNT;
  const isArea = spec.key === 'areaFraction';
  if (isCount && layer.cellCount === null) return nothing;
  if (isArea && layer.cellCount !== null) return fillBy(store, layer, index);
  return html`${isArea ? fillBy(store, layer, index) : nothing} ${paramControl(store, spec, index)}`;
}

/** By area or by count: a count replaces the area. */
function fillBy(store: Store, layer: Layer, index: number): TemplateResult {
  const setCount = (count: number | null) => COUNT && store.setParam(COUNT, index, count);
  return segments({
    name: `fill-${index}`,
    label: store.text('stopBy'),
    help: store.text('stopByHelp'),
    options: [
      { value: 'area', label: store.text('byArea') },
      { value: 'count', label: store.text('byCount') },
    ],
    value: layer.cellCount === null ? 'area' : 'count',
    // As many as there are, so that the switch itself changes nothing.
    action: (by) => setCount(by === 'area' ? null : (store.field?.layers.find(({ id }) => id === layer.id)?.selected.length ?? FALLBACK_COUNT)),
  });
}

/** Whether the layer has a control that something is wrong with: its card has to be open then. */
export function hasProblem(store: Store, index: number): boolean {
  return LAYER_ROWS.some((spec: ParamSpec) => problemOf(store, spec, index) !== null);
}
