/** `rock-field info`: what made this file? */

import type { Command } from '../command.ts';
import { misuse } from '../failures.ts';
import { sceneOfLink } from '../generators.ts';
import { SAYING } from '../options.ts';
import { linkInFile } from '../scenes.ts';

export const command: Command = {
  usage: 'FILE [--check]',
  about: 'Says what made a file: an export or a picture of rock-field, or an archive with one.',
  groups: [
    {
      title: 'Options',
      options: [...SAYING.filter(({ name }) => name === 'json').map((option) => ({ ...option, doc: 'A JSON object.' }))],
    },
  ],
  examples: [{ what: 'what made it, and how it is made again', line: 'rock-field info r.glb' }],
  run: async (args, { out }) => {
    const [file, other] = args.positionals;
    if (file === undefined) throw misuse('which file? As in rock-field info r.glb');
    if (other !== undefined) throw misuse('one file at a time');
    const { link, hash } = await linkInFile(file);
    const { generator, preset, params } = sceneOfLink(link);
    const facts = { file, generator: generator.name, preset, seed: params.seed, link, hash };
    out.write(
      args.is('json')
        ? `${JSON.stringify(facts, null, 2)}\n`
        : Object.entries(facts)
            .map(([key, value]) => `${`${key}:`.padEnd(11)} ${value}\n`)
            .join(''),
    );
    return 'done';
  },
};
