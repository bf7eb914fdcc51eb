/** `rock-field generate`: what is in a scene, for scripts. */

import type { Command } from '../command.ts';
import { placesOf, refuseUnknownEndings, tasksOf } from '../export-tasks.ts';
import { make } from '../make.ts';
import { OUTPUT, PARAMETER_OPTIONS, SAYING, SCENE } from '../options.ts';
import { misuse } from '../failures.ts';
import { refuseWords, scenesOf } from '../scenes.ts';
import { howOf } from './export.ts';

const FORMATS = ['json', 'npz'] as const;

export const command: Command = {
  usage: '--preset NAME | --link URL | --from FILE [options]',
  about:
    'Generates scenes and says what is in them: counts, all parameters, the link, and the hash of the buffers, by which two machines can tell that they made the same. Without --out it is printed. With --format npz all arrays are in the file too, for NumPy; indices of sites, cells, vertices and triangles are as in the documentation of the type Field.',
  groups: [
    { title: 'Which scene', options: SCENE },
    {
      title: 'Where to',
      options: [
        ...OUTPUT,
        {
          name: 'format',
          value: 'WORD',
          choices: FORMATS,
          doc: 'A description as JSON, or that with all arrays, as numpy.load reads them. Default: what the ending of --out says, else json.',
        },
      ],
    },
    { title: 'What it says', options: SAYING },
  ],
  others: PARAMETER_OPTIONS,
  footer: 'Every parameter of the scene is an option too, as in --image-width 400 or --density 0.5: rock-field help parameters lists them.',
  examples: [
    { what: 'how many rocks there are, and the hash', line: 'rock-field generate --preset riverbed --seed 7' },
    { what: 'vertices and triangles for Python', line: 'rock-field generate --preset riverbed --seed 7 --out riverbed.npz' },
    { what: 'wood ears on a shorter log', line: 'rock-field generate --preset wrinkled-colony --log-length 120' },
  ],
  run: async (args, surroundings) => {
    refuseWords(args);
    const say = (text: string): void => void surroundings.err.write(`rock-field: ${text}\n`);
    const scenes = await scenesOf(args, say);
    const out = args.get('out');
    const ending = FORMATS.find((format) => out?.toLowerCase().endsWith(`.${format}`));
    const as = (args.get('format') as (typeof FORMATS)[number] | undefined) ?? ending ?? 'json';
    if (ending !== undefined && ending !== as)
      throw misuse(`--out ${out}: the file is one of format ${as}; let the name end in .${as}, or leave --format out`);
    const values = scenes.map(({ preset, seed }, index) => ({ preset, seed, index: index + 1, map: '', target: '', format: as }));
    const isPrinted = out === undefined && as === 'json' && scenes.length === 1;
    const files = isPrinted ? [null] : placesOf(args, values, '{preset}-{seed}.{format}');
    refuseUnknownEndings(args, files, FORMATS);
    const tasks = tasksOf(
      args,
      scenes.map((scene, index) => ({ scene, wanted: { as }, file: files[index]!, isWatched: false })),
    );
    return make({ tasks, ...howOf(args) }, surroundings);
  },
};
