/** The command line, as it is typed: `dist/cli.js` in processes of its own, in folders of their own. */

import assert from 'node:assert/strict';
import { spawn, spawnSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { chmodSync, closeSync, existsSync, mkdtempSync, openSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { once } from 'node:events';
import os from 'node:os';
import path from 'node:path';
import { after, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { unzipSync } from 'fflate';
import { generate } from 'rock-field/core';
import { exportScene } from 'rock-field/export';
import { rockField as onTerminal } from './command-line.ts';

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
    ['export --preset riverbed --seed 1..9', 'several are --seeds 1..9'],
    ['export --preset riverbed,scree', 'Several are --preset riverbed --preset scree.'],
    ['export --preset riverbed --out rocks', 'is that the file rocks.glb, or, with / at its end, the folder rocks/?'],
    ['export --preset riverbed --out r.gbl', '.gbl is no kind of file that is written here. Did you mean r.glb?'],
    ['export --preset riverbed --out r.gltf', '.gltf is no kind of file that is written here: glb, obj, stl'],
    ['export --preset riverbed --target unreal --out r.{seed}', '.0 is no kind of file'],
    ['maps --preset riverbed --map height --out h.tif', '.tif is no kind of file that is written here: png, r16, exr, zip. With --format'],
    ['generate --preset riverbed --out f.npy', '.npy is no kind of file that is written here. Did you mean f.npz?'],
    ['export riverbed', 'Did you mean --preset riverbed?'],
    ['export v=1&preset=riverbed', 'Did you mean --link?'],
    ['generate nothing', '"nothing" belongs to no option.'],
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

test('a slip in parameters as JSON is told with what was meant', () => {
  const cwd = emptyFolder();
  writeFileSync(path.join(cwd, 'p.json'), '{"preset": "scree", "imageWidht": 48}');
  const { err } = rockField('export --from p.json', cwd);
  assert.match(err, /^rock-field: p\.json: there is no parameter called "imageWidht"\. Did you mean imageWidth\?$/m);
});

test('with --format a file may end as other programs want it', () => {
  const { status, err, cwd } = rockField([
    'maps',
    '--preset',
    'riverbed',
    ...SMALL,
    '--map',
    'height',
    '--format',
    'r16',
    '--out',
    'height.raw',
  ]);
  assert.equal(status, 0, err);
  assert.equal(readFileSync(path.join(cwd, 'height.raw')).length, 48 * 48 * 2);
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

test('one scene that cannot be made does not keep the others from being made, and the exit code tells', () => {
  const huge = 'v=1&preset=journal-fig1&w=8192&h=8192&r=1&a=1&n=-';
  const line = [
    'export',
    '--link',
    huge,
    '--preset',
    'scree',
    '--preset',
    'riverbed',
    '--seeds',
    '1,2',
    '--mesh',
    'one',
    '--out',
    '{preset}-{seed}.glb',
  ];
  const { status, out, err, cwd } = rockField([...line, '--link', 'v=1&preset=moraine&w=48&h=48']);
  const lines = out
    .trim()
    .split('\n')
    .map((text) => JSON.parse(text));
  assert.equal(status, 1, err);
  assert.deepEqual(lines.flatMap(({ preset, seed, error }) => (error ? [`${preset} ${seed} ${error.name} ${error.key}`] : [])).sort(), [
    'journal-fig1 1 OverBudget radius',
    'journal-fig1 2 OverBudget radius',
  ]);
  assert.equal(readdirSync(cwd).length, 6);
  assert.match(err, /2 of 8 could not be made; the others are there/);
});

test('info names the command that makes a file again, which makes it again to the last byte, and --check sees a change', () => {
  const { cwd } = rockField([
    'export',
    '--preset',
    'scree',
    '--seed',
    '3',
    ...SMALL,
    '--target',
    'unreal',
    '--lods',
    '2',
    '--metres-per-pixel',
    '0.02',
    '--out',
    'a.glb',
  ]);
  const { again, options, link } = JSON.parse(rockField('info a.glb --json', cwd).out);
  assert.equal(link, 'v=1&preset=scree&seed=3&w=48&h=48');
  assert.deepEqual(options, { solid: true, lods: 2, hulls: 'unreal', metresPerPixel: 0.02 });
  const words = [...again.matchAll(/'([^']*)'|(\S+)/g)].map(([, quoted, plain]) => quoted ?? plain).slice(1);
  assert.equal(rockField([...words, '--out', 'b.glb'], cwd).status, 0);
  const [one, other] = ['a.glb', 'b.glb'].map((name) => readFileSync(path.join(cwd, name)));
  assert.ok(one.equals(other));
  assert.equal(rockField('info b.glb --check', cwd).status, 0);
  other[other.length - 8] ^= 1;
  writeFileSync(path.join(cwd, 'b.glb'), other);
  const changed = rockField('info b.glb --check', cwd);
  assert.deepEqual([changed.status, /the scene is the same/.test(changed.out), /the file differs/.test(changed.out)], [1, true, true]);
});

test('info reads what each command writes, and says why it cannot read the rest', () => {
  const { cwd } = rockField(['maps', '--preset', 'scree', ...SMALL, '--map', 'splat', '--map', 'height', '--out', '{map}.png']);
  for (const line of [
    'maps --out m.zip',
    'maps --map all --out n.zip',
    'generate --out d.json',
    'generate --out d.npz',
    'export --parts 2 --out p.zip',
    'export --out s.stl',
  ]) {
    const { status, err } = rockField([...line.split(' '), '--preset', 'scree', ...SMALL], cwd);
    assert.equal(status, 0, `${line}: ${err}`);
  }
  for (const name of ['splat.png', 'height.png', 'm.zip', 'n.zip', 'd.json', 'd.npz', 'p.zip']) {
    const { status, out, err } = rockField(['info', name, '--check'], cwd);
    assert.deepEqual([name, status, err], [name, 0, '']);
    assert.match(out, /rocks, preset scree, seed 0/);
  }
  const stl = rockField('info s.stl', cwd);
  assert.deepEqual([stl.status, stl.err], [1, 'rock-field: s.stl brings no scene back: files of this kind do not say what made them\n']);
  assert.equal(rockField('info none.glb', cwd).status, 2);
});

test('an output that cannot be written is told, and the exit code tells, whatever the command', {
  skip: !existsSync('/dev/full') && 'there is no device that is always full',
}, async () => {
  const { cwd } = rockField(['generate', '--preset', 'scree', ...SMALL, '--out', 'd.json']);
  writeFileSync(path.join(cwd, 'list.txt'), 'preset=scree&w=48&h=48');
  for (const line of ['--help', '--version', 'presets --json', 'schema', 'info d.json', 'batch plan list.txt', 'generate --from d.json']) {
    const full = openSync('/dev/full', 'w');
    const { status, stderr } = spawnSync(process.execPath, [CLI, ...line.split(' ')], { cwd, stdio: ['ignore', full, 'pipe'] });
    closeSync(full);
    assert.deepEqual(
      [status, String(stderr).trim()],
      [3, 'rock-field: the output cannot be written: there is no space left on the device'],
      line,
    );
  }
  for (const line of ['presets --json', 'schema', 'generate --from d.json']) {
    const child = spawn(process.execPath, [CLI, ...line.split(' ')], { cwd, stdio: ['ignore', 'pipe', 'pipe'] });
    child.stdout.destroy();
    let err = '';
    child.stderr.on('data', (text) => {
      err += text;
    });
    const [status] = await once(child, 'close');
    assert.deepEqual([status, err.trim()], [141, 'rock-field: whatever read the output has gone'], line);
  }
});

test('a file that may not be read is not called damaged', {
  skip: process.getuid?.() !== 0 && 'only root can become somebody else',
}, (t) => {
  const { cwd } = rockField(['generate', '--preset', 'scree', ...SMALL, '--out', 'd.json']);
  chmodSync(cwd, 0o755);
  chmodSync(path.join(cwd, 'd.json'), 0o600);
  const asNobody = (...args: string[]): { status: number | null; err: string } => {
    const { status, stderr } = spawnSync(process.execPath, [CLI, ...args], { cwd, encoding: 'utf8', uid: 65534, gid: 65534 });
    return { status, err: stderr };
  };
  if (asNobody('--version').status !== 0) return t.skip('nobody else can read the program');
  for (const args of [
    ['info', 'd.json'],
    ['export', '--from', 'd.json'],
  ]) {
    const { status, err } = asNobody(...args);
    assert.deepEqual([status, err.trim()], [2, 'rock-field: d.json cannot be read: permission denied']);
  }
});

test('arrays for NumPy are those of the field, with their shapes', async () => {
  const { cwd } = rockField(['generate', '--preset', 'scree', ...SMALL, '--out', 'f.npz']);
  const files = unzipSync(readFileSync(path.join(cwd, 'f.npz')));
  const field = await generate({ preset: 'scree', imageWidth: 48, imageHeight: 48 });
  for (const [name, values, shape] of [
    ['positions', field.positions, [field.positions.length / 3, 3]],
    ['indices', field.indices, [field.indices.length / 3, 3]],
    ['rockLayer', field.rockLayer, [field.rockLayer.length]],
    ['layer1_sites', field.layers[0].sites, [field.layers[0].sites.length / 2, 2]],
  ] as const) {
    const file = files[`${name}.npy`];
    const length = 10 + new DataView(file.buffer, file.byteOffset).getUint16(8, true);
    const head = new TextDecoder('latin1').decode(file.subarray(0, length));
    assert.equal(length % 64, 0);
    const order = { Float32Array: '<f4', Uint32Array: '<u4', Uint8Array: '|u1' }[values.constructor.name];
    assert.ok(head.startsWith('\x93NUMPY\x01\x00'));
    assert.ok(
      head.includes(`'descr': '${order}', 'fortran_order': False, 'shape': (${shape.join(', ')}${shape.length === 1 ? ',' : ''})`),
      head,
    );
    assert.ok(Buffer.from(file.subarray(length)).equals(Buffer.from(values.buffer, values.byteOffset, values.byteLength)), name);
  }
  assert.equal(JSON.parse(new TextDecoder().decode(files['scene.json'])).rocks, field.stats.rocks);
});

test('a link is read by the generator that it is of, and what it clamps is told', () => {
  const facts = (
    link: string,
  ): { told: { generator: string; preset: string; params: { seed: number; imageHeight: number } }; err: string } => {
    const { status, out, err } = rockField(['generate', '--link', link]);
    assert.equal(status, 0, err);
    return { told: JSON.parse(out), err };
  };
  const ears = facts('https://example.org/wood-ear.html#v=1&preset=dry-colony&seed=4&d=0.02&ground=none');
  assert.deepEqual([ears.told.generator, ears.told.preset, ears.told.params.seed], ['wood-ears', 'dry-colony', 4]);
  const rocks = facts('https://example.org/?utm_source=mail#v=1&seed=4&w=40&h=0&r=12');
  assert.deepEqual([rocks.told.generator, rocks.told.preset, rocks.told.params.imageHeight], ['rocks', 'journal-fig1', 1]);
  assert.match(rocks.err, /h: 0 must be between 1 and 8192; using 1/);
});

test('a terminal is told how far it is and what was made, in words; what it cannot show is not written to it', async () => {
  const scene = ['--preset', 'scree', ...SMALL];
  const { code, out, err } = await onTerminal(['export', ...scene, '--seeds', '1,2', '--out', path.join(emptyFolder(), '{seed}.glb')], {
    isTTY: true,
  });
  assert.equal(code, 0);
  assert.match(out, /^(\S+[12]\.glb {2}\d+ kB\n){2}$/);
  assert.match(err, /\[#*-*\] \d+ % \d of 2/);
  assert.match(err, /2 of 2 files, \d+ kB, in \d+ s\n$/);
  const refused = await onTerminal(['export', ...scene, '--out', '-'], { isTTY: true });
  assert.deepEqual([refused.code, refused.out], [2, '']);
  assert.match(refused.err, /a terminal cannot show this file/);
  const shown = await onTerminal(['export', ...scene, '--format', 'obj', '--out', '-'], { isTTY: true });
  assert.match(shown.out, /^# scree-0/);
  const quiet = await onTerminal(['export', ...scene, '--quiet', '--out', path.join(emptyFolder(), 'q.glb')], { isTTY: true });
  assert.deepEqual([quiet.code, quiet.out, quiet.err], [0, '', '']);
});
