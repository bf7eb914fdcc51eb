/** `rock-field info`: what made this file? */

import { createHash } from 'node:crypto';
import { createReadStream, openAsBlob } from 'node:fs';
import { resolveOptions } from '../../export/options.ts';
import type { ExportOptions } from '../../export/options.ts';
import { VERSION } from '../../data/version.ts';
import type { Command } from '../command.ts';
import { misuse } from '../failures.ts';
import type { Exit } from '../failures.ts';
import { sceneOfLink } from '../generators.ts';
import type { LinkedScene } from '../generators.ts';
import { makeOne } from '../make.ts';
import type { Surroundings } from '../make.ts';
import { kebab, SAYING } from '../options.ts';
import { originOfFile } from '../scenes.ts';
import type { Wanted } from '../work.ts';

export const command: Command = {
  usage: 'FILE [--check] [--json]',
  about:
    'Says what made a file: an export, a picture or a postcard of rock-field, an archive with one, or the description that rock-field generate writes. With --check it is made again and compared.',
  groups: [
    {
      title: 'Options',
      options: [
        {
          name: 'check',
          doc: 'Makes the scene again, and of an export the file, and compares them to the last bit. The exit code is 1 where they differ.',
        },
        ...SAYING.filter(({ name }) => name === 'json').map((option) => ({ ...option, doc: 'A JSON object.' })),
      ],
    },
  ],
  examples: [
    { what: 'what made it, and how it is made again', line: 'rock-field info r.glb' },
    { what: 'whether this rock-field makes the same', line: 'rock-field info r.glb --check' },
  ],
  run: async (args, surroundings) => {
    const [file, other] = args.positionals;
    if (file === undefined) throw misuse('which file? As in rock-field info r.glb');
    if (other !== undefined) throw misuse('one file at a time');
    const { link, hash, version, options } = await originOfFile(file);
    const scene = sceneOfLink(link);
    for (const { text } of scene.notices) surroundings.err.write(`rock-field: ${text}\n`);
    const { generator, preset, params } = scene;
    const format = await formatOf(file, options);
    const again = commandOf(scene, format, options);
    const facts = { file, version, scene: generator.noun, preset, seed: params.seed, options, link, hash, again };
    const check = args.is('check') ? await checked(file, scene, hash, format, options, surroundings) : undefined;
    const all = { ...facts, ...(check && { check }) };
    surroundings.out.write(args.is('json') ? `${JSON.stringify(all, null, 2)}\n` : inWords(facts, check));
    return check && !(check.scene && check.file !== false) ? 'failed' : ('done' satisfies Exit);
  },
};

type Options = Readonly<Record<string, unknown>>;

/** Of an export; undefined for what only shows a scene. */
async function formatOf(file: string, options: Options): Promise<string | undefined> {
  if (typeof options['format'] === 'string') return options['format'];
  const head = await (await openAsBlob(file)).slice(0, 4).text();
  return head === 'glTF' || Number(options['parts']) > 1 ? 'glb' : undefined;
}

/** What is typed to make it again. */
function commandOf({ generator, params, preset }: LinkedScene, format: string | undefined, options: Options): string {
  const plain = generator.encode({ ...generator.table.presetParams(preset), seed: params.seed }, preset);
  const link = generator.encode(params, preset);
  const scene = link === plain ? `--preset ${preset} --seed ${params.seed}` : `--link '${link}'`;
  if (format === undefined) return `rock-field export ${scene}`;
  const words = Object.entries(options)
    .filter(([key, value]) => !(key === 'metresPerPixel' && value === 0.01))
    .map(([key, value]) => (typeof value === 'boolean' ? `--${value ? '' : 'no-'}${kebab(key)}` : `--${kebab(key)} ${String(value)}`));
  return ['rock-field export', scene, ...words].join(' ');
}

/** `file` is undefined where there is nothing that could be made again. */
interface Check {
  scene: boolean;
  /** Of the scene that is made now. */
  hash: string;
  file?: boolean;
}

async function checked(
  file: string,
  scene: LinkedScene,
  hash: string,
  format: string | undefined,
  options: Options,
  surroundings: Surroundings,
): Promise<Check> {
  const { generator, params, preset } = scene;
  if (hash === '') throw misuse(`${file} does not say which hash its scene had: there is nothing to compare`);
  const wanted: Wanted = format === undefined ? { as: 'hash' } : { as: 'export', options: resolveOptions(options as ExportOptions) };
  const made = await makeOne(
    {
      scene: { generator: generator.name, link: generator.encode(params, preset), preset, seed: params.seed },
      wanted,
      file: null,
      isWatched: false,
    },
    surroundings,
  );
  const isScene = made.hash === hash;
  if (format === undefined) return { scene: isScene, hash: made.hash };
  return { scene: isScene, hash: made.hash, file: made.sha256 === (await hashOfFile(file)) };
}

async function hashOfFile(file: string): Promise<string> {
  const hash = createHash('sha256');
  for await (const piece of createReadStream(file)) hash.update(piece as Uint8Array);
  return hash.digest('hex');
}

function inWords({ file, version, scene, preset, seed, link, hash, again }: Record<string, unknown>, check: Check | undefined): string {
  const by = version === '' ? 'rock-field' : `rock-field ${version}`;
  const rows: [string, unknown][] = [
    ['file', file],
    ['made by', by],
    ['scene', `${scene}, preset ${preset}, seed ${seed}`],
    ['link', link],
    ...(hash === '' ? [] : [['hash', hash] as [string, unknown]]),
    ['again', again],
    ...(check ? checkRows(check) : []),
  ];
  return rows.map(([key, value]) => `${key.padEnd(8)} ${String(value)}\n`).join('');
}

function checkRows({ scene, hash, file }: Check): [string, string][] {
  return [
    ['check', scene ? 'the scene is the same, to the last bit' : `the scene differs: rock-field ${VERSION} makes ${hash} of this link`],
    ...(file === undefined
      ? []
      : [
          ['', file ? 'the file is the same, to the last byte' : 'the file differs: it was changed, or made by another version'] as [
            string,
            string,
          ],
        ]),
  ];
}
