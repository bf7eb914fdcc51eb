// The dependency rule: who may use whom. For the modules of src/, it is in check-rust-deps.mjs.
import { existsSync, readFileSync, readdirSync } from 'node:fs';
import path from 'node:path';
import { rustProblems } from './check-rust-deps.mjs';
import { cargoEnv, pkg, root } from './env.mjs';
import { Failure, capture, isMain, main } from './run.mjs';

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
  const problems = [...rustProblems(path.join(root, 'src')), ...crates(), ...web(), ...browserGraph()];
  if (problems.length > 0) throw new Failure(`the dependency rule is broken:\n${problems.map((text) => `  ${text}`).join('\n')}`);
  console.log('dependency rule: kept');
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
