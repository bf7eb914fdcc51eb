/** `rock-field presets`: what to begin with. */

import { figureOf, PAPERS } from '../../rocks/figures.ts';
import { ROCKS } from '../../rocks/table.ts';
import { WOOD_EARS } from '../../wood-ear/table.ts';
import type { Command } from '../command.ts';
import { misuse } from '../failures.ts';
import { GENERATORS } from '../generators.ts';
import type { GeneratorName } from '../generators.ts';
import { SAYING } from '../options.ts';

export const command: Command = {
  usage: '[--json]',
  about:
    'Lists the presets, with what they are. Those of natural grounds and logs have natural colours; the others are figures of the papers that the generators are from.',
  groups: [
    {
      title: 'What it says',
      options: SAYING.filter(({ name }) => name === 'json').map((option) => ({
        ...option,
        doc: 'A list of JSON objects, with all parameters.',
      })),
    },
  ],
  examples: [
    { what: 'to read', line: 'rock-field presets' },
    { what: 'for a script', line: 'rock-field presets --json' },
  ],
  run: async (args, { out }) => {
    if (args.positionals.length > 0) throw misuse('rock-field presets lists all of them, and takes no words');
    const all = Object.values(GENERATORS).flatMap(({ name: generator, table }) =>
      table.presets.map(({ name, natural = false }) => ({
        ...{ name, generator, natural, description: describe(generator, name) },
        params: table.presetParams(name),
      })),
    );
    out.write(args.is('json') ? `${JSON.stringify(all, null, 2)}\n` : inWords(all));
    return 'done';
  },
};

/** What it is, and of how many sizes of stones. */
function describe(generator: GeneratorName, name: string): string {
  if (generator === 'wood-ears') return woodEars(name);
  const { imageWidth, imageHeight, layers, notation } = ROCKS.presetParams(name);
  const radii = [...new Set(layers.map(({ radius }) => radius))].sort((one, other) => one - other);
  const radius = radii.length > 1 ? `${radii[0]} to ${radii.at(-1)}` : `${radii[0]}`;
  const sizes = layers.length > 1 ? `${layers.length} layers of rocks` : 'one layer of rocks';
  const paper = PAPERS.find((candidate) => name.startsWith(candidate));
  return `${paper ? `${figureOf(name)} of the ${paper} paper` : capital(name)}: ${sizes}, radius ${radius}${notation === 'relative' ? ' % of the width' : ''}, ${imageWidth} × ${imageHeight} pixels`;
}

function capital(name: string): string {
  return name.charAt(0).toUpperCase() + name.slice(1).replaceAll('-', ' ');
}

/** What it is, and of what there is most to see. */
function woodEars(name: string): string {
  const { bases, log, moisture } = WOOD_EARS.presetParams(name);
  const [, chapter, number] = /^thesis-fig(\d+)-(\d+)$/.exec(name) ?? [];
  const values = name.startsWith('thesis-') ? `${capital(name.replace('thesis-', ''))} values of the thesis` : capital(name);
  const title = chapter === undefined ? values : `Fig. ${chapter}.${number} of the thesis`;
  return `${title}: ${bases.length > 1 ? `${bases.length} colonies` : 'one colony'} on a log of ${log.length} cm, moisture ${moisture} %`;
}

interface Line {
  name: string;
  generator: GeneratorName;
  natural: boolean;
  description: string;
}

function inWords(all: readonly Line[]): string {
  const width = 2 + Math.max(...all.map(({ name }) => name.length));
  const group = (title: string, has: (line: Line) => boolean): string => {
    const lines = all.filter(has).map(({ name, description }) => `  ${name.padEnd(width)}${description}\n`);
    return `${title}:\n${lines.join('')}`;
  };
  return [
    group('Natural grounds', ({ natural, generator }) => natural && generator === 'rocks'),
    group('Wood ears on a log', ({ natural, generator }) => natural && generator === 'wood-ears'),
    group('Figures of the papers about rocks', ({ natural, generator }) => !natural && generator === 'rocks'),
    group('Figures of the thesis about wood ears', ({ natural, generator }) => !natural && generator === 'wood-ears'),
  ].join('\n');
}
