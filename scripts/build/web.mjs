// The page and the package files: www/ and pkg/ → dist/, by esbuild. Takes a second, so it is always done anew.
import { copyFileSync, existsSync, mkdirSync, readFileSync, readdirSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { createHash } from 'node:crypto';
import path from 'node:path';
import * as esbuild from 'esbuild';
import { writeDocs } from '../docs/docs.mjs';
import { dist, hashOf, pkg, root } from '../lib/env.mjs';
import { GENERATORS, HEADLESS, PEERS, LATER, entriesOf, entryFile, pageScript, withGround, workersOf } from '../lib/generators.mjs';
import { copyHashed, filesIn, HASHED, HASHED_NAME, hashedAddresses, namesOf, publish, withPlainNames } from './hashed-names.mjs';
import { LICENCES_FILE, banner, licences } from './licences.mjs';
import { loadedBefore } from './loaded-before.mjs';
import { Failure, needed, step } from '../lib/run.mjs';
import { PANELS, nodeless, panelApart, panelByAddress, sheetsAsText, templatesInOneLine } from './web-plugins.mjs';
import { artefacts } from './wasm.mjs';

/** What the browser build put where, for the size check and the dependency check. */
export const metafile = path.join(pkg, 'web.meta.json');

// dist/ is flat: `new URL('./worker.js', import.meta.url)` then means the same file from whichever chunk the code landed in.
// Every list of entries is by the name that the file has in dist/, without its ending.
const PAGE_ENTRIES = { ...eachAs(({ page }) => page.script, pageScript), page: 'www/styles/page.css' };
/** What people import or write into their pages, by names that stay. */
const PUBLIC_ENTRIES = named(...GENERATORS.flatMap(entriesOf));
/** Likewise. Apart from the pages: what a page shares with them would be cut out of its files. */
const HEADLESS_ENTRIES = named(...HEADLESS);
/** The command and its threads, too: what several of them use is in chunks. */
const NODE_ENTRIES = named(...HEADLESS.map((name) => `${name}.node`), 'cli', 'cli-worker');
// One file for a classic <script>: it finds the others by its own address, since there is no import.meta in it.
const CDN = {
  entryPoints: eachAs(
    ({ cdn }) => cdn,
    ({ tag }) => entryFile(tag),
  ),
  inject: ['www/entries/variants/cdn.ts'],
  define: { 'import.meta.url': 'scriptUrl' },
  format: 'iife',
  platform: 'browser',
};
// In one file: it shares little with the pages that start it, and what it shares would be cut out of their files.
const WORKERS = named(...GENERATORS.flatMap(workersOf));
// The documentation is a guest of the package like any other: it loads rock-field.js and shares no chunk with the page.
const DOCS = { entryPoints: ['www/docs/docs.ts', 'www/styles/docs.css'], entryNames: HASHED_NAME, platform: 'browser' };
const SERVICE_WORKER = 'www/pages/service-worker.ts';
const COPIED = ['www/manifest.webmanifest', 'www/icon.svg', 'www/icon-maskable.svg', 'www/apple-touch-icon.png'];
/** The page of every generator is made of it. */
const PAGE = 'index.html';

// What a visit needs beside its scripts. Of the two renderers it needs one: that is kept when the page has used it.
const ALWAYS_NEEDED = ['page.css', ...COPIED.map((file) => path.basename(file))];
/** No browser asks for them. */
const NEVER_ASKED = /\.map$|\.node\.js$|^cli(-worker)?\.js$|_bg\.wasm$|\.txt$/;

/** Entries whose files in www/entries/ are called as what is made of them. */
function named(...names) {
  return Object.fromEntries(names.map((name) => [name, entryFile(name)]));
}

/** For each generator, what is made of it by the name that the file made of it has. */
function eachAs(nameOf, fileOf) {
  return Object.fromEntries(GENERATORS.map((generator) => [nameOf(generator), fileOf(generator)]));
}

/** The artefact of a generator, or one that comes later, which is in dist/ by this name too. */
function wasmFile({ wasm }) {
  return `${wasm}_bg.wasm`;
}

const common = {
  absWorkingDir: root,
  bundle: true,
  minify: true,
  format: 'esm',
  target: 'es2022',
  sourcemap: true,
  metafile: true,
  // All of them stand in one file (licences.mjs).
  legalComments: 'none',
  external: PEERS,
  logLevel: 'warning',
};

/**
 * `to` is what is served; with `keep`, files of former builds stay in it (hashed-names.mjs). `mark` is a word for every script and wasm file
 * to carry: tests make two builds of the same sources, and scripts add theirs to the set `globalThis.rockFieldMarks` as they run.
 *
 * @param {{ keep?: boolean, to?: string, mark?: string }} [options]
 */
export async function buildWeb({ keep = false, to = dist, mark } = {}) {
  requireFiles();
  await step(`Bundling the page into ${path.relative(root, to)}/`, 'a second', async () => {
    // Built beside and moved over, so that a failed build leaves the last good one being served.
    const staging = path.join(pkg, `.${path.basename(to)}`);
    rmSync(staging, { recursive: true, force: true });
    mkdirSync(staging, { recursive: true });
    const marks = mark ? `(globalThis.rockFieldMarks ??= new Set()).add(${JSON.stringify(mark)});` : '';
    const marking = { banner: { js: marks } };
    const hashed = { outdir: staging, entryNames: HASHED_NAME, platform: 'browser', ...marking };
    // In the order in which one is named in the other.
    const wasm = artefacts.map(({ feature }) => `${feature}_bg.wasm`);
    const names = new Map(wasm.map((name) => [name, copyHashed(path.join(pkg, name), staging, mark)]));
    const built = async (options) => {
      const made = await bundle({ ...hashed, ...options, plugins: [hashedAddresses(names), ...(options.plugins ?? [])] });
      for (const [name, own] of namesOf(made)) names.set(name, own);
      return made;
    };
    const workers = await built({ entryPoints: WORKERS });
    const panel = await built({ entryPoints: PANELS });
    const entryPoints = { ...PAGE_ENTRIES, ...PUBLIC_ENTRIES };
    const plugins = [panelApart(names), await loadedBefore(entryPoints, { plugins: [nodeless, sheetsAsText, panelApart(names)] })];
    const browser = await built({ entryPoints, chunkNames: 'chunk-[hash]', assetNames: '[name]', splitting: true, plugins });
    withPlainNames(staging, browser, PUBLIC_ENTRIES);
    const headless = await built({ entryPoints: HEADLESS_ENTRIES, chunkNames: 'chunk-[hash]', splitting: true });
    withPlainNames(staging, headless, HEADLESS_ENTRIES);
    // Read by people in stack traces.
    const chunks = { chunkNames: 'chunk-[hash].node', splitting: true };
    const node = await bundle({
      entryPoints: NODE_ENTRIES,
      outdir: staging,
      entryNames: '[name]',
      ...chunks,
      platform: 'node',
      minify: false,
    });
    removeUnasked(node);
    const cdn = { ...CDN, outdir: staging, banner: { js: banner() + marks } };
    const classic = await bundle({ ...cdn, plugins: [hashedAddresses(names), panelByAddress] });
    // By plain names for those who import them (`rock-field/generator_bg.wasm`), and for Node.
    for (const name of [...GENERATORS, ...LATER].map(wasmFile)) copyFileSync(path.join(pkg, name), path.join(staging, name));
    for (const file of COPIED) copyFileSync(path.join(root, file), path.join(staging, path.basename(file)));
    const guide = await docs(path.join(staging, 'docs'), marking);
    const meta = relativeTo(staging, merged(browser, headless, workers, panel));
    if (to === dist) writeFileSync(metafile, JSON.stringify(meta));
    const service = await finish(staging, meta, names);
    const all = [workers, panel, browser, headless, node, classic, guide, service];
    writeFileSync(path.join(staging, LICENCES_FILE), licences(all));
    writeFileSync(
      path.join(staging, '.npmignore'),
      pageAlone(meta)
        .map((name) => `/${name}*\n`)
        .join(''),
    );
    publish(staging, to, { keep });
  });
}

async function docs(outdir, marking) {
  const made = await bundle({ ...DOCS, outdir, ...marking });
  const names = namesOf(made);
  await writeDocs(outdir);
  for (const name of readdirSync(outdir).filter((file) => file.endsWith('.html'))) {
    const file = path.join(outdir, name);
    writeFileSync(file, withHashedNames(readFileSync(file, 'utf8'), names));
  }
  return made;
}

/** A page that asks for its script and its style sheet by their names in dist/. */
function withHashedNames(page, names) {
  return page.replace(/(?<=(?:src|href)=")[\w-]+\.(?:js|css)(?=")/g, (name) => names.get(name) ?? name);
}

/** Resolves with the list of what was built of what, and with the files themselves if they are not written. */
export async function bundle(options) {
  try {
    const plugins = [...(options.platform === 'browser' ? [nodeless, sheetsAsText, templatesInOneLine] : []), ...(options.plugins ?? [])];
    const define = options.platform === 'browser' ? { ...rendererBytes(), ...options.define } : options.define;
    const { metafile, outputFiles = [] } = await esbuild.build({ ...common, ...options, define, plugins });
    return { ...needed(metafile, 'list of what was built'), outputFiles };
  } catch (error) {
    throw new Failure(
      `the bundle has ${/** @type {Partial<import('esbuild').BuildFailure>} */ (error).errors?.length ?? 1} error(s), printed above`,
    );
  }
}

/** How large each renderer is once it has arrived: what a server tells is the compressed size, if anything. */
function rendererBytes() {
  // Each by itself: an object would be a chunk of its own.
  const size = (backend) => String(statSync(path.join(pkg, `renderer-${backend}_bg.wasm`)).size);
  return { __WEBGPU_BYTES__: size('webgpu'), __WEBGL_BYTES__: size('webgl') };
}

/** A module that is imported later by what was left out is written all the same: takes away what nothing asks for. */
function removeUnasked({ outputs }) {
  const asked = new Set(Object.values(outputs).flatMap(({ imports }) => imports.map(({ path: file }) => file)));
  const entries = Object.values(NODE_ENTRIES);
  for (const [file, { entryPoint }] of Object.entries(outputs)) {
    if (!file.endsWith('.js') || entries.includes(entryPoint) || asked.has(file)) continue;
    for (const suffix of ['', '.map']) rmSync(path.join(root, file + suffix));
  }
}

function requireFiles() {
  const entries = [PAGE_ENTRIES, PUBLIC_ENTRIES, WORKERS, NODE_ENTRIES, PANELS].flatMap(Object.values);
  const files = [...entries, ...CDN.inject, ...DOCS.entryPoints, SERVICE_WORKER, ...COPIED, PAGE];
  const compiled = artefacts.map(({ feature }) => path.join(path.relative(root, pkg), `${feature}_bg.wasm`));
  const missing = [...files, ...compiled].filter((file) => !existsSync(path.join(root, file)));
  if (missing.length > 0) throw new Failure(`the page cannot be built: missing ${missing.join(', ')}`);
}

/** Writes index.html with the build's id in it, and the service worker that knows the id and the files. */
async function finish(staging, meta, hashedNames) {
  const names = filesIn(staging)
    .filter((name) => !NEVER_ASKED.test(name))
    .sort();
  const files = Object.fromEntries(names.map((name) => [name, integrity(path.join(staging, name))]));
  const page = readFileSync(path.join(root, PAGE), 'utf8');
  if (!page.includes('</head>')) throw new Failure(`${PAGE} has no </head> to put the build's id before`);
  const build = hashOf(page, JSON.stringify(files)).slice(0, 16);
  for (const { file, script, title, description } of GENERATORS.map(({ page: own }) => own)) {
    // The chunks are asked for with the page, not one import after the other.
    const preloads = scriptsOf(meta, PAGE_ENTRIES[script]).map((chunk) => `<link rel="modulepreload" href="./${chunk}">`);
    const added = [`<meta name="rock-field-build" content="${build}">`, ...preloads].map((line) => `  ${line}\n  `).join('');
    let written = withHashedNames(page.replace('src="main.js"', `src="${script}.js"`), hashedNames).replace('</head>', `${added}</head>`);
    if (title) written = written.replace(/(?<=<title>)[^<]*/, title);
    if (description) written = written.replace(/(?<=<meta name="description" content=")[^"]*/, description);
    writeFileSync(path.join(staging, file), written);
  }
  const needed = (generator) => {
    const generators = withGround(generator);
    const workers = [...generators.map(({ worker }) => worker), ...generator.otherWorkers];
    const entries = [pageScript(generator), ...workers.map(entryFile)];
    const scripts = entries.flatMap((entry) => scriptsOf(meta, entry, { dynamic: true }));
    const others = [...generators.map(wasmFile), ...ALWAYS_NEEDED].map((name) => hashedNames.get(name) ?? name);
    return [...new Set([...scripts.filter((name) => !isRendererGlue(meta, name)), ...others])];
  };
  const pages = Object.fromEntries(GENERATORS.map((generator) => [generator.page.file, needed(generator)]));
  const glue = /^pkg\/([\w-]+)\.js$/;
  const ofWorkers = Object.values(WORKERS).map((entry) => {
    const [script] = scriptsOf(meta, entry);
    const artefacts = Object.keys(meta.outputs[`dist/${script}`].inputs).flatMap((input) => glue.exec(input)?.[1] ?? []);
    return [script, artefacts.map((wasm) => hashedNames.get(wasmFile({ wasm })))];
  });
  return bundle({
    entryPoints: { sw: SERVICE_WORKER },
    outdir: staging,
    sourcemap: false,
    define: {
      __BUILD__: JSON.stringify(build),
      __HASHED__: JSON.stringify(HASHED.source),
      __FILES__: JSON.stringify(files),
      __PAGES__: JSON.stringify(pages),
      __WORKERS__: JSON.stringify(Object.fromEntries(ofWorkers)),
    },
  });
}

/** An entry and every script it imports, by name; with `dynamic` also those it may import later. `entryPoint` is the source file. */
export function scriptsOf(meta, entryPoint, { dynamic = false } = {}) {
  const found = new Set(Object.keys(meta.outputs).filter((name) => meta.outputs[name].entryPoint === entryPoint));
  if (found.size !== 1) throw new Failure(`${entryPoint} is not an entry of the build`);
  for (const name of found) {
    for (const { path: imported, kind, external } of meta.outputs[name].imports) {
      if (!external && (kind === 'import-statement' || (dynamic && kind === 'dynamic-import'))) found.add(imported);
    }
  }
  return [...found].map((name) => name.slice('dist/'.length));
}

/** Files that no entry of the package asks for: `files` in package.json cannot tell them from the others. */
function pageAlone(meta) {
  const asked = [PUBLIC_ENTRIES, HEADLESS_ENTRIES, PANELS, WORKERS]
    .flatMap(Object.values)
    .flatMap((entry) => scriptsOf(meta, entry, { dynamic: true }));
  const scripts = Object.keys(meta.outputs)
    .map((name) => path.basename(name))
    .filter((name) => name.endsWith('.js'));
  return scripts.filter((name) => !asked.includes(name));
}

function isRendererGlue(meta, name) {
  return Object.keys(meta.outputs[`dist/${name}`].inputs).some((input) => input.startsWith('pkg/renderer-'));
}

function integrity(file) {
  return `sha256-${createHash('sha256').update(readFileSync(file)).digest('base64')}`;
}

/** Several builds into one folder, as one. */
function merged(...metas) {
  return {
    inputs: Object.assign({}, ...metas.map(({ inputs }) => inputs)),
    outputs: Object.assign({}, ...metas.map(({ outputs }) => outputs)),
  };
}

/** Output names in the metafile as they are in dist/. */
function relativeTo(staging, meta) {
  const prefix = `${path.relative(root, staging).replaceAll(path.sep, '/')}/`;
  return JSON.parse(JSON.stringify(meta).replaceAll(prefix, 'dist/'));
}
