/** `<rock-field-panel>`: everything that can be set, in one column: beside the page's picture, or in an element with `controls`. */

import { LitElement, html, nothing } from 'lit';
import { MAX_LAYERS, PARAMS } from '../params.ts';
import { FIELD_ROWS, presetParams } from '../params-flat.ts';
import { LANGUAGES, LANGUAGE_NAMES, presetName } from '../strings.ts';
import { icon } from './icons.ts';
import { hasProblem, layerCard } from './layer-card.ts';
import { loadLater } from './load-later.ts';
import { colorChoice, viewChoice } from './look.ts';
import { fillNumberFields, numberField, paramControl, problemOf } from './param-control.ts';
import { description, iconButton, segments } from './parts.ts';
import { messageLine, progressLine } from './status.ts';
import { summary } from './summary.ts';
import { LIST_KEYS, THEMES } from './store.ts';
import type { TemplateResult } from 'lit';
import type { ParamSpec } from '../params.ts';
import type { RockFieldElement } from '../rock-field-element.ts';
import type { StringKey } from '../strings.ts';
import type { Later } from './load-later.ts';
import type { Problem, Store } from './store.ts';

const SEED = PARAMS[0];
const GROUND_ROWS: readonly ParamSpec[] = FIELD_ROWS.filter((spec) => spec !== SEED && spec.stage !== 'look');
const LOOK_ROWS: readonly ParamSpec[] = FIELD_ROWS.filter(({ stage }) => stage === 'look');
/** The light falls on all colours; the rest is of natural ones. */
const SUN_ROWS = LOOK_ROWS.filter(({ key }) => key.startsWith('sun'));

/** What the panel's place does that the store cannot. */
export interface Actions {
  freshSeed: () => void;
  randomise: () => void;
  /** An element like the one whose panel this is. */
  newField: () => RockFieldElement;
  share: () => void;
  /** Absent where nobody knows the address of a script to embed. */
  embed?: (() => void) | undefined;
  /** Lists the page's keys. */
  help?: () => void;
  /** An element's panel alone is closed, and cancels in itself: on the page, `<stage-overlay>` has that. */
  close?: () => void;
  cancel?: () => void;
}

export class ControlPanel extends LitElement {
  static override properties = { store: { attribute: false }, actions: { attribute: false }, isEmbedded: { attribute: false }, isOpen: { state: true } };

  declare store: Store;
  declare actions: Actions;
  /** In an element, not on the page: without what is the page's alone. */
  declare isEmbedded: boolean;
  /** On narrow screens the panel is a sheet that can be folded away. */
  declare isOpen: boolean;

  /** Ids of the layers whose cards are open. */
  readonly #openLayers = new Set<number>();
  #unsubscribe: (() => void) | undefined;
  #seenProblem: Problem | null = null;
  #later: Later | undefined;
  #loading: Promise<Later> | undefined;

  constructor() {
    super();
    this.isEmbedded = false;
    this.isOpen = false;
    // What is being pointed at, or has the focus, is explained in the line below.
    this.addEventListener('pointerover', (event) => event.pointerType !== 'touch' && this.#explain(event));
    this.addEventListener('pointerleave', () => this.#explain(null));
    this.addEventListener('focusin', (event) => this.#explain(event));
  }

  /** In the tree it stands in, whose styles it has; labels and descriptions are found by id there. */
  protected override createRenderRoot(): HTMLElement {
    return this;
  }

  override connectedCallback(): void {
    super.connectedCallback();
    const { params: { layers: [first] }, color } = this.store;
    // Of a natural ground the look comes first, and the layers as an overview.
    if (first && color !== 'natural') this.#openLayers.add(first.id);
    this.#unsubscribe = this.store.subscribe(() => this.requestUpdate());
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.#unsubscribe?.();
  }

  protected override updated(): void {
    fillNumberFields(this);
    this.classList.toggle('is-open', this.isOpen);
    const { problem } = this.store;
    if (problem && problem !== this.#seenProblem) this.#reveal();
    this.#seenProblem = problem;
    if (this.store.field && !this.#later) this.#loadLater().catch((thrown: unknown) => console.warn(thrown));
  }

  #loadLater(): Promise<Later> {
    this.#loading ??= loadLater();
    const loading = this.#loading;
    loading.then(
      (later) => {
        this.#later = later;
        this.requestUpdate();
      },
      () => (this.#loading = undefined),
    );
    return loading;
  }

  /** A message under a control that nobody sees is no message. */
  #reveal(): void {
    const line = this.querySelector('.control-problem');
    if (!line) return;
    line.closest('details')?.setAttribute('open', '');
    this.isOpen = true;
    void this.updateComplete.then(() => line.scrollIntoView({ block: 'nearest' }));
  }

  protected override render(): TemplateResult {
    const { store, actions, isEmbedded } = this;
    return html`
      ${this.#toolbar()} ${isEmbedded ? messageLine(store) : nothing}
      <div class="panel-body">
        ${this.#start()} ${isEmbedded ? this.#view() : nothing} ${this.#look()} ${this.#layers()} ${this.#ground()} ${this.#statistics()}
        ${isEmbedded ? this.#embed() : this.#page()}
      </div>
      <p class="help-line is-idle" aria-hidden="true" .textContent=${this.#hint()}></p>
      ${actions.cancel ? progressLine(store, actions.cancel) : nothing}
    `;
  }

  #hint(): string {
    return this.store.text(this.isEmbedded ? 'helpHintShort' : 'helpHint');
  }

  #toolbar(): TemplateResult {
    const { store, actions } = this;
    const t = (key: StringKey) => store.text(key);
    const isEdited = this.#isEdited();
    return html`
      <div class="toolbar">
        ${this.isEmbedded ? html`<h2 class="panel-title">${t('controls')}</h2>` : this.#pageTitle()}
        ${iconButton({ icon: 'undo', label: t('undo'), action: () => store.undo(), disabled: !store.canUndo })}
        ${iconButton({ icon: 'redo', label: t('redo'), action: () => store.redo(), disabled: !store.canRedo })}
        ${iconButton({ icon: 'reset', label: t('reset'), action: () => store.reset(), disabled: !isEdited && store.params.seed === 0 })}
        ${iconButton({ icon: 'randomise', label: t('randomise'), action: actions.randomise })}
        <button class="button button-primary share" type="button" title=${t(this.#shareHelp())} aria-label=${t('share')} @click=${actions.share}>
          ${icon('share')}<span>${t('share')}</span>
        </button>
        ${actions.close ? iconButton({ icon: 'close', label: t('close'), action: actions.close, kind: 'close' }) : nothing}
      </div>
    `;
  }

  #pageTitle(): TemplateResult {
    const { store } = this;
    return html`
      <button class="button sheet-toggle" type="button" aria-expanded=${this.isOpen} @click=${() => (this.isOpen = !this.isOpen)}>
        ${icon('down')}${store.text('controls')}
      </button>
      <h1 class="wordmark"><img src="icon.svg" alt="" width="20" height="20" />${store.text('title')}</h1>
    `;
  }

  /** Another page need not read its address: there the link only holds the settings. */
  #shareHelp(): StringKey {
    return this.isEmbedded ? 'shareSettingsHelp' : 'shareHelp';
  }

  /** Preset and seed: where everybody begins. */
  #start(): TemplateResult {
    const { store } = this;
    const { params, preset, language } = store;
    const problem = problemOf(store, SEED, null);
    return html`
      <section class="start" aria-label=${store.text('preset')}>
        <div class="control" data-param="preset" data-help=${store.text('presetHelp')}>
          <div class="control-head">
            <span class="control-label" id="preset-label">${store.text('preset')}</span>
            ${this.#isEdited() ? html`<span class="quiet">${store.text('edited')}</span>` : nothing}
          </div>
          <button class="select preset-button" type="button" id="preset" aria-haspopup="dialog" aria-labelledby="preset-label preset-name" aria-describedby="preset-help" @click=${this.#choosePreset}>
            <span id="preset-name">${presetName(language, { name: preset })}</span>${icon('down')}
          </button>
          ${description('preset', store.text('presetHelp'), null)}
        </div>
        <div class="control" data-param="seed" data-help=${SEED.doc[language]}>
          <label class="control-label" for="seed-number">${SEED.label[language]}</label>
          <div class="field-row">
            ${numberField({ store, spec: SEED, layer: null, id: 'seed', shown: String(params.seed), unit: '', problem })}
            ${iconButton({ icon: 'previous', label: store.text('previousSeed'), action: () => store.setSeed(params.seed - 1) })}
            ${iconButton({ icon: 'next', label: store.text('nextSeed'), action: () => store.setSeed(params.seed + 1) })}
            ${iconButton({ icon: 'dice', label: store.text('freshSeed'), action: this.actions.freshSeed })}
          </div>
          ${description('seed', SEED.doc[language], problem)}
        </div>
      </section>
    `;
  }

  /** On the page this lies on the picture. */
  #view(): TemplateResult {
    return html`<section class="section" aria-label=${this.store.text('view')}>${viewChoice(this.store, false)} ${colorChoice(this.store, false)}</section>`;
  }

  #look(): TemplateResult {
    const isNatural = this.store.color === 'natural';
    const rows = isNatural ? LOOK_ROWS : SUN_ROWS;
    return html`
      <details class="section" ?open=${isNatural}>
        <summary><h2>${this.store.text('look')}</h2>${icon('down')}</summary>
        ${rows.map((spec) => paramControl(this.store, spec, null))}
      </details>
    `;
  }

  /** Whether anything but the seed differs from the preset. */
  #isEdited(): boolean {
    const { params, preset } = this.store;
    return JSON.stringify({ ...params, seed: 0 }) !== JSON.stringify(presetParams(preset));
  }

  #choosePreset = async (): Promise<void> => {
    const { choosePreset } = await this.#loadLater();
    const { store, actions } = this;
    const root = this.getRootNode();
    // From above, grounds are no pictures.
    const canDraw = store.backend === 'webgpu' || store.backend === 'webgl';
    choosePreset(store, root instanceof ShadowRoot ? root : document.body, canDraw ? actions.newField : null);
  };

  #layers(): TemplateResult {
    const { store } = this;
    const { layers } = store.params;
    const { problem } = store;
    const ofList = problem && LIST_KEYS.includes(problem.key) ? problem.text(store.language) : null;
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
              layer,
              index,
              isOpen: this.#openLayers.has(layer.id) || hasProblem(store, index),
              toggle: () => this.#toggleLayer(layer.id),
            }),
          )}
        </ol>
      </section>
    `;
  }

  #addLayer = async (): Promise<void> => {
    await this.store.addLayer();
    const added = this.store.params.layers.at(-1);
    if (added) this.#openLayers.add(added.id);
  };

  #toggleLayer(id: number): void {
    if (!this.#openLayers.delete(id)) this.#openLayers.add(id);
    this.requestUpdate();
  }

  #ground(): TemplateResult {
    return html`
      <details class="section" ?open=${true}>
        <summary><h2>${this.store.text('ground')}</h2>${icon('down')}</summary>
        ${GROUND_ROWS.map((spec) => paramControl(this.store, spec, null))}
      </details>
    `;
  }

  #statistics(): TemplateResult {
    return html`
      <details class="section" ?open=${true}>
        <summary><h2>${this.store.text('statistics')}</h2>${icon('down')}</summary>
        ${this.#later?.statistics(this.store) ?? html`<p class="quiet">${this.store.text('notYet')}</p>`}
      </details>
      <p class="visually-hidden" role="status">${this.store.progress ? '' : summary(this.store)}</p>
    `;
  }

  /** What is the page's and not the field's. */
  #page(): TemplateResult {
    const { store, actions } = this;
    return html`
      <section class="section" aria-labelledby="page-heading">
        <h2 id="page-heading">${store.text('page')}</h2>
        ${segments({
          name: 'language',
          label: store.text('language'),
          options: LANGUAGES.map((value) => ({ value, label: LANGUAGE_NAMES[value] })),
          value: store.language,
          action: (language) => store.setLanguage(language),
        })}
        ${segments({
          name: 'theme',
          label: store.text('theme'),
          options: THEMES.map((value) => ({ value, label: store.text(`theme-${value}`) })),
          value: store.theme,
          action: (theme) => store.setTheme(theme),
        })}
        <div class="button-row">
          ${this.#embedButton()}
          <button class="button" type="button" @click=${actions.help}>${icon('help')}${store.text('help')}</button>
          <a class="button" href="docs/" hreflang="en" data-help=${store.text('docsHelp')}>${store.text('docs')}</a>
        </div>
      </section>
    `;
  }

  #embed(): TemplateResult | typeof nothing {
    return this.actions.embed ? html`<div class="section"><div class="button-row">${this.#embedButton()}</div></div>` : nothing;
  }

  #embedButton(): TemplateResult {
    const { store, actions } = this;
    return html`
      <button class="button" type="button" title=${store.text('embedHelp')} data-help=${store.text('embedHelp')} @click=${actions.embed}>
        ${icon('code')}${store.text('embed')}
      </button>
    `;
  }

  #explain(event: Event | null): void {
    const line = this.querySelector('.help-line');
    const { activeElement } = this.getRootNode() as Document | ShadowRoot;
    const target = event?.target instanceof Element ? event.target : activeElement;
    const help = (target as HTMLElement | null)?.closest<HTMLElement>('[data-help]')?.dataset.help;
    if (!line) return;
    // Not by a render: a pointer crosses many controls, and only this line changes.
    line.textContent = help || this.#hint();
    line.classList.toggle('is-idle', !help);
  }
}

register('rock-field-panel', ControlPanel);

/** Under the first name that is free: a page may have another copy of this script. Made by `new` alone, so any name will do. */
function register(name: string, element: CustomElementConstructor, count = 1): void {
  const free = count === 1 ? name : `${name}-${count}`;
  if (customElements.get(free)) register(name, element, count + 1);
  else customElements.define(free, element);
}
