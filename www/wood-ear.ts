/** The page of wood ears. */

import './wood-ear-log.ts';
import { loadPreferences } from './controls/preferences.ts';
import { WoodEarPanel } from './controls/wood-ear-controls.ts';
import { WoodEarStore } from './controls/wood-ear-store.ts';
import { errorInfo, isAbort } from './errors.ts';
import { lazily } from './lazy.ts';
import { isLink } from './link.ts';
import { droppedFiles, hasFiles, logAmong } from './log-drop.ts';
import { openPage } from './page.ts';
import { loadJapanese } from './strings.ts';
import { decodeWoodEarLink, encodeWoodEarLink } from './wood-ear-link.ts';
import { WOOD_EARS } from './wood-ears.ts';
import type { OpenedLink } from './controls/scene-store.ts';
import type { WoodEarPresetName } from './wood-ear-flat.ts';
import type { WoodEars } from './wood-ears.ts';

/** What the page shows where no link says anything. */
const OPENING: WoodEarPresetName = 'fallen-log';

function readLink(text: string): OpenedLink<WoodEars> {
  return decodeWoodEarLink(isLink(WOOD_EARS, text) ? text : `#preset=${OPENING}`);
}

const preferences = loadPreferences();
// In one language from the first picture on.
if (preferences.language === 'ja') await loadJapanese();

const element = document.createElement('wood-ear-log');

function loadLog(file: File): void {
  element.loadLog(file).catch((thrown: unknown) => {
    if (!isAbort(thrown)) void store.fail(errorInfo(thrown));
  });
}

const store = openPage({
  newStore: (link, own, history) => new WoodEarStore(link, own, history),
  preferences,
  element,
  panel: new WoodEarPanel(),
  readLink,
  encode: encodeWoodEarLink,
  shown: () => element.scene,
  random: async (params, draw) => (await lazily(() => import('./controls/randomise-wood-ears.ts'))).randomWoodEars(params, draw),
  hasUnsavedLog: () => element.params.mesh !== null,
  actions: { loadLog, rocksPage: './' },
});

element.editable = true;

// A file that is dropped beside the picture is meant for it; the browser would leave the page for the file.
window.addEventListener('dragover', (event) => {
  if (hasFiles(event)) event.preventDefault();
});
window.addEventListener('drop', (event) => {
  if (event.defaultPrevented || !hasFiles(event)) return;
  event.preventDefault();
  void droppedFiles(event.dataTransfer).then((files) => {
    const file = logAmong(files);
    if (file) loadLog(file);
  });
});
