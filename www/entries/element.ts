/** `rock-field/element`: the class alone. Importing it registers nothing, so that a page can choose the name. */

export { RockFieldElement } from '../rocks/element.ts';
export type { RockFieldEventMap } from '../rocks/element.ts';
export type { ErrorInfo, ErrorName } from '../base/errors.ts';
export type { Field, FieldLayer, FieldStats, StageTimes } from '../data/field.ts';
export type { Progress } from '../generator/protocol.ts';
export type { Layer, Params, PresetName } from '../rocks/params.ts';
export type { Backend, CameraState, ColorMode, Theme, View } from '../base/view.ts';
