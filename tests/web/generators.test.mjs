// What names every generator agrees with the one list of them, and what a new one lacks is named.
import assert from 'node:assert/strict';
import { existsSync, readFileSync } from 'node:fs';
import path from 'node:path';
import { test } from 'node:test';
import { generatorProblems } from '../../scripts/checks/check-generators.mjs';
import { root } from '../../scripts/lib/env.mjs';
import { GENERATORS } from '../../scripts/lib/generators.mjs';

const PEBBLES = {
  ...GENERATORS[1],
  name: 'pebble-beach',
  tag: 'pebble-beach',
  classEntry: 'pebble-beach',
  wasm: 'pebbles',
  worker: 'pebble-worker',
  otherWorkers: [],
  panel: 'pebble-panel',
  cdn: 'pebble-cdn',
  page: { file: 'pebbles.html', script: 'pebbles' },
  table: 'PEBBLES',
  paramDocs: 'PEBBLE_DOCS',
  goldens: 'pebble_properties',
};

/** Files of the repository, changed as `changes` say: a file's name → what is made of its text, null for a file that is gone. */
function reading(changes) {
  return (name) => {
    const file = path.join(root, name);
    const text = existsSync(file) ? readFileSync(file, 'utf8') : null;
    return name in changes ? changes[name](text) : text;
  };
}

function without(text) {
  return (source) => {
    assert.ok(source.includes(text), `${text} is there to be taken away`);
    return source.replaceAll(text, '');
  };
}

test('package, crate, pages, typings and entries name every generator of the list', () => {
  assert.deepEqual(generatorProblems(), []);
});

test('what one of these files no longer says is named', () => {
  for (const [file, text] of [
    ['Cargo.toml', 'wood-ear = ['],
    ['src/bindings/mod.rs', 'mod wood_ear;'],
    ['www/controls/site.ts', "href: 'wood-ear.html'"],
    ['www/controls/clipboard.ts', "'wood-ear-log': 'wood-ear-cdn.js'"],
    ['www/typings/svelte.d.ts', "'wood-ear-log':"],
    ['www/entries/core.node.ts', "'../../pkg/wood-ear.js'"],
    ['www/entries/variants/inline-worker.ts', 'export function woodEarFileWorkerAddress()'],
    ['www/entries/variants/inlined.d.ts', "declare module 'inlined:wood-ear-worker'"],
    ['www/entries/wood-ear-log.ts', "customElements.define('wood-ear-log'"],
    ['www/wood-ear/table.ts', 'export const WOOD_EARS:'],
  ]) {
    assert.deepEqual(generatorProblems(GENERATORS, reading({ [file]: without(text) })), [`${file} has to have ${text}`]);
  }
});

test('a file of its own that a generator lacks is named', () => {
  for (const file of ['src/wood_ear/mod.rs', 'www/wood-ear/load-panel.cdn.ts', 'www/pages/wood-ear.ts', 'www/docs/pages/wood-ear-log.md']) {
    assert.deepEqual(generatorProblems(GENERATORS, reading({ [file]: () => null })), [`there is no ${file}`]);
  }
});

test('an export, a file and a side effect that package.json lacks are named', () => {
  const change = (edit) => ({
    'package.json'(text) {
      const manifest = JSON.parse(text);
      edit(manifest);
      return JSON.stringify(manifest);
    },
  });
  const problems = (edit) => generatorProblems(GENERATORS, reading(change(edit)));
  assert.match(
    problems(({ exports }) => delete exports['./wood-ear-cdn.js']).join('\n'),
    /^package\.json: exports has to have "\.\/wood-ear-cdn\.js"/,
  );
  assert.match(problems(({ exports }) => (exports['.'].node = './dist/element.js')).join('\n'), /^package\.json: exports has to have "\."/);
  const cut = (list, name) => list.splice(list.indexOf(name), 1);
  assert.deepEqual(
    problems(({ files }) => cut(files, 'dist/worker-*.js*')),
    ['package.json: files has nothing for dist/worker-A1B2C3D4.js'],
  );
  assert.deepEqual(
    problems(({ sideEffects }) => cut(sideEffects, './dist/rock-field.js')),
    ['package.json: sideEffects has nothing for ./dist/rock-field.js'],
  );
});

test('of a new entry everything is named that it lacks, and nothing else', () => {
  const problems = generatorProblems([...GENERATORS, PEBBLES]);
  for (const expected of [
    /src\/pebble_beach\/mod\.rs/,
    /src\/bindings\/pebbles\.rs/,
    /www\/pages\/pebble-beach\.ts/,
    /www\/entries\/pebble-worker\.ts/,
    /www\/docs\/pages\/pebble-beach\.md/,
    /exports has to have "\.\/pebble-beach"/,
    /exports has to have "\.\/pebbles_bg\.wasm"/,
    /files has nothing for dist\/pebble-cdn\.js/,
    /Cargo\.toml has to have pebbles = \[/,
    /www\/controls\/site\.ts has to have href: 'pebbles\.html'/,
    /www\/typings\/vue\.d\.ts has to have 'pebble-beach':/,
    /www\/entries\/core\.ts has to have/,
  ])
    assert.ok(
      problems.some((text) => expected.test(text)),
      `${expected} is named in:\n${problems.join('\n')}`,
    );
  assert.deepEqual(
    problems.filter((text) => !/pebble/i.test(text)),
    [],
  );
});

test('two generators cannot have files of one name in dist/', () => {
  const { worker } = GENERATORS[0];
  const problems = generatorProblems([...GENERATORS, { ...PEBBLES, worker }]);
  assert.ok(problems.includes(`two generators have a ${worker}`), problems.join('\n'));
});
