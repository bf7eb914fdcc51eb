/** The command line: finds the command, and turns whatever happens into words and an exit code. */

import { VERSION } from '../data/version.ts';
import type { Command } from './command.ts';
import { Ending, EXITS, failureOf, misuse, outputLost } from './failures.ts';
import type { Exit } from './failures.ts';
import type { Surroundings } from './make.ts';
import { didYouMean } from './suggest.ts';

/** The commands, each loaded when it is asked for. */
export const COMMANDS = {
  export: {
    summary: 'a scene as a file for Blender, Unreal, Unity, Godot, three.js or a printer',
    load: () => import('./commands/export.ts'),
  },
  maps: { summary: 'height, normal, id, cover, contact and splat maps of a field', load: () => import('./commands/maps.ts') },
  generate: { summary: 'what is in a scene, as JSON or as arrays for NumPy', load: () => import('./commands/generate.ts') },
  batch: { summary: 'a part of a long list of scenes, for many machines', load: () => import('./commands/batch.ts') },
  info: { summary: 'what made this file?', load: () => import('./commands/info.ts') },
  presets: { summary: 'what to begin with', load: () => import('./commands/presets.ts') },
  schema: { summary: 'all parameters and options, as JSON Schema', load: () => import('./commands/schema.ts') },
} as const satisfies Record<string, { summary: string; load: () => Promise<{ command: Command }> }>;

type CommandName = keyof typeof COMMANDS;

/** Returns the exit code. */
export async function main(argv: readonly string[], surroundings: Surroundings): Promise<number> {
  // A reader that has gone is heard of where something is written; without this it would be a crash.
  let lost: Ending | undefined;
  surroundings.out.on('error', (error) => {
    lost ??= outputLost(error);
  });
  surroundings.err.on('error', () => undefined);
  try {
    const exit = await run(argv, surroundings);
    await new Promise((resolve) => surroundings.out.write('', () => setImmediate(resolve)));
    if (lost) throw lost;
    return EXITS[exit].code;
  } catch (thrown) {
    if (thrown instanceof Ending) {
      surroundings.err.write(`rock-field: ${thrown.message}\n`);
      return EXITS[thrown.exit].code;
    }
    const { name, message, isStorage } = failureOf(thrown);
    surroundings.err.write(`rock-field: ${isStorage ? message : `${name}: ${message}`}\n`);
    return EXITS[isStorage ? 'storage' : 'failed'].code;
  }
}

async function run(argv: readonly string[], surroundings: Surroundings): Promise<Exit> {
  const { out } = surroundings;
  const [first, ...rest] = argv;
  if (first === '--version' || first === '-v' || first === '-V') {
    out.write(`${VERSION}\n`);
    return 'done';
  }
  const asked = first === 'help' ? rest : first === '--help' || first === '-h' || first === undefined ? [] : undefined;
  const { overview, helpOf, parameters } = await import('./help.ts');
  const width = Math.min(out.columns || 100, 120);
  if (asked !== undefined) {
    const [topic] = asked;
    if (topic === 'parameters') out.write(await parameters(width));
    else out.write(topic === undefined ? overview(COMMANDS, width) : helpOf(topic, await loaded(topic), width));
    // Without a word nothing was asked for.
    return first === undefined ? 'usage' : 'done';
  }
  const command = await loaded(first!);
  if (rest.includes('--help') || rest.includes('-h')) {
    out.write(helpOf(first!, command, width));
    return 'done';
  }
  const { parse } = await import('./parse.ts');
  const { HELP } = await import('./options.ts');
  const options = [...command.groups.flatMap((group) => group.options), ...(command.others ?? []), HELP];
  return command.run(parse(rest, options, `rock-field ${first}`), surroundings);
}

async function loaded(name: string): Promise<Command> {
  if (Object.hasOwn(COMMANDS, name)) return (await COMMANDS[name as CommandName].load()).command;
  const names = Object.keys(COMMANDS);
  const meant = didYouMean(name, names, (word) => `rock-field ${word}`);
  throw misuse(
    `there is no command ${JSON.stringify(name)}.${meant || ` There are ${names.join(', ')}; rock-field --help says what they do.`}`,
  );
}
