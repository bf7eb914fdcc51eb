/** A page of one generator: wires an element, the controls and the address bar to one store, which has one history with the element. */

import '../controls/stage-overlay.ts';
import { couple, listensTo } from '../controls/coupling.ts';
import { savePreferences } from '../controls/preferences.ts';
import { UNAVAILABLE } from '../base/errors.ts';
import { historyOf } from '../element/generator-element.ts';
import { lazily, onMissingFile, tellMissingFile } from '../base/lazy.ts';
import { isLink } from '../table/link.ts';
import { rememberPage } from '../controls/site.ts';
import { pageTitle, translate } from '../controls/strings.ts';
import type { Actions } from '../controls/actions.ts';
import type { Later, Panel } from '../controls/panel.ts';
import type { Draw, Edition, Kind } from '../table/table.ts';
import type { Change, OpenedLink, Preferences, Store } from '../controls/store.ts';
import type { GeneratorElement, ElementEventMap } from '../element/generator-element.ts';
import type { History } from '../base/history.ts';
import type { Link } from '../table/link.ts';
import type { StringKey } from '../controls/strings.en.ts';

/** A drag makes some 60 edits a second; Safari allows 100 changes of the address in 30 s. */
const ADDRESS_DELAY_MS = 300;

/** What the page is made of. */
export interface Page<K extends Kind> {
  newStore: (link: OpenedLink<K>, preferences: Preferences, history: History<Edition<K>>) => Store<K>;
  preferences: Preferences;
  element: GeneratorElement<K>;
  panel: Panel<K>;
  readLink: (text: string) => OpenedLink<K>;
  encode: (state: Link<K>) => string;
  /** What the element shows. */
  shown: () => K['result'] | null;
  /** What a panel of this generator can do beyond those of others. */
  actions?: object;
  /** Whether a reload would lose a log from a file, which is not in the address. */
  hasUnsavedLog?: () => boolean;
  /** Other parameters by lot. */
  random: (params: K['params'], draw: Draw) => Promise<K['params']>;
}

/** Returns the store, whose steps of undo are the element's. */
export function openPage<K extends Kind>({
  newStore,
  preferences,
  element,
  panel,
  readLink,
  encode,
  shown,
  random,
  hasUnsavedLog = () => false,
  actions: own = {},
}: Page<K>): Store<K> {
  const opening = readLink(location.search + location.hash);
  element.params = { ...opening.params, preset: opening.preset };
  const store = newStore(
    opening,
    preferences,
    historyOf(element, () => {
      if (heard()) element.camera = store.camera;
    }),
  );
  const stage = found('.stage');
  // What helps when a file cannot be had has to be there before that.
  const offline = lazily(() => import('./offline.ts'));
  const { title } = document;

  // The element follows the store …

  function follow(change: Change): void {
    if (change === 'preferences') showPreferences();
    if (change === 'params' || change === 'look' || change === 'camera') scheduleAddress();
  }

  function showPreferences(): void {
    const { language, theme } = store;
    savePreferences({ language, theme });
    const page = document.documentElement;
    page.lang = language;
    document.title = pageTitle(language, element.localName) ?? title;
    if (theme === 'auto') delete page.dataset.theme;
    else page.dataset.theme = theme;
    element.theme = theme;
    for (const words of document.querySelectorAll<HTMLElement>('[data-string]'))
      words.textContent = translate(language, words.dataset.string as StringKey);
    stage.setAttribute('aria-label', translate(language, 'picture'));
    panel.setAttribute('aria-label', translate(language, 'controls'));
  }

  // … and tells it what happened.

  const listen = listensTo(element);
  listen('load', () => void offline.then(({ keepOffline }) => keepOffline()));
  listen('generate', scheduleAddress);
  listen('error', ({ detail }: ElementEventMap<string>['error']) => {
    if (UNAVAILABLE.test(detail.error.name)) tellMissingFile(true);
  });
  listen('restored', () => {
    // The plan that stands in says why by itself, until it goes.
    if (store.backend !== 'canvas2d' && element.backend !== 'canvas2d') store.say((language) => translate(language, 'lostPicture'));
  });
  // After what looks at the backend that there was.
  const heard = couple(store, element, shown);
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

  // The address.

  let addressTimer: ReturnType<typeof setTimeout> | undefined;

  function link(): string {
    return encode(store.shown);
  }

  function scheduleAddress(): void {
    clearTimeout(addressTimer);
    addressTimer = setTimeout(writeAddress, ADDRESS_DELAY_MS);
  }

  function writeAddress(): void {
    clearTimeout(addressTimer);
    addressTimer = undefined;
    // What a run has not made yet may be refused.
    if (!store.isSettled) return;
    write(link());
  }

  function write(text: string): void {
    // Without the `?…` it may have been opened with: one link, not two.
    try {
      history.replaceState(null, '', `${location.pathname}#${text}`);
    } catch {
      // A frame without an address of its own, or a browser that has counted too many changes. Links are made without it.
    }
    rememberPage(text);
  }

  /** What a page that is opened in place of this one begins with: also what this one has not made. */
  function wantedLink(): string {
    const { wanted, params, preset, view, chosenColor, camera } = store;
    return encode({ view, color: chosenColor, camera, ...(wanted ?? { params, preset }) });
  }

  // Whoever leaves the page finds it again as it was left. A click comes before the page is left, a closed window does not.
  const writeAtOnce = () => addressTimer !== undefined && writeAddress();
  document.addEventListener('click', writeAtOnce, true);
  window.addEventListener('pagehide', () => {
    writeAtOnce();
    if (!store.isSettled) rememberPage(wantedLink());
  });
  if (isLink(store.table, location.hash)) rememberPage(link());

  window.addEventListener('hashchange', ({ newURL }) => {
    // Not the present address: an edit may have been written to it since, which is older than what was put there.
    const { hash } = new URL(newURL);
    // A place on the page, not a link: what is shown stays.
    if (hash !== '' && !isLink(store.table, hash)) return;
    clearTimeout(addressTimer);
    const opened = readLink(hash);
    store.open(opened);
    element.camera = store.camera = opened.camera;
  });

  // What the buttons do.

  const act = (name: keyof Later['pageActions']) => () =>
    void panel.loadLater().then(({ pageActions }) => pageActions[name]({ store, element, stage, random, link }));

  const actions: Actions<K> = {
    freshSeed: act('freshSeed'),
    randomise: act('randomise'),
    link,
    newElement: () => document.createElement(element.localName) as GeneratorElement<K>,
    share: () => {
      writeAddress();
      act('share')();
    },
    embed: act('embed'),
    help: act('help'),
  };

  // Everything stands; put it on the page.

  panel.className = 'panel';
  panel.id = 'controls';
  panel.setAttribute('role', 'region');
  panel.tabIndex = -1;
  Object.assign(panel, { store, actions: { ...actions, ...own } });

  const overlay = document.createElement('stage-overlay');
  Object.assign(overlay, {
    store,
    actions: { cancel: () => store.cancel(element), frameAll: () => element.frameAll(), toggleFullScreen: act('fullScreen') },
  });

  store.subscribe(follow);
  showPreferences();
  Object.assign(element, { view: store.view, color: store.chosenColor, camera: store.camera });
  element.className = 'picture';
  // Nothing scrolls here.
  element.interaction = 'always';
  stage.append(element, overlay);
  stage.after(panel);
  // No key is pressed before there is something to see.
  void lazily(() => import('../controls/keys.ts')).then(({ listenToKeys }) =>
    listenToKeys(store, { frameAll: () => element.frameAll(), help: () => void actions.help?.() }),
  );

  found('.skip-link').addEventListener('click', (event) => {
    // Not by the address: that is the link's.
    event.preventDefault();
    panel.focus();
  });
  found('.boot').remove();

  void offline.then(({ offerNewerVersion, sayUncaught }) => {
    offerNewerVersion(onMissingFile, store, () => write(wantedLink()), hasUnsavedLog);
    sayUncaught(store);
  });
  return store;
}

function found(selector: string): HTMLElement {
  const element = document.querySelector<HTMLElement>(selector);
  if (!element) throw new Error(`the page has no ${selector}`);
  return element;
}
