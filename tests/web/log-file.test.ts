// Log files of any kind: what a file is told that is no log, too large or gone, and how far the reading is.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { FARTHEST, MOST_TRIANGLES, MOST_VERTICES } from '../../www/wood-ear/log-file/limits.ts';
import { readLogFile } from '../../www/wood-ear/log-file/read.ts';
import { shown } from '../../www/base/file-name.ts';
import { QUAD, given, refusal } from './log-files.ts';

test('a file of another format is told what it is', async () => {
  const stl = new Uint8Array(84 + 50);
  stl[80] = 1;
  const cases: [string, BlobPart, RegExp][] = [
    ['log.fbx', 'Kaydara FBX Binary  \0', /is an FBX file/],
    ['log.stl', stl, /is an STL file/],
    ['text.stl', 'solid log\nfacet normal 0 0 1\n', /is an STL file/],
    ['log.ply', 'ply\nformat ascii 1.0\n', /is a PLY file/],
    ['log.blend', 'BLENDER-v400', /is a Blender file/],
    ['log.dae', '<?xml version="1.0"?>\n<COLLADA>', /is a COLLADA file/],
    ['log.glb.gz', Uint8Array.of(0x1f, 0x8b, 8, 0), /is a gzip archive; unpack it/],
    ['log.zip', 'PK\x03\x04', /is a ZIP archive; unpack it/],
    ['log.mtl', '# Blender\nnewmtl bark\nKd 1 1 1\n', /is a material library/],
    ['bark.png', Uint8Array.of(0x89, 0x50, 0x4e, 0x47), /is a picture/],
    ['page.glb', '<!doctype html><title>404</title>', /is a web page/],
    ['data.json', '{"a": 1}', /is JSON, but neither a glTF nor an OBJ/],
    ['empty.obj', '', /is empty/],
  ];
  for (const [file, content, words] of cases) {
    const { name, message } = await refusal(given(file, content));
    assert.equal(name, 'LogFileUnknown', file);
    assert.match(message, words);
  }
});

test('names and quotes of files are short in messages, and cannot break or reorder their line', async () => {
  const { message } = await refusal(given(`${'x'.repeat(5000)}\n\u202e.obj`, 'v 1 2'));
  assert.ok(message.length < 200, message);
  assert.match(message, /^x+….*\.obj, line 1/);
  assert.ok(!/[\n\u202e]/.test(message));
  assert.ok((await refusal(given('log.obj', `v ${'9,'.repeat(100_000)} 1 1`))).message.length < 250);
  assert.equal(shown('log.obj'), 'log.obj');
});

test('a file over the limit is not opened, one that is gone is said to be gone', async () => {
  const huge = given('huge.obj', 'v 0 0 0');
  Object.defineProperty(huge, 'size', { value: 62 * 2 ** 20 });
  Object.defineProperty(huge, 'arrayBuffer', { value: () => assert.fail('opened') });
  const { name, message, value, max } = await refusal(huge);
  assert.deepEqual([name, value, max], ['LogFileTooLarge', 62 * 2 ** 20, 48 * 2 ** 20]);
  assert.match(message, /^huge\.obj is 62 MB; a log file may be at most 48 MB$/);
  const gone = given('gone.obj', 'v 0 0 0');
  Object.defineProperty(gone, 'arrayBuffer', { value: () => Promise.reject(new DOMException('no', 'NotReadableError')) });
  assert.equal((await refusal(gone)).name, 'LogFileUnreadable');
});

test('the limits are the generator’s', () => {
  const rust = readFileSync(new URL('../../src/wood_ear/user_log.rs', import.meta.url), 'utf8');
  const constant = (name: string) => Number(new RegExp(`${name}:\\s*usize\\s*=\\s*([\\d_]+)`).exec(rust)?.[1]?.replaceAll('_', ''));
  assert.deepEqual([constant('MOST_VERTICES'), constant('MOST_TRIANGLES')], [MOST_VERTICES, MOST_TRIANGLES]);
  assert.equal(Number(/REACH:\s*f64\s*=\s*([\d_.]+)/.exec(rust)?.[1]?.replaceAll('_', '')), FARTHEST);
});

test('how far the reading is goes from 0 up and never back', async () => {
  const told: number[] = [];
  await readLogFile(given('log.obj', `${QUAD}${'# bark\n'.repeat(5000)}f 1 2 3 4\n`), { onProgress: (fraction) => told.push(fraction) });
  assert.ok(told.length > 10 && told.every((fraction, k) => fraction >= (told[k - 1] ?? 0) && fraction <= 1));
});
