/** What the first picture does not need, in one file that is loaded when it stands, or earlier if somebody is quick. */

export { choosePreset } from './preset-picker.ts';
export { lastSection, wayToLog } from './last-section.ts';
export { numberField, paramControl } from './param-control.ts';
export { pageActions } from './page-actions.ts';
export { placeError } from './place-error.ts';
export { japaneseNotice } from '../table/notices.ja.ts';
export { errorText, later } from './strings-later.ts';
