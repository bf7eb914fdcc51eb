/**
 * What the attributes of `<wood-ear-log>` say; see `element/attribute-reader.ts`. `bases` lists where colonies spread from, `x y z` or
 * `x y z range`, with commas between them; `ground` is a preset of rocks, a link to a field of them, or `none`.
 */

import { attributesOf, AttributeReader, quote } from '../element/attribute-reader.ts';
import type { ElementAttributes } from '../element/attribute-reader.ts';
import { PRESETS } from '../rocks/params.ts';
import { decodeWoodEarLink, readGround } from './link.ts';
import type { WoodEarBase } from './request.ts';
import { groundOf, WOOD_EARS } from './table.ts';
import type { WoodEars, WoodEarSceneParams, WoodEarSceneRequest } from './table.ts';

export const WOOD_EAR_ATTRIBUTES = attributesOf(WOOD_EARS.rows);

export function readWoodEarAttributes(get: (name: string) => string | null): ElementAttributes<WoodEars> {
  const reader = new AttributeReader(WOOD_EARS, get);
  const source = reader.source({
    ofRequest: (request) => ({
      params: WOOD_EARS.resolve(request as object),
      preset: (request as WoodEarSceneRequest).preset ?? WOOD_EARS.presets[0]!.name,
    }),
    ofLink: decodeWoodEarLink,
  });
  const params = reader.rows(WOOD_EAR_ATTRIBUTES, source.params);
  return reader.common(source, { ...params, bases: readBases(reader, params), ground: readGroundAttribute(reader, params) });
}

function readBases(reader: AttributeReader<WoodEars>, params: WoodEarSceneParams): WoodEarBase[] {
  const given = reader.get('bases');
  if (given === null) return params.bases;
  const { max } = WOOD_EARS.itemCount;
  const entries = given.split(/[,;]/).map((entry) => entry.trim().split(/\s+/));
  if (entries.some(({ length }) => length < 3 || length > 4)) {
    reader.note('bases', 'no-bases', { given: quote(given) });
    return params.bases;
  }
  if (entries.length > max) reader.note('bases', 'more-bases', { given: entries.length, used: max });
  return entries.slice(0, max).map((entry) => {
    let base: WoodEarBase = { position: [0, 0, 0], range: null };
    WOOD_EARS.itemRows.forEach((row, k) => {
      const text = entry[k];
      if (text !== undefined) base = WOOD_EARS.written(base, row, reader.one('bases', text, row, row, WOOD_EARS.read(base, row)));
    });
    return base;
  });
}

function readGroundAttribute(reader: AttributeReader<WoodEars>, { ground }: WoodEarSceneParams): string {
  const given = reader.get('ground')?.trim();
  if (given === undefined) return ground;
  const preset = PRESETS.find(({ name }) => name === given);
  if (preset) return groundOf(preset.name);
  const { link, notices } = readGround(given);
  for (const { text } of notices) reader.say('ground', text);
  return link;
}
