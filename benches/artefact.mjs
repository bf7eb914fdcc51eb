// Builds what the bench needs besides dist/: the literal loops as wasm, and the workload and the frames as a script each, in .cache/bench/.
import { copyFileSync, existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import * as esbuild from 'esbuild';
import { cargoEnv, hashOf, pkg, root, target } from '../scripts/lib/env.mjs';
import { run, step } from '../scripts/lib/run.mjs';
import { bindgenProgram } from '../scripts/setup.mjs';
import { artefacts } from '../scripts/build/wasm.mjs';

const WASM = 'wasm32-unknown-unknown';

/** Where all of it lies; a static site, for the browser's sake. */
export const folder = path.join(root, '.cache', 'bench');

export async function buildBench() {
  mkdirSync(folder, { recursive: true });
  await step('Building the literal loops as wasm', '10–60 s', buildLiteral);
  for (const name of ['generator.js', 'generator_bg.wasm', 'renderer-webgpu_bg.wasm', 'renderer-webgl_bg.wasm'])
    copyFileSync(path.join(pkg, name), path.join(folder, name));
  await esbuild.build({
    absWorkingDir: root,
    entryPoints: ['benches/workload.mjs', 'benches/worker.mjs', 'benches/frames-page.mjs'],
    outdir: folder,
    outExtension: { '.js': '.mjs' },
    bundle: true,
    format: 'esm',
    target: 'es2022',
    logLevel: 'warning',
  });
  writeFileSync(path.join(folder, 'index.html'), '<!doctype html><title>bench</title>\n');
}

/** With the target, profile and optimisation of the generator, so that only the method differs. */
async function buildLiteral() {
  const { profile, optimise } = artefacts.find(({ feature }) => feature === 'generator');
  await run('cargo', ['build', '--lib', '--features', 'bench', '--target', WASM, '--profile', profile], { env: cargoEnv, cwd: root });
  const compiled = path.join(target, WASM, profile, 'rock_field.wasm');
  const stamp = path.join(folder, 'bench.stamp');
  const hash = hashOf(readFileSync(compiled), ...optimise);
  if (existsSync(stamp) && readFileSync(stamp, 'utf8') === hash) return;
  await run(bindgenProgram('wasm-bindgen'), [compiled, '--target', 'web', '--out-dir', folder, '--out-name', 'bench']);
  const wasm = path.join(folder, 'bench_bg.wasm');
  await run(process.execPath, [path.join(root, 'node_modules', 'binaryen', 'bin', 'wasm-opt'), wasm, '-o', wasm, ...optimise]);
  writeFileSync(stamp, hash);
}
