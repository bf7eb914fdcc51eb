/** Links to colonies of wood ears, with what their log lies on; see `table/link.ts`. A log of one's own is in no link. */

import { decode, encode } from '../table/link.ts';
import type { DecodedLink, LinkReader, Link } from '../table/link.ts';
import { decodeLink, encodeLink } from '../rocks/link.ts';
import { WOOD_EARS } from './table.ts';
import type { WoodEars, WoodEarSceneParams } from './table.ts';

const GROUND = 'ground';

export function encodeWoodEarLink(state: Link<WoodEars>): string {
  const { ground } = state.params;
  const isOther = ground !== WOOD_EARS.presetParams(state.preset).ground;
  return encode(WOOD_EARS, state, isOther ? [`${GROUND}=${nested(readGround(ground).link)}`] : []);
}

/** Reads `#…`, `?…`, a whole address or what `encodeWoodEarLink` returns. */
export function decodeWoodEarLink(text: string): DecodedLink<WoodEars> {
  return decode(WOOD_EARS, text, [], withGround);
}

/**
 * A link in a link: `v.1_preset.moraine_seed.3`. It has no character that anything escapes or takes for the outer link's; older links have it
 * escaped, `v%3D1%26preset%3Dmoraine`, and are read as before.
 */
function nested(link: string): string {
  return link.replaceAll('=', '.').replaceAll('&', '_');
}

function unnested(text: string): string {
  return /^v\.\d/.test(text)
    ? text
        .split('_')
        .map((pair) => pair.replace('.', '='))
        .join('&')
    : text;
}

function withGround(params: WoodEarSceneParams, _lists: ReadonlyMap<string, string[]>, reader: LinkReader): WoodEarSceneParams {
  const given = reader.take(GROUND);
  if (given === undefined) return params;
  const { link, notices } = readGround(given);
  reader.notices.push(...notices);
  return { ...params, ground: link };
}

/** A link to a field of rocks as it is written here, and what was wrong with it; `none` and nothing are bare soil. */
export function readGround(text: string): { link: string; notices: DecodedLink<WoodEars>['notices'] } {
  if (text === '' || text === 'none') return { link: '', notices: [] };
  const { params, preset, notices } = decodeLink(unnested(text));
  return { link: encodeLink({ params, preset }), notices };
}
