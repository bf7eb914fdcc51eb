/** What the first picture of rocks does not need; as `controls/later.ts`, with what rocks alone have. */

export * from '../../controls/later.ts';
export { showExport } from './export-dialog.ts';
export { layerControls } from './layer-controls.ts';
export { nextLayer } from './next-layer.ts';
export { inNotation } from './notation.ts';
export { presetGroups } from './preset-groups.ts';
export { paintSection } from './painting/paint-section.ts';
export { randomParams } from './randomise.ts';
export { scaledLayer } from './scaled-layer.ts';
export { statistics } from './statistics.ts';
