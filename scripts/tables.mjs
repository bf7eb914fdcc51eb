// The element's tables as the build's own scripts need them: parameters, presets, links and choices, bundled from www/ for this Node.
import path from 'node:path';
import * as esbuild from 'esbuild';
import { root } from './env.mjs';

const SOURCES = ['attribute-notices', 'attribute-reader', 'camera-orbit', 'element-attributes', 'error-list', 'notices', 'param-docs.gen', 'params', 'params-flat', 'renderer/quality', 'rocks', 'strings', 'strings-later', 'table', 'url-codec', 'wood-ear-docs.gen', 'wood-ears', 'docs/notice-help', 'docs/words'];

let loading;

/** Everything these modules export, in one object. */
export function tables() {
  loading ??= load();
  return loading;
}

async function load() {
  const stdin = { contents: SOURCES.map((name) => `export * from './${name}.ts';`).join('\n'), resolveDir: path.join(root, 'www'), loader: 'ts' };
  const { outputFiles } = await esbuild.build({ stdin, bundle: true, write: false, format: 'esm', platform: 'node', target: 'node20', logLevel: 'warning' });
  return import(`data:text/javascript;base64,${Buffer.from(outputFiles[0].contents).toString('base64')}`);
}
