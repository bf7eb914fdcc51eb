// dist/THIRD-PARTY-LICENSES.txt says whose software is in the package. The bundles' source maps and the names that Rust leaves in the artefacts
// are witnesses that the build's own lists do not know of.
import assert from 'node:assert/strict';
import { mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { test } from 'node:test';
import { LICENCES_FILE, chosenOf, packagesOf, partIn } from '../../scripts/build/licences.mjs';
import { dist, root } from '../../scripts/lib/env.mjs';
import { Failure } from '../../scripts/lib/run.mjs';

const written = readFileSync(path.join(dist, LICENCES_FILE), 'utf8');
const [list = '', ...texts] = written.split(/\n-{80}\n(?=Text \d)/);

/** The licence of a part and the numbers of its texts. */
function entryOf(name) {
  const found = new RegExp(`\\n${name.replaceAll('/', '\\/')} \\d\\S*\\n {4}(.*); text ([\\d, ]+)\\n`).exec(`${list}\n`);
  return found && { licence: found[1], texts: found[2].split(', ').map((number) => texts[Number(number) - 1] ?? '') };
}

/** A package in a folder of its own, in the list of what a bundler read. */
function planted(files) {
  const base = mkdtempSync(path.join(os.tmpdir(), 'licences-'));
  const folder = path.join(base, 'node_modules', '@some', 'thing');
  mkdirSync(folder, { recursive: true });
  for (const [name, text] of Object.entries(files)) writeFileSync(path.join(folder, name), text);
  const outputs = { 'dist/a.js': { inputs: { 'www/a.ts': {}, 'node_modules/@some/thing/lib/deep.js': {} } } };
  try {
    return packagesOf([{ outputs }], base);
  } finally {
    rmSync(base, { recursive: true });
  }
}

const described = (license) => JSON.stringify({ name: '@some/thing', version: '1.2.3', license });

test('every npm package that a script or style sheet in dist/ holds a piece of is listed with its licence', () => {
  const maps = readdirSync(dist, { recursive: true, encoding: 'utf8' }).filter((name) => name.endsWith('.map'));
  const sources = maps.flatMap((name) => JSON.parse(readFileSync(path.join(dist, name), 'utf8')).sources);
  const names = new Set(sources.flatMap((source) => /node_modules\/((?:@[^/]+\/)?[^/]+)/.exec(source)?.[1] ?? []));
  assert.ok(names.has('earcut') && names.has('lit-html'), 'the source maps name packages');
  for (const name of names) {
    const entry = entryOf(name);
    assert.ok(entry, `${name} is listed`);
    const own = readFileSync(path.join(root, 'node_modules', name, name === 'meshoptimizer' ? 'LICENSE.md' : 'LICENSE'), 'utf8');
    const holder = /copyright.*\d{4}.*/i.exec(own)?.[0].trim() ?? '';
    assert.ok(holder && entry.texts.some((text) => text.includes(holder)), `${name}: ${holder}`);
  }
});

test('the crates in the artefacts and the Rust standard library are listed, and no crate that only tests or macros use', () => {
  for (const name of ['glam', 'rand', 'robust', 'rlsf', 'spade', 'wasm-bindgen', 'wgpu-core', 'naga', 'hashbrown', 'profiling'])
    assert.ok(entryOf(name), name);
  assert.match(entryOf('Rust standard library')?.licence ?? '', /MIT AND Unicode-3\.0/);
  assert.ok(entryOf('dlmalloc \\(in the Rust standard library\\)'), 'its allocator');
  for (const name of ['peak_alloc', 'serde_json', 'syn', 'wasm-bindgen-test', 'rock-field']) assert.equal(entryOf(name), null, name);
});

test('each text stands there once and is whole, and the file names no folder of the machine that made it', () => {
  assert.ok(texts.length > 20);
  const bodies = texts.map(
    (text) =>
      text
        .split(/\n-{80}\n/)[1]
        ?.replaceAll(/\s+/g, ' ')
        .trim() ?? '',
  );
  assert.equal(new Set(bodies).size, bodies.length);
  for (const body of bodies) assert.ok(body.length > 60, body);
  assert.ok(!written.includes(root) && !written.includes(os.homedir()) && !written.includes('.cargo'));
  assert.ok(!/&#\d+;|\r|<(year|pre)/.test(written), 'it is plain text');
});

test('scripts that people copy alone say where the licences are', () => {
  const { version } = JSON.parse(readFileSync(path.join(root, 'package.json'), 'utf8'));
  for (const name of ['cdn.js', 'wood-ear-cdn.js']) {
    const [first] = readFileSync(path.join(dist, name), 'utf8').split('\n');
    assert.equal(first, `/*! rock-field ${version} | MIT OR Apache-2.0 | third-party licences: ${LICENCES_FILE} */`);
  }
});

test('a package without a licence, or without its text, fails the build by its name', () => {
  assert.throws(() => planted({ 'package.json': described(undefined) }), failure('@some/thing 1.2.3 is bundled and names no licence'));
  assert.throws(
    () => planted({ 'package.json': described('MIT'), 'README.md': 'MIT' }),
    failure('@some/thing 1.2.3 is bundled and has no file with its licence, MIT'),
  );
  assert.throws(() => planted({ 'package.json': described('SEE LICENSE IN FILE'), LICENSE: 'Mine' }), /not an SPDX expression/);
});

test('a licence that asks for more than its text fails the build, unless there is another to choose', () => {
  for (const licence of ['GPL-3.0-only', 'MPL-2.0', 'MIT AND LGPL-2.1-only', 'CC-BY-SA-4.0', 'Apache-2.0 WITH Swift-exception'])
    assert.throws(
      () => planted({ 'package.json': described(licence), LICENSE: 'All of it' }),
      /@some\/thing 1\.2\.3 has the licence .* not among MIT/,
    );
  assert.deepEqual(chosenOf('GPL-3.0-only OR MIT', 'it'), ['MIT']);
  assert.deepEqual(chosenOf('Apache-2.0/MIT', 'it'), ['MIT']);
  assert.deepEqual(chosenOf('(Zlib OR Apache-2.0) AND Unicode-3.0', 'it'), ['Zlib', 'Unicode-3.0']);
  assert.deepEqual(chosenOf('Apache-2.0 WITH LLVM-exception', 'it'), ['Apache-2.0 WITH LLVM-exception']);
});

test('the text of the chosen licence is passed on, with notices; if no file is named after it, all that there are', () => {
  const files = { 'LICENSE-MIT': 'the one', LICENSE_APACHE: 'the other', NOTICE: 'by whom', 'index.js': '' };
  const [part] = planted({ ...files, 'package.json': described('Apache-2.0 OR MIT') });
  assert.deepEqual(part, {
    name: '@some/thing',
    version: '1.2.3',
    licence: 'Apache-2.0 OR MIT',
    chosen: ['MIT'],
    texts: ['the one', 'by whom'],
  });
  const [unnamed] = planted({ COPYING: 'all of it', 'package.json': described('Apache-2.0 OR MIT') });
  assert.deepEqual(unnamed?.texts, ['all of it']);
  const folder = path.join(root, 'www', 'styles');
  const instead = partIn({ name: 'a', version: '1.0.0', license: 'MIT', folder }, (licence) => `the words of ${licence}`);
  assert.deepEqual(instead.texts, ['the words of MIT']);
});

function failure(message) {
  return (error) => error instanceof Failure && error.message === message;
}
