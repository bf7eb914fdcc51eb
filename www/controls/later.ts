/** What the first picture does not need, in one file that is loaded when it stands, or earlier if somebody is quick. */

export { choosePreset, presetGroups } from './preset-picker.ts';
export { nextLayer } from './next-layer.ts';
export { lastSection, wayToLog } from './last-section.ts';
export { layerControls } from './layer-controls.ts';
export { inNotation } from './notation.ts';
export { numberField, paramControl } from './param-control.ts';
export { randomParams } from './randomise.ts';
export { scaledLayer } from './scaled-layer.ts';
export { pageActions } from './page-actions.ts';
export { placeError } from './place-error.ts';
export { statistics } from './statistics.ts';
export { japaneseNotice } from '../notices.ja.ts';
export { errorText, later } from '../strings-later.ts';
