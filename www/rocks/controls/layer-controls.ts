/** The parameters of one layer, below its line. */

import { html, nothing } from 'lit';
import { LAYER_ROWS, readValue } from '../request.ts';
import { later } from '../../controls/strings-later.ts';
import { icon } from '../../controls/icons.ts';
import { paramControl } from '../../controls/param-control.ts';
import { segments } from '../../controls/parts.ts';
import type { TemplateResult } from 'lit';
import type { ParamSpec } from '../spec.ts';
import type { Layer } from '../params.ts';
import type { RockStore } from './store.ts';

/** What a switch to counting starts from when nothing has been generated yet. */
const FALLBACK_COUNT = 20;

const COUNT = LAYER_ROWS.find(({ kind }) => kind === 'optional-integer');
const SIZE_ROWS = LAYER_ROWS.filter(({ stage }) => stage !== 'mesh' && stage !== 'look');
const SHAPE_ROWS = LAYER_ROWS.filter(({ component }) => component !== null);
const WEAR_ROWS = LAYER_ROWS.filter(({ stage, component }) => stage === 'mesh' && component === null);
const LOOK_ROWS = LAYER_ROWS.filter(({ stage }) => stage === 'look');

export function layerControls(store: RockStore, layer: Layer, index: number): TemplateResult {
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

function sizeControl(store: RockStore, spec: ParamSpec, layer: Layer, index: number): TemplateResult | typeof nothing {
  const isCount = spec === COUNT;
  const isArea = spec.key === 'areaFraction';
  if (isCount && layer.cellCount === null) return nothing;
  if (isArea && layer.cellCount !== null) return fillBy(store, layer, index);
  return html`${isArea ? fillBy(store, layer, index) : nothing} ${paramControl(store, spec, index, spec.key === 'radius' ? shapeLock(store) : undefined)}`;
}

/** Whether height and taper follow the radius. */
function shapeLock(store: RockStore): TemplateResult {
  const { keepsShape } = store;
  const label = later(store.language, 'keepShape');
  return html`
    <button class="button icon-button lock" type="button" title=${label} aria-label=${label} aria-pressed=${keepsShape} @click=${() => store.setKeepsShape(!keepsShape)}>
      ${icon(keepsShape ? 'lock' : 'unlock')}
    </button>
  `;
}

/** By area or by count: a count replaces the area. */
function fillBy(store: RockStore, layer: Layer, index: number): TemplateResult {
  const setCount = (count: number | null) => COUNT && store.setParam(COUNT, index, count);
  return segments({
    name: `fill-${index}`,
    label: later(store.language, 'stopBy'),
    help: later(store.language, 'stopByHelp'),
    options: [
      { value: 'area', label: later(store.language, 'byArea') },
      { value: 'count', label: later(store.language, 'byCount') },
    ],
    value: layer.cellCount === null ? 'area' : 'count',
    // As many as there are, so that the switch itself changes nothing.
    action: (by) =>
      setCount(by === 'area' ? null : (store.field?.layers.find(({ id }) => id === layer.id)?.selected.length ?? FALLBACK_COUNT)),
  });
}
