// The packed package in the pages of others: each host is built from the tarball alone, with no special configuration, and opened in Chromium.
import assert from 'node:assert/strict';
import { cpSync, existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import * as esbuild from 'esbuild';
import { cache, hashOf, root } from '../../scripts/env.mjs';
import { isMain, main, npm, run, say, step } from '../../scripts/run.mjs';
import { pack } from '../../scripts/package.mjs';
import { serve } from '../../scripts/serve.mjs';
import { launch } from '../e2e/browser.mjs';

const ELEMENT = '<rock-field preset="journal-fig1" seed="7" style="width: 400px; height: 300px"></rock-field>';

/** Everything from the page's own origin: what `rock-field` promises to get by with. The rest is this page's icon and the element's size. */
const STRICT = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self'; connect-src 'self'; img-src data:; style-src-attr 'unsafe-inline'";

/**
 * `prepare(site, folder)` fills the site from the unpacked package; `policy` is the site's Content-Security-Policy. With `cdn` the
 * package is served from another origin, whose address `page` is given.
 */
const HOSTS = [
  { name: 'a module by its path', prepare: vendor, page: () => page('<script type="module" src="./rock-field/rock-field.js"></script>') },
  { name: 'an import map', prepare: vendor, page: () => page('<script type="importmap">{ "imports": { "rock-field": "./rock-field/rock-field.js" } }</script><script type="module">import "rock-field";</script>') },
  { name: 'a strict policy', prepare: vendor, policy: STRICT, page: () => page('<script type="module" src="./rock-field/rock-field.js"></script>') },
  { name: 'a classic script', prepare: vendor, policy: STRICT, page: () => page('<script src="./rock-field/cdn.js" defer></script>') },
  { name: 'a classic script from another origin', cdn: true, page: (cdn) => page(`<script src="${cdn}cdn.js"></script>`) },
  { name: 'esbuild, the files of the package beside its output', prepare: withEsbuild, policy: STRICT, page: () => page('<script type="module" src="./rock-field/bundled.js"></script>') },
  { name: 'Vite', prepare: withVite, policy: STRICT },
  { name: 'webpack', prepare: withWebpack, policy: STRICT, page: () => page('<script src="./main.js" defer></script>') },
];

export async function check() {
  const { outside, folder } = await pack();
  try {
    const failed = [];
    for (const host of HOSTS) {
      const site = path.join(outside, 'site');
      rmSync(site, { recursive: true, force: true });
      mkdirSync(site);
      await host.prepare?.(site, folder);
      await step(host.name, '5 s', () => show(host, site, folder)).catch((error) => {
        say(`  ✗ ${error.message}`);
        failed.push(host.name);
      });
    }
    assert.deepEqual(failed, [], 'hosts in which there are no rocks');
  } finally {
    rmSync(outside, { recursive: true, force: true });
  }
}

/** Opens the page and waits for the picture; it has to come without an error, and from nowhere else. */
async function show({ cdn: fromCdn, policy, page: content }, site, folder) {
  const cdn = fromCdn ? await serve(path.join(folder, 'dist'), { intercept: allowAll }) : undefined;
  if (content) writeFileSync(path.join(site, 'index.html'), content(cdn?.url));
  const session = await launch({ folder: site, intercept: policy && ((request, response) => void response.setHeader('content-security-policy', policy)) });
  try {
    const asked = new Set();
    const prepare = (opened) => void opened.context().on('request', (request) => asked.add(new URL(request.url()).origin));
    const { page: opened, errors } = await session.open('', { prepare });
    const rocks = await opened.evaluate(async () => {
      await customElements.whenDefined('rock-field');
      const element = document.querySelector('rock-field');
      const failure = new Promise((_, reject) => element.addEventListener('error', ({ detail }) => reject(new Error(detail.error.message))));
      await Promise.race([element.ready, failure]);
      return element.field.stats.rocks;
    });
    assert.ok(rocks > 2000, `${rocks} rocks`);
    assert.deepEqual(errors, []);
    const known = [session.url, cdn?.url].filter(Boolean).map((url) => new URL(url).origin);
    assert.deepEqual([...asked].filter((origin) => origin !== 'null' && !known.includes(origin)), [], 'origins that are none of ours were asked');
  } finally {
    await session.close();
    await cdn?.close();
  }
}

function page(scripts) {
  return `<!doctype html><html lang="en"><meta charset="utf-8"><title>host</title><link rel="icon" href="data:,">${ELEMENT}${scripts}`;
}

/** The package's files copied beside the page, as one does without a bundler. */
function vendor(site, folder) {
  cpSync(path.join(folder, 'dist'), path.join(site, 'rock-field'), { recursive: true });
}

/** esbuild leaves `new URL('./worker.js', import.meta.url)` as it stands: what it names has to be put there. */
async function withEsbuild(site, folder) {
  vendor(site, folder);
  const stdin = { contents: "import 'rock-field';", resolveDir: path.dirname(path.dirname(folder)) };
  await esbuild.build({ stdin, bundle: true, format: 'esm', outfile: path.join(site, 'rock-field', 'bundled.js'), logLevel: 'warning' });
}

async function withVite(site, folder) {
  const project = await install('vite', folder);
  writeFileSync(path.join(project, 'index.html'), page('<script type="module" src="./main.js"></script>'));
  await run(process.execPath, [path.join('node_modules', 'vite', 'bin', 'vite.js'), 'build', '--logLevel', 'warn', '--outDir', site, '--emptyOutDir'], { cwd: project });
}

async function withWebpack(site, folder) {
  const project = await install('webpack', folder);
  await run(process.execPath, [path.join('node_modules', 'webpack-cli', 'bin', 'cli.js'), '--mode', 'production', '--output-path', site, '--stats', 'errors-only'], { cwd: project });
}

/** A host's project in the cache, with the packages of its lockfile and ours as unpacked from the tarball. */
async function install(name, folder) {
  const source = path.join(root, 'tests', 'hosts', name);
  const project = path.join(cache, 'hosts', `${name}-${hashOf(readFileSync(path.join(source, 'package-lock.json'))).slice(0, 12)}`);
  const done = path.join(project, 'node_modules', '.package-lock.json');
  cpSync(source, project, { recursive: true });
  if (!existsSync(done)) {
    await step(`Installing the packages of ${name}`, '10 s', () => npm(['ci', '--ignore-scripts', '--no-audit', '--no-fund', '--loglevel=error'], { cwd: project }));
  }
  const ours = path.join(project, 'node_modules', 'rock-field');
  rmSync(ours, { recursive: true, force: true });
  cpSync(folder, ours, { recursive: true });
  return project;
}

/** What public CDNs answer with. */
function allowAll(request, response) {
  response.setHeader('access-control-allow-origin', '*');
  return false;
}

if (isMain(import.meta)) {
  await main(async () => {
    await check();
    say(`✓ ${HOSTS.length} hosts show rocks`);
  });
}
