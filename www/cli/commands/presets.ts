/** `rock-field presets`: what to begin with. */

import { presetLabel } from '../../rocks/controls/preset-groups.ts';
import { PRESETS } from '../../rocks/params.ts';
import { LAYER_ROWS } from '../../rocks/request.ts';
import { PAPERS, presetName } from '../../rocks/words.ts';
import type { Preset } from '../../rocks/spec.ts';
import { ROCKS } from '../../rocks/table.ts';
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

/** As the page calls it, and what sets it apart. */
function describe(generator: GeneratorName, name: string): string {
  if (generator === 'wood-ears') return woodEars(name);
  const preset: Preset = PRESETS.find((candidate) => candidate.name === name)!;
  if (!preset.natural) {
    const columns = LAYER_ROWS.filter(({ kind }) => kind !== 'optional-integer').map(({ label }) => label.split(' ').at(-1) ?? '');
    const paper = PAPERS.find((candidate) => name.startsWith(candidate)) ?? '';
    return `${paper}, ${presetLabel('en', preset, columns).replaceAll(/[\u00a0\u2060\u202f]/g, ' ')}`;
  }
  const { imageWidth, imageHeight, layers } = ROCKS.presetParams(name);
  const radii = layers.map(({ radius }) => radius);
  return `${presetName('en', preset)}: ${layers.length} sizes of stones, radius ${Math.min(...radii)} to ${Math.max(...radii)}, on ${imageWidth} × ${imageHeight} pixels`;
}

/** `thesis-fig4-2` is a figure; the others say themselves what they are. */
function woodEars(name: string): string {
  const [, chapter, number] = /^thesis-fig(\d+)-(\d+)$/.exec(name) ?? [];
  if (chapter !== undefined) return `the thesis, Fig. ${chapter}.${number}`;
  const words = name.replace(/^thesis-/, '').replaceAll('-', ' ');
  return name.startsWith('thesis-') ? `the thesis, ${words} values` : words.charAt(0).toUpperCase() + words.slice(1);
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
