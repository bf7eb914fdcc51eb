/** The generators as the command line knows them: scenes are links, whatever grows them. */

import type { Link } from '../table/link.ts';
import { isLink, LINK_VERSION } from '../table/link.ts';
import type { Notice } from '../table/notices.ts';
import type { Kind, Table } from '../table/table.ts';
import { decodeLink, encodeLink } from '../rocks/link.ts';
import { ROCKS } from '../rocks/table.ts';
import { decodeWoodEarLink, encodeWoodEarLink } from '../wood-ear/link.ts';
import { WOOD_EARS } from '../wood-ear/table.ts';
import { misuse } from './failures.ts';
import { didYouMean } from './suggest.ts';

export type GeneratorName = 'rocks' | 'wood-ears';

/** Parameters of any generator: its own modules know more of them. */
export type AnyParams = Kind['params'];

export interface AnyGenerator {
  name: GeneratorName;
  /** What it makes, in a sentence. */
  noun: string;
  table: Table<Kind>;
  decode(text: string): Link<Kind> & { notices: Notice[] };
  /** The link of parameters as they are generated, however they are seen. */
  encode(params: AnyParams, preset: string): string;
}

/** A generator without its own types: of parameters nothing is known here that its table does not tell. */
function generator<K extends Kind>(
  name: GeneratorName,
  noun: string,
  table: Table<K>,
  decode: (text: string) => Link<K> & { notices: Notice[] },
  encode: (state: Link<K>) => string,
): AnyGenerator {
  const view = table.views[0] ?? '3d';
  return {
    name,
    noun,
    table: table as unknown as Table<Kind>,
    decode,
    encode: (params, preset) => encode({ params, preset, view, color: null, camera: null }),
  };
}

export const GENERATORS: Readonly<Record<GeneratorName, AnyGenerator>> = {
  rocks: generator('rocks', 'rocks', ROCKS, decodeLink, encodeLink),
  'wood-ears': generator('wood-ears', 'wood ears', WOOD_EARS, decodeWoodEarLink, encodeWoodEarLink),
};

const ALL = Object.values(GENERATORS);

/** @throws {Ending} naming the preset that was probably meant. */
export function generatorOfPreset(preset: string): AnyGenerator {
  const found = ALL.find(({ table }) => table.presets.some(({ name }) => name === preset));
  if (found) return found;
  const names = ALL.flatMap(({ table }) => table.presets.map(({ name }) => name));
  const several = preset.includes(',')
    ? ` Several are ${preset
        .split(',')
        .map((name) => `--preset ${name.trim()}`)
        .join(' ')}.`
    : '';
  throw misuse(
    `there is no preset called ${JSON.stringify(preset)}.${several || didYouMean(preset, names) || ' rock-field presets lists them.'}`,
  );
}

/** A scene that a link shows. */
export interface LinkedScene {
  generator: AnyGenerator;
  params: AnyParams;
  preset: string;
  /** What of the link could not be taken as it stood. */
  notices: readonly Notice[];
}

/**
 * What a link shows, whichever generator it is of.
 *
 * @throws {Ending} for a text that is no link, for one of a newer version, and where nobody knows its preset.
 */
export function sceneOfLink(text: string): LinkedScene {
  const read: LinkedScene[] = [];
  for (const generator of ALL) {
    if (!isLink(generator.table, text)) continue;
    const { params, preset, notices } = generator.decode(text);
    // Nobody could understand it better, and of a long list every line is read so.
    if (notices.length === 0 && read.length === 0) return { generator, params, preset, notices };
    read.push({ generator, params, preset, notices });
  }
  if (read.length === 0)
    throw misuse(
      `this is no link to a scene: ${short(text)}. Copy it from the page, and write it in quotes, since & means something to a shell.`,
    );
  const codes = (notices: readonly Notice[]): Set<string> => new Set(notices.map(({ code }) => code));
  const version = read[0]!.notices.find(({ code }) => code === 'unknown-version');
  if (version) throw misuse(newer(version.given));
  // The one that knows the preset; where none is named, the one that understands most of it.
  const [best] = read
    .filter(({ notices }) => !codes(notices).has('unknown-preset'))
    .sort((one, other) => Number(codes(one.notices).has('unknown-key')) - Number(codes(other.notices).has('unknown-key')));
  if (!best) generatorOfPreset(read[0]!.notices.find(({ code }) => code === 'unknown-preset')!.given);
  return best!;
}

function newer(given: string): string {
  return /^\d+$/.test(given) && Number(given) > Number(LINK_VERSION)
    ? `the link is of version ${given}, and this rock-field reads version ${LINK_VERSION}: install a newer one with npm install rock-field@latest`
    : `the link says that it is of version ${JSON.stringify(given)}, which there is not: this rock-field reads version ${LINK_VERSION}`;
}

function short(text: string): string {
  return JSON.stringify(text.length > 60 ? `${text.slice(0, 60)}…` : text);
}
