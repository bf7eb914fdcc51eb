/** What the first picture does not need, in one file that is loaded when it stands, or earlier if somebody is quick. */

export { embedCode } from './clipboard.ts';
export { copyOrShow, showKeys } from './dialogs.ts';
export { choosePreset, presetGroups } from './preset-picker.ts';
export { nextLayer } from './next-layer.ts';
export { lastSection, wayToLog } from './last-section.ts';
export { layerControls } from './layer-controls.ts';
export { inNotation } from './notation.ts';
export { numberField, paramControl } from './param-control.ts';
export { randomParams } from './randomise.ts';
export { scaledLayer } from './scaled-layer.ts';
export { statistics } from './statistics.ts';
export { japaneseNotice } from '../notices.ja.ts';
export { errorText, later } from '../strings-later.ts';
