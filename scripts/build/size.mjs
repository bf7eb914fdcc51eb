// The size budgets, after brotli as a web server would send it. Needs a build.
import { existsSync, readFileSync } from 'node:fs';
import path from 'node:path';
import { brotliCompressSync, constants } from 'node:zlib';
import { dist, hashOf, pkg } from '../lib/env.mjs';
import { GENERATORS, LATER, camelCase, pageScript } from '../lib/generators.mjs';
import { Failure, isMain, main } from '../lib/run.mjs';

/** The artefacts whose budgets stand in generators.mjs. */
const LISTED = [...GENERATORS, ...LATER];

/** In bytes; 1 kB = 1000 bytes. */
export const BUDGETS = {
  ...Object.fromEntries(LISTED.map(({ wasm, budget }) => [camelCase(wasm), budget])),
  rendererWebgpu: 113_000,
  rendererWebgl: 660_000,
  page: 48_000,
};

/** Of the pages, that of the first generator is measured. */
const PAGE = pageScript(GENERATORS[0]);

const ADVICE = {
  ...Object.fromEntries(
    LISTED.map(({ wasm }) => [
      camelCase(wasm),
      `look for formatting code and generic copies (twiggy top pkg/${wasm}_bg.wasm), or for a new dependency (cargo tree --features ${wasm})`,
    ]),
  ),
  rendererWebgpu:
    'look for a wgpu feature that crept in (cargo tree -e features --features renderer-webgpu): exports are linker roots, so what is compiled in counts',
  rendererWebgl: 'look for a wgpu feature that crept in (cargo tree -e features --features renderer-webgl)',
  page: `see what is in it with: npx esbuild --analyze --bundle --minify --format=esm --splitting --outdir=.cache/analyse ${PAGE}; import lazily what the first picture does not need`,
};

/** Bytes after brotli: wasm and glue of each artefact, and the page's script with everything it imports at once. */
export async function measure() {
  const meta = path.join(pkg, 'web.meta.json');
  if (!existsSync(meta)) throw new Failure('there is no build to measure. Make one with: npm run build');
  const { scriptsOf } = await import('./web.mjs');
  const scripts = scriptsOf(JSON.parse(readFileSync(meta, 'utf8')), PAGE);
  return {
    ...Object.fromEntries(await Promise.all(LISTED.map(async ({ wasm }) => [camelCase(wasm), await artefact(wasm)]))),
    rendererWebgpu: await artefact('renderer-webgpu'),
    rendererWebgl: await artefact('renderer-webgl'),
    page: scripts.reduce((sum, name) => sum + brotli(Buffer.from(withSteadyHashes(readFileSync(path.join(dist, name), 'utf8')))), 0),
  };
}

/**
 * The hashes in a script's imports change with every edit of what they name, and some compress better than others: 70 bytes in a page. Hashes that are
 * always the same stand in for them.
 */
function withSteadyHashes(text) {
  const steady = new Map();
  return text.replace(/(?<=-)[A-Z0-9]{8}(?=\.(?:js|css|wasm)\b)/g, (hash) => {
    if (!steady.has(hash)) steady.set(hash, hashOf(String(steady.size)).slice(0, 8).toUpperCase());
    return steady.get(hash);
  });
}

async function artefact(name) {
  const { transform } = await import('esbuild');
  const glue = await transform(readFileSync(path.join(pkg, `${name}.js`), 'utf8'), { minify: true, format: 'esm', target: 'es2022' });
  return brotli(readFileSync(path.join(pkg, `${name}_bg.wasm`))) + brotli(Buffer.from(glue.code));
}

/** Bytes as a web server would send them. */
export function brotli(bytes) {
  const { BROTLI_PARAM_QUALITY, BROTLI_PARAM_SIZE_HINT } = constants;
  return brotliCompressSync(bytes, { params: { [BROTLI_PARAM_QUALITY]: 11, [BROTLI_PARAM_SIZE_HINT]: bytes.length } }).length;
}

/** Prints the table; throws when something is over its budget. */
export async function check() {
  const sizes = await measure();
  const over = [];
  for (const [name, budget] of Object.entries(BUDGETS)) {
    const fits = sizes[name] <= budget;
    if (!fits) over.push(name);
    console.log(`${name.padEnd(16)}${kB(sizes[name])} of ${kB(budget)} kB brotli${fits ? '' : '   OVER'}`);
  }
  if (over.length === 0) return;
  const advice = over.map((name) => `  ${name}: ${ADVICE[name]}.`).join('\n');
  throw new Failure(
    `over the size budget: ${over.join(', ')}\n${advice}\n  If the growth is worth it, say so in CHANGELOG.md and raise the budget (scripts/lib/generators.mjs, scripts/build/size.mjs).`,
  );
}

function kB(bytes) {
  return (bytes / 1000).toFixed(1).padStart(6);
}

if (isMain(import.meta)) await main(check);
