/** `rock-field/export` for browsers, workers and bundlers: scenes as files, without a page. It imports nothing from Node. */

import type { ExportedFile } from '../export/file.ts';
import { exportWith } from '../rocks/export.ts';
import type { ExportRun } from '../rocks/export.ts';
import type { ExportOptions } from '../export/options.ts';
import { groundRealm } from '../rocks/ground-realm.ts';
import type { PaintedRequest } from '../rocks/painted.ts';
import { exportColonyWith } from '../wood-ear/headless-export.ts';
import type { WoodEarExportRequest, WoodEarExportRun } from '../wood-ear/headless-export.ts';
import { generate, growWoodEar } from './core.ts';

export { RockFieldError } from '../base/errors.ts';
export { exportSchema } from '../export/schema.ts';
export type { ErrorInfo, ErrorName } from '../base/errors.ts';
export type { ExportedFile, ExportNote, ExportReport } from '../export/file.ts';
export type { MapFacts } from '../export/maps/maps.ts';
export type { ExportOptions, ExportTarget } from '../export/options.ts';
export type { ExportRun } from '../rocks/export.ts';
export type { FieldRequest } from '../rocks/request.ts';
export type { WoodEarExportRequest, WoodEarExportRun } from '../wood-ear/headless-export.ts';

/**
 * The field of a request as a file. The same request and options give the same bytes everywhere.
 *
 * @throws {RockFieldError} naming the parameter or the option, its value and its bounds; `ExportTooLarge`.
 */
export function exportScene(request?: PaintedRequest, options?: ExportOptions, run?: ExportRun): Promise<ExportedFile> {
  return exportWith({ generate, ground: groundRealm }, request, options, run);
}

/**
 * The colony of a request on its log, and the rocks around it, as a file. The generator of wood ears is fetched when it is first called.
 *
 * @throws {RockFieldError} naming the parameter or the option, its value and its bounds; `ExportImpossible`; `ExportTooLarge`.
 */
export function exportWoodEar(request?: WoodEarExportRequest, options?: ExportOptions, run?: WoodEarExportRun): Promise<ExportedFile> {
  return exportColonyWith({ grow: growWoodEar, generate, soil: groundRealm }, request, options, run);
}
