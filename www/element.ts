/** `rock-field/element`: the class alone. Importing it registers nothing, so that a page can choose the name. */

export { RockFieldElement } from './rock-field-element.ts';
export type { RockFieldEventMap } from './rock-field-element.ts';
export type { ErrorInfo, ErrorName } from './errors.ts';
export type { Field, FieldLayer, FieldStats, StageTimes } from './field.ts';
export type { Progress } from './generator/protocol.ts';
export type { Layer, Params, PresetName } from './params.ts';
export type { Backend, CameraState, ColorMode, View } from './renderer/renderer.ts';
export type { Theme } from './attribute-reader.ts';
