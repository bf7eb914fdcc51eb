/** A page of one generator: wires an element, the controls and the address bar to one store, which has one history with the element. */

import '../controls/stage-overlay.ts';
import { couple, listensTo } from '../controls/coupling.ts';
import { savePreferences } from '../controls/preferences.ts';
import { UNAVAILABLE } from '../base/errors.ts';
import { historyOf } from '../element/params-element.ts';
import { lazily, onMissingFile, tellMissingFile } from '../base/lazy.ts';
import { Address } from './address.ts';
import { pageTitle, translate } from '../controls/strings.ts';
import type { Actions } from '../controls/actions.ts';
import type { Later, Panel } from '../controls/panel.ts';
import type { Draw, Edition, Kind } from '../table/table.ts';
import type { Change, OpenedLink, Preferences, Store } from '../controls/store.ts';
import type { GeneratorElement, ElementEventMap } from '../element/generator-element.ts';
import type { History } from '../base/history.ts';
import type { FileParts } from './bring-back.ts';
import type { Links } from './address.ts';
import type { StringKey } from '../controls/strings.en.ts';

/** So long the panel waits for the first picture, ms. */
const PATIENCE_MS = 4000;

/** What the page is made of. */
export interface Page<K extends Kind> extends Links<K> {
  newStore: (link: OpenedLink<K>, preferences: Preferences, history: History<Edition<K>>) => Store<K>;
  preferences: Preferences;
  element: GeneratorElement<K>;
  panel: Panel<K>;
  /** What the element shows. */
  shown: () => K['result'] | null;
  /** What a panel of this generator can do beyond those of others. */
  actions?: object;
  /** Whether a reload would lose a log from a file, which is not in the address. */
  hasUnsavedLog?: () => boolean;
  /** What brings scenes back out of files. */
  files: () => Promise<{ listenToFiles: (parts: FileParts<K>) => void }>;
  /** Other parameters by lot. */
  random: (params: K['params'], draw: Draw) => Promise<K['params']>;
}

/** Returns the store, whose steps of undo are the element's. */
export function openPage<K extends Kind>(page: Page<K>): Store<K> {
  const { element } = page;
  const opening = page.readLink(location.search + location.hash);
  element.params = { ...opening.params, preset: opening.preset };
  const store = page.newStore(
    opening,
    page.preferences,
    historyOf(element, () => {
      if (heard()) element.camera = store.camera;
    }),
  );
  // What helps when a file cannot be had has to be there before that.
  const offline = lazily(() => import('./offline.ts'));
  const open = (link: OpenedLink<K>): void => {
    store.open(link);
    element.camera = store.camera = link.camera;
  };
  const address = new Address(store, page, open);
  const showPreferences = preferencesOf(page, store);

  const listen = listensTo(element);
  listen('load', () => void offline.then(({ keepOffline }) => keepOffline()));
  listen('generate', () => address.schedule());
  listenTo(element, store);
  // After what looks at the backend that there was.
  const heard = couple(store, element, page.shown);
  store.subscribe((change: Change) => {
    if (change === 'preferences') showPreferences();
    if (change === 'params' || change === 'look' || change === 'camera') address.schedule();
  });

  showPreferences();
  show(page, store, address);
  void lazily(page.files).then(({ listenToFiles }) => listenToFiles({ store, element, panel: page.panel, open }));
  void offline.then(({ offerNewerVersion, sayUncaught }) => {
    offerNewerVersion(onMissingFile, store, () => address.leave(), page.hasUnsavedLog ?? (() => false));
    sayUncaught(store);
  });
  return store;
}

/** Returns what gives the page its language and theme, and remembers them. */
function preferencesOf<K extends Kind>({ element, panel }: Page<K>, store: Store<K>): () => void {
  const { title } = document;
  return () => {
    const { language, theme } = store;
    savePreferences({ language, theme });
    const root = document.documentElement;
    root.lang = language;
    document.title = pageTitle(language, element.localName) ?? title;
    if (theme === 'auto') delete root.dataset.theme;
    else root.dataset.theme = theme;
    element.theme = theme;
    for (const words of document.querySelectorAll<HTMLElement>('[data-string]'))
      words.textContent = translate(language, words.dataset.string as StringKey);
    found('.stage').setAttribute('aria-label', translate(language, 'picture'));
    panel.setAttribute('aria-label', translate(language, 'controls'));
  };
}

/** What the page does with the element's events beyond what a panel does. */
function listenTo<K extends Kind>(element: GeneratorElement<K>, store: Store<K>): void {
  const listen = listensTo(element);
  listen('error', ({ detail }: ElementEventMap<string>['error']) => {
    if (UNAVAILABLE.test(detail.error.name)) tellMissingFile(true);
  });
  listen('restored', () => {
    // The plan that stands in says why by itself, until it goes.
    if (store.backend !== 'canvas2d' && element.backend !== 'canvas2d') store.say((language) => translate(language, 'lostPicture'));
  });
  listen('notice', (event: ElementEventMap<string>['notice']) => {
    // The page says it, or offers the remedy beside the progress.
    event.preventDefault();
    const { message } = event.detail;
    if (message !== store.offer?.text) store.say(() => message);
  });
  listen('camera-change', ({ detail }: ElementEventMap<string>['camera-change']) => {
    // The default camera is no part of a link.
    store.camera = JSON.stringify(detail.camera) === JSON.stringify(element.defaultCamera) ? null : detail.camera;
    store.notify('camera');
  });
}

/** Everything stands: puts it on the page. */
function show<K extends Kind>({ element, panel, random, actions }: Page<K>, store: Store<K>, address: Address<K>): void {
  const stage = found('.stage');
  const link = (): string => address.link();
  const act = (name: keyof Later['pageActions']) => () =>
    void panel.loadLater().then(({ pageActions }) => pageActions[name]({ store, element, stage, random, link }));
  const frameAll = (): void => element.frameAll();
  const help = act('help');
  const own: Actions<K> = {
    element,
    freshSeed: act('freshSeed'),
    randomise: act('randomise'),
    link,
    newElement: () => document.createElement(element.localName) as GeneratorElement<K>,
    share: () => {
      address.write();
      act('share')();
    },
    embed: act('embed'),
    help,
    pictured: Promise.race([element.ready, new Promise((resolve) => setTimeout(resolve, PATIENCE_MS))]),
  };
  panel.className = 'panel';
  panel.id = 'controls';
  panel.setAttribute('role', 'region');
  panel.tabIndex = -1;
  Object.assign(panel, { store, actions: { ...own, ...actions } });

  const overlay = document.createElement('stage-overlay');
  Object.assign(overlay, { store, actions: { cancel: () => store.cancel(element), frameAll, toggleFullScreen: act('fullScreen') } });

  Object.assign(element, { view: store.view, color: store.chosenColor, camera: store.camera });
  element.className = 'picture';
  // Nothing scrolls here.
  element.interaction = 'always';
  // Its words need not be laid out.
  found('.boot').remove();
  stage.append(element, overlay);
  stage.after(panel);
  // No key is pressed before there is something to see.
  void lazily(() => import('../controls/hands.ts')).then(({ takeInHand }) => takeInHand(store, element, overlay, { frameAll, help }));

  found('.skip-link').addEventListener('click', (event) => {
    // Not by the address: that is the link's.
    event.preventDefault();
    panel.focus();
  });
}

function found(selector: string): HTMLElement {
  const element = document.querySelector<HTMLElement>(selector);
  if (!element) throw new Error(`the page has no ${selector}`);
  return element;
}
