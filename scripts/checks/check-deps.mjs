// The dependency rule: who may use whom. For the modules of src/, it is in check-rust-deps.mjs; for those of www/, in check-web-deps.mjs.
import { existsSync, readFileSync } from 'node:fs';
import path from 'node:path';
import { rustProblems } from './check-rust-deps.mjs';
import { webProblems } from './check-web-deps.mjs';
import { cargoEnv, pkg, root } from '../lib/env.mjs';
import { GENERATORS, LATER } from '../lib/generators.mjs';
import { Failure, capture, isMain, main } from '../lib/run.mjs';

/** Crates an artefact must not have in its tree. */
const FORBIDDEN_CRATES = [
  { features: [], crates: ['wgpu', 'web-sys', 'js-sys', 'wasm-bindgen'] },
  ...[...GENERATORS, ...LATER].map(({ wasm }) => ({ features: [wasm], crates: ['wgpu', 'wgpu-core', 'naga', 'web-sys'] })),
];

export async function check() {
  const problems = [...rustProblems(path.join(root, 'src')), ...crates(), ...webProblems(path.join(root, 'www')), ...browserGraph()];
  if (problems.length > 0) throw new Failure(`the dependency rule is broken:\n${problems.map((text) => `  ${text}`).join('\n')}`);
  console.log('dependency rule: kept');
}

function crates() {
  return FORBIDDEN_CRATES.flatMap(({ features, crates: forbidden }) => {
    const flags = ['--no-default-features', '--features', features.join(','), '--target', 'wasm32-unknown-unknown', '--edges', 'normal'];
    const tree = capture('cargo', ['tree', '--prefix', 'none', '--format', '{p}', ...flags], {
      cwd: root,
      env: { ...process.env, ...cargoEnv },
    });
    if (tree === null) return ['cargo tree fails; run it to see why'];
    const present = new Set(tree.split('\n').map((line) => line.split(' ')[0]));
    const name = features.join(',') || 'default';
    return forbidden
      .filter((crate) => present.has(crate))
      .map((crate) => `the ${name} feature set has ${crate} in its tree (cargo tree --features "${features}" -i ${crate})`);
  });
}

function browserGraph() {
  const file = path.join(pkg, 'web.meta.json');
  if (!existsSync(file)) return ['there is no build to look into. Make one with: npm run build'];
  const { outputs } = JSON.parse(readFileSync(file, 'utf8'));
  return Object.entries(outputs).flatMap(([name, { imports }]) =>
    imports
      .filter((entry) => entry.path.startsWith('node:'))
      .map((entry) => `${name} imports ${entry.path}, and is one of the browser's files`),
  );
}

if (isMain(import.meta)) await main(check);
