/** One parameter as its row of the table says: a slider with a number beside it, or a choice. */

import { html } from 'lit';
import { live } from 'lit/directives/live.js';
import { labelOf, translate } from './strings.ts';
import { problemOf, shownNumber } from './numbers.ts';
import { menu } from './menu.ts';
import { describedBy, description, mathText, segments } from './parts.ts';
import { sliderScale } from './slider-scale.ts';
import type { TemplateResult } from 'lit';
import type { Row } from '../table/row.ts';
import type { Kind } from '../table/table.ts';
import type { Store } from './store.ts';

/** How far from the middle of the thumb a finger may be to take it; the thumb is as wide as tokens.css has it for fingers. */
const REACH_PX = 24;
const THUMB_PX = 20;
/** A line of a wheel that counts in lines. */
const LINE_PX = 16;

/** More words than these do not fit into a line. */
const MOST_SEGMENTS = 4;

/** The control of a row, for the item `item` (an index) or, with `null`, for the whole. `beside`: what stands beside the number of a slider. */
export function paramControl<K extends Kind>(store: Store<K>, spec: Row, item: number | null, beside?: TemplateResult): TemplateResult {
  return spec.kind === 'choice' ? choiceControl(store, spec, item) : numberControl(store, spec, item, beside);
}

/** The page's id of a control; also how tests find it. */
function idOf(spec: Row, item: number | null): string {
  return item === null ? spec.url : `${spec.url}-${item}`;
}

function choiceControl<K extends Kind>(store: Store<K>, spec: Row, item: number | null): TemplateResult {
  const { language } = store;
  const choose = spec.choices.length > MOST_SEGMENTS ? menu : segments;
  return choose({
    name: idOf(spec, item),
    label: labelOf(language, spec.label),
    help: store.help(spec),
    options: spec.choices.map(({ value, label }) => ({ value, label: labelOf(language, label) })),
    value: String(store.refusedValue(spec, item) ?? store.valueOf(spec, item)),
    action: (value) => store.setParam(spec, item, value),
    problem: problemOf(store, spec, item),
  });
}

function numberControl<K extends Kind>(store: Store<K>, spec: Row, item: number | null, beside?: TemplateResult): TemplateResult {
  const { language, params, table } = store;
  const value = Number(store.refusedValue(spec, item) ?? store.valueOf(spec, item));
  const scale = sliderScale(table.boundsOf(spec, params));
  const unit = table.unitOf(spec, params);
  const shown = shownNumber(value);
  const id = idOf(spec, item);
  const help = store.help(spec);
  const problem = problemOf(store, spec, item);
  const slide = ({ target }: Event) => {
    const slider = target as HTMLInputElement;
    if (slider.dataset.missed === undefined) store.setParam(spec, item, scale.valueAt(slider.valueAsNumber, value));
    else slider.value = String(scale.positionOf(value));
  };
  return html`
    <div class="control" data-param=${id} data-help=${help}>
      <div class="control-head">
        <label class="control-label" for=${id}>${mathText(labelOf(language, spec.label))}</label>
        ${beside} ${numberField({ store, spec, item, id, shown, unit, problem })}
      </div>
      <input
        class="slider"
        type="range"
        id=${id}
        min=${scale.min}
        max=${scale.max}
        step=${scale.step}
        .value=${live(String(scale.positionOf(value)))}
        .style=${fill(scale, scale.positionOf(value))}
        aria-valuetext=${unit ? `${shown} ${unit}` : shown}
        aria-describedby=${describedBy(id, help, problem)}
        @pointerdown=${(event: PointerEvent) => grab(store, event)}
        @keydown=${({ target }: Event) => delete (target as HTMLInputElement).dataset.missed}
        @input=${slide}
      />
      ${description(id, help, problem)}
    </div>
  `;
}

interface NumberField<K extends Kind> {
  store: Store<K>;
  spec: Row;
  item: number | null;
  id: string;
  shown: string;
  unit: string;
  problem: string | null;
}

export function numberField<K extends Kind>({ store, spec, item, id, shown, unit, problem }: NumberField<K>): TemplateResult {
  const { language, params, table } = store;
  const { min, max, step } = table.boundsOf(spec, params);
  const isReal = spec.kind.endsWith('real');
  const isLegal = (typed: number) => typed >= min && typed <= max && (isReal || Number.isInteger(typed));
  const complain = (typed: number) => {
    const key = Number.isFinite(typed) ? 'clampedInField' : 'notANumber';
    store.setProblem({ key: spec.key, item, component: spec.component, text: (at) => translate(at, key, { min, max }) });
  };
  const type = ({ target }: Event) => {
    const field = target as HTMLInputElement;
    field.dataset.typing = '';
    const typed = field.valueAsNumber;
    if (isLegal(typed)) store.setParam(spec, item, typed + 0);
    else complain(typed);
  };
  const settle = ({ target }: Event) => {
    const field = target as HTMLInputElement;
    delete field.dataset.typing;
    const typed = field.valueAsNumber;
    if (Number.isFinite(typed) && !isLegal(typed)) {
      const inside = Math.min(max, Math.max(min, typed));
      store.setParam(spec, item, (isReal ? inside : Math.round(inside)) + 0);
      complain(typed);
    } else {
      if (!Number.isFinite(typed)) store.setProblem(null);
      field.value = field.dataset.shown ?? '';
    }
  };
  return html`
    <span class="number">
      <input
        class="number-field"
        type="number"
        id="${id}-number"
        inputmode=${min < 0 ? 'text' : isReal ? 'decimal' : 'numeric'}
        autocomplete="off"
        min=${min}
        max=${max}
        step=${step}
        data-shown=${shown}
        aria-label=${unit ? `${labelOf(language, spec.label)} (${unit})` : labelOf(language, spec.label)}
        aria-describedby=${describedBy(id, store.help(spec), problem)}
        aria-invalid=${problem ? 'true' : 'false'}
        @input=${type}
        @change=${settle}
        @blur=${settle}
        @wheel=${scrollPanel}
      />
      ${unit ? html`<span class="unit" aria-hidden="true">${unit}</span>` : ''}
    </span>
  `;
}

/** The filled part of a track, as shares of its length: from zero, or from the end where zero is not on it. */
function fill({ min, max }: { min: number; max: number }, position: number): string {
  const share = (at: number) => Math.min(1, Math.max(0, (at - min) / (max - min)));
  const [from, to] = [share(0), share(position)].sort((a, b) => a - b);
  return `--fill-from: ${from}; --fill-to: ${to}`;
}

/** A wheel over the number that has the focus scrolls the panel, as over every other, and does not change the number. */
function scrollPanel(event: WheelEvent): void {
  const field = event.currentTarget as HTMLElement;
  if (!field.matches(':focus')) return;
  event.preventDefault();
  field.closest('.panel-body')?.scrollBy(0, event.deltaY * (event.deltaMode === WheelEvent.DOM_DELTA_LINE ? LINE_PX : 1));
}

/** A slider is held until the pointer is lifted. Fingers, which also scroll and tap, have to take it by the thumb. */
function grab<K extends Kind>(store: Store<K>, { currentTarget, pointerType, clientX }: PointerEvent): void {
  const slider = currentTarget as HTMLInputElement;
  slider.toggleAttribute('data-missed', pointerType === 'touch' && Math.abs(clientX - thumbOf(slider)) > REACH_PX);
  store.hold();
  // The window that the panel is in: a frame's or a popup's, perhaps.
  const view = slider.ownerDocument.defaultView ?? window;
  const release = ({ type }: Event) => {
    view.removeEventListener('pointerup', release, true);
    view.removeEventListener('pointercancel', release, true);
    // The slider's last input event comes before this, its change event may come after. What has become a scroll was no edit.
    if (type === 'pointercancel') store.abandon();
    else store.release();
  };
  view.addEventListener('pointerup', release, true);
  view.addEventListener('pointercancel', release, true);
}

/** Where the middle of a slider's thumb is, px from the window's left. */
function thumbOf(slider: HTMLInputElement): number {
  const { left, width } = slider.getBoundingClientRect();
  const [min, max] = [Number(slider.min), Number(slider.max)];
  return left + THUMB_PX / 2 + ((slider.valueAsNumber - min) / (max - min)) * (width - THUMB_PX);
}
