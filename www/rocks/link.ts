/** Links to fields of rocks; see `table/link.ts`. */

import { decode, encode } from '../table/link.ts';
import type { DecodedLink, LinkReader, Link } from '../table/link.ts';
import type { Params } from './params.ts';
import { isStrokes } from './stroke-text.ts';
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
  const own = layers.some(({ id }, index) => id !== index) ? [`id=${layers.map(({ id }) => id).join(',')}`] : [];
  if (params.strokes) own.push(`strokes=${params.strokes}`);
  return encode(ROCKS, { params, preset, view, color, camera, defaultCamera }, own);
}

/** Reads `#…`, `?…`, a whole address or what `encodeLink` returns. */
export function decodeLink(text: string): RockLink {
  return decode(ROCKS, text, ['id', CUTS.url], (params, lists, reader) =>
    withStrokes(withIds(withCuts(params, lists, reader), lists, reader), reader),
  );
}

function withStrokes(params: Params, reader: LinkReader): Params {
  const strokes = reader.take('strokes');
  if (!strokes) return params;
  if (isStrokes(strokes)) params.strokes = strokes;
  else reader.note('bad-strokes', 'strokes', strokes, '');
  return params;
}

/** What links had before `detail` was a length: how often every triangle of a layer is cut into four. */
const CUTS = { ...ROCKS.itemRows.find(({ key }) => key === 'detail')!, url: 'de', kind: 'integer', min: 0, max: 3 } as const;

/** A layer that was cut so often gets the `detail` by which most of its rocks are. */
function withCuts(params: Params, lists: ReadonlyMap<string, string[]>, reader: LinkReader): Params {
  const given = lists.get(CUTS.url);
  const row = ROCKS.itemRows.find(({ key }) => key === 'detail')!;
  if (!given || lists.has(row.url)) return params;
  const { max } = ROCKS.boundsOf(row, params);
  const layers = params.layers.map((layer, index) => {
    const cuts = reader.value(CUTS, CUTS, given[index] ?? '0', 0) as number;
    return {
      ...layer,
      detail: cuts === 0 ? 0 : Math.min(max, Number(((100 * 2 ** cuts) / edgeOf(layer, params.notation)).toPrecision(3))),
    };
  });
  return { ...params, layers };
}

/** How long the edges of the papers' mesh are in the mean, in the layer's unit: as src/rocks/subdivide.rs has it, of a cell of the mean size. */
function edgeOf({ radius, height: [base, perRock, perVertex] }: Params['layers'][number], notation: Params['notation']): number {
  const height = (base + (perRock + perVertex) / 2) * (notation === 'relative' ? radius : 1);
  const area = 1.42 * radius ** 2;
  const surface = area + 3.88 * Math.sqrt(area) * height;
  // Of a cell with six corners come 16 triangles, and an equilateral one has √3/4 of the square of its edge.
  return Math.sqrt(((surface / 16) * 4) / Math.sqrt(3));
}

function withIds(params: Params, lists: ReadonlyMap<string, string[]>, reader: LinkReader): Params {
  const given = lists.get('id');
  const ids = given?.map((item) => (/^\d{1,10}$/.test(item) ? Number(item) : NaN));
  const isGood = ids === undefined || (new Set(ids).size === ids.length && ids.every((id) => id <= 0xffff_ffff));
  if (!isGood) reader.note('bad-ids', 'id', given?.join(',') ?? '', ids.map((_, index) => index).join(','));
  return { ...params, layers: params.layers.map((layer, index) => ({ ...layer, id: (isGood ? ids?.[index] : undefined) ?? index })) };
}
