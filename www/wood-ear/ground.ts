/** What a log lies on: the rocks around it, or bare soil. */

import { errorInfo, isCoded, RockFieldError } from '../base/errors.ts';
import type { WoodEarColony, WoodEarLog } from '../data/colony.ts';
import type { Field } from '../data/field.ts';
import type { FieldJob } from '../rocks/client.ts';
import { decodeLink } from '../rocks/link.ts';
import { footprintOf } from './footprint.ts';
import { placeOf } from './table.ts';
import type { Place, WoodEarScene, WoodEarSceneParams } from './table.ts';

/** Rocks that are higher than this at their edge do not fit under the log's side, px. */
const CLEARANCE = 9;

/** What to ask the rocks' generator for. `side`: of the square of ground, px. */
export function rocksAround(link: string, side: number, log: WoodEarLog, place: Place): FieldJob {
  const { params } = decodeLink(link);
  return { ...params, imageWidth: side, imageHeight: side, footprint: footprintOf(log, place, CLEARANCE) };
}

export function sceneOf(colony: WoodEarColony, ground: Field, params: WoodEarSceneParams): WoodEarScene {
  const { rings, meridians } = params;
  return { colony, ground, place: placeOf(colony.log, params), rings, meridians };
}

/** What is wrong with a parameter of the rocks is wrong with the ground, which has no such parameter of its own. */
export function ofGround(thrown: unknown): unknown {
  return isCoded(thrown) && thrown.key
    ? new RockFieldError({ ...errorInfo(thrown), key: 'ground', layer: undefined, message: `ground: ${thrown.message}` })
    : thrown;
}

/** Soil without a rock. */
export function bareField(side: number): Field {
  const none = { sites: 0, cells: 0, selection: 0, shape: 0, mesh: 0, total: 0 };
  return {
    imageWidth: side,
    imageHeight: side,
    layers: [],
    positions: new Float32Array(),
    normals: new Float32Array(),
    indices: new Uint32Array(),
    rockStarts: new Uint32Array(1),
    vertexStarts: new Uint32Array(1),
    rockLayer: new Uint8Array(),
    stats: { rocks: 0, triangles: 0, coveredFraction: 0, ms: none },
  };
}
