// The element's tables as the build's own scripts need them: parameters, presets, links and choices, bundled from www/ for this Node.
import path from 'node:path';
import * as esbuild from 'esbuild';
import { root } from './env.mjs';
import { GENERATORS } from './generators.mjs';

const SOURCES = [
  ...[
    'base/error-list',
    'base/fov',
    'base/view',
    'table/notices',
    'table/table',
    'renderer/limits',
    'scene/camera/orbit',
    'element/attribute-notices',
    'element/attribute-reader',
    'export/options',
    'cli/failures',
    'cli/options',
    'cli/pattern',
    'three/options',
  ],
  ...['controls/strings', 'controls/strings-later', 'docs/notice-help', 'docs/words'],
  ...GENERATORS.flatMap(({ name }) => [`${name}/param-docs.gen`, `${name}/table`]),
  // The examples and the gallery of the documentation are about rocks.
  ...['rocks/attributes', 'rocks/figures', 'rocks/link', 'rocks/params', 'rocks/request', 'rocks/words', 'rocks/controls/preset-groups'],
];

let loading;

/** Everything these modules export, in one object. */
export function tables() {
  loading ??= load();
  return loading;
}

async function load() {
  /** @type {import('esbuild').StdinOptions} */
  const stdin = {
    contents: SOURCES.map((name) => `export * from './${name}.ts';`).join('\n'),
    resolveDir: path.join(root, 'www'),
    loader: 'ts',
  };
  const { outputFiles } = await esbuild.build({
    stdin,
    bundle: true,
    write: false,
    format: 'esm',
    platform: 'node',
    target: 'node20',
    logLevel: 'warning',
  });
  return import(`data:text/javascript;base64,${Buffer.from(outputFiles[0].contents).toString('base64')}`);
}
