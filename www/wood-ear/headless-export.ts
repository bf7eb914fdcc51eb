/** Colonies as files without a page: what `entries/export.ts` and `export.node.ts` share. */

import type { WoodEarColony } from '../data/colony.ts';
import type { Field } from '../data/field.ts';
import type { Progress } from '../generator/protocol.ts';
import { checkRun } from '../generator/run-checks.ts';
import type { ExportedFile } from '../export/file.ts';
import type { ExportOptions } from '../export/options.ts';
import type { GroundRealm } from '../rocks/ground.ts';
import { FOOTPRINT } from '../rocks/headless.ts';
import type { GenerateOptions, HeadlessJob } from '../rocks/headless.ts';
import { colonyOptions } from './export-options.ts';
import { exportColony } from './export.ts';
import { bareField, ofGround, rocksAround } from './ground.ts';
import type { WoodEarOptions } from './headless.ts';
import type { WoodEarRequest } from './request.ts';
import type { WoodEarStage } from './session.ts';
import { colonyRequest, groundSide, placeOf, WOOD_EARS } from './table.ts';

/** A colony with what its log lies on: a link to a field of rocks, or an empty text for bare soil. Natural presets lie on a forest's floor. */
export type WoodEarExportRequest = WoodEarRequest & { ground?: string | undefined };

/** As of `growWoodEar`; progress goes on while the file is written, in the stage `file`. */
export interface WoodEarExportRun extends Omit<WoodEarOptions, 'onProgress' | 'onPreview'> {
  /** Called every 16 ms or so. */
  onProgress?: ((progress: Progress<WoodEarStage | 'file'>) => void) | undefined;
}

/** The share of the work that is done when the colony is there. */
const GROWN = 0.5;

/** The two generators of `rock-field/core`, and what makes the ground between the rocks. */
export interface Generators {
  soil: GroundRealm;
  grow: (request: WoodEarRequest, options?: WoodEarOptions) => Promise<WoodEarColony>;
  generate: (request: HeadlessJob, options?: GenerateOptions) => Promise<Field>;
}

/**
 * Grows a colony, generates the rocks around its log, and exports them.
 *
 * @throws {RockFieldError} about a parameter, about an option, or `ExportTooLarge`.
 */
export async function exportColonyWith(
  { grow, generate, soil }: Generators,
  request: WoodEarExportRequest = {},
  options?: ExportOptions,
  waiting: WoodEarExportRun = {},
): Promise<ExportedFile> {
  // All of it is read now: what the caller does to the objects afterwards is no part of the request.
  const { onProgress, ...run } = checkRun(waiting, 'run');
  const resolved = colonyOptions(options);
  const params = WOOD_EARS.resolve(request);
  const { preset } = request;
  const colony = await grow(colonyRequest(params), {
    ...run,
    onProgress: onProgress && ((progress) => onProgress({ ...progress, fraction: GROWN * progress.fraction })),
  });
  const place = placeOf(colony.log, params);
  const side = groundSide(params);
  const { signal, maxBytes } = run;
  const rocks = async (): Promise<Field> => {
    const { footprint, ...job } = rocksAround(params.ground, side, colony.log, place);
    return generate({ ...job, [FOOTPRINT]: footprint }, { signal, maxBytes }).catch((thrown: unknown) => {
      throw ofGround(thrown);
    });
  };
  const ground = params.ground === '' ? bareField(side) : await rocks();
  signal?.throwIfAborted();
  return exportColony({ colony, ground, place }, { params, preset }, resolved, soil, {
    signal,
    onProgress: onProgress && ((fraction) => onProgress({ stage: 'file', fraction: GROWN + (1 - GROWN) * fraction })),
  });
}
