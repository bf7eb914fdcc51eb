// dist/inline/: the package's scripts with the worker and the wasm in them, for bundlers that take no other files along (www/entries/variants/inline.ts).
import { readFileSync, readdirSync, rmSync } from 'node:fs';
import path from 'node:path';
import { deflateSync } from 'node:zlib';
import { dist, pkg, root } from '../lib/env.mjs';
import { GENERATORS, HEADLESS, addressFunction, entriesOf, entryFile, workersOf } from '../lib/generators.mjs';
import { Failure } from '../lib/run.mjs';
import { LICENCES_FILE, banner, packagesOf } from './licences.mjs';
import { bundle } from './web.mjs';

const ENTRIES = [...GENERATORS.flatMap(entriesOf), ...HEADLESS].map(entryFile);
const WORKERS = GENERATORS.flatMap(workersOf);

/** The forms that bundlers recognise, and ours are written in. */
const WASM = /new URL\('\.\/([\w-]+)_bg\.wasm', import\.meta\.url\)/g;
const WORKER_ADDRESS = /new URL\('\.\/([\w-]*worker)\.js', import\.meta\.url\), \{ type: 'module' \}/g;

// The glue names its wasm too, in a branch that is never taken. There is no import.meta in a classic script.
const common = { define: { 'import.meta.url': 'undefined' }, platform: 'browser', sourcemap: false };

export async function buildInline(outdir = path.join(dist, 'inline')) {
  rmSync(outdir, { recursive: true, force: true });
  const entryPoints = WORKERS.map(entryFile);
  // Classic scripts, since a page without an origin (`<iframe sandbox>`) starts no module from a blob in Chromium.
  const inside = await bundle({
    ...common,
    format: 'iife',
    entryPoints,
    outdir,
    entryNames: '[name]',
    write: false,
    inject: ['www/entries/variants/inline.ts'],
    plugins: [inline()],
  });
  const workers = new Map(inside.outputFiles.map(({ path: file, text }) => [path.basename(file, '.js'), text]));
  const whole = await bundle({
    ...common,
    banner: { js: banner() },
    entryPoints: ENTRIES,
    outdir,
    entryNames: '[name]',
    chunkNames: 'chunk-[hash]',
    splitting: true,
    inject: ['www/entries/variants/inline.ts', 'www/entries/variants/inline-worker.ts'],
    plugins: [inline(workers)],
  });
  const left = readdirSync(outdir).filter((name) => /import\.meta|new URL\("\.\//.test(readFileSync(path.join(outdir, name), 'utf8')));
  if (left.length > 0)
    throw new Failure(
      `addresses of other files are left in dist/inline/: ${left.join(', ')}; scripts/build/inline.mjs knows one form of them`,
    );
  const told = readFileSync(path.join(dist, LICENCES_FILE), 'utf8');
  const untold = packagesOf([inside, whole]).filter(({ name, version }) => !told.includes(`\n${name} ${version}\n`));
  if (untold.length > 0)
    throw new Failure(`${LICENCES_FILE} says nothing of ${untold.map(({ name }) => name).join(', ')}, which only dist/inline/ has in it`);
}

function inline(workers = new Map()) {
  return {
    name: 'inline',
    setup(build) {
      build.onLoad({ filter: /[\\/]www[\\/].*\.ts$/ }, ({ path: file }) => {
        const text = readFileSync(file, 'utf8');
        const contents = text
          .replaceAll(WASM, "inlined('$1_bg.wasm', () => import('inlined:$1'))")
          .replaceAll(WORKER_ADDRESS, (_, name) => `${addressFunction(name)}()`);
        return { contents, loader: 'ts' };
      });
      build.onResolve({ filter: /^inlined:/ }, ({ path: name }) => ({
        path: name.slice('inlined:'.length),
        namespace: 'inlined',
        sideEffects: false,
      }));
      build.onLoad({ filter: /.*/, namespace: 'inlined' }, ({ path: name }) => {
        const text = workers.get(name) ?? deflateSync(readFileSync(path.join(pkg, `${name}_bg.wasm`)), { level: 9 }).toString('base64');
        return { contents: `export default ${JSON.stringify(text)};`, loader: 'js', resolveDir: root };
      });
    },
  };
}
