// The page and the package files: www/ and pkg/ → dist/, by esbuild. Takes a second, so it is always done anew.
import { copyFileSync, existsSync, mkdirSync, readFileSync, readdirSync, renameSync, rmSync, writeFileSync } from 'node:fs';
import { createHash } from 'node:crypto';
import path from 'node:path';
import * as esbuild from 'esbuild';
import { writeDocs } from './docs.mjs';
import { dist, hashOf, pkg, root } from './env.mjs';
import { Failure, step } from './run.mjs';
import { nodeless, panelApart, panelByAddress, sheetsAsText, tinyCopied } from './web-plugins.mjs';
import { artefacts } from './wasm.mjs';

/** What the browser build put where, for the size check and the dependency check. */
export const metafile = path.join(pkg, 'web.meta.json');

// dist/ is flat: `new URL('./worker.js', import.meta.url)` then means the same file from whichever chunk the code landed in.
const BROWSER_ENTRIES = ['www/main.ts', 'www/wood-ear.ts', 'www/rock-field.ts', 'www/element.ts', 'www/wood-ear-log.ts', 'www/core.ts', 'www/styles/page.css'];
const NODE_ENTRIES = ['www/core.node.ts'];
// One file for a classic <script>: it finds the others by its own address, since there is no import.meta in it.
const CDN = { entryPoints: { cdn: 'www/rock-field.ts', 'wood-ear-cdn': 'www/wood-ear-log.ts' }, inject: ['www/cdn.ts'], define: { 'import.meta.url': 'scriptUrl' }, format: 'iife', platform: 'browser', plugins: [panelByAddress] };
// In one file: it shares little with the pages that start it, and what it shares would be cut out of their files.
const WORKERS = ['www/generator/worker.ts', 'www/generator/wood-ear-worker.ts'];
// What an element with `controls` loads when its panel is opened. In one file: what it shares with the element is little, and would
// be cut out of the element's file, which everybody loads.
const PANELS = ['www/panel.ts', 'www/wood-ear-panel.ts'];
// The documentation is a guest of the package like any other: it loads rock-field.js and shares no chunk with the page.
const DOCS = { entryPoints: ['www/docs/docs.ts', 'www/styles/docs.css'], entryNames: '[name]', platform: 'browser' };
const SERVICE_WORKER = 'www/service-worker.ts';
const COPIED = ['www/manifest.webmanifest', 'www/icon.svg', 'www/icon-maskable.svg'];
const PAGE = 'index.html';
/** The pages that are made of it, each with its script, what a visit needs beside it, and what it says of itself where that is not the first's. */
const PAGES = [
  { name: PAGE, script: 'www/main.ts', workers: ['worker'], wasm: ['generator_bg.wasm'] },
  {
    name: 'wood-ear.html',
    script: 'www/wood-ear.ts',
    // The log lies on rocks.
    workers: ['wood-ear-worker', 'worker'],
    wasm: ['wood-ear_bg.wasm', 'generator_bg.wasm'],
    title: 'rock-field – wood ears on a fallen log',
    description: 'A colony of wood-ear fungus on a fallen log, grown in the browser from one seed. Place it, let it dry, wrinkle and curl, share the link.',
  },
];

// What a visit needs beside its scripts. Of the two renderers it needs one: that is kept when the page has used it.
const ALWAYS_NEEDED = ['page.css', ...COPIED.map((file) => path.basename(file))];

const common = { absWorkingDir: root, bundle: true, minify: true, format: 'esm', target: 'es2022', sourcemap: true, legalComments: 'none', logLevel: 'warning' };

export async function buildWeb() {
  requireFiles();
  await step('Bundling the page into dist/', 'a second', async () => {
    // Built beside and swapped in, so that a failed build leaves the last good one being served.
    const staging = path.join(pkg, '.dist');
    rmSync(staging, { recursive: true, force: true });
    mkdirSync(staging, { recursive: true });
    const browser = await bundle({
      entryPoints: BROWSER_ENTRIES,
      outdir: staging,
      entryNames: '[name]',
      chunkNames: 'chunk-[hash]',
      assetNames: '[name]',
      splitting: true,
      metafile: true,
      platform: 'browser',
      plugins: [panelApart, tinyCopied],
    });
    const workers = await bundle({ entryPoints: WORKERS, outdir: staging, entryNames: '[name]', metafile: true, platform: 'browser' });
    const panel = await bundle({ entryPoints: PANELS, outdir: staging, entryNames: '[name]', metafile: true, platform: 'browser', plugins: [sheetsAsText] });
    await bundle({ entryPoints: NODE_ENTRIES, outdir: staging, entryNames: '[name]', platform: 'node' });
    await bundle({ ...CDN, outdir: staging });
    for (const { feature } of artefacts) copyFileSync(path.join(pkg, `${feature}_bg.wasm`), path.join(staging, `${feature}_bg.wasm`));
    for (const file of COPIED) copyFileSync(path.join(root, file), path.join(staging, path.basename(file)));
    await bundle({ ...DOCS, outdir: path.join(staging, 'docs') });
    await writeDocs(path.join(staging, 'docs'));
    const meta = relativeTo(staging, merged(browser.metafile, workers.metafile, panel.metafile));
    writeFileSync(metafile, JSON.stringify(meta));
    await finish(staging, meta);
    writeFileSync(path.join(staging, '.npmignore'), pageAlone(meta).map((name) => `/${name}*\n`).join(''));
    swapIn(staging);
  });
}

export async function bundle(options) {
  try {
    const plugins = [...(options.platform === 'browser' ? [nodeless] : []), ...(options.plugins ?? [])];
    return await esbuild.build({ ...common, ...options, plugins });
  } catch (error) {
    throw new Failure(`the bundle has ${error.errors?.length ?? 1} error(s), printed above`);
  }
}

function requireFiles() {
  const files = [...BROWSER_ENTRIES, ...WORKERS, ...NODE_ENTRIES, ...CDN.inject, ...PANELS, ...DOCS.entryPoints, SERVICE_WORKER, ...COPIED, PAGE];
  const missing = files.filter((file) => !existsSync(path.join(root, file)));
  if (missing.length > 0) throw new Failure(`the page cannot be built: missing ${missing.join(', ')}`);
}

/** Writes index.html with the build's id in it, and the service worker that knows the id and the files. */
async function finish(staging, meta) {
  const names = readdirSync(staging, { recursive: true, withFileTypes: true })
    .filter((entry) => entry.isFile() && !entry.name.endsWith('.map'))
    .map((entry) => path.relative(staging, path.join(entry.parentPath ?? entry.path, entry.name)).replaceAll(path.sep, '/'))
    .sort();
  const files = Object.fromEntries(names.map((name) => [name, integrity(path.join(staging, name))]));
  const page = readFileSync(path.join(root, PAGE), 'utf8');
  if (!page.includes('</head>')) throw new Failure(`${PAGE} has no </head> to put the build's id before`);
  const build = hashOf(page, JSON.stringify(files)).slice(0, 16);
  for (const { name, script, title, description } of PAGES) {
    const entry = `${path.basename(script, '.ts')}.js`;
    // The chunks are asked for with the page, not one import after the other.
    const preloads = scriptsOf(meta, entry).map((chunk) => `<link rel="modulepreload" href="./${chunk}">`);
    const added = [`<meta name="rock-field-build" content="${build}">`, ...preloads].map((line) => `  ${line}\n  `).join('');
    let written = page.replace('src="main.js"', `src="${entry}"`).replace('</head>', `${added}</head>`);
    if (title) written = written.replace(/(?<=<title>)[^<]*/, title);
    if (description) written = written.replace(/(?<=<meta name="description" content=")[^"]*/, description);
    writeFileSync(path.join(staging, name), written);
  }
  const needed = ({ script, workers, wasm }) => {
    const scripts = [path.basename(script, '.ts'), ...workers].flatMap((entry) => scriptsOf(meta, `${entry}.js`, { dynamic: true }));
    return [...new Set([...scripts.filter((name) => !isRendererGlue(meta, name)), ...wasm, ...ALWAYS_NEEDED])];
  };
  const pages = Object.fromEntries(PAGES.map((page) => [page.name, needed(page)]));
  await bundle({
    entryPoints: { sw: SERVICE_WORKER },
    outdir: staging,
    sourcemap: false,
    define: { __BUILD__: JSON.stringify(build), __FILES__: JSON.stringify(files), __PAGES__: JSON.stringify(pages) },
  });
}

/** An entry and every script it imports, by name; with `dynamic` also those it may import later. */
export function scriptsOf(meta, entry, { dynamic = false } = {}) {
  const found = new Set([`dist/${entry}`]);
  for (const name of found) {
    for (const { path: imported, kind, external } of meta.outputs[name].imports) {
      if (!external && (kind === 'import-statement' || (dynamic && kind === 'dynamic-import'))) found.add(imported);
    }
  }
  return [...found].map((name) => name.slice('dist/'.length));
}

/** Chunks that no entry of the package asks for: `files` in package.json cannot tell them from the others. */
function pageAlone(meta) {
  const entries = [...BROWSER_ENTRIES.filter((file) => file.endsWith('.ts') && !PAGES.some(({ script }) => script === file)), ...PANELS];
  const asked = entries.flatMap((file) => scriptsOf(meta, `${path.basename(file, '.ts')}.js`, { dynamic: true }));
  const chunks = Object.keys(meta.outputs).map((name) => path.basename(name)).filter((name) => name.startsWith('chunk-') && name.endsWith('.js'));
  return chunks.filter((name) => !asked.includes(name));
}

function isRendererGlue(meta, name) {
  return Object.keys(meta.outputs[`dist/${name}`].inputs).some((input) => input.startsWith('pkg/renderer-'));
}

function integrity(file) {
  return `sha256-${createHash('sha256').update(readFileSync(file)).digest('base64')}`;
}

function swapIn(staging) {
  const old = path.join(pkg, '.dist-old');
  rmSync(old, { recursive: true, force: true });
  if (existsSync(dist)) renameSync(dist, old);
  renameSync(staging, dist);
  rmSync(old, { recursive: true, force: true });
}

/** Several builds into one folder, as one. */
function merged(...metas) {
  return { inputs: Object.assign({}, ...metas.map(({ inputs }) => inputs)), outputs: Object.assign({}, ...metas.map(({ outputs }) => outputs)) };
}

/** Output names in the metafile as they are in dist/. */
function relativeTo(staging, meta) {
  const prefix = `${path.relative(root, staging).replaceAll(path.sep, '/')}/`;
  return JSON.parse(JSON.stringify(meta).replaceAll(prefix, 'dist/'));
}
