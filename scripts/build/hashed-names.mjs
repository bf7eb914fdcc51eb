// Names with the content's hash in them, such as worker-7GQ2XW3B.js: such a file is never replaced by another, so whoever has its name gets
// the right one or none. Everything a script or a page fetches is named like this, but for the entries that people write into their own pages.
import { createHash } from 'node:crypto';
import { mkdirSync, readFileSync, readdirSync, renameSync, rmSync, statSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { Failure, needed } from '../lib/run.mjs';

/** The bundler's option, and what it comes to; www/pages/service-worker.ts recognises the same names. */
export const HASHED_NAME = '[name]-[hash]';
export const HASHED = /-[A-Z0-9]{8}\.(js|css|wasm)(\.map)?$/;

/** `worker.js` for `worker-7GQ2XW3B.js`, wherever it stands in a text. */
export function plainName(text) {
  return text.replace(/-[A-Z0-9]{8}(?=\.(js|css|wasm)\b)/g, '');
}

/** The one form of an address that bundlers recognise, and that sources are written in. The glue of wasm-bindgen leaves out the `./`. */
const ADDRESS = /new URL\('(?:\.\/)?([\w.-]+)', import\.meta\.url\)/g;

/** How long `npm run build -- --keep` keeps the files of former builds. */
const KEPT_DAYS = 30;

/** Copies a wasm file under a name with its hash, perhaps with a `mark` in a section that nobody reads; returns that name. */
export function copyHashed(file, folder, mark = '') {
  const { name, ext } = path.parse(file);
  const section = mark ? [0, mark.length + 1, mark.length, ...Buffer.from(mark)] : [];
  const bytes = Buffer.concat([readFileSync(file), Buffer.from(section)]);
  const hash = createHash('sha256').update(bytes).digest('hex').slice(0, 8).toUpperCase();
  writeFileSync(path.join(folder, `${name}-${hash}${ext}`), bytes);
  return `${name}-${hash}${ext}`;
}

/** By plain name (`worker.js`): the name with a hash that the bundler gave the entry. */
export function namesOf({ outputs }) {
  const entries = Object.entries(outputs).filter(([, { entryPoint }]) => entryPoint);
  return new Map(entries.map(([file]) => [plainName(path.basename(file)), path.basename(file)]));
}

/** Puts hashed names into the addresses of scripts: a script and what it fetches are of one build by that. */
export function hashedAddresses(names) {
  return {
    name: 'hashed-addresses',
    setup(build) {
      build.onLoad({ filter: /[\\/](www|pkg)[\\/].*\.(ts|js)$/ }, ({ path: file }) => {
        const text = readFileSync(file, 'utf8');
        const contents = text.replaceAll(ADDRESS, (_, name) => {
          if (!names.has(name)) throw new Failure(`${file} asks for ${name}, which the build has not made before it`);
          return `new URL('./${names.get(name)}', import.meta.url)`;
        });
        return contents === text ? undefined : { contents, loader: path.extname(file).slice(1) };
      });
    },
  };
}

/** Gives the entries that people write into their pages their plain names again, each with its source map. Nothing that was built imports an entry. */
export function withPlainNames(folder, meta, entryPoints) {
  const names = namesOf(meta);
  for (const [name, entryPoint] of Object.entries(entryPoints)) {
    const plain = `${name}.js`;
    const hashed = needed(names.get(plain), `${plain} in what was built`);
    writeFileSync(path.join(folder, plain), readFileSync(path.join(folder, hashed), 'utf8').replace(`${hashed}.map`, `${plain}.map`));
    renameSync(path.join(folder, `${hashed}.map`), path.join(folder, `${plain}.map`));
    rmSync(path.join(folder, hashed));
    const output = needed(
      Object.keys(meta.outputs).find((file) => meta.outputs[file].entryPoint === entryPoint),
      `output for ${entryPoint}`,
    );
    for (const suffix of ['', '.map']) {
      meta.outputs[path.posix.join(path.posix.dirname(output), plain + suffix)] = meta.outputs[output + suffix];
      delete meta.outputs[output + suffix];
    }
  }
}

/**
 * Moves a build over the one that is being served, in an order in which every file finds those it asks for, and takes away what is of no
 * use any more. With `keep`, files with hashed names of former builds stay for a month: pages that are open still ask for them.
 */
export function publish(staging, folder, { keep = false } = {}) {
  const made = filesIn(staging).sort((a, b) => turn(a) - turn(b));
  for (const name of made) {
    mkdirSync(path.dirname(path.join(folder, name)), { recursive: true });
    renameSync(path.join(staging, name), path.join(folder, name));
  }
  const oldest = Date.now() - KEPT_DAYS * 24 * 3600 * 1000;
  const current = new Set(made);
  const isKept = (name) => keep && HASHED.test(name) && statSync(path.join(folder, name)).mtimeMs > oldest;
  for (const name of filesIn(folder)) if (!current.has(name) && !isKept(name)) rmSync(path.join(folder, name));
  removeEmpty(folder);
  rmSync(staging, { recursive: true });
}

/** Files, then the scripts that ask for them, then pages, then the service worker, which takes in all of them. */
function turn(name) {
  if (HASHED.test(name)) return 0;
  return name === 'sw.js' ? 3 : name.endsWith('.html') ? 2 : 1;
}

function removeEmpty(folder) {
  for (const entry of readdirSync(folder, { withFileTypes: true })) {
    const inner = path.join(folder, entry.name);
    if (!entry.isDirectory()) continue;
    removeEmpty(inner);
    if (readdirSync(inner).length === 0) rmSync(inner, { recursive: true });
  }
}

/** Relative to the folder, with forward slashes. */
export function filesIn(folder) {
  return readdirSync(folder, { recursive: true, withFileTypes: true })
    .filter((entry) => entry.isFile())
    .map((entry) => path.relative(folder, path.join(entry.parentPath ?? entry.path, entry.name)).replaceAll(path.sep, '/'));
}
