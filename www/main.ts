/** The page: wires the element, the controls and the address bar to one store. */

import './rock-field.ts';
import './controls/stage-overlay.ts';
import { ControlPanel } from './controls/control-panel.ts';
import { listenToKeys } from './controls/keys.ts';
import { loadLater } from './controls/load-later.ts';
import { loadPreferences, savePreferences } from './controls/preferences.ts';
import { Store } from './controls/store.ts';
import { RockFieldError, errorInfo } from './errors.ts';
import { translate } from './strings.ts';
import { decodeLink, encodeLink } from './url-codec.ts';
import type { Actions } from './controls/control-panel.ts';
import type { Change } from './controls/store.ts';
import type { PresetName } from './params.ts';
import type { RockFieldEventMap } from './rock-field-element.ts';
import type { RockFieldElement } from './rock-field.ts';
import type { StringKey } from './strings.ts';
import type { DecodedLink } from './url-codec.ts';

/** A drag makes some 60 edits a second; Safari allows 100 changes of the address in 30 s. */
const ADDRESS_DELAY_MS = 300;

/** What the page shows where no link says anything. Links without a preset are the codec's own, as they were when they were written. */
const OPENING: PresetName = 'riverbed';

const store = new Store(readLink(location.search + location.hash), loadPreferences());
const stage = found('.stage');
const field = document.createElement('rock-field');

function readLink(text: string): DecodedLink {
  return decodeLink(text || `#preset=${OPENING}`);
}

function found(selector: string): HTMLElement {
  const element = document.querySelector<HTMLElement>(selector);
  if (!element) throw new Error(`the page has no ${selector}`);
  return element;
}

// The element follows the store …

function follow(change: Change): void {
  if (change === 'params') showParams();
  if (change === 'look') Object.assign(field, { view: store.view, color: store.chosenColor });
  if (change === 'preferences') showPreferences();
  if (change === 'params' || change === 'look' || change === 'camera') scheduleAddress();
}

function showParams(): void {
  try {
    field.params = { ...store.params, preset: store.preset };
  } catch (thrown) {
    void store.fail(errorInfo(thrown));
  }
}

function showPreferences(): void {
  const { language, theme } = store;
  savePreferences({ language, theme });
  const page = document.documentElement;
  page.lang = language;
  if (theme === 'auto') delete page.dataset.theme;
  else page.dataset.theme = theme;
  field.theme = theme;
  for (const element of document.querySelectorAll<HTMLElement>('[data-string]')) {
    element.textContent = translate(language, element.dataset.string as StringKey);
  }
  stage.setAttribute('aria-label', translate(language, 'picture'));
  panel.setAttribute('aria-label', translate(language, 'controls'));
}

// … and tells it what happened.

function listen<K extends keyof RockFieldEventMap>(element: RockFieldElement, type: K, listener: (event: RockFieldEventMap[K]) => void): void {
  element.addEventListener(type, listener as EventListener);
}

listen(field, 'load', () => {
  store.setBackend(field.backend);
  void import('./offline.ts').then(({ keepOffline }) => keepOffline());
});
listen(field, 'generate', ({ detail }) => {
  store.setBackend(field.backend);
  store.showField(detail.field, detail.superseded ? null : store.params);
});
listen(field, 'progress', ({ detail }) => store.setProgress(detail));
listen(field, 'error', ({ detail }) => void store.fail(detail.error));
listen(field, 'restored', () => {
  store.setBackend(field.backend);
  store.say((language) => translate(language, 'lostPicture'));
});
listen(field, 'notice', ({ detail }) => store.say(() => detail.message));
listen(field, 'camera-change', ({ detail }) => {
  store.camera = detail.framed ? null : detail.camera;
  store.notify('camera');
});

// The address.

let addressTimer: ReturnType<typeof setTimeout> | undefined;

function link(): string {
  return encodeLink(store);
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
  history.replaceState(null, '', `${location.pathname}#${link()}`);
}

window.addEventListener('hashchange', () => {
  // An edit on its way to the address is older than what was put there.
  clearTimeout(addressTimer);
  const opened = readLink(location.hash);
  store.open(opened);
  field.camera = opened.camera;
});

// What the buttons do.

async function withFreshSeed(use: (seed: number) => void | Promise<void>): Promise<void> {
  try {
    await use(await field.freshSeed());
  } catch (thrown) {
    void store.fail(errorInfo(thrown));
  }
}

const actions: Actions = {
  freshSeed: () => void withFreshSeed((seed) => store.setSeed(seed)),
  randomise: () => void withFreshSeed(async (seed) => {
    const { randomParams } = await loadLater();
    store.edit(randomParams(store.params, seed));
  }),
  newField: () => document.createElement('rock-field'),
  share: async () => {
    writeAddress();
    const { copyOrShow } = await loadLater();
    await copyOrShow(store, document.body, pageAddress(), 'copied', 'share');
  },
  embed: async () => {
    const { copyOrShow, embedCode } = await loadLater();
    await copyOrShow(store, document.body, embedCode(link(), location.href), 'embedCopied', 'embed');
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
  field.cancel();
  store.setProgress(null);
  store.backToShown();
}

// Everything stands; put it on the page.

const panel = new ControlPanel();
panel.className = 'panel';
panel.id = 'controls';
panel.setAttribute('role', 'region');
panel.tabIndex = -1;
Object.assign(panel, { store, actions });

const overlay = document.createElement('stage-overlay');
Object.assign(overlay, { store, actions: { cancel, frameAll: () => field.frameAll(), toggleFullScreen: () => void toggleFullScreen() } });

store.subscribe(follow);
showPreferences();
Object.assign(field, { params: { ...store.params, preset: store.preset }, view: store.view, color: store.chosenColor, camera: store.camera });
field.className = 'picture';
// Nothing scrolls here.
field.interaction = 'always';
stage.append(field, overlay);
stage.after(panel);
listenToKeys(store, { frameAll: () => field.frameAll(), help: () => void actions.help?.() });

found('.skip-link').addEventListener('click', (event) => {
  // Not by the address: that is the field's.
  event.preventDefault();
  panel.focus();
});
found('.boot').remove();

// What nobody caught is said, not swallowed.
window.addEventListener('unhandledrejection', ({ reason }) => {
  const message = reason instanceof RockFieldError ? reason.message : String(reason);
  if (reason?.name !== 'AbortError') store.say((language) => translate(language, 'pageFailed', { message }));
});
