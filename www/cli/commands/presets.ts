/** `rock-field presets`: what to begin with. */

import type { Command } from '../command.ts';
import { GENERATORS } from '../generators.ts';
import { SAYING } from '../options.ts';

export const command: Command = {
  usage: '[--json]',
  about:
    'Lists the presets, with what they are. Those of natural grounds and logs have natural colours; the others are figures of the papers that the generators are from.',
  groups: [
    {
      title: 'What it says',
      options: SAYING.filter(({ name }) => name === 'json').map((option) => ({ ...option, doc: 'A list of JSON objects.' })),
    },
  ],
  examples: [
    { what: 'to read', line: 'rock-field presets' },
    { what: 'for a script', line: 'rock-field presets --json' },
  ],
  run: async (args, { out }) => {
    const presets = Object.values(GENERATORS).flatMap(({ name: generator, table }) =>
      table.presets.map(({ name, natural = false }) => ({ name, generator, natural, ...table.presetParams(name) })),
    );
    out.write(args.is('json') ? `${JSON.stringify(presets, null, 2)}\n` : presets.map(({ name }) => `${name}\n`).join(''));
    return 'done';
  },
};
