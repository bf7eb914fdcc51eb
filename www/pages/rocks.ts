/** The page of rock fields. */

import '../entries/rock-field.ts';
import { ControlPanel } from '../rocks/controls/panel.ts';
import { loadPreferences } from '../controls/preferences.ts';
import { ROCK_LATER } from '../rocks/controls/deferred.ts';
import { Store } from '../rocks/controls/store.ts';
import { isLink } from '../table/link.ts';
import { openPage } from './page.ts';
import { ROCKS } from '../rocks/table.ts';
import { loadJapanese } from '../controls/strings.ts';
import { decodeLink, encodeLink } from '../rocks/link.ts';
import type { PresetName } from '../rocks/params.ts';
import type { DecodedLink } from '../rocks/link.ts';

/** What the page shows where no link says anything. Links without a preset are the codec's own, as they were when they were written. */
const OPENING: PresetName = 'riverbed';

function readLink(text: string): DecodedLink {
  return decodeLink(isLink(ROCKS, text) ? text : `#preset=${OPENING}`);
}

const preferences = loadPreferences();
// In one language from the first picture on.
if (preferences.language === 'ja') await loadJapanese();

const element = document.createElement('rock-field');

openPage({
  newStore: (link, own, history) => new Store(link, own, ROCK_LATER, history),
  preferences,
  element,
  panel: new ControlPanel(),
  readLink,
  encode: encodeLink,
  shown: () => element.field,
  random: async (params, draw) => (await ROCK_LATER.load()).randomParams(params, draw),
});
