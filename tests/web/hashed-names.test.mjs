// What `npm run build` leaves in dist/: one build's files, and those of former ones where they are kept.
import assert from 'node:assert/strict';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, utimesSync, writeFileSync } from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { test } from 'node:test';
import { filesIn, HASHED, plainName, publish } from '../../scripts/build/hashed-names.mjs';

/** Files, by name with their content, in a folder of their own. */
function folderWith(files) {
  const folder = mkdtempSync(path.join(os.tmpdir(), 'hashed-names-'));
  for (const [name, text] of Object.entries(files)) {
    mkdirSync(path.dirname(path.join(folder, name)), { recursive: true });
    writeFileSync(path.join(folder, name), text);
  }
  return folder;
}

test('a build replaces the one that was there, or leaves its hashed files of the last month beside', () => {
  for (const keep of [false, true]) {
    const dist = folderWith({
      'index.html': 'old',
      'worker-AAAAAAAA.js': 'old',
      'gone-BBBBBBBB.css': 'older',
      'old.js': 'old',
      'types/a.d.ts': 'old',
    });
    const long = new Date(Date.now() - 40 * 24 * 3600 * 1000);
    utimesSync(path.join(dist, 'gone-BBBBBBBB.css'), long, long);
    const staging = folderWith({ 'index.html': 'new', 'worker-CCCCCCCC.js': 'new', 'docs/index.html': 'new' });
    publish(staging, dist, { keep });
    assert.deepEqual(filesIn(dist).sort(), [
      'docs/index.html',
      'index.html',
      ...(keep ? ['worker-AAAAAAAA.js'] : []),
      'worker-CCCCCCCC.js',
    ]);
    assert.equal(readFileSync(path.join(dist, 'index.html'), 'utf8'), 'new');
    rmSync(dist, { recursive: true });
  }
});

test('names with a hash are told from others', () => {
  for (const name of ['chunk-2B4SO27Z.js', 'generator_bg-6DA3B806.wasm', 'page-V4TWGZ6V.css', 'docs/docs-ZPPN6GXI.js.map'])
    assert.match(name, HASHED);
  for (const name of ['rock-field.js', 'wood-ear-log.js', 'generator_bg.wasm', 'custom-elements.json']) assert.doesNotMatch(name, HASHED);
  assert.equal(plainName('/wood-ear-worker-BV6DS75R.js?x'), '/wood-ear-worker.js?x');
});
