/** `rock-field/export` for Node: the same as `export.ts`, with the generator of `core.node.ts`. */

import { readFile } from 'node:fs/promises';
import type { ExportedFile } from '../export/file.ts';
import { exportWith } from '../rocks/export.ts';
import type { ExportRun } from '../rocks/export.ts';
import type { ExportOptions } from '../export/options.ts';
import { Realm } from '../generator/headless.ts';
import type { GroundModule } from '../rocks/ground.ts';
import type { FieldRequest } from '../rocks/request.ts';
import { exportColonyWith } from '../wood-ear/headless-export.ts';
import type { WoodEarExportRequest, WoodEarExportRun } from '../wood-ear/headless-export.ts';
import { generate, growWoodEar } from './core.node.ts';

export { RockFieldError } from '../base/errors.ts';
export { exportSchema } from '../export/schema.ts';

// Fetched when a ground is first asked for.
const ground = /* @__PURE__ */ new Realm<GroundModule>(
  () => import('../../pkg/ground-mesh.js'),
  () => readFile(new URL('./ground-mesh_bg.wasm', import.meta.url)),
);

/** The field of a request as a file. */
export function exportScene(request?: FieldRequest, options?: ExportOptions, run?: ExportRun): Promise<ExportedFile> {
  return exportWith({ generate, ground }, request, options, run);
}

/** The colony of a request on its log, and the rocks around it, as a file. */
export function exportWoodEar(request?: WoodEarExportRequest, options?: ExportOptions, run?: WoodEarExportRun): Promise<ExportedFile> {
  return exportColonyWith({ grow: growWoodEar, generate, soil: ground }, request, options, run);
}
