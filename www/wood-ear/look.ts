/** What of a colony's parameters a renderer shows beyond its mesh, with the look of what the log lies on. */

import { lookOf } from '../rocks/look.ts';
import type { Look } from '../data/look.ts';
import { decodeLink } from '../rocks/link.ts';
import type { WoodEarSceneParams } from './table.ts';

/** The sun is the scene's, not the ground's own. */
export function woodEarLook({ ground, moisture, variation, translucency, velvet, sunAzimuth, sunElevation }: WoodEarSceneParams): Look {
  const look = lookOf(decodeLink(ground).params);
  // Neither snow nor water would lie on the log.
  return { ...look, snow: 0, water: 0, sunAzimuth, sunElevation, flesh: { moisture: moisture / 100, variation, translucency, velvet } };
}
