/** What `--help` says. */

import { ROCKS } from '../rocks/table.ts';
import type { Row } from '../table/row.ts';
import { WOOD_EARS } from '../wood-ear/table.ts';
import type { Command } from './command.ts';
import { PARAMETERS, ROCKS_OWN, WOOD_EAR_OWN } from './options.ts';
import type { Option } from './options.ts';

/** The column in which what an option means begins. */
const COLUMN = 26;

/** Of the whole. */
export function overview(commands: Readonly<Record<string, { summary: string }>>, width: number): string {
  return [
    'Grows ground covered with rocks, and logs with wood ears, and writes them as files.',
    '',
    'Usage: rock-field COMMAND [options]',
    '',
    'Commands:',
    ...Object.entries(commands).flatMap(([name, { summary }]) => entry(`  ${name}`, summary, width, 14)),
    '',
    'Try:',
    '  rock-field export --preset riverbed --seed 7 --target blender --out riverbed.glb',
    '  rock-field export --preset scree --seeds 1..1000 --out "scree/{seed:4}.glb"',
    '  rock-field info riverbed.glb',
    '',
    ...wrapped(
      '`rock-field COMMAND --help` lists the options of a command, with examples; `rock-field help parameters` all parameters of rocks and wood ears.',
      width,
    ),
    '',
  ].join('\n');
}

/** Of one command. */
export function helpOf(name: string, { usage, about, groups, footer, examples }: Command, width: number): string {
  return [
    `Usage: rock-field ${name} ${usage}`,
    '',
    ...wrapped(about, width),
    '',
    'Examples:',
    ...examples.flatMap(({ what, line }) => [`  # ${what}`, `  ${line}`]),
    '',
    ...groups.flatMap(({ title, options }) => [`${title}:`, ...options.flatMap((option) => optionLines(option, width)), '']),
    ...(footer === undefined ? [] : [...wrapped(footer, width), '']),
  ].join('\n');
}

function optionLines({ name, short, value, isNegatable, choices, values = choices?.join(', '), doc }: Option, width: number): string[] {
  const head = `  ${short ? `-${short}, ` : '    '}--${isNegatable ? '[no-]' : ''}${name}${value === undefined ? '' : ` ${value}`}`;
  return entry(head, `${doc}${values ? ` (${values})` : ''}`, width, COLUMN);
}

/** All parameters, with what they do. */
export async function parameters(width: number): Promise<string> {
  const [rocks, woodEars] = await Promise.all([ROCKS.docs(), WOOD_EARS.docs()]);
  const lines = (rows: ReadonlyMap<string, Row>, docs: Readonly<Record<string, { en: string }>>): string[] =>
    [...rows].flatMap(([name, row]) => entry(`  --${name}`, `${docs[row.url]?.en ?? row.label} ${valuesOf(row)}`, width, COLUMN));
  const own = (options: readonly Option[]): string[] => options.flatMap((option) => entry(`  --${option.name}`, option.doc, width, COLUMN));
  return [
    ...wrapped('Parameters take the place of those of the preset, the link or the file that they stand beside.', width),
    '',
    'Of rocks:',
    ...lines(PARAMETERS.rocks, rocks),
    ...own(ROCKS_OWN),
    '',
    ...wrapped(
      'Of each layer of rocks, a list with a value for each layer, as in --radius "90 30 10"; the length of the lists is the number of layers:',
      width,
    ),
    ...lines(PARAMETERS.layers, rocks),
    '',
    'Of wood ears:',
    ...lines(PARAMETERS.woodEars, woodEars),
    ...own(WOOD_EAR_OWN),
    '',
  ].join('\n');
}

/** What a parameter can be, and what it is where nobody says so. */
export function valuesOf({ kind, choices, min, max, unit, default: standard }: Row): string {
  if (kind === 'choice') return `(${choices.map(({ value }) => value).join(', ')})`;
  const of = unit.px === '' ? '' : ` ${unit.px}`;
  return `(${min} to ${max}${of}${standard === null ? ', or - for none' : `; ${standard}`})`;
}

/** A term, and in a column beside it what it means. */
function entry(term: string, meaning: string, width: number, column: number): string[] {
  const [first = '', ...rest] = wrapped(meaning, Math.max(30, width - column));
  const indent = ' '.repeat(column);
  const more = rest.map((line) => indent + line);
  return term.length + 2 > column ? [term, indent + first, ...more] : [term.padEnd(column) + first, ...more];
}

/** Words in lines of a width, without what Markdown has for links and emphasis; the marks of code are left. */
function wrapped(text: string, width: number): string[] {
  const lines: string[] = [];
  let line = '';
  for (const word of plain(text).split(' ')) {
    if (line !== '' && line.length + 1 + word.length > width) {
      lines.push(line);
      line = word;
    } else line = line === '' ? word : `${line} ${word}`;
  }
  return [...lines, line];
}

function plain(text: string): string {
  return text.replaceAll(/\[([^\]]+)\]\([^)]*\)/g, '$1').replaceAll('*', '');
}
