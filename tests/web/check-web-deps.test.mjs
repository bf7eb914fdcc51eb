// The rule for the modules of www/ finds what breaks it: every case plants a violation in a small folder.
import assert from 'node:assert/strict';
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { test } from 'node:test';
import { webProblems } from '../../scripts/checks/check-web-deps.mjs';

/** A folder that keeps the rule. */
const SOUND = {
  'base/errors.ts': "/** See `location.href`, and import './nothing.ts'. */\nexport const name = 'Internal';\n",
  'table/row.ts': "import type { Words } from '../base/language.ts';\nexport interface Row { label: Words }\n",
  'base/language.ts': 'export type Words = Record<string, string>;\n',
  'generator/wasm.ts': "import type { InitInput } from '../../pkg/generator.js';\nexport type Source = InitInput;\n",
  'renderer/artefact.ts': "import '../../pkg/renderer-webgpu.js';\nexport const history: { settled: number } = { settled: 1 };\n",
  'scene/scene-element.ts':
    "import { history } from '../renderer/artefact.ts';\nexport const now = history.settled;\nexport const later = () => import('./picture.ts');\n",
  'scene/picture.ts': "export { name } from '../base/errors.ts';\n",
  'controls/panel.ts':
    "import { html } from 'lit';\nimport css from '../styles/panel.css';\nexport const panel = [html, css, location.pathname];\n",
  'styles/css.d.ts': "declare module '*.css' {\n  const text: string;\n  export default text;\n}\n",
  'rocks/element.ts': "import { now } from '../scene/scene-element.ts';\nexport class RockField { now = now; }\n",
  'pages/rocks.ts': "import '../rocks/element.ts';\nhistory.replaceState(null, '', location.hash);\n",
};

/** What is wrong with the folder once these files are added to it, or replaced. */
function problemsOf(files) {
  const folder = mkdtempSync(path.join(os.tmpdir(), 'check-web-deps-'));
  for (const [name, text] of Object.entries({ ...SOUND, ...files })) {
    mkdirSync(path.dirname(path.join(folder, name)), { recursive: true });
    writeFileSync(path.join(folder, name), text);
  }
  const problems = webProblems(folder);
  rmSync(folder, { recursive: true });
  return problems;
}

/** That the planted violation is found, and nothing else. */
function finds(files, ...patterns) {
  const problems = problemsOf(files);
  assert.equal(problems.length, patterns.length, problems.join('\n'));
  for (const [index, pattern] of patterns.entries()) assert.match(problems[index], pattern);
}

test('a folder that keeps the rule has no problem', () => {
  finds({});
});

test('an import that points up is found, whether of a value, of a type, again exported, or later', () => {
  const ways = [
    "import { RockField } from '../rocks/element.ts';\nexport const made = new RockField();",
    "import type { RockField } from '../rocks/element.ts';\nexport type Made = RockField;",
    "import {\n  type RockField,\n} from '../rocks/element.ts';\nexport type Made = RockField;",
    "export * from '../rocks/element.ts';",
    "export type * from '../rocks/element.ts';",
    "import '../rocks/element.ts';",
    "export const load = () => import('../rocks/element.ts');",
    "export type Module = typeof import('../rocks/element.ts');",
  ];
  for (const text of ways) finds({ 'controls/store.ts': text }, /^controls\/store\.ts imports rocks\/element\.ts, which is not below it/);
});

test('rooms of one floor do not know each other, and a renderer knows no table', () => {
  finds(
    { 'generator/loop.ts': "export { history } from '../renderer/artefact.ts';\n" },
    /^generator\/loop\.ts imports renderer\/artefact\.ts, which is not below it/,
  );
  finds(
    { 'renderer/gpu.ts': "import type { Row } from '../table/row.ts';\nexport type Known = Row;\n" },
    /^renderer\/gpu\.ts imports table\/row\.ts; renderer knows nothing of table/,
  );
});

test('a circle of imports is found, also one of types alone, and one that is closed later', () => {
  const first = "import type { Second } from './second.ts';\nexport interface First { next: Second }\n";
  finds(
    { 'table/first.ts': first, 'table/second.ts': "import type { First } from './first.ts';\nexport interface Second { next: First }\n" },
    /^a circle of imports: table\/first\.ts → table\/second\.ts → table\/first\.ts$/,
  );
  finds(
    {
      'table/first.ts': first,
      'table/second.ts': "export interface Second { next: string }\nexport const load = () => import('./first.ts');\n",
    },
    /^a circle of imports/,
  );
});

test('a file in no room is found, and an import of what is no module', () => {
  finds({ 'camera.ts': 'export const TAN = 1;\n' }, /^camera\.ts is in no room/);
  finds({ 'helpers/camera.ts': 'export const TAN = 1;\n' }, /^helpers\/camera\.ts is in no room/);
  finds({ 'scene/words.ts': "export * from './camera.ts';\n" }, /^scene\/words\.ts imports scene\/camera\.ts, which is no module of www\//);
});

test('packages are imported where they belong, and an unknown one nowhere', () => {
  finds(
    { 'scene/tree.ts': "import { html } from 'lit';\nexport const tree = html;\n" },
    /^scene\/tree\.ts imports lit; only files that match/,
  );
  finds({ 'scene/tree.ts': "import 'node:fs';\n" }, /^scene\/tree\.ts imports node:fs; only files that match/);
  finds({ 'controls/parts.ts': "import 'lodash';\n" }, /^controls\/parts\.ts imports lodash, a package that is not in PACKAGES/);
});

test('wasm is touched by few files', () => {
  for (const text of [
    "import '../../pkg/generator.js';\n",
    "export const load = () => import('../../pkg/generator.js');\n",
    "export const url = 'generator_bg.wasm';\n",
    'export const module = WebAssembly.compile(new Uint8Array());\n',
  ]) {
    finds({ 'rocks/client.ts': text }, /^rocks\/client\.ts touches wasm/);
  }
});

test('elements and what they are made of leave the page’s address alone', () => {
  const ways = [
    'export const here = location.href;\n',
    'export const here = window.location.hash;\n',
    "history.replaceState(null, '', '#');\n",
    'export const query = new URLSearchParams();\n',
    "addEventListener('hashchange', () => {});\n",
  ];
  for (const text of ways)
    for (const file of ['scene/scene-element.ts', 'element/generator-element.ts', 'rocks/attributes.ts', 'wood-ear/element.ts'])
      finds(
        { ...(file.startsWith('scene') && { 'rocks/element.ts': 'export {};\n' }), [file]: text },
        new RegExp(`^${file} touches the page's address`),
      );
});
