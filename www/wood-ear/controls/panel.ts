/** `<wood-ear-panel>`: the panel of a colony of wood ears. */

import { html, nothing } from 'lit';
import { PRESETS } from '../../rocks/params.ts';
import { presetName } from '../../rocks/words.ts';
import { woodEarPresetName, woodEarText } from './strings.ts';
import { beginGroundEdit } from '../../controls/site.ts';
import { decodeLink } from '../../rocks/link.ts';
import { logAmong } from '../log-drop.ts';
import { BASE_ROWS, LOG_ROWS } from '../request.ts';
import { icon } from '../../controls/icons.ts';
import { problemOf } from '../../controls/numbers.ts';
import { menu } from '../../controls/menu.ts';
import { description, iconButton, segments } from '../../controls/parts.ts';
import { WOOD_EAR_LATER } from './deferred.ts';
import { register, Panel } from '../../controls/panel.ts';
import type { Later } from '../../controls/panel.ts';
import { woodEarStatistics } from './statistics.ts';
import type { TemplateResult } from 'lit';
import type { PresetName } from '../../rocks/params.ts';
import type { WoodEarStringKey } from './strings.ts';
import type { Row } from '../../table/row.ts';
import type { WoodEarBase } from '../request.ts';
import type { WoodEars } from '../table.ts';
import type { Place } from '../../controls/parts.ts';
import type { PresetGroup } from '../../controls/preset-picker.ts';
import type { Actions } from '../../controls/actions.ts';
import type { WoodEarStore } from './store.ts';

/** The thesis's sliders, which everybody begins with. */
const SLIDERS: readonly string[] = ['density', 'range', 'moisture', 'wrinkles', 'size', 'sizeSpread'];
const RANGE = BASE_ROWS[3] as Row;

export interface WoodEarActions extends Actions<WoodEars> {
  /** Shows a log from a file. */
  loadLog: (file: File) => void;
  /** The page of rocks that opens a link; absent in an element. */
  rocksPage?: string;
}

export class WoodEarPanel extends Panel<WoodEars> {
  declare store: WoodEarStore;
  declare actions: WoodEarActions;
  protected override readonly deferred = WOOD_EAR_LATER;
  readonly #openBases = new Set<number>();

  protected override words(key: 'presetHelp' | 'shareHelp' | 'embedHelp'): string {
    return this.#t(key);
  }

  #t(key: WoodEarStringKey, slots?: Record<string, string | number>): string {
    return woodEarText(this.store.language, key, slots);
  }

  override presetName(): string {
    return woodEarPresetName(this.store.language, this.store.preset);
  }

  protected override choosePreset({ choosePreset }: Later, place: Place): void {
    const { store, actions } = this;
    const group = (label: string, isPictured: boolean): PresetGroup => ({
      label,
      isPictured,
      presets: store.table.presets
        .filter(({ natural = false }) => natural === isPictured)
        .map(({ name }) => ({ name, words: woodEarPresetName(store.language, name) })),
    });
    const canDraw = store.backend === 'webgpu' || store.backend === 'webgl';
    choosePreset(store, place, [group(this.#t('natural'), true), group(this.#t('thesis'), false)], canDraw ? actions.newElement : null);
  }

  protected override sections(): TemplateResult {
    const { rows } = this.store.table;
    const isOfLog = (row: Row) => LOG_ROWS.some(({ key }) => key === row.key);
    const sliders = rows.filter(({ key }) => SLIDERS.includes(key));
    const form = rows.filter((row) => row.key !== 'seed' && row.stage !== 'look' && !SLIDERS.includes(row.key) && !isOfLog(row));
    return html`
      ${this.section(this.#t('colony'), sliders)} ${this.#bases()} ${this.section(this.#t('form'), form, false)} ${this.look()} ${this.#log()} ${this.#ground()}
    `;
  }

  protected override figures(): TemplateResult | undefined {
    return this.store.result ? woodEarStatistics(this.store, this.store.result) : undefined;
  }

  #bases(): TemplateResult {
    const { store } = this;
    const { bases } = store.params;
    const { max } = store.table.itemCount;
    const { problem } = store;
    const add = (): void => {
      store.addBase();
      void this.focusItem(bases.length);
    };
    return html`
      <section class="section" aria-labelledby="bases-heading">
        <div class="section-head">
          <h2 id="bases-heading">${this.#t('bases')} <span class="quiet">${bases.length} / ${max}</span></h2>
          <button class="button" type="button" ?disabled=${bases.length >= max} @click=${add}>${icon('add')}${this.#t('addBase')}</button>
        </div>
        ${description('bases', '', problem?.key === 'bases' ? problem.text(store.language) : null)}
        <p class="quiet">${this.#t('basesHint')}</p>
        <ol class="layers">${bases.map((base, index) => this.#base(base, index))}</ol>
      </section>
    `;
  }

  #base(base: WoodEarBase, index: number): TemplateResult {
    const { store } = this;
    const n = index + 1;
    const isOpen = this.#openBases.has(index) || BASE_ROWS.some((row) => problemOf(store, row, index) !== null);
    const { min } = store.table.itemCount;
    const remove = (): void => {
      store.removeItem(index);
      void this.focusItem(index);
    };
    return html`
      <li class="layer" data-base=${index}>
        <div class="layer-head">
          <button class="layer-toggle" type="button" aria-expanded=${isOpen} aria-controls="base-${index}" @click=${() => this.#toggleBase(index)}>
            <span class="layer-name">${this.#t('base', { n })}</span>
            <span class="layer-numbers">${base.position.map((value) => Math.round(value)).join(', ')} cm</span>
            ${icon('down')}
          </button>
          ${iconButton({ icon: 'remove', label: this.#t('removeBase', { n }), action: remove, disabled: store.params.bases.length <= min })}
        </div>
        <div class="layer-body" id="base-${index}" ?hidden=${!isOpen}>${isOpen ? this.#baseControls(base, index) : nothing}</div>
      </li>
    `;
  }

  #baseControls(base: WoodEarBase, index: number): TemplateResult {
    const { store } = this;
    const ofColony = 'colony';
    return html`
      ${segments({
        name: `range-of-${index}`,
        label: this.#t('rangeOf'),
        help: this.#t('rangeHelp'),
        options: [
          { value: ofColony, label: this.#t('ofColony') },
          { value: 'own', label: this.#t('ownRange') },
        ],
        value: base.range === null ? ofColony : 'own',
        action: (value) => store.setParam(RANGE, index, value === ofColony ? null : store.params.range),
      })}
      ${base.range === null ? nothing : this.control(RANGE, index)} ${BASE_ROWS.slice(0, 3).map((row) => this.control(row, index))}
    `;
  }

  #toggleBase(index: number): void {
    if (!this.#openBases.delete(index)) this.#openBases.add(index);
    this.requestUpdate();
  }

  #log(): TemplateResult {
    const { store, actions } = this;
    const { problem } = store;
    const { mesh } = store.params;
    const choose = ({ target }: Event) => {
      const input = target as HTMLInputElement;
      const file = logAmong(input.files ?? []);
      // So that the same file can be chosen again.
      input.value = '';
      if (file) actions.loadLog(file);
    };
    return html`
      <details class="section" ?open=${mesh !== null}>
        <summary><h2>${this.#t('log')}</h2>${icon('down')}</summary>
        ${mesh ? html`<p class="quiet">${this.#t('logFileNote')}</p>` : nothing} ${LOG_ROWS.filter(({ key }) => !mesh || key === 'logSpacing').map((row) => this.control(row, null))}
        ${description('log', '', problem?.key === 'log' ? problem.text(store.language) : null)}
        <div class="button-row">
          <label class="button file-button">${this.#t('logFile')}<input class="visually-hidden" type="file" accept=".glb,.gltf,.obj,model/gltf-binary,model/gltf+json,model/obj" @change=${choose} /></label>
          ${mesh ? html`<button class="button" type="button" @click=${() => store.removeMesh()}>${this.#t('removeLogFile')}</button>` : nothing}
        </div>
      </details>
    `;
  }

  #ground(): TemplateResult {
    const { store, actions } = this;
    const {
      language,
      params: { ground },
    } = store;
    const natural = PRESETS.filter((preset) => 'natural' in preset);
    const opened = ground === '' ? null : decodeLink(ground);
    const value: string = opened?.preset ?? '';
    const isListed = value === '' || natural.some(({ name }) => name === value);
    const options = [
      { value: '', label: this.#t('bare') },
      ...natural.map((preset) => ({ value: preset.name as string, label: presetName(language, preset) })),
    ];
    if (!isListed) options.push({ value, label: this.#t('ownGround') });
    return html`
      <section class="section" aria-labelledby="ground-heading">
        <h2 id="ground-heading" class="visually-hidden">${this.#t('ground')}</h2>
        ${menu({ name: 'ground', label: this.#t('ground'), help: this.#t('groundHelp'), options, value, action: (chosen) => store.chooseGround(chosen as PresetName | '') })}
        ${
          opened
            ? html`<div class="button-row">
              <button class="button" type="button" @click=${() => store.chooseGround(opened.preset, opened.params.seed + 1)}>${icon('dice')}${this.#t('groundSeed')}</button>
              ${actions.rocksPage ? html`<a class="button" href="${actions.rocksPage}#${ground}" @click=${beginGroundEdit}>${this.#t('openGround')}</a>` : nothing}
            </div>`
            : nothing
        }
      </section>
    `;
  }
}

register('wood-ear-panel', WoodEarPanel);
