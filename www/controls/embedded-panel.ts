/** The panel in an element: a store on the element's own history. */

import { addStyles, removeStyles } from '../base/document-styles.ts';
import { errorInfo } from '../base/errors.ts';
import { loadJapanese, translate } from './strings.ts';
import { embedCode } from './clipboard.ts';
import { couple } from './coupling.ts';
import { copyOrShow } from './dialogs.ts';
import { hasModifier, travel } from './keys.ts';
import { LAYOUT_STYLES, PANEL_STYLES } from './panel-styles.ts';
import { isDialogOpen } from './parts.ts';
import type { OpenPanel, PanelOwner } from '../element/panel-owner.ts';
import type { GeneratorElement } from '../element/generator-element.ts';
import type { History } from '../base/history.ts';
import type { Edition, Kind } from '../table/table.ts';
import type { Actions } from './actions.ts';
import type { Panel } from './panel.ts';
import type { OpenedLink, Preferences, Store } from './store.ts';

/** From here on the panel stands beside the picture, px. */
const BESIDE_FROM = 600;
/** From here on it stands below; in less it is a sheet over its lower part. */
const BELOW_FROM = 480;

/** What an embedded panel is made of. */
export interface PanelParts<K extends Kind> {
  newStore: (link: OpenedLink<K>, preferences: Preferences, history: History<Edition<K>>) => Store<K>;
  panel: Panel<K>;
  /** What a panel of this generator can do beyond those of others. */
  actions?: object;
  /** An address that the classic scripts lie beside, where one is known. */
  script: string | null;
}

export class EmbeddedPanel<K extends Kind> implements OpenPanel {
  readonly #owner: PanelOwner<K, GeneratorElement<K>>;
  readonly #element: GeneratorElement<K>;
  readonly #store: Store<K>;
  readonly #host = document.createElement('div');
  readonly #panel: Panel<K>;
  readonly #close: () => void;
  /** Tells the store that the element has changed the history. */
  readonly #heard: () => boolean;
  /** Ends every listener. */
  readonly #listening = new AbortController();
  readonly #size = new ResizeObserver(([entry]) => entry && this.#layOut(entry.contentRect));

  constructor(owner: PanelOwner<K, GeneratorElement<K>>, close: () => void, { newStore, panel, script, actions = {} }: PanelParts<K>) {
    const { element, root } = owner;
    this.#owner = owner;
    this.#element = element;
    this.#close = close;
    this.#panel = panel;
    const history = owner.history();
    const { view, theme, backend } = element;
    const result = owner.result();
    this.#store = newStore(
      { ...history.present, view, color: owner.chosenColor(), camera: null, notices: [] },
      { language: owner.language(), theme },
      history,
    );
    this.#store.metresPerPixel = () => element.metresPerPixel;
    this.#heard = couple(this.#store, element, () => owner.result(), this.#listening.signal);
    if (result) this.#store.showResult(result, !owner.isSettled());
    this.#store.setBackend(backend);
    this.#store.subscribe((change) => change === 'preferences' && this.#dress());
    const inner = this.#build({ ...this.#actions(script), ...actions });
    addStyles(root, LAYOUT_STYLES);
    root.append(this.#host);
    // Not before it stands in its document.
    addStyles(inner, PANEL_STYLES);
    this.#listenToKeys(inner);
    this.#layOut(element.getBoundingClientRect());
    this.#size.observe(element);
  }

  focus(): void {
    this.#panel.focus();
  }

  get hasFocus(): boolean {
    return this.#owner.root.activeElement === this.#host;
  }

  dispose(): void {
    const { root } = this.#owner;
    this.#listening.abort();
    this.#size.disconnect();
    this.#host.remove();
    removeStyles(root, LAYOUT_STYLES);
  }

  /** The element has changed: its look, its words or its history. */
  sync(): void {
    const store = this.#store;
    const { view, theme } = this.#element;
    const chosenColor = this.#owner.chosenColor();
    const language = this.#owner.language();
    if (language !== store.language || theme !== store.theme) {
      Object.assign(store, { language, theme });
      store.notify('preferences');
      // Its sentences may have to be fetched.
      void loadJapanese().then(() => store.notify('preferences'));
    }
    if (view !== store.view || chosenColor !== store.chosenColor) {
      Object.assign(store, { view, chosenColor });
      store.notify('look');
    }
    this.#heard();
  }

  #actions(script: string | null): Actions<K> {
    const element = this.#element;
    const store = this.#store;
    const owner = this.#owner;
    const root = () => this.#panel.getRootNode() as ShadowRoot;
    const withFreshSeed = (use: (seed: number) => void) => {
      element.freshSeed().then(use, (thrown: unknown) => void store.fail(errorInfo(thrown)));
    };
    return {
      element,
      freshSeed: () => withFreshSeed((seed) => store.setSeed(seed)),
      randomise: () => withFreshSeed((seed) => void store.randomise(owner.random, seed)),
      newElement: () => {
        const other = new (element.constructor as new () => GeneratorElement<K>)();
        other.backend = element.backend;
        return other;
      },
      share: () => void copyOrShow(store, root(), element.shareURL(), 'copied', 'share'),
      embed:
        script === null
          ? undefined
          : () =>
              void copyOrShow(
                store,
                root(),
                embedCode(element.localName, new URL(element.shareURL()).hash.slice(1), script),
                'embedCopied',
                'embed',
              ),
      close: this.#close,
      cancel: () => store.cancel(element),
    };
  }

  #build(actions: Actions<K>): ShadowRoot {
    this.#host.className = 'controls-panel';
    this.#host.setAttribute('part', 'panel');
    const inner = this.#host.attachShadow({ mode: 'open' });
    const panel = this.#panel;
    panel.className = 'panel';
    panel.setAttribute('role', 'region');
    panel.tabIndex = -1;
    Object.assign(panel, { store: this.#store, actions, isEmbedded: true });
    this.#dress();
    inner.append(panel);
    return inner;
  }

  #dress(): void {
    const { language, theme } = this.#store;
    this.#host.lang = language;
    this.#host.dataset.theme = theme;
    this.#panel.setAttribute('aria-label', translate(language, 'controls'));
  }

  #layOut({ width, height }: { width: number; height: number }): void {
    this.#host.dataset.layout = width >= BESIDE_FROM ? 'beside' : height >= BELOW_FROM ? 'below' : 'over';
  }

  /** A native control keeps what is typed into it from nobody, but pages know one when they see one: of these they see the element alone. */
  #listenToKeys(inner: ShadowRoot): void {
    inner.addEventListener('keydown', (event) => {
      const key = event as KeyboardEvent;
      if (!isDialogOpen(inner) && !key.isComposing) {
        if (key.key === 'Escape') this.#close();
        if (key.key === 'Escape' || travel(this.#store, key)) key.preventDefault();
      }
      if (!hasModifier(key) || key.defaultPrevented) key.stopPropagation();
    });
    for (const type of ['keyup', 'keypress', 'beforeinput', 'input']) inner.addEventListener(type, (event) => event.stopPropagation());
  }
}
