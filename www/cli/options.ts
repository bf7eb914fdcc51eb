/**
 * What can be written after a command. Parameters and the options of exports stand in their tables, and are called as attributes are:
 * `imageWidth` is `--image-width`. The rest is listed here.
 */

import type { RockFieldError } from '../base/errors.ts';
import { attributesOf } from '../element/attribute-reader.ts';
import { OPTIONS, TARGETS } from '../export/options.ts';
import type { OptionKey } from '../export/options.ts';
import { ROCKS } from '../rocks/table.ts';
import type { Row } from '../table/row.ts';
import { WOOD_EARS } from '../wood-ear/table.ts';
import { didYouMean } from './suggest.ts';

export interface Option {
  /** Without the hyphens before it. */
  name: string;
  /** One letter that says the same. */
  short?: string;
  /** What stands for its value in the help, `N`; a switch has none. */
  value?: string;
  /** Whether it may be given more than once. */
  isList?: boolean;
  /** Whether `--no-…` is there too. */
  isNegatable?: boolean;
  /** The words that it can be. */
  choices?: readonly string[];
  /** What else is to be known of its values: bounds, and what it is where it is not given. */
  values?: string;
  /** In a sentence or two. */
  doc: string;
}

/** `metresPerPixel` → `metres-per-pixel`. */
export function kebab(key: string): string {
  return key.replace(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`);
}

const KEYS = Object.keys(OPTIONS) as OptionKey[];
/** `mesh "kit" or "one"`, `mesh: "one"` and `groundMesh`, as messages of the exporter have them; a key that is a plain word too is one only before its values. */
const NAMED = new RegExp(
  `\\b(${KEYS.join('|')}):? ((?:"\\w+"(?: or )?)+)|\\b(${KEYS.filter((key) => /[A-Z]/.test(key)).join('|')})\\b`,
  'g',
);

/** A message about a parameter or an option of exports, with its key and all others as they are typed. */
export function inOptions({ message, key }: { message: string; key?: string | undefined }): string {
  const typed = key === undefined || !message.startsWith(key) ? message : `--${kebab(key)}${message.slice(key.length)}`;
  return typed
    .replace(NAMED, (_, before = '', values = '', alone = '') =>
      alone ? `--${kebab(alone)}` : `--${kebab(before)} ${values.replaceAll('"', '')}`,
    )
    .replace(/(?<= or )"(\w+)"(?=$|[:;,)])/g, '$1');
}

/** The names that parameters and options of exports have in code. */
const NAMES = new Set([
  ...[ROCKS.rows, ROCKS.itemRows, WOOD_EARS.rows, WOOD_EARS.itemRows].flatMap((rows) => rows.map(({ key }) => key)),
  ...['preset', 'layers', 'strokes', 'bases', 'ground', ...KEYS],
]);

/** What is wrong with parameters or options that code passes, with what was meant by a name that there is not. */
export function ofCode({ name, message, key = '' }: RockFieldError): string {
  const meant = name === 'UnknownKey' ? didYouMean(key, NAMES) : '';
  return meant === '' ? message : `${message}.${meant}`;
}

export const HELP: Option = { name: 'help', short: 'h', doc: 'Says this.' };

/** Which scenes. */
export const SCENE: readonly Option[] = [
  {
    name: 'preset',
    short: 'p',
    value: 'NAME',
    isList: true,
    doc: 'What to begin with: `rock-field presets` lists them. Those of wood ears make wood ears. May be given several times.',
  },
  {
    name: 'link',
    value: 'URL',
    isList: true,
    doc: 'A link to a scene, as the page shares it, in quotes. May be given several times.',
  },
  {
    name: 'from',
    value: 'FILE',
    isList: true,
    doc: 'A file that knows its scene: a picture or an export of rock-field, or parameters as JSON.',
  },
  { name: 'seed', short: 's', value: 'N', doc: 'Other numbers are other rocks of the same kind.' },
  { name: 'seeds', value: 'LIST', doc: 'Several seeds: `1..1000`, or `1,5,9..12`.' },
];

/** Where the files go, and how they are made. */
export const OUTPUT: readonly Option[] = [
  {
    name: 'out',
    short: 'o',
    value: 'PATTERN',
    doc: 'Where to write: a file, a folder (with a `/` at its end), or a pattern with `{preset}`, `{seed}`, `{index}`, `{map}`, `{target}` and `{format}`; `{seed:4}` is 0007. Folders are made. `-` is the standard output.',
  },
  { name: 'force', short: 'f', doc: 'Replaces files that are there already.' },
  { name: 'skip-existing', doc: 'Leaves files that are there as they are, and makes the others: goes on with a run that was stopped.' },
  {
    name: 'jobs',
    short: 'j',
    value: 'N',
    doc: 'How many are made at a time. Default: one more than there are cores, if there are 2 GB of memory for each.',
  },
];

/** How it says what it does. */
export const SAYING: readonly Option[] = [
  { name: 'json', doc: 'A line of JSON for each file, also on a terminal; in a pipe that is so anyway.' },
  { name: 'quiet', short: 'q', doc: 'Says nothing but errors.' },
];

/** The options of an export, by their keys in the table. */
export const EXPORT_KEYS: ReadonlyMap<string, OptionKey> = new Map(KEYS.map((key) => [kebab(key), key]));

/** The program that a file is for. */
export const TARGET: Option = {
  name: 'target',
  short: 't',
  value: 'PROGRAM',
  choices: Object.keys(TARGETS),
  doc: 'The program that the file is for. It sets what suits the program; any option beside it counts instead.',
};

export const EXPORT: readonly Option[] = [TARGET, ...[...EXPORT_KEYS].map(([name, key]) => exportOption(name, key))];

/** Those of maps alone. */
const MAP_KEYS: readonly OptionKey[] = ['format', 'map', 'side', 'square', 'samples', 'green', 'contact', 'metresPerPixel'];
export const MAPS: readonly Option[] = [TARGET, ...MAP_KEYS.map((key) => exportOption(kebab(key), key))];

function exportOption(name: string, key: OptionKey): Option {
  const row = OPTIONS[key];
  const { doc } = row;
  if (row.kind === 'switch') return { name, isNegatable: true, doc };
  const values = `${row.kind === 'choice' ? row.choices.join(', ') : `${row.min} to ${row.max}`}; ${row.default}`;
  if (row.kind === 'choice') return { name, value: 'WORD', choices: row.choices, values, doc };
  return { name, value: row.kind === 'integer' ? 'N' : 'X', values, doc };
}

/** Parameters by the names of their options: of rocks, of each layer of rocks, of wood ears. */
export const PARAMETERS: { readonly rocks: Rows; readonly layers: Rows; readonly woodEars: Rows } = {
  rocks: attributesOf(ROCKS.rows),
  layers: attributesOf(ROCKS.itemRows),
  woodEars: attributesOf(WOOD_EARS.rows),
};

type Rows = ReadonlyMap<string, Row>;

/** What rocks have that is no row of their table. */
export const ROCKS_OWN: readonly Option[] = [{ name: 'strokes', value: 'TEXT', doc: 'Painted strokes, as links have them.' }];

/** What wood ears have that is no row of their table. */
export const WOOD_EAR_OWN: readonly Option[] = [
  { name: 'bases', value: 'LIST', doc: 'Where colonies spread from, in cm: `x y z` or `x y z range`, with commas between them.' },
  { name: 'ground', value: 'SCENE', doc: 'What the log lies on: a preset of rocks, a link to rocks, or `none`.' },
];

/** Every parameter, each name once: `--seed` is one of both generators. */
export const PARAMETER_OPTIONS: readonly Option[] = parameterOptions();

function parameterOptions(): Option[] {
  const { rocks, layers, woodEars } = PARAMETERS;
  const named = new Map<string, Option>();
  for (const [name, row] of [...rocks, ...layers, ...woodEars]) {
    if (SCENE.some((option) => option.name === name)) continue;
    named.set(name, { name, value: layers.has(name) ? 'LIST' : 'X', doc: row.label });
  }
  for (const option of [...ROCKS_OWN, ...WOOD_EAR_OWN]) named.set(option.name, option);
  return [...named.values()];
}
