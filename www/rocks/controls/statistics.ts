/** Honest numbers of the field that is shown. */

import { html, nothing } from 'lit';
import { STAGES } from '../../generator/protocol.ts';
import { later } from '../../controls/strings-later.ts';
import { BACKENDS } from '../../controls/backends.ts';
import { mathText } from '../../controls/parts.ts';
import { percent } from '../../controls/numbers.ts';
import type { TemplateResult } from 'lit';
import type { FieldLayer } from '../../data/field.ts';
import type { RockStore } from './store.ts';

export function statistics(store: RockStore): TemplateResult {
  const { field, language } = store;
  if (!field) return html`<p class="quiet">${store.text('notYet')}</p>`;
  const { rocks, triangles, coveredFraction, ms } = field.stats;
  const time = (value: number) => (value === 0 ? '–' : value.toLocaleString(language, { maximumFractionDigits: value < 10 ? 1 : 0 }));
  return html`
    <dl class="figures">
      <div><dt>${later(store.language, 'rocks')}</dt><dd>${rocks.toLocaleString(language)}</dd></div>
      <div><dt>${later(store.language, 'triangles')}</dt><dd>${triangles.toLocaleString(language)}</dd></div>
      <div><dt>${later(store.language, 'covered')}</dt><dd>${percent(coveredFraction)}</dd></div>
    </dl>
    ${field.layers.length > 0 ? layerTable(store, field.layers) : nothing}
    <dl class="figures figures-small" aria-label=${later(store.language, 'time')}>
      ${STAGES.map((stage) => html`<div><dt>${store.text(`stage-${stage}`)}</dt><dd>${time(ms[stage])}</dd></div>`)}
      <div><dt>${later(store.language, 'total')}</dt><dd>${time(ms.total)} ms</dd></div>
    </dl>
    <p class="quiet">${later(store.language, 'cached')} ${later(store.language, 'backend')}: <span data-backend>${store.backend ? BACKENDS[store.backend] : '–'}</span></p>
  `;
}

function layerTable(store: RockStore, layers: readonly FieldLayer[]): TemplateResult {
  const anySaturated = layers.some((layer) => layer.sitesSaturated || layer.saturated);
  return html`
    <table class="layer-table">
      <thead>
        <tr>
          <th scope="col"><span class="visually-hidden">${store.text('layers')}</span></th>
          <th scope="col">${later(store.language, 'rocks')}</th>
          <th scope="col">${later(store.language, 'sites')}</th>
          <th scope="col">${mathText(later(store.language, 'ofTarget'))}</th>
          <th scope="col">${mathText(later(store.language, 'asked'))}</th>
          <th scope="col">${later(store.language, 'reached')}</th>
        </tr>
      </thead>
      <tbody>
        ${layers.map((layer, index) => layerRow(store, layer, index))}
      </tbody>
    </table>
    ${anySaturated ? html`<p class="quiet">${later(store.language, 'saturatedKey')}</p>` : nothing}
  `;
}

function layerRow(store: RockStore, layer: FieldLayer, index: number): TemplateResult {
  const { language } = store;
  const mark = (isSaturated: boolean, why: string) =>
    isSaturated
      ? html`<span class="saturated" title=${why}><span aria-hidden="true">●</span><span class="visually-hidden">${later(store.language, 'saturated')}</span></span>`
      : nothing;
  return html`
    <tr>
      <th scope="row">
        <span class="chip" data-color=${layer.id % 8}></span><span class="visually-hidden">${store.text('layer', { n: index + 1 })}</span>
      </th>
      <td>${layer.selected.length.toLocaleString(language)}</td>
      <td>${(layer.sites.length / 2).toLocaleString(language)}${mark(layer.sitesSaturated, later(store.language, 'sitesSaturated'))}</td>
      <td>${layer.targetSites.toLocaleString(language)}</td>
      <td>${layer.areaFraction.toFixed(3)}</td>
      <td>${layer.areaReached.toFixed(3)}${mark(layer.saturated, later(store.language, 'cellsSaturated'))}</td>
    </tr>
  `;
}
