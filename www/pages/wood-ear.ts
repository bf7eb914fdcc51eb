/** The page of wood ears. */

import '../entries/wood-ear-log.ts';
import { loadPreferences } from '../controls/preferences.ts';
import { WoodEarPanel } from '../wood-ear/controls/panel.ts';
import { WoodEarStore } from '../wood-ear/controls/store.ts';
import { errorInfo, isAbort } from '../base/errors.ts';
import { lazily } from '../base/lazy.ts';
import { isLink } from '../table/link.ts';
import { openPage } from './page.ts';
import { loadJapanese } from '../controls/strings.ts';
import { decodeWoodEarLink, encodeWoodEarLink } from '../wood-ear/link.ts';
import { WOOD_EARS } from '../wood-ear/table.ts';
import type { OpenedLink } from '../controls/store.ts';
import type { WoodEarPresetName } from '../wood-ear/request.ts';
import type { WoodEars } from '../wood-ear/table.ts';

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
  files: () => import('./wood-ear-files.ts'),
  random: async (params, draw) => (await lazily(() => import('../wood-ear/controls/randomise.ts'))).randomWoodEars(params, draw),
  hasUnsavedLog: () => element.params.mesh !== null,
  actions: { loadLog, rocksPage: './' },
});

element.editable = true;
