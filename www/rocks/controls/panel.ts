/** `<rock-field-panel>`: the panel of a field of rocks. */

import { html, nothing } from 'lit';
import { MAX_LAYERS } from '../params.ts';
import { presetName } from '../words.ts';
import { icon } from '../../controls/icons.ts';
import { hasProblem, layerCard } from './layer-card.ts';
import { description } from '../../controls/parts.ts';
import { register, Panel } from '../../controls/panel.ts';
import type { TemplateResult } from 'lit';
import type { Paintable } from './painting/paintable.ts';
import type { Rocks } from '../table.ts';
import { ROCK_LATER } from './deferred.ts';
import type { RockLater } from './deferred.ts';
import type { Place } from '../../controls/parts.ts';
import type { RockStore } from './store.ts';

export class RockPanel extends Panel<Rocks> {
  declare store: RockStore;
  protected override readonly deferred = ROCK_LATER;
  declare protected later: RockLater | undefined;
  /** Ids of the layers whose cards are open. */
  readonly #openLayers = new Set<number>();

  override connectedCallback(): void {
    super.connectedCallback();
    const {
      params: {
        layers: [first],
      },
      color,
    } = this.store;
    // Of a natural ground the look comes first, and the layers as an overview.
    if (first && color !== 'natural') this.#openLayers.add(first.id);
  }

  protected override words(key: 'presetHelp' | 'shareHelp' | 'embedHelp'): string {
    return this.store.text(key);
  }

  override presetName(): string {
    return presetName(this.store.language, { name: this.store.preset });
  }

  protected override choosePreset({ choosePreset, presetGroups }: RockLater, place: Place): void {
    const { store, actions } = this;
    // From above, grounds are no pictures.
    const canDraw = store.backend === 'webgpu' || store.backend === 'webgl';
    choosePreset(store, place, presetGroups(store.language), canDraw ? actions.newElement : null);
  }

  protected override sections(): TemplateResult {
    const ground = this.store.table.rows.filter(({ stage, key }) => stage !== 'look' && key !== 'seed');
    return html`${this.look()} ${this.#layers()} ${this.#paint()} ${this.section(this.store.text('ground'), ground)}`;
  }

  protected override figures(): TemplateResult | undefined {
    return this.later?.statistics(this.store);
  }

  #layers(): TemplateResult {
    const { store } = this;
    const { layers } = store.params;
    const { problem } = store;
    const ofList = problem && store.listKeys.includes(problem.key) ? problem.text(store.language) : null;
    return html`
      <section class="section" aria-labelledby="layers-heading">
        <div class="section-head">
          <h2 id="layers-heading">${store.text('layers')} <span class="quiet">${layers.length} / ${MAX_LAYERS}</span></h2>
          <button class="button" type="button" ?disabled=${layers.length >= MAX_LAYERS} @click=${this.#addLayer}>${icon('add')}${store.text('addLayer')}</button>
        </div>
        ${description('layers', '', ofList)}
        ${layers.length === 0 ? html`<p class="quiet">${store.text('noLayers')}</p>` : nothing}
        <ol class="layers">
          ${layers.map((layer, index) =>
            layerCard({
              store,
              later: this.later,
              layer,
              index,
              isOpen: this.#openLayers.has(layer.id) || hasProblem(store, index),
              toggle: () => this.#toggleLayer(layer.id),
              focus: (at) => void this.focusItem(at),
            }),
          )}
        </ol>
      </section>
    `;
  }

  #paint(): TemplateResult | undefined {
    return this.later?.paintSection(this.store, this.actions.element as unknown as Paintable, () => (this.isOpen = false));
  }

  #addLayer = async (): Promise<void> => {
    await this.store.addLayer();
    const added = this.store.params.layers.at(-1);
    if (added) this.#openLayers.add(added.id);
    await this.focusItem(this.store.params.layers.length - 1);
  };

  #toggleLayer(id: number): void {
    if (!this.#openLayers.delete(id)) this.#openLayers.add(id);
    void this.loadLater();
    this.requestUpdate();
  }
}

register('rock-field-panel', RockPanel);
