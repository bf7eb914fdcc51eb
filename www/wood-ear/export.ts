/** Colonies of wood ears as files, with their log and the rocks that it lies on. */

import { exportModel } from '../export/file.ts';
import type { ExportedFile, Note } from '../export/file.ts';
import { joined } from '../export/shapes/join.ts';
import type { ResolvedOptions } from '../export/options.ts';
import { coloured } from '../export/origin/written-options.ts';
import { Pace } from '../export/pace.ts';
import type { Waiting } from '../export/pace.ts';
import { rockExtras, writtenRocks } from '../rocks/export.ts';
import { withGround } from '../rocks/ground.ts';
import type { GroundRealm } from '../rocks/ground.ts';
import { decodeLink } from '../rocks/link.ts';
import { presetColor } from '../table/table.ts';
import { colonyModel } from './export-model.ts';
import { colonyHash } from './hash.ts';
import { encodeWoodEarLink } from './link.ts';
import type { WoodEarPresetName } from './request.ts';
import { WOOD_EARS } from './table.ts';
import type { WoodEarScene, WoodEarSceneParams } from './table.ts';

/** Where a colony comes from. */
export interface ColonySource {
  params: WoodEarSceneParams;
  /** The preset that the parameters began with, if any: the file is named after it. */
  preset?: WoodEarPresetName | undefined;
}

/** What there is to write: the colony, the rocks around it, and where the log's origin is on the ground. */
export type ExportedScene = Pick<WoodEarScene, 'colony' | 'ground' | 'place'>;

/**
 * A colony as a file. The same scene and options give the same bytes everywhere.
 *
 * @param soil what makes the ground between the rocks, if the options ask for it.
 * @throws {RockFieldError} `ExportTooLarge`.
 */
export async function exportColony(
  { colony, ground, place }: ExportedScene,
  { params, preset }: ColonySource,
  options: ResolvedOptions,
  soil: GroundRealm,
  { signal, onProgress }: Waiting = {},
): Promise<ExportedFile> {
  const { isNatural, options: written } = coloured(options, presetColor(WOOD_EARS, preset ?? '') === 'natural');
  // Solid ears are looked at one by one.
  const looked = options.solid ? 0.6 : 0;
  const pace = new Pace({ signal, onProgress: onProgress && ((fraction) => onProgress(looked * fraction)) });
  const { model, extras, notes } = await colonyModel(colony, params, options, isNatural, pace);
  const [x, y, z] = place;
  const onGround = { ...model, centre: [0, 0, -z] as const };
  const rocks = decodeLink(params.ground).params;
  const stones = await writtenRocks(ground, rocks, options, isNatural, signal);
  const around = await withGround(stones, ground, rocks, options, isNatural, soil);
  const whole = around.groupOf.length > 0 ? joined(onGround, around, [-x, -y, -z]) : onGround;
  const own = model.groupOf.length;
  return exportModel(
    whole,
    {
      title: `${preset ?? 'wood-ear-log'}-${params.seed}`,
      link: linkOf(params, preset),
      hash: () => colonyHash(colony),
      hasPatterns: isNatural,
      extrasOf: (body) => (body < own ? extras(body) : rockExtras(ground, rocks, body - own)),
      notes: params.mesh ? [...notes, { code: 'log-not-in-link' } satisfies Note] : notes,
    },
    written,
    { signal, onProgress: onProgress && ((fraction) => onProgress(looked + (1 - looked) * fraction)) },
  );
}

function linkOf(params: WoodEarSceneParams, preset: WoodEarPresetName = WOOD_EARS.presets[0]!.name): string {
  return encodeWoodEarLink({ params, preset, view: WOOD_EARS.views[0]!, color: null, camera: null });
}
