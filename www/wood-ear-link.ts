/** Links to colonies of wood ears, with what their log lies on; see `link.ts`. A log of one's own is in no link. */

import { decodeScene, encodeScene } from './link.ts';
import type { DecodedScene, LinkReader, SceneLink } from './link.ts';
import { decodeLink, encodeLink } from './url-codec.ts';
import { WOOD_EARS } from './wood-ears.ts';
import type { WoodEars, WoodEarSceneParams } from './wood-ears.ts';

const GROUND = 'ground';

export function encodeWoodEarLink(state: SceneLink<WoodEars>): string {
  const { ground } = state.params;
  const isOther = ground !== WOOD_EARS.presetParams(state.preset).ground;
  return encodeScene(WOOD_EARS, state, isOther ? [`${GROUND}=${encodeURIComponent(ground)}`] : []);
}

/** Reads `#…`, `?…`, a whole address or what `encodeWoodEarLink` returns. */
export function decodeWoodEarLink(text: string): DecodedScene<WoodEars> {
  return decodeScene(WOOD_EARS, text, [], withGround);
}

function withGround(params: WoodEarSceneParams, _lists: ReadonlyMap<string, string[]>, reader: LinkReader): WoodEarSceneParams {
  const given = reader.take(GROUND);
  if (given === undefined) return params;
  const { link, notices } = readGround(given);
  reader.notices.push(...notices);
  return { ...params, ground: link };
}

/** A link to a field of rocks as it is written here, and what was wrong with it; `none` and nothing are bare soil. */
export function readGround(text: string): { link: string; notices: DecodedScene<WoodEars>['notices'] } {
  if (text === '' || text === 'none') return { link: '', notices: [] };
  const { params, preset, notices } = decodeLink(text);
  return { link: encodeLink({ params, preset }), notices };
}
