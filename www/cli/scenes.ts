/** The scenes that a command line asks for: presets, links or files, with parameters put in their place, for each of the seeds. */

import { accessSync, constants, existsSync, openAsBlob, statSync } from 'node:fs';
import { RockFieldError } from '../base/errors.ts';
import { isReadable } from '../table/link.ts';
import type { Row } from '../table/row.ts';
import type { Kind } from '../table/table.ts';
import { Refused } from '../export/origin/refused.ts';
import { sceneInFile } from '../export/origin/scene-in-file.ts';
import type { FileOrigin } from '../export/origin/scene-in-file.ts';
import { PRESETS } from '../rocks/params.ts';
import { groundOf } from '../wood-ear/table.ts';
import { Ending, misuse, unreadable } from './failures.ts';
import { GENERATORS, generatorOfPreset, sceneOfLink } from './generators.ts';
import type { AnyGenerator, AnyParams, GeneratorName, LinkedScene } from './generators.ts';
import { inOptions, ofCode, PARAMETER_OPTIONS, PARAMETERS, ROCKS_OWN, WOOD_EAR_OWN } from './options.ts';
import type { Arguments } from './parse.ts';
import { MOST_SCENES, seedsOf } from './seeds.ts';
import { didYouMean } from './suggest.ts';

/** One scene to be made, as plain data. */
export interface Scene {
  generator: GeneratorName;
  /** All that there is to know of it. */
  link: string;
  preset: string;
  seed: number;
}

const NUMBER = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;
/** Stands for no number, where a parameter may have none. */
const NONE = '-';
/** Formats in which nothing is read of where a file comes from. */
const MUTE = /\.(stl|obj|ply|csv|r16|exr)$/i;

/** Words that belong to no option; @throws {Ending} that says to which they may belong. */
export function refuseWords({ positionals }: Arguments): void {
  const [word] = positionals;
  if (word === undefined) return;
  const meant = Object.values(GENERATORS).some(({ table }) => table.presets.some(({ name }) => name === word))
    ? ` Did you mean --preset ${word}?`
    : word.includes('=')
      ? ' Did you mean --link? Write the link in quotes.'
      : existsSync(word)
        ? ` Did you mean --from ${word}?`
        : '';
  throw misuse(`${JSON.stringify(word)} belongs to no option.${meant}`);
}

/**
 * @param say is given what of a link could not be taken as it stood, in sentences.
 * @throws {Ending} about whatever is wrong; nothing has been made.
 */
export async function scenesOf(args: Arguments, say: (notice: string) => void): Promise<Scene[]> {
  const bases: LinkedScene[] = [
    ...args.all('preset').map(sceneOfPreset),
    ...args.all('link').map(sceneOfLink),
    ...(await Promise.all(args.all('from').map(sceneOfFile))),
  ];
  if (bases.length === 0) throw misuse('which scene? Name a preset, as in --preset riverbed, or give a --link or a file with --from.');
  for (const { notices } of bases) for (const { text } of notices) say(text);
  if (args.get('seed') !== undefined && args.get('seeds') !== undefined) throw misuse('--seed and --seeds cannot be given together');
  const edited = bases.map(({ generator, params, preset }) => ({
    generator,
    preset,
    params: withParameters(generator, params, preset, args),
  }));
  return edited.flatMap(({ generator, preset, params }) => {
    const seeds = args.get('seeds') === undefined ? [params.seed] : seedsOf(args.get('seeds')!, boundsOfSeed(generator));
    if (seeds.length * edited.length > MOST_SCENES) throw misuse(`these are more than ${MOST_SCENES} scenes; make them in several runs`);
    return seeds.map((seed): Scene => ({ generator: generator.name, link: generator.encode({ ...params, seed }, preset), preset, seed }));
  });
}

function sceneOfPreset(preset: string): LinkedScene {
  const generator = generatorOfPreset(preset);
  return { generator, params: generator.table.presetParams(preset), preset, notices: [] };
}

/** The scene that a file shows. */
async function sceneOfFile(file: string): Promise<LinkedScene> {
  return sceneOfLink((await originOfFile(file)).link);
}

/**
 * What a file says of its scene.
 *
 * @throws {Ending} where there is no such file, or it brings no scene back.
 */
export async function originOfFile(file: string): Promise<FileOrigin> {
  let blob: Blob;
  try {
    // Of a folder there is a blob, too.
    if (!statSync(file).isFile()) throw new Error('this is no file');
    // A blob says no more than that it cannot be read, and only when that is tried.
    accessSync(file, constants.R_OK);
    blob = await openAsBlob(file);
  } catch (cause) {
    throw unreadable(file, cause);
  }
  try {
    const found = await sceneInFile(blob);
    return 'link' in found ? found : { link: linkOfRequest(found.request), hash: '', version: '', options: {} };
  } catch (thrown) {
    if (thrown instanceof RockFieldError) throw new Ending('failed', `${file}: ${ofCode(thrown)}`, { cause: thrown });
    if (!(thrown instanceof Refused)) throw thrown;
    const foreign = MUTE.test(file)
      ? 'files of this kind do not say what made them'
      : 'it was not made by rock-field, or what it said of its scene was taken out of it';
    throw new Ending(
      'failed',
      thrown.reason === 'broken' ? `${file} is damaged: the scene in it cannot be read` : `${file} brings no scene back: ${foreign}`,
      { cause: thrown },
    );
  }
}

/** Parameters as code passes them. */
export function linkOfRequest(request: Record<string, unknown>): string {
  const given = request['preset'];
  const generator =
    given === undefined ? GENERATORS['bases' in request || 'log' in request ? 'wood-ears' : 'rocks'] : generatorOfPreset(String(given));
  const preset = given === undefined ? generator.table.presets[0]!.name : String(given);
  return generator.encode(generator.table.resolve(request), preset);
}

function boundsOfSeed({ table }: AnyGenerator): { min: number; max: number } {
  return table.rows.find(({ key }) => key === 'seed') ?? { min: 0, max: 0xffff_ffff };
}

/** `params` with what was given beside them. */
function withParameters(generator: AnyGenerator, params: AnyParams, preset: string, args: Arguments): AnyParams {
  const { table } = generator;
  const { rocks, layers, woodEars } = PARAMETERS;
  const isRocks = generator.name === 'rocks';
  const [rows, lists] = isRocks ? [rocks, layers] : [woodEars, new Map<string, Row>()];
  refuseForeign(
    generator,
    new Set([...rows.keys(), ...lists.keys(), ...(isRocks ? ROCKS_OWN : WOOD_EAR_OWN).map((option) => option.name)]),
    args,
  );
  let edited = params;
  for (const [name, row] of rows) {
    const given = args.get(name);
    if (given !== undefined) edited = table.written(edited, row, typedValue(name, given.trim(), row));
  }
  edited = isRocks ? withStrokes(withLayers(generator, edited, lists, args), args) : withLog(edited, args);
  return checked(generator, edited, preset);
}

/** A parameter of the other generator would change nothing. */
function refuseForeign({ noun }: AnyGenerator, own: ReadonlySet<string>, args: Arguments): void {
  const foreign = args.names().find((name) => PARAMETER_OPTIONS.some((option) => option.name === name) && !own.has(name));
  if (foreign !== undefined) throw misuse(`--${foreign} is no parameter of ${noun}.${didYouMean(foreign, own, (word) => `--${word}`)}`);
}

/** The first list in the order of the table tells the number of layers, as it does in attributes. */
function withLayers({ table }: AnyGenerator, params: AnyParams, lists: ReadonlyMap<string, Row>, args: Arguments): AnyParams {
  const given = [...lists].flatMap(([name, row]) => {
    const text = args.get(name);
    return text === undefined ? [] : [{ name, row, items: text.split(/[\s,]+/).filter((item) => item !== '') }];
  });
  const [first] = given;
  if (!first) return params;
  const count = first.items.length;
  const other = given.find(({ items }) => items.length !== count);
  if (other)
    throw misuse(
      `--${first.name} is for ${count} layers and --${other.name} for ${other.items.length}: each list has a value for each layer, as in --radius "90 30 10"`,
    );
  const before = table.items(params);
  let layers: Kind['item'][] = Array.from({ length: count }, (_, index) => before[index] ?? table.newItem(index, params));
  for (const { name, row, items } of given) {
    if (!isReadable(row, items)) typedValue(name, items[0] ?? '', row);
    layers = layers.map((layer, index) => table.written(layer, row, typedValue(name, items[index] ?? '', row)));
  }
  return table.withItems(params, layers);
}

function withStrokes(params: AnyParams, args: Arguments): AnyParams {
  const strokes = args.get('strokes')?.trim();
  return strokes === undefined ? params : ({ ...params, strokes } as AnyParams);
}

/** The bases and the ground of wood ears. */
function withLog(params: AnyParams, args: Arguments): AnyParams {
  const { table } = GENERATORS['wood-ears'];
  const [bases, ground] = [args.get('bases'), args.get('ground')?.trim()];
  let edited = params;
  if (bases !== undefined) {
    const entries = bases.split(/[,;]/).map((entry) => entry.trim().split(/\s+/));
    if (entries.some(({ length }) => length < 3 || length > 4))
      throw misuse(
        `--bases ${JSON.stringify(bases)}: write x y z or x y z range, in cm, with commas between them, as in --bases "0 -20 30, 40 -20 30 25"`,
      );
    edited = table.withItems(
      edited,
      entries.map((entry) =>
        table.itemRows.reduce<Kind['item']>(
          (base, row, k) => (entry[k] === undefined ? base : table.written(base, row, typedValue('bases', entry[k], row))),
          { position: [0, 0, 0], range: null },
        ),
      ),
    );
  }
  return ground === undefined ? edited : ({ ...edited, ground: groundLink(ground) } as AnyParams);
}

function groundLink(given: string): string {
  if (given === '' || given === 'none') return '';
  const preset = PRESETS.find(({ name }) => name === given);
  if (preset) return groundOf(preset.name);
  if (/^[\w-]+$/.test(given)) generatorOfPreset(given);
  const { generator, params, preset: name } = sceneOfLink(given);
  if (generator.name !== 'rocks') throw misuse(`--ground ${given}: a log lies on rocks, and this is a link to ${generator.noun}`);
  return generator.encode(params, name);
}

/** A value as it was typed; whether it is within its bounds is checked with all others. */
function typedValue(name: string, given: string, row: Row): unknown {
  if (row.kind === 'choice') {
    const words = row.choices.map(({ value }) => value);
    if (words.includes(given)) return given;
    throw misuse(`--${name} ${given}: there is no such choice; it may be ${words.join(', ')}.${didYouMean(given, words)}`);
  }
  if (row.kind.startsWith('optional') && given === NONE) return null;
  if (NUMBER.test(given)) return Number(given);
  const several = name === 'seed' && /^\d+(\.\.|,)/.test(given) ? `; several are --seeds ${given}` : '';
  throw misuse(`--${name} ${given}: it must be a number${several}`);
}

function checked({ table }: AnyGenerator, params: AnyParams, preset: string): AnyParams {
  try {
    return table.resolve({ ...params, preset });
  } catch (thrown) {
    throw thrown instanceof RockFieldError ? misuse(inOptions(thrown)) : thrown;
  }
}
