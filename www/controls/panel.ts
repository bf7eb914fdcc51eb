/** What the panels of all generators have: everything that can be set, in one column, beside the page's picture or in an element with `controls`. */

import { LitElement, html, nothing } from 'lit';
import { pageAddress, PAGES } from './site.ts';
import { labelOf } from './strings.ts';
import { icon } from './icons.ts';
import { colorChoice, viewChoice } from './view-choice.ts';
import { fillNumberFields, problemOf } from './numbers.ts';
import { description, iconButton } from './parts.ts';
import { messageLine, progressLine } from './status.ts';
import type { TemplateResult } from 'lit';
import type { StringKey } from './strings.en.ts';
import type { Row } from '../table/row.ts';
import type { Kind } from '../table/table.ts';
import type { Actions } from './actions.ts';
import type { Deferred } from '../base/deferred.ts';
import type * as module from './later.ts';
import type { Place } from './parts.ts';
import type { Problem, Store } from './store.ts';

/** What of a panel comes later, with the dialog that saves files, which each generator has of its own. */
export type Later = typeof module & { showExport(store: Store<Kind>, place: Place): void };

export abstract class Panel<K extends Kind> extends LitElement {
  static override properties = {
    store: { attribute: false },
    actions: { attribute: false },
    isEmbedded: { attribute: false },
    isOpen: { state: true },
  };

  declare store: Store<K>;
  declare actions: Actions<K>;
  /** In an element, not on the page: without what is the page's alone. */
  declare isEmbedded: boolean;
  /** On narrow screens the panel is a sheet that can be folded away. */
  declare isOpen: boolean;

  #unsubscribe: (() => void) | undefined;
  /** The picture is there, or a hand is: so should the controls be. */
  #isDue = false;
  #seenProblem: Problem | null = null;
  /** The file that brings what comes later. */
  protected abstract readonly deferred: Deferred<Later>;
  protected later: Later | undefined;

  constructor() {
    super();
    this.isEmbedded = false;
    this.isOpen = false;
    // What is being pointed at, or has the focus, is explained in the line below.
    this.addEventListener('pointerover', (event) => event.pointerType !== 'touch' && this.#explain(event));
    this.addEventListener('pointerleave', () => this.#explain(null));
    this.addEventListener('focusin', (event) => this.#explain(event));
    for (const type of ['pointerover', 'focusin']) this.addEventListener(type, this.#complete);
  }

  /** In the tree it stands in, whose styles it has; labels and descriptions are found by id there. */
  protected override createRenderRoot(): HTMLElement {
    return this;
  }

  override connectedCallback(): void {
    super.connectedCallback();
    this.#unsubscribe = this.store.subscribe(() => this.requestUpdate());
    void this.actions.pictured?.then(() => this.#complete());
    if (!this.actions.pictured) this.#complete();
  }

  /** Fetches what comes later, now that nothing is in its way. */
  #complete = (): void => {
    if (this.#isDue) return;
    this.#isDue = true;
    void this.store.loadDocs();
    this.loadLater().catch((thrown: unknown) => console.warn(thrown));
  };

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.#unsubscribe?.();
  }

  /** The first time in a task of its own: it takes as long as all that the page does before. */
  protected override async scheduleUpdate(): Promise<void> {
    if (!this.hasUpdated) await new Promise((resolve) => setTimeout(resolve));
    super.scheduleUpdate();
  }

  protected override updated(): void {
    fillNumberFields(this);
    this.classList.toggle('is-open', this.isOpen);
    const { problem } = this.store;
    if (problem && problem !== this.#seenProblem) this.#reveal();
    this.#seenProblem = problem;
    if (((this.#isDue && this.store.result) || this.store.messages.length > 0) && !this.later)
      this.loadLater().catch((thrown: unknown) => console.warn(thrown));
  }

  async loadLater(): Promise<Later> {
    const later = await this.deferred.load();
    this.later = later;
    this.requestUpdate();
    return later;
  }

  #export = (): void => this.later?.showExport(this.store as unknown as Store<Kind>, this.place());

  /** A message under a control that nobody sees is no message. */
  #reveal(): void {
    const line = this.querySelector('.control-problem');
    if (!line) return;
    line.closest('details')?.setAttribute('open', '');
    this.isOpen = true;
    void this.updateComplete.then(() => line.scrollIntoView({ block: 'nearest' }));
  }

  /** The text that a key stands for; each generator words it for itself. */
  protected abstract words(key: 'presetHelp' | 'shareHelp' | 'embedHelp'): string;
  abstract presetName(): string;
  /** Opens the list of presets. `place`: where dialogs appear. */
  protected abstract choosePreset(later: Later, place: Place): void;
  /** Between the preset and the statistics. */
  protected abstract sections(): TemplateResult;
  /** The figures of the result. */
  protected abstract figures(): TemplateResult | undefined;

  protected override render(): TemplateResult {
    const { store, actions, isEmbedded } = this;
    return html`
      ${this.#toolbar()} ${isEmbedded ? messageLine(store) : nothing}
      <div class="panel-body">
        ${this.#start()} ${isEmbedded ? this.#view() : nothing} ${this.sections()} ${this.#statistics()}
        ${this.later?.lastSection({ store, actions, isEmbedded, embedHelp: this.words('embedHelp'), exportFiles: this.#export })}
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
    return html`
      <div class="toolbar">
        ${this.isEmbedded ? html`<h2 class="panel-title">${t('controls')}</h2>` : this.#pageTitle()}
        ${iconButton({ icon: 'undo', label: t('undo'), action: () => store.undo(), disabled: !store.canUndo })}
        ${iconButton({ icon: 'redo', label: t('redo'), action: () => store.redo(), disabled: !store.canRedo })}
        ${iconButton({ icon: 'reset', label: t('reset'), action: () => store.reset(), disabled: !store.isEdited })}
        ${iconButton({ icon: 'randomise', label: t('randomise'), action: actions.randomise })}
        <button class="button button-primary share" type="button" title=${this.isEmbedded ? t('shareSettingsHelp') : this.words('shareHelp')} aria-label=${t('share')} @click=${actions.share}>
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

  /** Preset and seed: where everybody begins. */
  #start(): TemplateResult {
    const { store } = this;
    const { params, language } = store;
    const seed = store.table.rows[0] as Row;
    const problem = problemOf(store, seed, null);
    return html`
      <section class="start" aria-label=${store.text('preset')}>
        ${this.isEmbedded ? nothing : this.#pages()}
        <div class="control" data-param="preset" data-help=${this.words('presetHelp')}>
          <div class="control-head">
            <span class="control-label" id="preset-label">${store.text('preset')}</span>
            ${store.isEdited ? html`<span class="quiet">${store.text('edited')}</span>` : nothing}
          </div>
          <button class="select preset-button" type="button" id="preset" aria-haspopup="dialog" aria-labelledby="preset-label preset-name" aria-describedby="preset-help" @click=${this.#openPresets}>
            <span id="preset-name">${this.presetName()}</span>${icon('down')}
          </button>
          ${description('preset', this.words('presetHelp'), null)}
        </div>
        <div class="control" data-param="seed" data-help=${store.help(seed)}>
          <label class="control-label" for="seed-number">${labelOf(language, seed.label)}</label>
          <div class="field-row">
            ${this.later?.numberField({ store, spec: seed, item: null, id: 'seed', shown: String(params.seed), unit: '', problem }) ?? html`<span class="number"></span>`}
            ${iconButton({ icon: 'previous', label: store.text('previousSeed'), action: () => store.setSeed(params.seed - 1) })}
            ${iconButton({ icon: 'next', label: store.text('nextSeed'), action: () => store.setSeed(params.seed + 1) })}
            ${iconButton({ icon: 'dice', label: store.text('freshSeed'), action: this.actions.freshSeed })}
          </div>
          ${description('seed', store.help(seed), problem)}
        </div>
      </section>
    `;
  }

  /** The pages, one for each generator. */
  #pages(): TemplateResult {
    const { store } = this;
    const here = location.pathname.endsWith(PAGES[1].href);
    return html`
      <nav class="segment-row scenes" aria-label=${store.text('scenes')}>
        ${PAGES.map(({ name, href }, index) => {
          const isHere = here === (index === 1);
          return html`<a class="segment" href=${pageAddress(href)} aria-current=${isHere ? 'page' : nothing} @click=${({ currentTarget }: Event) => ((currentTarget as HTMLAnchorElement).href = pageAddress(href))}><span>${store.text(name)}</span></a>`;
        })}
      </nav>
      ${here ? nothing : this.later?.wayToLog(store, this.actions)}
    `;
  }

  /** The item at a place of the list, the last, or what adds one takes the focus when the list has changed. */
  protected async focusItem(index: number): Promise<void> {
    await this.updateComplete;
    const items = [...this.querySelectorAll('.layers > .layer')];
    const at = items[index] ?? items.at(-1);
    const target = at?.querySelector<HTMLElement>('.layer-toggle') ?? this.querySelector<HTMLElement>('.section-head .button');
    target?.focus();
  }

  /** On the page this lies on the picture. */
  #view(): TemplateResult {
    return html`<section class="section" aria-label=${this.store.text('view')}>${viewChoice(this.store, false)} ${colorChoice(this.store, false)}</section>`;
  }

  /** In natural colours all of the look can be set, in others the light alone. */
  protected look(): TemplateResult {
    const { store } = this;
    const isNatural = store.color === 'natural';
    const rows = store.table.rows.filter(({ stage, key }) => stage === 'look' && (isNatural || key.startsWith('sun')));
    return this.section(store.text('look'), rows, isNatural);
  }

  protected section(heading: string, rows: readonly Row[], isOpen = true): TemplateResult {
    return html`
      <details class="section" ?open=${isOpen}>
        <summary><h2>${heading}</h2>${icon('down')}</summary>
        ${rows.map((row) => this.control(row, null))}
      </details>
    `;
  }

  /** The control of a row, as soon as it is loaded. */
  protected control(row: Row, item: number | null): TemplateResult | undefined {
    return this.later?.paramControl(this.store, row, item);
  }

  #openPresets = async (): Promise<void> => {
    this.choosePreset(await this.loadLater(), this.place());
  };

  /** Where dialogs appear. */
  protected place(): Place {
    const root = this.getRootNode();
    return root instanceof ShadowRoot ? root : document.body;
  }

  #statistics(): TemplateResult {
    return html`
      <details class="section" ?open=${true}>
        <summary><h2>${this.store.text('statistics')}</h2>${icon('down')}</summary>
        ${this.figures() ?? html`<p class="quiet">${this.store.text('notYet')}</p>`}
      </details>
      <p class="visually-hidden" role="status">${this.store.progress ? '' : this.store.summary()}</p>
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

/** Under the first name that is free: a page may have another copy of this script. Made by `new` alone, so any name will do. */
export function register(name: string, element: CustomElementConstructor, count = 1): void {
  const free = count === 1 ? name : `${name}-${count}`;
  if (customElements.get(free)) register(name, element, count + 1);
  else customElements.define(free, element);
}
