/** What the first picture of wood ears does not need; as `controls/later.ts`, with what wood ears alone have. */

export * from '../../controls/later.ts';
export { showExport } from './export-dialog.ts';
