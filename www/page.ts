/** A page of one scene: wires an element, the controls and the address bar to one store. */

import './controls/stage-overlay.ts';
import { loadLater } from './controls/load-later.ts';
import { savePreferences } from './controls/preferences.ts';
import { RockFieldError, errorInfo } from './errors.ts';
import { lazily, onMissingFile, tellMissingFile } from './lazy.ts';
import { isLink } from './link.ts';
import { rememberScene } from './scenes.ts';
import { pageTitle, translate } from './strings.ts';
import { same } from './table.ts';
import type { Actions, ScenePanel } from './controls/scene-panel.ts';
import type { Change, OpenedLink, SceneStore } from './controls/scene-store.ts';
import type { GeneratorElement, SceneEventMap } from './generator-element.ts';
import type { SceneLink } from './link.ts';
import type { StringKey } from './strings.ts';
import type { Kind } from './table.ts';

/** A drag makes some 60 edits a second; Safari allows 100 changes of the address in 30 s. */
const ADDRESS_DELAY_MS = 300;

/** Errors that a file may be the reason of which is not there any more. */
const UNAVAILABLE = /^(Wasm|Worker)Unavailable$/;

/** What the page is made of. */
export interface Page<K extends Kind> {
  store: SceneStore<K>;
  element: GeneratorElement<K>;
  panel: ScenePanel<K>;
  readLink: (text: string) => OpenedLink<K>;
  encode: (state: SceneLink<K>) => string;
  /** What the element shows. */
  shown: () => K['result'] | null;
  /** Of the scene's own panel. */
  actions?: object;
  /** Whether a reload would lose a log from a file, which is not in the address. */
  hasUnsavedLog?: () => boolean;
  /** Other parameters by lot. */
  random: (params: K['params'], seed: number) => Promise<K['params']>;
}

export function openPage<K extends Kind>({ store, element, panel, readLink, encode, shown, random, hasUnsavedLog = () => false, actions: own = {} }: Page<K>): void {
  const stage = found('.stage');
  // What helps when a file cannot be had has to be there before that.
  const offline = lazily(() => import('./offline.ts'));
  const { title } = document;

  // The element follows the store …

  function follow(change: Change): void {
    if (change === 'params') showParams();
    if (change === 'look') Object.assign(element, { view: store.view, color: store.chosenColor });
    if (change === 'preferences') showPreferences();
    if (change === 'params' || change === 'look' || change === 'camera') scheduleAddress();
  }

  /** The preset that the element was told last. */
  let told = store.preset;

  function showParams(): void {
    // The element has them already where a change of it came here: assigning them would be another run.
    if (told === store.preset && same(store.table, element.params, store.params)) return;
    try {
      element.params = { ...store.params, preset: store.preset };
      told = store.preset;
    } catch (thrown) {
      void store.fail(errorInfo(thrown));
    }
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
    for (const words of document.querySelectorAll<HTMLElement>('[data-string]')) words.textContent = translate(language, words.dataset.string as StringKey);
    stage.setAttribute('aria-label', translate(language, 'picture'));
    panel.setAttribute('aria-label', translate(language, 'controls'));
  }

  // … and tells it what happened.

  function listen<Event>(type: string, listener: (event: Event) => void): void {
    element.addEventListener(type, listener as EventListener);
  }

  listen('load', () => {
    store.setBackend(element.backend);
    void offline.then(({ keepOffline }) => keepOffline());
  });
  listen('generate', ({ detail }: CustomEvent<{ superseded: boolean }>) => {
    store.setBackend(element.backend);
    const result = shown();
    if (result) store.showResult(result, detail.superseded ? null : store.params);
  });
  listen('progress', ({ detail }: SceneEventMap<K['stage']>['progress']) => store.setProgress(detail));
  listen('error', (event: SceneEventMap<string>['error']) => {
    // The page has words for it.
    event.preventDefault();
    const { error, shown: isSaid } = event.detail;
    if (UNAVAILABLE.test(error.name)) tellMissingFile(true);
    if (isSaid) store.setProgress(null);
    else void store.fail(error);
  });
  listen('restored', () => {
    // The plan that stands in says why by itself, until it goes.
    const isSaid = store.backend === 'canvas2d' || element.backend === 'canvas2d';
    store.setBackend(element.backend);
    if (!isSaid) store.say((language) => translate(language, 'lostPicture'));
  });
  listen('notice', ({ detail }: SceneEventMap<string>['notice']) => {
    // What is offered beside the progress is not said twice.
    if (detail.message !== store.offer?.text) store.say(() => detail.message);
  });
  listen('camera-change', ({ detail }: SceneEventMap<string>['camera-change']) => {
    // The default camera is no part of a link.
    store.camera = JSON.stringify(detail.camera) === JSON.stringify(element.defaultCamera) ? null : detail.camera;
    store.notify('camera');
  });

  // The address.

  let addressTimer: ReturnType<typeof setTimeout> | undefined;

  function link(): string {
    return encode(store);
  }

  function pageAddress(): string {
    return `${location.origin}${location.pathname}#${link()}`;
  }

  function scheduleAddress(): void {
    clearTimeout(addressTimer);
    addressTimer = setTimeout(writeAddress, ADDRESS_DELAY_MS);
  }

  function writeAddress(): void {
    clearTimeout(addressTimer);
    addressTimer = undefined;
    // Without the `?…` it may have been opened with: one link, not two.
    try {
      history.replaceState(null, '', `${location.pathname}#${link()}`);
    } catch {
      // A frame without an address of its own, or a browser that has counted too many changes. Links are made without it.
    }
    rememberScene(link());
  }

  // Whoever leaves the page finds it again as it was left. A click comes before the page is left, a closed window does not.
  const writeAtOnce = () => addressTimer !== undefined && writeAddress();
  document.addEventListener('click', writeAtOnce, true);
  window.addEventListener('pagehide', writeAtOnce);
  if (isLink(store.table, location.hash)) rememberScene(link());

  window.addEventListener('hashchange', () => {
    // A place on the page, not a scene: what is shown stays.
    if (location.hash !== '' && !isLink(store.table, location.hash)) return;
    // An edit on its way to the address is older than what was put there.
    clearTimeout(addressTimer);
    const opened = readLink(location.hash);
    store.open(opened);
    element.camera = store.camera = opened.camera;
  });

  // What the buttons do.

  async function withFreshSeed(use: (seed: number) => void | Promise<void>): Promise<void> {
    try {
      await use(await element.freshSeed());
    } catch (thrown) {
      void store.fail(errorInfo(thrown));
    }
  }

  const actions: Actions<K> = {
    freshSeed: () => void withFreshSeed((seed) => store.setSeed(seed)),
    randomise: () => void withFreshSeed(async (seed) => store.edit(await random(store.params, seed))),
    link,
    newElement: () => document.createElement(element.localName) as GeneratorElement<K>,
    share: async () => {
      writeAddress();
      const { copyOrShow } = await loadLater();
      await copyOrShow(store, document.body, pageAddress(), 'copied', 'share');
    },
    embed: async () => {
      const { copyOrShow, embedCode } = await loadLater();
      await copyOrShow(store, document.body, embedCode(element.localName, link(), location.href), 'embedCopied', 'embed');
    },
    help: async () => (await loadLater()).showKeys(store, document.body),
  };

  async function toggleFullScreen(): Promise<void> {
    try {
      if (document.fullscreenElement) await document.exitFullscreen();
      else await stage.requestFullscreen();
    } catch (thrown) {
      console.info('rock-field: no full screen:', thrown);
    }
  }

  function cancel(): void {
    element.cancel();
    store.setProgress(null);
    store.backToShown();
  }

  // Everything stands; put it on the page.

  panel.className = 'panel';
  panel.id = 'controls';
  panel.setAttribute('role', 'region');
  panel.tabIndex = -1;
  Object.assign(panel, { store, actions: { ...actions, ...own } });

  const overlay = document.createElement('stage-overlay');
  Object.assign(overlay, { store, actions: { cancel, frameAll: () => element.frameAll(), toggleFullScreen: () => void toggleFullScreen() } });

  store.subscribe(follow);
  showPreferences();
  Object.assign(element, { params: { ...store.params, preset: store.preset }, view: store.view, color: store.chosenColor, camera: store.camera });
  element.className = 'picture';
  // Nothing scrolls here.
  element.interaction = 'always';
  stage.append(element, overlay);
  stage.after(panel);
  // No key is pressed before there is something to see.
  void lazily(() => import('./controls/keys.ts')).then(({ listenToKeys }) => listenToKeys(store, { frameAll: () => element.frameAll(), help: () => void actions.help?.() }));

  found('.skip-link').addEventListener('click', (event) => {
    // Not by the address: that is the scene's.
    event.preventDefault();
    panel.focus();
  });
  found('.boot').remove();

  void offline.then(({ offerNewerVersion }) => offerNewerVersion(onMissingFile, store, writeAddress, hasUnsavedLog));

  // What nobody caught is said, not swallowed.
  window.addEventListener('unhandledrejection', ({ reason }) => {
    const message = reason instanceof RockFieldError ? reason.message : String(reason);
    if (reason?.name !== 'AbortError' && !store.remedy) store.say((language) => translate(language, 'pageFailed', { message }), true);
  });
}

function found(selector: string): HTMLElement {
  const element = document.querySelector<HTMLElement>(selector);
  if (!element) throw new Error(`the page has no ${selector}`);
  return element;
}
