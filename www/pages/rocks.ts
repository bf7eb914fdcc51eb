/** The page of rock fields. */

import '../entries/rock-field.ts';
import { RockPanel } from '../rocks/controls/panel.ts';
import { loadPreferences } from '../controls/preferences.ts';
import { ROCK_LATER } from '../rocks/controls/deferred.ts';
import { RockStore } from '../rocks/controls/store.ts';
import { isLink } from '../table/link.ts';
import { openPage } from './page.ts';
import { ROCKS } from '../rocks/table.ts';
import { loadJapanese } from '../controls/strings.ts';
import { decodeLink, encodeLink } from '../rocks/link.ts';
import type { PresetName } from '../rocks/params.ts';
import type { RockLink } from '../rocks/link.ts';

/** What the page shows where no link says anything. Links without a preset are the codec's own, as they were when they were written. */
const OPENING: PresetName = 'riverbed';

function readLink(text: string): RockLink {
  return decodeLink(isLink(ROCKS, text) ? text : `#preset=${OPENING}`);
}

const preferences = loadPreferences();
// In one language from the first picture on.
if (preferences.language === 'ja') await loadJapanese();

const element = document.createElement('rock-field');

openPage({
  newStore: (link, own, history) => new RockStore(link, own, ROCK_LATER, history),
  preferences,
  element,
  panel: new RockPanel(),
  readLink,
  encode: encodeLink,
  shown: () => element.field,
  files: () => import('./rock-files.ts'),
  random: async (params, draw) => (await ROCK_LATER.load()).randomParams(params, draw),
});
