// The limits of files and functions are held: each case plants a file or a function that is too long.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { test } from 'node:test';
import { lengthProblems } from '../../scripts/checks/check-lengths.mjs';
import { root } from '../../scripts/lib/env.mjs';

const lines = (count, text) => Array.from({ length: count }, () => text).join('\n');

/** A shader of one function with so many lines between its braces, and one after it. */
const shader = (count, head = 'fn long(at: vec3f) -> f32 {') =>
  `${head}\n${lines(count, '  if at.x > 0.0 { x += 1.0; } // }')}\n}\n\nfn short() {\n}\n`;

/** What `look` says of a folder with these files. */
function inFolder(files, look) {
  const folder = mkdtempSync(path.join(os.tmpdir(), 'lengths-'));
  for (const [name, text] of Object.entries(files)) {
    mkdirSync(path.dirname(path.join(folder, name)), { recursive: true });
    writeFileSync(path.join(folder, name), text);
  }
  const said = look(folder);
  rmSync(folder, { recursive: true });
  return said;
}

const problemsOf = (files) => inFolder(files, lengthProblems);

test('Rust and WGSL files of 450 lines, and functions of shaders of 80, are not too long', () => {
  assert.deepEqual(problemsOf({ 'src/a.rs': `${lines(450, '// a')}\n`, 'src/b.wgsl': lines(450, '// b'), 'src/c.wgsl': shader(78) }), []);
});

test('a line more is too much', () => {
  for (const name of ['src/a.rs', 'tests/deep/down/a.rs', 'src/a.wgsl'])
    assert.match(problemsOf({ [name]: lines(451, '// a') }).join('\n'), new RegExp(`^${name} has 451 lines; a file has at most 450`));
  const heads = {
    1: 'fn long(at: vec3f) -> f32 {',
    2: '// Shown.\n@fragment fn long(at: vec3f) -> f32 {',
    3: '// Shown.\n@fragment\nfn long(@location(0) at: vec3f) -> f32 {',
  };
  for (const [line, head] of Object.entries(heads)) {
    const expected = new RegExp(`^a\\.wgsl:${line} long has 81 lines; a function has at most 80`);
    assert.match(problemsOf({ 'a.wgsl': shader(79, head) }).join('\n'), expected);
  }
});

test('what is not written by us may be as long as it likes', () => {
  assert.deepEqual(
    problemsOf({ 'node_modules/a/a.rs': lines(451, '// a'), 'target/a.rs': lines(451, '// a'), '.cache/a.rs': lines(451, '// a') }),
    [],
  );
});

test('Biome refuses files of more than 450 lines, and functions of more than 80', () => {
  const body = (count) => `${lines(count, '  console.log();')}\n`;
  const files = {
    'short.mjs': `export function f() {\n${body(80)}}\n`,
    'function.mjs': `export function f() {\n${body(81)}}\n`,
    'arrow.ts': `export const f = () => {\n${body(81)}};\n`,
    'test.ts': `test('a', async () => {\n${body(81)}});\n`,
    'short-file.mjs': body(450),
    'file.mjs': body(451),
  };
  const report = inFolder(files, (folder) => {
    const biome = path.join(root, 'node_modules', '@biomejs', 'biome', 'bin', 'biome');
    const config = `--config-path=${path.join(root, 'biome.jsonc')}`;
    return spawnSync(process.execPath, [biome, 'lint', config, '--vcs-enabled=false', '--max-diagnostics=none', folder], {
      encoding: 'utf8',
    });
  });
  const found = [...`${report.stdout}${report.stderr}`.matchAll(/([\w-]+(?:\.\w+)+):\d+:\d+ lint\/\w+\/(noExcessive\w+)/g)];
  assert.deepEqual(found.map(([, file, rule]) => `${file} ${rule}`).sort(), [
    'arrow.ts noExcessiveLinesPerFunction',
    'file.mjs noExcessiveLinesPerFile',
    'function.mjs noExcessiveLinesPerFunction',
    'test.ts noExcessiveLinesPerFunction',
  ]);
});

test('clippy has the same limit for functions, and is told to hold it', () => {
  assert.match(readFileSync(path.join(root, 'clippy.toml'), 'utf8'), /^too-many-lines-threshold = 80$/m);
  assert.match(readFileSync(path.join(root, 'Cargo.toml'), 'utf8'), /^too_many_lines = "warn"$/m);
});
