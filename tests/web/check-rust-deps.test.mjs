// The rule for the modules of src/ finds what breaks it: every case plants a violation in a small crate.
import assert from 'node:assert/strict';
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { test } from 'node:test';
import { rustProblems } from '../../scripts/checks/check-rust-deps.mjs';

const ROOMS = { base: [], rocks: ['base'] };

/** A crate that keeps the rule: rocks/mod.rs re-exports a type of rocks/shape.rs, and base.rs has tests. */
const SOUND = {
  'lib.rs': 'mod base;\npub mod rocks;\npub use rocks::Shape;\n',
  'base.rs':
    '/// See crate::rocks::Shape.\npub(crate) fn number() -> u32 { 7 }\n\n#[cfg(test)]\nmod tests {\n    use crate::rocks::Shape;\n}\n',
  'rocks/mod.rs': 'mod grow;\nmod shape;\npub use shape::{Corner, Shape};\n#[cfg(test)]\nmod tests;\n',
  'rocks/shape.rs': 'use crate::base;\npub struct Shape;\npub struct Corner;\n',
  'rocks/grow.rs': 'use super::{\n    Corner,\n    shape::Shape,\n};\nfn grow() -> u32 { crate::base::number() }\n',
  'rocks/tests.rs': 'use crate::anything::at_all;\nuse super::grow;\n',
};

/** What is wrong with the crate once these files are added to it, or replaced. */
function problemsOf(files, rooms = ROOMS) {
  const folder = mkdtempSync(path.join(os.tmpdir(), 'check-rust-deps-'));
  for (const [name, text] of Object.entries({ ...SOUND, ...files })) {
    mkdirSync(path.dirname(path.join(folder, name)), { recursive: true });
    writeFileSync(path.join(folder, name), text);
  }
  const problems = rustProblems(folder, rooms);
  rmSync(folder, { recursive: true });
  return problems;
}

test('a crate that keeps the rule has no problem', () => {
  assert.deepEqual(problemsOf({}), []);
});

test('a room that uses another one that it may not use is found, however the path is written', () => {
  const uses = [
    'use crate::rocks::Shape;',
    'use crate::{\n    rocks::{self, Shape},\n};',
    'use super::rocks::Shape as Other;',
    'fn f() -> crate::rocks::Shape { todo!() }',
    // Re-exported by lib.rs.
    'use crate::Shape;',
    // A text with a quote does not hide what follows it.
    "const QUOTE: char = '\"'; use crate::rocks::Shape;",
  ];
  for (const use of uses) {
    const problems = problemsOf({ 'base.rs': use });
    assert.ok(
      problems.some((problem) => /^src\/base\.rs:\d+ uses rocks(\/shape)?; base may use no other room$/.test(problem)),
      `${use}\n${problems.join('\n')}`,
    );
  }
});

test('a module that belongs to no room is found, and so is a room that is not there', () => {
  assert.match(problemsOf({ 'extra.rs': 'fn f() {}' }).join('\n'), /^src\/extra\.rs belongs to no room/);
  assert.match(problemsOf({ 'bindings/extra.rs': 'fn f() {}' }).join('\n'), /^src\/bindings\/extra\.rs belongs to no room/);
  assert.match(problemsOf({}, { ...ROOMS, trees: [] }).join('\n'), /a rule for trees, which is not there/);
});

test('circles of modules are found, within a room and between rooms', () => {
  const circle = (files, rooms) =>
    problemsOf(files, rooms)
      .filter((problem) => /circle/.test(problem))
      .join('\n');
  assert.match(circle({ 'rocks/shape.rs': 'use super::grow::grow;\npub struct Shape;' }), /rocks\/grow → rocks\/shape → rocks\/grow/);
  // Through a name that the parent re-exports, and through one that a child takes from its parent.
  assert.match(circle({ 'rocks/shape.rs': 'fn f() { super::grow::grow() }' }), /rocks\/grow → rocks\/shape → rocks\/grow/);
  assert.match(
    circle({ 'rocks/mod.rs': 'mod grow;\nmod shape;\nstruct Kind;\nfn f() { grow::grow() }', 'rocks/grow.rs': 'use super::Kind;' }),
    /rocks → rocks\/grow → rocks/,
  );
  const rooms = { base: ['rocks'], rocks: ['base'] };
  assert.match(circle({ 'base.rs': 'use crate::rocks::Shape;' }, rooms), /base → rocks\/shape → base/);
});
