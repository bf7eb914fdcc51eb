/** Links to fields of rocks; see `table/link.ts`. */

import { decode, encode } from '../table/link.ts';
import type { DecodedLink, LinkReader, Link } from '../table/link.ts';
import type { Params } from './params.ts';
import { ROCKS } from './table.ts';
import type { Rocks } from './table.ts';
import type { CameraState } from '../base/view.ts';

export { LINK_VERSION, MAX_LINK_LENGTH } from '../table/link.ts';
export type { Notice, NoticeCode } from '../table/notices.ts';

export const VIEWS = ROCKS.views;
export const COLORS = ROCKS.colors;

export type LinkState = Link<Rocks>;
export type RockLink = DecodedLink<Rocks>;

export function encodeLink(state: Pick<LinkState, 'params'> & Partial<LinkState> & { defaultCamera?: CameraState | null }): string {
  // One by one: of a store these are accessors, which no spread sees.
  const { params, preset = ROCKS.presets[0]!.name, view = VIEWS[0]!, color = null, camera = null, defaultCamera = null } = state;
  const { layers } = params;
  const ids = layers.some(({ id }, index) => id !== index) ? [`id=${layers.map(({ id }) => id).join(',')}`] : [];
  return encode(ROCKS, { params, preset, view, color, camera, defaultCamera }, ids);
}

/** Reads `#…`, `?…`, a whole address or what `encodeLink` returns. */
export function decodeLink(text: string): RockLink {
  return decode(ROCKS, text, ['id'], withIds);
}

function withIds(params: Params, lists: ReadonlyMap<string, string[]>, reader: LinkReader): Params {
  const given = lists.get('id');
  const ids = given?.map((item) => (/^\d{1,10}$/.test(item) ? Number(item) : NaN));
  const isGood = ids === undefined || (new Set(ids).size === ids.length && ids.every((id) => id <= 0xffff_ffff));
  if (!isGood) reader.note('bad-ids', 'id', given?.join(',') ?? '', ids.map((_, index) => index).join(','));
  return { ...params, layers: params.layers.map((layer, index) => ({ ...layer, id: (isGood ? ids?.[index] : undefined) ?? index })) };
}
