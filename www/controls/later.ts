/** What the first picture does not need, in one file that is loaded when it stands, or earlier if somebody is quick. */

export { choosePreset } from './preset-picker.ts';
export { presetGroups } from '../rocks/controls/preset-groups.ts';
export { nextLayer } from '../rocks/controls/next-layer.ts';
export { lastSection, wayToLog } from './last-section.ts';
export { layerControls } from '../rocks/controls/layer-controls.ts';
export { inNotation } from '../rocks/controls/notation.ts';
export { numberField, paramControl } from './param-control.ts';
export { randomParams } from '../rocks/controls/randomise.ts';
export { scaledLayer } from '../rocks/controls/scaled-layer.ts';
export { pageActions } from './page-actions.ts';
export { placeError } from './place-error.ts';
export { statistics } from '../rocks/controls/statistics.ts';
export { japaneseNotice } from '../table/notices.ja.ts';
export { errorText, later } from './strings-later.ts';
