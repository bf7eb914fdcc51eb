/** `rock-field batch`: a part of a long list, for many machines, and what becomes of all parts. */

import { resolveOptions } from '../../export/options.ts';
import { batchOf, claimable, idOf } from '../batch/batch-file.ts';
import type { Finding } from '../batch/check.ts';
import { MANIFEST } from '../batch/folder.ts';
import { listOf, readList } from '../batch/list.ts';
import type { List } from '../batch/list.ts';
import { merge, verify } from '../batch/merge.ts';
import type { Merged } from '../batch/merge.ts';
import { runShard } from '../batch/run-shard.ts';
import { WHOLE, shardOf } from '../batch/shards.ts';
import type { Shard } from '../batch/shards.ts';
import type { Command } from '../command.ts';
import { givenOptions } from '../export-tasks.ts';
import { misuse } from '../failures.ts';
import type { Exit } from '../failures.ts';
import type { Surroundings } from '../make.ts';
import { EXPORT, OUTPUT, PARAMETER_OPTIONS, SAYING, SCENE } from '../options.ts';
import type { Arguments } from '../parse.ts';
import { scenesOf } from '../scenes.ts';
import { didYouMean } from '../suggest.ts';

/** What may follow `rock-field batch` in the place of a list. */
const WORDS = ['plan', 'verify', 'merge'];

export const command: Command = {
  usage: 'LIST --out DIR [--shard K/N] [options]\n       rock-field batch plan LIST [--out DIR] | verify DIR | merge DIR',
  about:
    'Makes the scenes of a list: all of them, or one of N parts, so that many machines can work on one folder. LIST is a file with a link to a scene, or its parameters as JSON, on each line; lines that begin with # are comments, and - is the standard input. Instead of a list there may be presets and seeds, as in --preset riverbed --seeds 1..100000. What is there and whole is left as it is, so that any part may be repeated at any time. plan checks a list and says how many scenes it has; verify reads all files; merge does so too, and writes manifest.json with one hash for all of them, which is the same however the work was divided.',
  groups: [
    { title: 'Which scenes', options: SCENE },
    {
      title: 'Where to',
      options: [
        { name: 'out', short: 'o', value: 'DIR', doc: 'The folder of the batch. It belongs to one list, with the same options.' },
        { name: 'shard', value: 'K/N', doc: 'The part to be made, counted from 0: 0/160 to 159/160. Default: 0/1, which is all of them.' },
        ...OUTPUT.filter(({ name }) => name === 'jobs'),
      ],
    },
    { title: 'What it says', options: SAYING },
    { title: 'The files', options: EXPORT },
  ],
  others: PARAMETER_OPTIONS,
  footer:
    'A line of JSON may have "export" with options of this scene alone, by their names in the documentation: {"preset": "scree", "seed": 3, "export": {"mesh": "kit"}}.',
  examples: [
    { what: 'a thousand river beds, on all cores', line: 'rock-field batch --preset riverbed --seeds 1..1000 --out rocks' },
    { what: 'is all of it there?', line: 'rock-field batch verify rocks' },
    { what: 'the manifest', line: 'rock-field batch merge rocks' },
    {
      what: 'the first of 160 parts of a hundred thousand',
      line: 'rock-field batch --preset riverbed --seeds 1..100000 --shard 0/160 --out beds --target unreal',
    },
    { what: 'a list that another program writes', line: 'echo "preset=scree&seed=3" | rock-field batch - --out listed' },
  ],
  run: (args, surroundings) => {
    const [first, second, ...others] = args.positionals;
    if (first === 'plan') return plan(args, [second, ...others], surroundings);
    if (first !== 'verify' && first !== 'merge') return shard(args, args.positionals, surroundings);
    if (second === undefined || others.length > 0) throw misuse(`rock-field batch ${first} is followed by one folder`);
    const foreign = args.names().find((name) => name !== 'json' && name !== 'quiet');
    if (foreign !== undefined) throw misuse(`rock-field batch ${first} does not take --${foreign}: the folder knows its options`);
    return check(first, second, args, surroundings);
  },
};

async function shard(args: Arguments, lists: readonly (string | undefined)[], surroundings: Surroundings): Promise<Exit> {
  const folder = args.get('out');
  if (folder === undefined) {
    const [first = ''] = lists;
    throw misuse(`--out is missing: the folder of the batch.${didYouMean(first, WORDS, (word) => `rock-field batch ${word}`)}`);
  }
  const part = args.get('shard') === undefined ? WHOLE : shardOf(args.get('shard')!);
  const { list, options } = await asked(args, lists, part, surroundings);
  const isJson = args.is('json') || !surroundings.out.isTTY;
  return runShard({ folder, list, options, jobs: args.get('jobs'), isJson, isQuiet: args.is('quiet') }, surroundings);
}

/** Checks all that can be checked, and writes nothing. */
async function plan(args: Arguments, lists: readonly (string | undefined)[], surroundings: Surroundings): Promise<Exit> {
  const { list, options } = await asked(args, lists, WHOLE, surroundings);
  const batch = batchOf(list.count, list.hash, options);
  const folder = args.get('out');
  if (folder !== undefined) claimable(folder, batch);
  surroundings.out.write(`${JSON.stringify({ status: 'planned', items: list.count, batch: idOf(batch) })}\n`);
  return 'done';
}

/** The scenes that a command line names, with the options of all of them. */
async function asked(
  args: Arguments,
  [file, other]: readonly (string | undefined)[],
  part: Shard,
  { err }: Surroundings,
): Promise<{ list: List; options: Readonly<Record<string, unknown>> }> {
  if (other !== undefined) throw misuse(`there are two lists, ${file} and ${other}: write all scenes into one`);
  const given = givenOptions(args);
  const options = { ...resolveOptions(given) };
  if (file === undefined) {
    const scenes = await scenesOf(args, (text) => void err.write(`rock-field: ${text}\n`));
    return { list: listOf(scenes, given, part), options };
  }
  const foreign = args.names().find((name) => [...SCENE, ...PARAMETER_OPTIONS].some((option) => option.name === name));
  if (foreign !== undefined) throw misuse(`--${foreign} and a list cannot be given together: the lines of ${file} say what is made`);
  return { list: await readList(file, given, part), options };
}

async function check(what: 'verify' | 'merge', folder: string, args: Arguments, { out, err }: Surroundings): Promise<Exit> {
  const onFinding = (finding: Finding): void => void out.write(`${JSON.stringify(finding)}\n`);
  const found = await (what === 'merge' ? merge : verify)(folder, onFinding);
  const { batch, whole, bytes, missing, corrupt, foreign, merkle } = found;
  const isWhole = merkle !== null;
  const status = !isWhole ? 'incomplete' : what === 'merge' ? 'merged' : 'verified';
  out.write(`${JSON.stringify({ status, items: batch.items, whole, missing, corrupt, foreign, bytes, merkle })}\n`);
  if (!args.is('quiet')) err.write(`rock-field: ${words(what, folder, found)}\n`);
  return isWhole && (what === 'merge' || foreign === 0) ? 'done' : 'failed';
}

function words(what: 'verify' | 'merge', folder: string, { batch, whole, missing, corrupt, foreign, merkle }: Merged): string {
  const strange = foreign > 0 ? [foreign === 1 ? '1 file does not belong there' : `${foreign} files do not belong there`] : [];
  if (merkle !== null) {
    const written = what === 'merge' ? [`${folder}/${MANIFEST} is written`] : [];
    return [`all ${batch.items} files are there and whole`, ...strange, ...written].join('; ');
  }
  const wrong = [...(missing > 0 ? [`${missing} are missing`] : []), ...(corrupt > 0 ? [`${corrupt} are not what was written`] : [])];
  return `${[`${whole} of ${batch.items} files are whole`, ...wrong, ...strange].join('; ')}. Make the shards again: whatever is whole stays`;
}
