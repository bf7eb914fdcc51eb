/** The bar on the picture while somebody paints: what the brush does, to which layer, how wide it is. */

import { html, render } from 'lit';
import { live } from 'lit/directives/live.js';
import { iconButton, segments } from '../../../controls/parts.ts';
import { menu } from '../../../controls/menu.ts';
import { STROKE_MODES } from '../../strokes.ts';
import css from '../../../styles/paint.css';
import { BRUSH_WIDTH } from './brush.ts';
import type { Brush } from './brush.ts';
import type { RockStore } from '../store.ts';
import { paintWords } from './paint-words.ts';
import type { PaintKey } from './paint-words.ts';

export const PAINT_STYLES = css;

/** How far apart the ends of the slider are: equal steps of it are equal ratios of the width. */
const SPAN = Math.log(BRUSH_WIDTH.max / BRUSH_WIDTH.min);

/** What the bar is about. */
interface Painting {
  readonly brush: Brush;
  readonly store: RockStore;
  /** What those are told who cannot see the brush. */
  readonly said: PaintKey | null;
  setBrush(change: Partial<Brush>): void;
  end(): void;
}

export function showBar(painter: Painting, root: ShadowRoot): void {
  const { brush, store } = painter;
  const { language, params } = store;
  const words = (key: PaintKey) => paintWords(language, key);
  const layers = [
    { value: '', label: words('allLayers') },
    ...params.layers.map(({ id }, index) => ({ value: String(id), label: store.text('layer', { n: index + 1 }) })),
  ];
  const place = Math.log(brush.width / BRUSH_WIDTH.min) / SPAN;
  const slide = ({ target }: Event): void =>
    painter.setBrush({ width: BRUSH_WIDTH.min * Math.exp(SPAN * (target as HTMLInputElement).valueAsNumber) });
  const content = html`
    <div class="bar" role="toolbar" aria-label=${words('bar')}>
      ${segments({
        name: 'brush-mode',
        label: words('mode'),
        hideLabel: true,
        help: words(`help-${brush.mode}`),
        options: STROKE_MODES.map((mode) => ({ value: mode, label: words(`mode-${mode}`) })),
        value: brush.mode,
        action: (mode) => painter.setBrush({ mode }),
      })}
      ${menu({
        name: 'brush-layer',
        label: words('layer'),
        options: layers,
        value: brush.layer === null ? '' : String(brush.layer),
        action: (layer) => painter.setBrush({ layer: layer === '' ? null : Number(layer) }),
      })}
      <label class="brush-width">
        <span>${words('width')}</span>
        <input
          class="slider"
          type="range"
          min="0"
          max="1"
          step="0.01"
          .value=${live(String(place))}
          style="--fill-to: ${place}"
          aria-valuetext=${`${Math.round(brush.width * params.imageWidth)} px`}
          @input=${slide}
        />
      </label>
      ${iconButton({ icon: 'undo', label: store.text('undo'), action: () => store.undo(), disabled: !store.canUndo })}
      ${iconButton({ icon: 'redo', label: store.text('redo'), action: () => store.redo(), disabled: !store.canRedo })}
      <button class="button button-primary" type="button" @click=${() => painter.end()}>${words('end')}</button>
      <p class="quiet bar-help">${words(`help-${brush.mode}`)} <span class="bar-keys">${words('keys')}</span></p>
      <p class="visually-hidden" role="status">${painter.said && words(painter.said)}</p>
    </div>
  `;
  render(content, root);
}
