/** `rock-field export`: scenes as files for other programs. */

import type { Command } from '../command.ts';
import { exportTasks } from '../export-tasks.ts';
import { make } from '../make.ts';
import { EXPORT, OUTPUT, PARAMETER_OPTIONS, SAYING, SCENE } from '../options.ts';
import { refuseWords, scenesOf } from '../scenes.ts';

export const command: Command = {
  usage: '--preset NAME | --link URL | --from FILE [options]',
  about:
    'Writes scenes as files that Blender, Unreal, Unity, Godot, three.js or a slicer open. The same scene and options are the same file, byte for byte, on every machine and on the page. Without --out a file is called as the page calls it, such as riverbed-7.glb.',
  groups: [
    { title: 'Which scene', options: SCENE },
    { title: 'Where to', options: OUTPUT },
    { title: 'What it says', options: SAYING },
    { title: 'The file', options: EXPORT },
  ],
  others: PARAMETER_OPTIONS,
  footer: 'Every parameter of the scene is an option too, as in --image-width 400 or --moss 0.5: rock-field help parameters lists them.',
  examples: [
    { what: 'a river bed for Blender', line: 'rock-field export --preset riverbed --seed 7 --target blender --out r.glb' },
    { what: 'a thousand of them, on all cores', line: 'rock-field export --preset riverbed --seeds 1..1000 --out "beds/{seed:4}.glb"' },
    {
      what: 'twelve kinds of rocks that share their meshes, for Unreal',
      line: 'rock-field export --preset scree --target unreal --mesh kit --out scree.glb',
    },
    { what: 'a tray to print', line: 'rock-field export --preset shingle --target print --out tray.stl' },
    {
      what: 'what somebody sent you, a little larger',
      line: 'rock-field export --link "v=1&preset=moraine&seed=3" --metres-per-pixel 0.02 --out m.glb',
    },
  ],
  run: async (args, surroundings) => {
    refuseWords(args);
    const say = (text: string): void => void surroundings.err.write(`rock-field: ${text}\n`);
    const tasks = exportTasks(args, await scenesOf(args, say), ['']);
    return make({ tasks, ...howOf(args) }, surroundings);
  },
};

/** How it is made and told, as all commands that make files have it. */
export function howOf(args: Parameters<typeof exportTasks>[0]): {
  jobs: string | undefined;
  isJson: boolean;
  isQuiet: boolean;
  goOn: string;
} {
  return {
    jobs: args.get('jobs'),
    isJson: args.is('json'),
    isQuiet: args.is('quiet'),
    goOn: 'the same command with --skip-existing makes the others',
  };
}
