/** The command line, as it is typed: `dist/cli.js` in processes of its own, in folders of their own. */

import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { existsSync, mkdtempSync, readdirSync, readFileSync, rmSync } from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { after, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { exportScene } from 'rock-field/export';

const CLI = fileURLToPath(new URL('../../dist/cli.js', import.meta.url));
/** Little work. */
const SMALL = ['--image-width', '48', '--image-height', '48'];

const folders: string[] = [];
after(() => {
  for (const folder of folders) rmSync(folder, { recursive: true, force: true });
});

function emptyFolder(): string {
  const folder = mkdtempSync(path.join(os.tmpdir(), 'rock-field-cli-'));
  folders.push(folder);
  return folder;
}

/** Runs a command in a folder; a line is split at its spaces. */
function rockField(
  line: string | readonly string[],
  cwd = emptyFolder(),
): { status: number | null; out: string; err: string; cwd: string } {
  const args = typeof line === 'string' ? line.split(' ') : line;
  const { status, stdout, stderr } = spawnSync(process.execPath, [CLI, ...args], { cwd, encoding: 'utf8' });
  return { status, out: stdout, err: stderr, cwd };
}

const sha256 = (bytes: Uint8Array): string => createHash('sha256').update(bytes).digest('hex');

test('a file of the command line is the file of rock-field/export, byte for byte', async () => {
  const { status, out, cwd } = rockField([
    'export',
    '--preset',
    'riverbed',
    '--seed',
    '7',
    '--target',
    'blender',
    ...SMALL,
    '--out',
    'r.glb',
  ]);
  assert.equal(status, 0);
  const { bytes } = await exportScene({ preset: 'riverbed', seed: 7, imageWidth: 48, imageHeight: 48 }, { target: 'blender' });
  assert.equal(sha256(readFileSync(path.join(cwd, 'r.glb'))), sha256(bytes));
  assert.equal(JSON.parse(out).sha256, sha256(bytes));
});

test('what was mistyped is named with what was meant, and nothing is written', () => {
  const cwd = emptyFolder();
  for (const [line, said] of [
    ['exprt --preset riverbed', 'Did you mean rock-field export?'],
    ['export --preset riverbd', 'Did you mean riverbed?'],
    ['export --preset wrinkled-colny', 'Did you mean wrinkled-colony?'],
    ['export --presett riverbed', 'Did you mean --preset?'],
    ['export --preset riverbed --mesh rock', 'Did you mean rocks?'],
    ['export --preset riverbed --target blendr', 'Did you mean blender?'],
    ['export --preset riverbed --metre-per-pixel 2', 'Did you mean --metres-per-pixel?'],
    ['export --preset riverbed --notation relativ', 'Did you mean relative?'],
    ['export --preset riverbed --radius 1,2 --detail 1', '--radius is for 2 layers and --detail for 1'],
    ['export --preset riverbed --image-width 9999999', '--image-width is 9999999; it must be between'],
    ['export --preset riverbed --density 3', '--density is no parameter of rocks'],
    ['export --preset riverbed --seed 1.5', 'whole number'],
    ['export --preset riverbed --seeds 9..1', 'write a range as 1..1000'],
    ['export --preset riverbed --seeds 1..99999999', 'more than 1000000 scenes'],
    ['export --preset riverbed --jobs 0', '--jobs 0: it must be a whole number from 1'],
    ['export --preset riverbed --seeds 1,2 --out {sed}.glb', 'Did you mean {seed}?'],
    ['export --preset riverbed --seeds 1,2 --out r.glb', 'put {seed} into it'],
    ['export --preset riverbed --format stl --out r.glb', 'let the name end in .stl'],
    ['export --preset riverbed --format obj --hulls unreal', 'hulls'],
    ['export --preset wrinkled-colony --mesh kit', 'every wood ear has its own shape'],
    ['maps --preset wrinkled-colony', 'wood ears have none'],
    ['export --link v=2&preset=riverbed', 'the link is of version 2, and this rock-field reads version 1'],
    ['export --link v=1&preset=riverbd', 'Did you mean riverbed?'],
    ['export --link https://example.org/', 'this is no link to a scene'],
    ['export --out r.glb', 'which scene?'],
    ['export --preset', 'needs a value'],
    ['export --preset --seed 3', 'needs a value'],
    ['export --preset riverbed --solid=yes', 'is a switch'],
  ] as const) {
    const { status, out, err } = rockField(line, cwd);
    assert.equal(status, 2, `${line}: ${err}`);
    assert.ok(err.includes(said), `${line}: ${err}`);
    assert.equal(out, '', line);
  }
  assert.deepEqual(readdirSync(cwd), []);
});

test('a file that is there is neither replaced nor touched, unless that is asked for', () => {
  const cwd = emptyFolder();
  const line = ['export', '--preset', 'scree', ...SMALL, '--seeds', '1,2', '--mesh', 'one', '--out', 's/{seed:3}.glb'];
  assert.equal(rockField(line, cwd).status, 0);
  rmSync(path.join(cwd, 's', '002.glb'));
  const refused = rockField(line, cwd);
  assert.equal(refused.status, 2);
  assert.match(refused.err, /001\.glb is there already/);
  assert.equal(existsSync(path.join(cwd, 's', '002.glb')), false);
  const rest = rockField([...line, '--skip-existing'], cwd);
  assert.deepEqual([rest.status, rest.out.trim().split('\n').length], [0, 1]);
  assert.equal(
    rockField([...line, '--force'], cwd)
      .out.trim()
      .split('\n').length,
    2,
  );
});

test('a file says the same of its colours whether they were asked for by name or are those of its preset', async () => {
  const request = { preset: 'scree', imageWidth: 48, imageHeight: 48 } as const;
  const hashes = [{}, { color: 'preset' }, { color: 'natural' }] as const;
  const [plain, ...others] = await Promise.all(hashes.map(async (options) => sha256((await exportScene(request, options)).bytes)));
  assert.deepEqual(others, [plain, plain]);
});
