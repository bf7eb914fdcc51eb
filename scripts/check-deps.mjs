// The dependency rule: who may use whom. What it says is in RULES; the rest finds out who does.
import { existsSync, readFileSync, readdirSync } from 'node:fs';
import path from 'node:path';
import { cargoEnv, pkg, root } from './env.mjs';
import { Failure, capture, isMain, main } from './run.mjs';

const BASE = ['bitmap', 'mesh', 'noise', 'rng', 'params', 'error'];

/** Module of src/ → the modules it may use, beside itself. A longer name wins: `bindings/renderer` before `bindings`. */
const RULES = {
  ...Object.fromEntries(BASE.map((name) => [name, BASE])),
  // What the stages will allocate is computed from what they are: the two know each other.
  memory: [...BASE, 'rocks'],
  rocks: [...BASE, 'memory'],
  wood_ear: BASE,
  export: BASE,
  validate: [...BASE, 'rocks', 'wood_ear'],
  'bindings/generator': [...BASE, 'memory', 'rocks', 'export'],
  'bindings/wood_ear': [...BASE, 'wood_ear', 'export'],
  'bindings/error': ['error'],
  'bindings/renderer': ['render'],
  render: [],
};

/** Crates an artefact must not have in its tree. */
const FORBIDDEN_CRATES = [
  { features: [], crates: ['wgpu', 'web-sys', 'js-sys', 'wasm-bindgen'] },
  { features: ['generator'], crates: ['wgpu', 'wgpu-core', 'naga', 'web-sys'] },
  { features: ['wood-ear'], crates: ['wgpu', 'wgpu-core', 'naga', 'web-sys'] },
];

/** Only these files of www/ import the wasm glue. */
const WASM_IMPORTERS = ['www/entries/worker.ts', 'www/entries/wood-ear-worker.ts', 'www/renderer/artefact.ts', 'www/entries/core.ts', 'www/entries/core.node.ts'];
/** Elements know no address bar: only the page does. */
const ELEMENTS = ['www/entries/rock-field.ts', 'www/scene/scene-element.ts', 'www/entries/wood-ear-log.ts'];

export async function check() {
  const problems = [...rust(), ...crates(), ...web(), ...browserGraph()];
  if (problems.length > 0) throw new Failure(`the dependency rule is broken:\n${problems.map((text) => `  ${text}`).join('\n')}`);
  console.log('dependency rule: kept');
}

function rust() {
  const exported = flatNames();
  return files('src', /\.rs$/).flatMap((file) => {
    const module = moduleOf(file);
    if (module === undefined) return [];
    const allowed = [...RULES[module], module.split('/')[0]];
    return usesOf(readFileSync(path.join(root, file), 'utf8'), exported)
      .filter((used) => !allowed.includes(used.module))
      .map(({ module: other, line }) => `${file}:${line} uses ${other}; ${module} may use only ${RULES[module].join(', ') || 'itself'}`);
  });
}

/** The module of RULES that a file belongs to; none for lib.rs. */
function moduleOf(file) {
  const name = file.replace(/^src\//, '').replace(/(\/mod)?\.rs$/, '');
  return Object.keys(RULES)
    .filter((module) => name === module || name.startsWith(`${module}/`))
    .sort((a, b) => b.length - a.length)[0];
}

/** Modules of this crate named in a file outside its tests, with the line. `validate` may also stand in debug builds. */
function usesOf(text, exported) {
  const uses = [];
  let debugOnly = false;
  const lines = text.split('\n');
  for (const [index, raw] of lines.entries()) {
    if (/^#\[cfg\(test\)\]/.test(raw) && /^\s*(pub\s*(\(.*\)\s*)?)?mod\s+\w+\s*\{/.test(lines[index + 1] ?? '')) break;
    const line = raw.replace(/\/\/.*$/, '');
    if (/cfg!?\((any\()?(debug_assertions|test)/.test(line)) debugOnly = true;
    const roots = [...line.matchAll(/\bcrate::(\w+|\{[^}]*\}?)/g)].flatMap(([, name]) => (name.startsWith('{') ? name.match(/(?<![:\w])\w+/g) ?? [] : [name]));
    for (const name of roots) {
      const module = exported.get(name) ?? name;
      if (module === 'validate' && (debugOnly || /debug_assert/.test(line))) continue;
      uses.push({ module, line: index + 1 });
    }
    if (/[;}]\s*$/.test(line)) debugOnly = false;
  }
  return uses;
}

/** What lib.rs re-exports: name → the module it comes from. */
function flatNames() {
  const text = readFileSync(path.join(root, 'src/lib.rs'), 'utf8');
  const names = new Map();
  for (const [, module, rest] of text.matchAll(/pub(?:\([^)]*\))? use (?:crate::|self::)?(\w+)::([^;]+);/g)) {
    for (const name of rest.match(/\w+/g) ?? []) names.set(name, module);
  }
  return names;
}

function crates() {
  return FORBIDDEN_CRATES.flatMap(({ features, crates: forbidden }) => {
    const flags = ['--no-default-features', '--features', features.join(','), '--target', 'wasm32-unknown-unknown', '--edges', 'normal'];
    const tree = capture('cargo', ['tree', '--prefix', 'none', '--format', '{p}', ...flags], { cwd: root, env: { ...process.env, ...cargoEnv } });
    if (tree === null) return ['cargo tree fails; run it to see why'];
    const present = new Set(tree.split('\n').map((line) => line.split(' ')[0]));
    const name = features.join(',') || 'default';
    return forbidden.filter((crate) => present.has(crate)).map((crate) => `the ${name} feature set has ${crate} in its tree (cargo tree --features "${features}" -i ${crate})`);
  });
}

function web() {
  return files('www', /\.ts$/).flatMap((file) => {
    const text = readFileSync(path.join(root, file), 'utf8').replaceAll(/\/\*[\s\S]*?\*\/|(?<!:)\/\/.*$/gm, '');
    const problems = [];
    const values = [...text.matchAll(/\b(?:import|export)\s+(type\s)?[^'";]*?['"]([^'"]+)['"]|\bimport\s*\(\s*['"]([^'"]+)['"]/g)].filter(([, type]) => !type);
    const imported = values.map(([, , from, later]) => from ?? later);
    if (!WASM_IMPORTERS.includes(file) && (imported.some((name) => /\/pkg\//.test(name)) || /_bg\.wasm|\bWebAssembly\.(instantiate|compile|Module|Instance)/.test(text))) {
      problems.push(`${file} touches wasm; only ${WASM_IMPORTERS.join(', ')} may`);
    }
    if (ELEMENTS.includes(file) && (imported.some((name) => /(rocks|wood-ear)\/link/.test(name)) || /\b(location|history)\.|\bURLSearchParams\b/.test(text))) {
      problems.push(`${file} touches the page's address; only the page may`);
    }
    return problems;
  });
}

function browserGraph() {
  const file = path.join(pkg, 'web.meta.json');
  if (!existsSync(file)) return ['there is no build to look into. Make one with: npm run build'];
  const { outputs } = JSON.parse(readFileSync(file, 'utf8'));
  return Object.entries(outputs).flatMap(([name, { imports }]) =>
    imports.filter((entry) => entry.path.startsWith('node:')).map((entry) => `${name} imports ${entry.path}, and is one of the browser's files`),
  );
}

/** Files below a folder, relative to the root, with forward slashes. */
function files(folder, pattern) {
  return readdirSync(path.join(root, folder), { recursive: true, withFileTypes: true })
    .filter((entry) => entry.isFile() && pattern.test(entry.name))
    .map((entry) => path.relative(root, path.join(entry.parentPath ?? entry.path, entry.name)).replaceAll(path.sep, '/'))
    .sort();
}

if (isMain(import.meta)) await main(check);
