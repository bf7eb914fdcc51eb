/** Every command that help, README and documentation show is run; only the fields are made smaller, and the seeds fewer. */

import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { chmodSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { after, test } from 'node:test';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { COMMANDS } from '../../www/cli/main.ts';

const ROOT = fileURLToPath(new URL('../../', import.meta.url));
const CLI = path.join(ROOT, 'dist', 'cli.js');
const PAGES = path.join('www', 'docs', 'pages');

const folder = mkdtempSync(path.join(os.tmpdir(), 'rock-field-docs-'));
after(() => rmSync(folder, { recursive: true, force: true }));

/** Stands for the command: the same arguments, of less work. Its own are kept where a document says a size. */
const STAND_IN = `#!${process.execPath}
let args = process.argv.slice(2).map((word) => word.replace(/^(\\d+)\\.\\.\\d{2,}$/, (_, from) => from + '..' + (Number(from) + 1)));
const log = args.some((word) => /colony|wood-ear/.test(word));
const has = (name) => args.includes('--' + name);
const isBatch = args[0] === 'batch' && has('preset');
const makes = (isBatch || ['export', 'maps', 'generate'].includes(args[0])) && !has('help') && !has('link');
if (makes && log) for (const [name, least] of [['density', '0.02'], ['collisions', 'off'], ['ground', 'none']]) if (!has(name)) args.push('--' + name, least);
if (makes && !log) for (const side of ['image-width', 'image-height']) if (!has(side)) args.push('--' + side, '48');
if (has('side')) args[args.indexOf('--side') + 1] = '33';
process.argv.splice(2, Infinity, ...args);
import(${JSON.stringify(pathToFileURL(CLI).href)});
`;
const bin = path.join(folder, 'bin');
mkdirSync(bin);
writeFileSync(path.join(bin, 'rock-field.cjs'), STAND_IN);
writeFileSync(path.join(bin, 'rock-field'), `#!/bin/sh\nexec "${process.execPath}" "${path.join(bin, 'rock-field.cjs')}" "$@"\n`);
chmodSync(path.join(bin, 'rock-field'), 0o755);

/** Blocks of lines of a shell that call the command, in a Markdown file. */
function blocksOf(markdown: string): string[][] {
  return [...markdown.matchAll(/```sh\n(.*?)```/gs)]
    .map(([, block]) => block.split('\n').filter((line) => /^(npx )?rock-field /.test(line)))
    .filter((lines) => lines.length > 0);
}

/** Runs lines one after the other in an empty folder. */
function runAll(lines: readonly string[], title: string): void {
  const cwd = mkdtempSync(path.join(folder, 'run-'));
  // A list of scenes, by the name that it has everywhere.
  writeFileSync(
    path.join(cwd, 'scenes.txt'),
    'v=1&preset=riverbed&w=48&h=48\n{"preset": "scree", "seed": 3, "imageWidth": 48, "imageHeight": 48}\n',
  );
  for (const line of lines) {
    const { status, stderr } = spawnSync('sh', ['-c', line.replace(/^npx /, '')], {
      cwd,
      encoding: 'utf8',
      env: { ...process.env, PATH: `${bin}${path.delimiter}${process.env.PATH}` },
    });
    assert.equal(status, 0, `${title}: ${line}\n${stderr}`);
  }
}

const isPosix = process.platform !== 'win32';

test('every line of README and documentation runs', { skip: !isPosix && 'these are lines of a POSIX shell' }, () => {
  const documents = ['README.md', ...readdirSync(path.join(ROOT, PAGES)).map((name) => path.join(PAGES, name))];
  let count = 0;
  for (const document of documents) {
    for (const lines of blocksOf(readFileSync(path.join(ROOT, document), 'utf8'))) {
      runAll(lines, document);
      count += lines.length;
    }
  }
  assert.ok(count > 15, `${count}`);
});

test('every example of --help runs, and each command has some', { skip: !isPosix && 'these are lines of a POSIX shell' }, async () => {
  for (const [name, { load }] of Object.entries(COMMANDS)) {
    const { command } = await load();
    assert.ok(command.examples.length > 0, name);
    const isAbout = name === 'info' ? ['rock-field export --preset scree --out r.glb'] : [];
    runAll([...isAbout, ...command.examples.map(({ line }) => line)], `rock-field ${name} --help`);
  }
  const { out } = help('--help');
  const lines = out.split('\n').flatMap((line) => (/^ {2}rock-field [a-z]+ /.test(line) ? [line.trim()] : []));
  assert.equal(lines.length, 3);
  runAll(lines, 'rock-field --help');
});

function help(...args: string[]): { out: string; status: number | null } {
  const { stdout, status } = spawnSync(process.execPath, [CLI, ...args], { encoding: 'utf8' });
  return { out: stdout, status };
}

test('--help names every command, that of a command every option that it takes, and neither needs what makes scenes', async () => {
  assert.deepEqual(
    Object.keys(COMMANDS).filter((name) => !help('--help').out.includes(`  ${name} `)),
    [],
  );
  const page = readFileSync(path.join(ROOT, PAGES, 'command-line.md'), 'utf8');
  for (const [name, { load }] of Object.entries(COMMANDS)) {
    assert.ok(page.includes(`| \`${name}\` |`), `the page has no ${name}`);
    const { command } = await load();
    const { out, status } = help(name, '--help');
    assert.equal(status, 0);
    for (const { options } of command.groups)
      for (const { name: typed, choices, values } of options) {
        assert.match(out, new RegExp(`--(\\[no-\\])?${typed}\\b`));
        if (choices && values !== undefined) assert.deepEqual(values.split(';')[0]!.split(', '), choices, `${name} --${typed}`);
      }
  }
  const everything = help('help', 'parameters').out;
  for (const { name } of (await COMMANDS.export.load()).command.others ?? []) assert.ok(everything.includes(`  --${name}`), name);
});
