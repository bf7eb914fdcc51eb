// `rock-field batch`: what is made, what is left as it is, and what is refused, on one thread and in processes that die.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { createHash } from 'node:crypto';
import { existsSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, renameSync, rmSync, statSync, writeFileSync } from 'node:fs';
import os, { hostname } from 'node:os';
import path from 'node:path';
import { after, test } from 'node:test';
import { exportScene } from 'rock-field/export';
import { batchOf, putFirst } from '../../www/cli/batch/batch-file.ts';
import { MerkleTree } from '../../www/cli/batch/merkle.ts';
import { PER_FOLDER, groupOf, isSceneOf, scenePath } from '../../www/cli/batch/folder.ts';
import { readRecord } from '../../www/cli/batch/record.ts';
import { rockField, CLI } from './command-line.ts';
import type { Ran } from './command-line.ts';

const folder = mkdtempSync(path.join(os.tmpdir(), 'rock-field-batch-'));
after(() => rmSync(folder, { recursive: true, force: true }));

const SMALL = ['--image-width', '64', '--image-height', '64'];
const SIX = ['--preset', 'journal-fig1', '--seeds', '1..6', ...SMALL];

let count = 0;
const fresh = (): string => path.join(folder, `out-${++count}`);
const batch = (...args: string[]): Promise<Ran> => rockField(['batch', ...args]);
const statuses = ({ lines }: Ran): Record<string, number> => {
  const counts: Record<string, number> = {};
  for (const { status } of lines) counts[String(status)] = (counts[String(status)] ?? 0) + 1;
  return counts;
};
const last = ({ lines }: Ran): Record<string, unknown> => lines.at(-1)!;
const fileOf = (out: string, { lines }: Ran, index: number): string =>
  path.join(out, String(lines.find((line) => line.index === index)!.file));
function list(name: string, ...lines: string[]): string {
  const file = path.join(folder, name);
  writeFileSync(file, lines.join('\n'));
  return file;
}
const filesBelow = (out: string): string[] =>
  readdirSync(out, { recursive: true, encoding: 'utf8' })
    .filter((name) => statSync(path.join(out, name)).isFile())
    .sort();

/** The files of items, without those that are being written. */
const scenesBelow = (out: string): string[] =>
  filesBelow(out).filter((name) => name.startsWith('scenes') && !path.basename(name).startsWith('.'));

test('the Merkle tree is that of RFC 6962', () => {
  // The vectors of Certificate Transparency's reference implementation.
  const leaves = ['', '00', '10', '2021', '3031', '40414243', '5051525354555657', '606162636465666768696a6b6c6d6e6f'];
  const tree = new MerkleTree();
  const roots = [tree.root()];
  for (const leaf of leaves) {
    tree.add(Buffer.from(leaf, 'hex'));
    roots.push(tree.root());
  }
  assert.equal(roots[0], 'e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855');
  assert.equal(roots[1], '6e340b9cffb37a989ca544e6bb780a2c78901d3fb33738768511a30617afa01d');
  assert.equal(roots[3], 'aeb6bcfe274b70a14fb067a5e5578264db0fa9b51af5e0ba159158f329e06e77');
  assert.equal(roots[8], '5dc9da79a70659a9ad559cb701ded9a2ab9d823aad2f4960cfe370eff4604328');
});

test('no folder has more than a thousand files, and a name tells its item alone', () => {
  assert.equal(scenePath(17, 'riverbed-7.glb'), 'scenes/000/000017-riverbed-7.glb');
  const groups = Array.from({ length: 100_000 }, (_, index) => groupOf(index));
  assert.equal(new Set(groups).size, 100_000 / PER_FOLDER);
  assert.ok(isSceneOf(1017, 'scenes/001/001017-riverbed-7.glb'));
  for (const wrong of [
    'scenes/000/001017-riverbed-7.glb',
    'scenes/001/001016-riverbed-7.glb',
    'scenes/001/../../001017-x',
    '/scenes/001/001017-x',
  ])
    assert.ok(!isSceneOf(1017, wrong), wrong);
});

test('the root is the same whatever the number of shards, and files are those of an export', async () => {
  const [one, three] = [fresh(), fresh()];
  const whole = await batch(...SIX, '--out', one);
  assert.deepEqual([whole.code, statuses(whole)], [0, { made: 6 }]);
  for (const shard of [2, 0, 1]) assert.deepEqual(statuses(await batch(...SIX, '--shard', `${shard}/3`, '--out', three)), { made: 2 });
  const roots = [last(await batch('merge', one)), last(await batch('merge', three))];
  assert.equal(roots[0]!.status, 'merged');
  assert.deepEqual(roots[0], roots[1]);
  assert.deepEqual(readFileSync(path.join(one, 'manifest.json')), readFileSync(path.join(three, 'manifest.json')));
  const { bytes } = await exportScene({ preset: 'journal-fig1', seed: 3, imageWidth: 64, imageHeight: 64 });
  assert.deepEqual(readFileSync(fileOf(one, whole, 2)), Buffer.from(bytes));
  const manifest = JSON.parse(readFileSync(path.join(one, 'manifest.json'), 'utf8'));
  assert.deepEqual([manifest.items, manifest.files.length, manifest.merkle], [6, 6, roots[0]!.merkle]);
  assert.equal(manifest.files[2][2], createHash('sha256').update(bytes).digest('hex'));
});

test('what is there and whole is left as it is; what is missing, corrupt, of another key or without a record is made again, and nothing else', async () => {
  const out = fresh();
  const first = await batch(...SIX, '--out', out);
  const root = last(await batch('verify', out)).merkle;
  const [corrupt, missing] = [fileOf(out, first, 1), fileOf(out, first, 4)];
  const bytes = readFileSync(corrupt);
  bytes[bytes.length - 1]! ^= 1;
  writeFileSync(corrupt, bytes);
  rmSync(missing);
  rmSync(path.join(out, 'records/000/000005.json'));
  writeFileSync(path.join(out, 'records/000/000000.json'), '{"batch": "');
  const other = path.join(out, 'records/000/000003.json');
  writeFileSync(
    other,
    readFileSync(other, 'utf8').replace(/"key":"./, (text) => `${text.slice(0, -1)}${text.endsWith('0') ? 1 : 0}`),
  );
  const found = await batch('verify', out);
  assert.equal(found.code, 1);
  const named = found.lines.slice(0, -1).map(({ status, index }) => [status, index]);
  assert.deepEqual(named, [
    ['missing', 0],
    ['corrupt', 1],
    ['missing', 3],
    ['missing', 4],
    ['missing', 5],
  ]);
  assert.equal((await batch('merge', out)).code, 1);
  assert.ok(!existsSync(path.join(out, 'manifest.json')));
  const again = await batch(...SIX, '--out', out);
  assert.deepEqual(
    again.lines
      .filter(({ status }) => status === 'made')
      .map(({ index }) => index)
      .sort(),
    [0, 1, 3, 4, 5],
  );
  assert.deepEqual(last(await batch('merge', out)).merkle, root);
});

test('what a file could not have is told in its line, and once on a terminal, as by export', async () => {
  const scene = ['--preset', 'scree', ...SMALL, '--textures', '1k'];
  const exported = await rockField(['export', ...scene, '--out', `${fresh()}/`]);
  const ran = await batch(...scene, '--out', fresh());
  assert.ok((last(ran).notes as string[]).includes('no-device'));
  assert.deepEqual(last(ran).notes, last(exported).notes);
  const { err } = await rockField(['batch', ...scene, '--seeds', '1..3', '--out', fresh()], { isTTY: true });
  assert.match(err, /note: .*graphics device.* \(in all files\)/);
  assert.equal(err.split('note: ').length - 1, (last(exported).notes as string[]).length);
});

test('foreign files are named, and do not stand in the way of the manifest', async () => {
  const out = fresh();
  await batch(...SIX, '--out', out);
  writeFileSync(path.join(out, 'scenes/000/holiday.jpg'), 'x');
  writeFileSync(path.join(out, 'scenes/000/000003-other.glb'), 'x');
  mkdirSync(path.join(out, 'scenes/777'));
  writeFileSync(path.join(out, 'scenes/000/.DS_Store'), 'x');
  const found = await batch('verify', out);
  assert.equal(found.code, 1);
  const foreign = found.lines.filter(({ status }) => status === 'foreign').map(({ file }) => file);
  assert.deepEqual(foreign, ['scenes/000/000003-other.glb', 'scenes/000/holiday.jpg', 'scenes/777']);
  assert.match(found.err, /3 files do not belong there/);
  assert.equal((await batch('merge', out)).code, 0);
  const manifest = path.join(out, 'manifest.json');
  const said = readFileSync(manifest, 'utf8');
  const ofAnother = said.replace(/"(?=[\da-f]{64}"\])/, '"0').replace(/"0([\da-f]{63})[\da-f]"/, '"0$1"');
  for (const other of [
    said.replace(/"merkle":"./, '"merkle":"x'),
    said.slice(0, 200),
    ofAnother,
    said.replace('journal-fig1-1', 'journal-fig1-9'),
  ]) {
    assert.notEqual(other, said);
    writeFileSync(manifest, other);
    const { lines } = await batch('verify', out);
    assert.deepEqual(lines.filter(({ status }) => status === 'foreign').at(-1), { status: 'foreign', file: 'manifest.json' });
  }
  writeFileSync(manifest, said);
  assert.equal(last(await batch('verify', out)).foreign, 3);
});

test('no byte of a record can change without a word, whether there is a manifest or not', async () => {
  const out = fresh();
  await batch('--preset', 'journal-fig1', ...SMALL, '--out', out);
  const record = path.join(out, 'records/000/000000.json');
  const bytes = readFileSync(record);
  for (let at = 0; at < bytes.length - 1; at++) {
    const changed = Buffer.from(bytes);
    changed[at]! ^= 1;
    writeFileSync(record, changed);
    assert.ok(readRecord(out, 0) === null, `byte ${at}: ${changed}`);
  }
  writeFileSync(record, bytes);
  assert.equal((await batch('verify', out)).code, 0);
});

test('merges at once all end well: none removes what another is writing', async () => {
  const out = fresh();
  await batch(...SIX, '--out', out);
  // Of this process, which lives; of one that is gone; and of another machine.
  const [living, dead, elsewhere] = [`${hostname()}.${process.pid}`, `${hostname()}.${2 ** 22 + 1}`, 'another-machine.1'].map((whose) =>
    path.join(out, `.rock-field-${whose}.7.7.tmp`),
  ) as [string, string, string];
  for (const file of [living, dead, elsewhere]) writeFileSync(file, 'x');
  assert.equal((await batch('merge', out)).code, 0);
  assert.deepEqual(
    [living, dead, elsewhere].map((file) => existsSync(file)),
    [true, false, false],
  );
});

test('a folder of another list, other options, another version or no batch is refused before anything is written', async () => {
  const out = fresh();
  await batch(...SIX, '--out', out);
  const before = filesBelow(out);
  const refused = async (words: RegExp, ...args: string[]): Promise<void> => {
    const ran = await batch(...args, '--out', out);
    assert.equal(ran.code, 2, ran.err);
    assert.match(ran.err, words);
    assert.deepEqual(filesBelow(out), before);
  };
  await refused(/its list has other scenes/, '--preset', 'journal-fig1', '--seeds', '2..7', ...SMALL);
  await refused(/its list has 6 scenes, and this one 5/, '--preset', 'journal-fig1', '--seeds', '2..6', ...SMALL);
  await refused(/its mesh is "rocks", and here it is "one"/, ...SIX, '--mesh', 'one');
  const file = path.join(out, 'batch.json');
  const said = readFileSync(file, 'utf8');
  writeFileSync(file, said.replace(/"version": "[^"]+"/, '"version": "0.1.9"'));
  await refused(/it was made by rock-field 0\.1\.9/, ...SIX);
  writeFileSync(file, said.replace('"rockField": 1', '"rockField": 99'));
  await refused(/another version of rock-field, or has been changed/, ...SIX);
  renameSync(file, path.join(folder, 'lost.json'));
  before.splice(before.indexOf('batch.json'), 1);
  await refused(/has files in it, but no batch\.json/, ...SIX);
  assert.equal((await batch('verify', out)).code, 2);
});

test('a list has links or parameters with options of their own, and comments; the same scenes in other words are the same list', async () => {
  const out = fresh();
  const lines = [
    '# three scenes',
    'https://example.com/#v=1&preset=journal-fig1&seed=1&w=64&h=64',
    '',
    '  {"preset": "journal-fig1", "seed": 2, "imageWidth": 64, "imageHeight": 64, "export": {"format": "stl"}}',
    '{"preset": "thesis-default", "rings": 4, "meridians": 9, "range": 20, "seed": 3, "export": {"mesh": "one"}}',
  ];
  const ran = await batch(list('three.txt', ...lines), '--out', out);
  assert.equal(ran.code, 0, ran.err);
  const files = ran.lines.map(({ file }) => file).sort();
  assert.deepEqual(files, [
    'scenes/000/000000-journal-fig1-1.glb',
    'scenes/000/000001-journal-fig1-2.stl',
    'scenes/000/000002-thesis-default-3.glb',
  ]);
  const others = [
    '{"imageHeight": 64, "imageWidth": 64, "seed": 1}',
    '{"link": "preset=journal-fig1&w=64&h=64&seed=2", "export": {"format": "stl"}}\r',
    lines[4]!,
  ];
  assert.deepEqual(statuses(await batch(list('same.txt', ...others), '--out', out)), { skipped: 3 });
});

test('a slip in any line is told with what was meant, in every shard, and nothing is written', async () => {
  const good = 'preset=journal-fig1&seed=1&w=64&h=64';
  const cases: [string, RegExp][] = [
    ['preset=riverbad&seed=1', /line 2: .*riverbad.* Did you mean riverbed\?/],
    ['v=9&preset=riverbed&seed=1', /line 2: the link is of version 9/],
    ['preset=riverbed&seed=1&sed=3', /line 2: .*sed/],
    ['preset=riverbed&seed=-1', /line 2: .*seed/],
    ['{"preset": "riverbed", "seeed": 1}', /line 2: .*seeed.* Did you mean seed\?/],
    ['{"preset": "riverbed", "layers": [{"radus": 9}]}', /line 2: .*radus.* Did you mean radius\?/],
    ['{"preset": "riverbed", "seed": 1.5}', /line 2: .*seed/],
    ['{"preset": "riverbed"', /line 2: .*JSON/],
    ['{"preset": "riverbed", "export": {"mash": "one"}}', /line 2: .*mash.* Did you mean mesh\?/],
    ['{"preset": "riverbed", "export": {"format": "stl", "mesh": "kit"}}', /line 2: .*mesh/],
    ['{"preset": "riverbed", "export": 5}', /line 2: export/],
    ['what is this', /line 2: this is no link/],
  ];
  const out = fresh();
  for (const [line, words] of cases) {
    const ran = await batch(list('bad.txt', good, line, good), '--shard', '0/3', '--out', out);
    assert.equal(ran.code, 2, `${line}: ${ran.err}`);
    assert.match(ran.err, words);
  }
  const many = await batch(list('many.txt', ...Array.from({ length: 30 }, () => 'preset=riverbad')), '--out', out);
  assert.match(many.err, /… and 20 more/);
  assert.ok(!existsSync(out));
});

test('what a shard, a folder or a list cannot be is refused in words', async () => {
  // As Windows PowerShell writes what is led to a file.
  const utf16 = list('utf16.txt');
  writeFileSync(utf16, '\ufeffpreset=journal-fig1&seed=1\r\n', 'utf16le');
  const file = list('one.txt', 'preset=journal-fig1&w=64&h=64');
  const out = fresh();
  const cases: [string[], RegExp][] = [
    [[file, '--out', out, '--shard', '0/0'], /0\/0; there must be at least one shard/],
    [[file, '--out', out, '--shard', '160/160'], /160\/160; shards are counted from 0, so that the last of 160 is 159\/160/],
    [[file, '--out', out, '--shard', '17'], /it must be like 17\/160/],
    [[file, '--out', out, '--shard', '-1/4'], /it must be like 17\/160/],
    [[file, '--out', out, '--shard', '0/9999999'], /at most 1000000/],
    [[file], /--out is missing/],
    [['--out', out], /which scene\?/],
    [[file, '--out', out, '--preset', 'riverbed'], /--preset and a list cannot be given together/],
    [[file, file, '--out', out], /two lists/],
    [[path.join(folder, 'nothing.txt'), '--out', out], /nothing\.txt cannot be read: there is no such file or folder$/m],
    [[folder, '--out', out], /cannot be read: there is a folder of this name$/m],
    [[utf16, '--out', out], /utf16\.txt is no text in UTF-8/],
    [['verfy', out], /Did you mean rock-field batch verify\?/],
    [[list('empty.txt', '# nothing'), '--out', out], /no lines with a scene/],
    [[file, '--out', out, '--mash', 'one'], /Did you mean --mesh\?/],
    [[file, '--out', file], /one\.txt is a file/],
    [['verify'], /followed by one folder/],
    [['verify', folder], /no folder of a batch/],
    [['merge', folder, '--target', 'blender'], /does not take --target/],
  ];
  for (const [args, words] of cases) {
    const ran = await batch(...args);
    assert.equal(ran.code, 2, `${args.join(' ')}: ${ran.err}`);
    assert.match(ran.err, words);
  }
  assert.ok(!existsSync(out));
});

test('an item that cannot be made fails alone, and a folder that cannot be written to ends the run', async () => {
  const out = fresh();
  const heavy = '{"imageWidth": 64, "imageHeight": 64, "seed": 1, "export": {"format": "png", "side": 16384, "map": "splat"}}';
  const ran = await batch(list('heavy.txt', 'preset=journal-fig1&w=64&h=64', heavy, 'preset=journal-fig1&w=64&h=64&seed=2'), '--out', out);
  assert.deepEqual([ran.code, statuses(ran)], [1, { made: 2, failed: 1 }]);
  const { error } = ran.lines.find(({ status }) => status === 'failed') as { error: { name: string; message: string } };
  assert.equal(error.name, 'ExportTooLarge');
  assert.match(ran.err, /item 1 /);
  assert.equal((await batch('merge', out)).code, 1);
  const blocked = fresh();
  mkdirSync(blocked);
  await batch(...SIX, '--shard', '0/6', '--out', blocked);
  rmSync(path.join(blocked, 'scenes'), { recursive: true });
  writeFileSync(path.join(blocked, 'scenes'), 'a file where a folder should be');
  const storage = await batch(...SIX, '--out', blocked, '--jobs', '1');
  assert.equal(storage.code, 3, storage.err);
  assert.match(storage.err, /files cannot be written/);
});

test('the list that the documentation shows is one', async () => {
  const page = readFileSync(new URL('../../www/docs/pages/cluster.md', import.meta.url), 'utf8');
  const [, shown] = /```text scenes\.txt\n(.*?)```/s.exec(page)!;
  const ran = await batch('plan', list('shown.txt', shown!));
  assert.deepEqual([ran.code, last(ran).items], [0, 4], ran.err);
});

test('plan says how many scenes there are, refuses a foreign folder, and writes nothing', async () => {
  const out = fresh();
  const ran = await batch('plan', ...SIX, '--out', out);
  assert.deepEqual([ran.code, last(ran).items], [0, 6]);
  assert.ok(!existsSync(out));
  await batch(...SIX, '--out', out);
  assert.equal((await batch('plan', ...SIX, '--out', out, '--mesh', 'one')).code, 2);
});

/** A run in a process of its own; `kill` ends it after the first item that it tells of. */
function running(args: readonly string[], kill?: NodeJS.Signals): Promise<{ code: number | null; out: string; err: string }> {
  return new Promise((resolve) => {
    const child = spawn(process.execPath, [CLI, 'batch', ...args]);
    const said = { out: '', err: '' };
    child.stdout.on('data', (data) => {
      said.out += String(data);
      if (kill) child.kill(kill);
    });
    child.stderr.on('data', (data) => (said.err += String(data)));
    child.on('close', (code) => resolve({ code, ...said }));
  });
}

test('a run that is killed leaves no half file, and the same command makes what is missing', {
  skip: process.platform === 'win32',
}, async () => {
  const forty = ['--preset', 'journal-fig1', '--seeds', '1..40', ...SMALL];
  const straight = fresh();
  await batch(...forty, '--out', straight);
  const { merkle } = last(await batch('merge', straight));
  const ends = { SIGKILL: null, SIGTERM: 143, SIGINT: 130 } as const;
  for (const [signal, code] of Object.entries(ends)) {
    const out = fresh();
    const ran = await running([...forty, '--out', out, '--jobs', '1'], signal as NodeJS.Signals);
    assert.equal(ran.code, code, ran.err);
    if (code !== null) assert.match(ran.err, /the same command makes the others/);
    // Also one that no record tells of yet.
    for (const name of scenesBelow(out))
      assert.ok(readFileSync(path.join(out, name)).equals(readFileSync(path.join(straight, name))), `${signal}: ${name} is a half file`);
    const found = await batch('verify', out);
    assert.deepEqual([found.code, last(found).corrupt, last(found).foreign], [1, 0, 0], signal);
    const there = Number(last(found).whole);
    const again = statuses(await batch(...forty, '--out', out));
    assert.ok(there > 0 && (again.skipped ?? 0) >= there, `${signal}: ${there} were there, ${JSON.stringify(again)}`);
    assert.equal(last(await batch('merge', out)).merkle, merkle);
    assert.deepEqual(
      filesBelow(out).filter((name) => name.includes('.tmp')),
      [],
    );
  }
});

test('runs into one folder at once, of one shard or of two lists, end as one after the other would', async () => {
  const twelve = ['--preset', 'journal-fig1', '--seeds', '1..12', ...SMALL];
  const [out, straight, contested] = [fresh(), fresh(), fresh()];
  const runs = await Promise.all([0, 1, 2].map(() => running([...twelve, '--out', out, '--jobs', '1'])));
  assert.deepEqual(
    runs.map(({ code, err }) => [code, err]),
    [0, 1, 2].map(() => [0, '']),
  );
  await batch(...twelve, '--out', straight);
  assert.equal(last(await batch('merge', out)).merkle, last(await batch('merge', straight)).merkle);
  // The first to come has the folder; the other is refused, and has written nothing.
  const nobodys = fresh();
  const [one, other] = ['1', '2'].map((digit) => batchOf(6, digit.repeat(64), {}));
  putFirst(nobodys, one);
  putFirst(nobodys, one);
  assert.throws(() => putFirst(nobodys, other), /belongs to another batch/);
  assert.match(readFileSync(path.join(nobodys, 'batch.json'), 'utf8'), /"list": "1+"/);
  assert.deepEqual(readdirSync(nobodys), ['batch.json']);
  const two = await Promise.all(
    [1, 2].map((first) => running(['--preset', 'journal-fig1', '--seeds', `${first}..6`, ...SMALL, '--out', contested])),
  );
  assert.deepEqual(two.map(({ code }) => code).sort(), [0, 2]);
  assert.equal((await batch('verify', contested)).code, 0);
});

test('when nobody reads what it tells, it ends, as a run has to whose worker has died', async () => {
  const out = fresh();
  const child = spawn(process.execPath, [
    CLI,
    'batch',
    '--preset',
    'journal-fig1',
    '--seeds',
    '1..2000',
    ...SMALL,
    '--out',
    out,
    '--jobs',
    '1',
  ]);
  child.stdout.once('data', () => child.stdout.destroy());
  const code = await new Promise((resolve) => child.on('close', resolve));
  assert.equal(code, 141);
  assert.ok(Number(last(await batch('verify', out)).whole) < 2000);
});
