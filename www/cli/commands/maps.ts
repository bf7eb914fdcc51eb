/** `rock-field maps`: what terrains are made of, as pictures and numbers. */

import { MAPS as MAPS_OF, OPTIONS } from '../../export/options.ts';
import type { Command } from '../command.ts';
import { exportTasks } from '../export-tasks.ts';
import { misuse } from '../failures.ts';
import { make } from '../make.ts';
import { MAPS, OUTPUT, PARAMETER_OPTIONS, SAYING, SCENE } from '../options.ts';
import { refuseWords, scenesOf } from '../scenes.ts';
import { howOf } from './export.ts';

const FORMATS = Object.keys(MAPS_OF);
const MAP = OPTIONS.map.choices;

export const command: Command = {
  usage: '--preset NAME | --link URL | --from FILE [options]',
  about:
    'Writes maps of fields of rocks, seen from above: for landscapes, displacement, masks and scattering. Without --map all of them are in one ZIP; with it each is a file of its own.',
  groups: [
    { title: 'Which scene', options: SCENE },
    { title: 'Where to', options: OUTPUT },
    { title: 'What it says', options: SAYING },
    {
      title: 'The maps',
      options: MAPS.map((option) => {
        if (option.name === 'map')
          return {
            ...option,
            isList: true,
            values: MAP.join(', '),
            doc: 'Which map: `all` are in a ZIP, each of the others in a file of its own. May be given several times.',
          };
        return option.name === 'format'
          ? {
              ...option,
              choices: FORMATS,
              values: `${FORMATS.join(', ')}; zip, and png with --map`,
              doc: 'The kind of file: PNG, raw 16 bits without a header, OpenEXR, or a ZIP.',
            }
          : option;
      }),
    },
  ],
  others: PARAMETER_OPTIONS,
  footer: 'Every parameter of the scene is an option too, as in --image-width 400 or --moss 0.5: rock-field help parameters lists them.',
  examples: [
    { what: 'all maps of a field', line: 'rock-field maps --preset riverbed --seed 7 --out maps.zip' },
    {
      what: 'a landscape for Unreal: 16 bits, 1009 samples on a side',
      line: 'rock-field maps --preset scree --map height --format r16 --side 1009 --samples corners --out scree.r16',
    },
    {
      what: 'height and masks of a hundred seeds',
      line: 'rock-field maps --preset moraine --seeds 1..100 --map height --map splat --out "maps/{seed}-{map}.png"',
    },
  ],
  run: async (args, surroundings) => {
    refuseWords(args);
    const say = (text: string): void => void surroundings.err.write(`rock-field: ${text}\n`);
    const scenes = await scenesOf(args, say);
    if (scenes.some(({ generator }) => generator !== 'rocks'))
      throw misuse('maps show rocks from above: wood ears have none. rock-field export writes them as meshes.');
    const maps = args.all('map');
    const isPlain = maps.length > 0 && !maps.includes('all');
    const preferred = { format: isPlain ? 'png' : 'zip' } as const;
    const isKnown = MAP.some((map) => maps.includes(map));
    return make({ tasks: exportTasks(args, scenes, isKnown ? [...new Set(maps)] : [''], preferred), ...howOf(args) }, surroundings);
  },
};
