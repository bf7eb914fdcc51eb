/** `rock-field/export` for Node: the same as `export.ts`, with the generator of `core.node.ts`. */

import type { ExportedFile } from '../export/file.ts';
import { exportWith } from '../rocks/export.ts';
import type { ExportRun } from '../rocks/export.ts';
import type { ExportOptions } from '../export/options.ts';
import type { PaintedRequest } from '../rocks/painted.ts';
import { exportColonyWith } from '../wood-ear/headless-export.ts';
import type { WoodEarExportRequest, WoodEarExportRun } from '../wood-ear/headless-export.ts';
import { generate, growWoodEar } from './core.node.ts';
import { ground } from './ground.node.ts';

export { RockFieldError } from '../base/errors.ts';
export { exportSchema } from '../export/schema.ts';

/** The field of a request as a file. */
export function exportScene(request?: PaintedRequest, options?: ExportOptions, run?: ExportRun): Promise<ExportedFile> {
  return exportWith({ generate, ground }, request, options, run);
}

/** The colony of a request on its log, and the rocks around it, as a file. */
export function exportWoodEar(request?: WoodEarExportRequest, options?: ExportOptions, run?: WoodEarExportRun): Promise<ExportedFile> {
  return exportColonyWith({ grow: growWoodEar, generate, soil: ground }, request, options, run);
}
