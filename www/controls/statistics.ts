/** Honest numbers of the field that is shown. */

import { html, nothing } from 'lit';
import { STAGES } from '../generator/protocol.ts';
import { mathText } from './parts.ts';
import type { TemplateResult } from 'lit';
import type { FieldLayer } from '../field.ts';
import type { Backend } from '../renderer/renderer.ts';
import type { Store } from './store.ts';

const BACKENDS: Record<Backend, string> = { webgpu: 'WebGPU', webgl: 'WebGL2', canvas2d: 'Canvas 2D', null: '–' };

export function percent(store: Store, share: number): string {
  // Plus zero: an empty sum may be −0.
  return (share + 0).toLocaleString(store.language, { style: 'percent', minimumFractionDigits: 1, maximumFractionDigits: 1 });
}

export function rockCount(store: Store, n: number): string {
  return n === 1 ? store.text('oneRock') : store.text('someRocks', { n: n.toLocaleString(store.language) });
}

/** One line: `3,105 rocks · 48,930 triangles · 84.0 % covered`. */
export function summary(store: Store): string {
  const { field } = store;
  if (!field) return store.text('notYet');
  const { rocks, triangles, coveredFraction } = field.stats;
  return store.text('summary', {
    rocks: rockCount(store, rocks),
    triangles: triangles.toLocaleString(store.language),
    covered: percent(store, coveredFraction),
  });
}

export function statistics(store: Store): TemplateResult {
  const { field, language } = store;
  if (!field) return html`<p class="quiet">${store.text('notYet')}</p>`;
  const { rocks, triangles, coveredFraction, ms } = field.stats;
  const time = (value: number) => (value === 0 ? '–' : value.toLocaleString(language, { maximumFractionDigits: value < 10 ? 1 : 0 }));
  return html`
    <dl class="figures">
      <div><dt>${store.text('rocks')}</dt><dd>${rocks.toLocaleString(language)}</dd></div>
      <div><dt>${store.text('triangles')}</dt><dd>${triangles.toLocaleString(language)}</dd></div>
      <div><dt>${store.text('covered')}</dt><dd>${percent(store, coveredFraction)}</dd></div>
    </dl>
    ${field.layers.length > 0 ? layerTable(store, field.layers) : nothing}
    <dl class="figures figures-small" aria-label=${store.text('time')}>
      ${STAGES.map((stage) => html`<div><dt>${store.text(`stage-${stage}`)}</dt><dd>${time(ms[stage])}</dd></div>`)}
      <div><dt>${store.text('total')}</dt><dd>${time(ms.total)} ms</dd></div>
    </dl>
    <p class="quiet">${store.text('cached')} ${store.text('backend')}: <span data-backend>${store.backend ? BACKENDS[store.backend] : '–'}</span></p>
  `;
}

function layerTable(store: Store, layers: readonly FieldLayer[]): TemplateResult {
  const anySaturated = layers.some((layer) => layer.sitesSaturated || layer.saturated);
  return html`
    <table class="layer-table">
      <thead>
        <tr>
          <th scope="col"><span class="visually-hidden">${store.text('layers')}</span></th>
          <th scope="col">${store.text('rocks')}</th>
          <th scope="col">${store.text('sites')}</th>
          <th scope="col">${mathText(store.text('ofTarget'))}</th>
          <th scope="col">${mathText(store.text('asked'))}</th>
          <th scope="col">${store.text('reached')}</th>
        </tr>
      </thead>
      <tbody>
        ${layers.map((layer, index) => layerRow(store, layer, index))}
      </tbody>
    </table>
    ${anySaturated ? html`<p class="quiet">${store.text('saturatedKey')}</p>` : nothing}
  `;
}

function layerRow(store: Store, layer: FieldLayer, index: number): TemplateResult {
  const { language } = store;
  const mark = (isSaturated: boolean, why: string) =>
    isSaturated ? html`<span class="saturated" title=${why}><span aria-hidden="true">●</span><span class="visually-hidden">${store.text('saturated')}</span></span>` : nothing;
  return html`
    <tr>
      <th scope="row">
        <span class="chip" data-color=${layer.id % 8}></span><span class="visually-hidden">${store.text('layer', { n: index + 1 })}</span>
      </th>
      <td>${layer.selected.length.toLocaleString(language)}</td>
      <td>${(layer.sites.length / 2).toLocaleString(language)}${mark(layer.sitesSaturated, store.text('sitesSaturated'))}</td>
      <td>${layer.targetSites.toLocaleString(language)}</td>
      <td>${layer.areaFraction.toFixed(3)}</td>
      <td>${layer.areaReached.toFixed(3)}${mark(layer.saturated, store.text('cellsSaturated'))}</td>
    </tr>
  `;
}
