// Bundles the unit tests of www/ (Node 20 cannot read TypeScript) and names the bundles for `node --test`.
import { existsSync, mkdirSync, readFileSync, readdirSync, rmSync } from 'node:fs';
import path from 'node:path';
import { pathToFileURL } from 'node:url';
import * as esbuild from 'esbuild';
import { root } from '../lib/env.mjs';
import { Failure } from '../lib/run.mjs';
import { panelApart, sheetsAsText } from '../build/web-plugins.mjs';

/**
 * Bundles tests/web/*.test.{ts,mjs} into .cache/web-tests/. Packages stay outside, so `import … from 'rock-field/core'` is the built package.
 */
export async function bundleWebTests() {
  const folder = path.join(root, 'tests', 'web');
  const tests = existsSync(folder) ? readdirSync(folder).filter((name) => /\.test\.(ts|mjs)$/.test(name)) : [];
  if (tests.length === 0) throw new Failure('there are no tests in tests/web');
  const outdir = path.join(root, '.cache', 'web-tests');
  rmSync(outdir, { recursive: true, force: true });
  mkdirSync(outdir, { recursive: true });
  await esbuild.build({
    absWorkingDir: root,
    entryPoints: tests.map((name) => path.join(folder, name)),
    outdir,
    outExtension: { '.js': '.mjs' },
    bundle: true,
    packages: 'external',
    platform: 'node',
    format: 'esm',
    target: 'node20',
    sourcemap: 'inline',
    // Not that of the tests, which takes `rock-field/core` from the sources to know its types.
    tsconfig: path.join(root, 'tsconfig.json'),
    logLevel: 'warning',
    // In one bundle, importing the element would import Lit with the panel.
    plugins: [sourceUrls, sheetsAsText, panelApart()],
  });
  return tests.map((name) => path.join(outdir, name.replace(/\.(ts|mjs)$/, '.mjs')));
}

/** `import.meta.url` stays the source file's, so that a test finds its data beside it. */
const sourceUrls = {
  name: 'source-urls',
  setup(build) {
    build.onLoad({ filter: /\.(ts|mjs)$/ }, ({ path: file }) => {
      const contents = readFileSync(file, 'utf8').replaceAll('import.meta.url', JSON.stringify(pathToFileURL(file).href));
      return { contents, loader: file.endsWith('.ts') ? 'ts' : 'js' };
    });
  },
};
