// dist/THIRD-PARTY-LICENSES.txt: who wrote what else is in the files of the package, and the licences that come with it.
//
// Written here and not by a tool, since none sees all of it: license-checker lists what is installed, of which a tenth is bundled; bundlers'
// plugins know one of our eight bundles each, and no crates; cargo-about does the crates well, but compiling it takes longer than `npm start`.
import { spawnSync } from 'node:child_process';
import { existsSync, readFileSync, readdirSync } from 'node:fs';
import path from 'node:path';
import parse from 'spdx-expression-parse';
import { root } from '../lib/env.mjs';
import { Failure } from '../lib/run.mjs';
import { artefacts } from './wasm.mjs';

export const LICENCES_FILE = 'THIRD-PARTY-LICENSES.txt';

/** What stands at the head of files that people take away without the others. */
export function banner() {
  const { name, version, license } = ourselves();
  return `/*! ${name} ${version} | ${license} | third-party licences: ${LICENCES_FILE} */\n`;
}

const ourselves = () => JSON.parse(readFileSync(path.join(root, 'package.json'), 'utf8'));

/** Licences that ask for no more than their text, each with what files of it are called. Of those that authors offer, the first is taken. */
const ALLOWED = {
  MIT: /\bmit\b/i,
  'MIT-0': /\bmit-?0\b/i,
  ISC: /\bisc\b/i,
  'BSD-3-Clause': /\bbsd\b/i,
  'BSD-2-Clause': /\bbsd\b/i,
  Zlib: /\bzlib\b/i,
  'BSL-1.0': /\b(bsl|boost)\b/i,
  'Unicode-3.0': /\bunicode\b/i,
  'CC0-1.0': /\bcc0\b/i,
  'Apache-2.0': /\bapache\b/i,
  'Apache-2.0 WITH LLVM-exception': /\b(apache|llvm)\b/i,
};
const PREFERRED = Object.keys(ALLOWED);

/** Files in which a package says what it is licensed under; of `NOTICE`, whatever the licence. */
const LICENCE = /^(licen[cs]e|copying|unlicense)/i;
const NOTICE = /^(notice|copyright)/i;

/**
 * What is not ours: `texts` are those that its licence wants to be passed on.
 *
 * @typedef {{ name: string, version: string, licence: string, chosen: string[], texts: string[] }} Part
 */

/** The licences that are taken of an SPDX expression; a Failure says which one of `who` is none of ours. */
export function chosenOf(expression, who) {
  let tree;
  try {
    // Old crates write a slash for OR.
    tree = parse((expression ?? '').replaceAll('/', ' OR '));
  } catch {
    throw new Failure(`${who} has the licence ${JSON.stringify(expression ?? null)}, which is not an SPDX expression`);
  }
  const chosen = choose(tree);
  if (!chosen) {
    throw new Failure(
      `${who} has the licence ${expression}, which is not among ${PREFERRED.join(', ')}. If it may be bundled, add it to scripts/build/licences.mjs`,
    );
  }
  return chosen;
}

/** @returns {string[] | undefined} */
function choose(tree) {
  if ('license' in tree) {
    const name = tree.exception ? `${tree.license} WITH ${tree.exception}` : tree.license;
    return name in ALLOWED ? [name] : undefined;
  }
  const [left, right] = [choose(tree.left), choose(tree.right)];
  if (tree.conjunction === 'and') return left && right && [...new Set([...left, ...right])];
  if (!left || !right) return left ?? right;
  return rank(left) <= rank(right) ? left : right;
}

const rank = (chosen) => Math.max(...chosen.map((name) => PREFERRED.indexOf(name)));

/**
 * The part that lies in `folder`. `instead` gives the text of a licence for a package that names it without a file of it.
 *
 * @param {{ name: string, version: string, license?: string | null, folder: string }} found
 * @param {(licence: string) => string | undefined} [instead]
 * @returns {Part}
 */
export function partIn({ name, version, license, folder }, instead = () => undefined) {
  const who = `${name} ${version}`;
  if (!license) throw new Failure(`${who} is bundled and names no licence`);
  const chosen = chosenOf(license, who);
  const files = readdirSync(folder, { withFileTypes: true })
    .filter((entry) => entry.isFile())
    .map((entry) => entry.name)
    .sort();
  const licences = files.filter((file) => LICENCE.test(file));
  const named = licences.filter((file) => chosen.some((licence) => ALLOWED[licence].test(file.replaceAll(/[_.]/g, '-'))));
  const used = [...(named.length > 0 ? named : licences), ...files.filter((file) => NOTICE.test(file))];
  const texts =
    licences.length > 0
      ? used.map((file) => readFileSync(path.join(folder, file), 'utf8'))
      : chosen.map((licence) => {
          const text = instead(licence);
          if (!text) throw new Failure(`${who} is bundled and has no file with its licence, ${license}`);
          return text;
        });
  return { name, version, licence: license, chosen, texts };
}

/** The npm packages that the bundler took something from, whose folders are relative to `base`. */
export function packagesOf(metafiles, base = root) {
  const inputs = metafiles.flatMap(({ outputs }) => Object.values(outputs).flatMap((output) => Object.keys(output.inputs)));
  const folders = new Set(inputs.map((input) => /^(?:.*\/)?node_modules\/(?:@[^/]+\/)?[^/]+(?=\/)/.exec(input)?.[0] ?? ''));
  folders.delete('');
  return [...folders].map((relative) => {
    const folder = path.join(base, relative);
    const { name, version, license } = JSON.parse(readFileSync(path.join(folder, 'package.json'), 'utf8'));
    return partIn({ name, version, license, folder });
  });
}

let inWasm = /** @type {Part[] | undefined} */ (undefined);

/** What is linked into the artefacts: crates, and Rust's standard library. The same all the time that a script runs. */
function linked() {
  inWasm ??= [...crates(), ...standardLibrary()];
  return inWasm;
}

function crates() {
  const features = ['--no-default-features', '--features', artefacts.map(({ feature }) => feature).join()];
  const target = 'wasm32-unknown-unknown';
  // Without the network, but for crates that no build has needed so far: `cargo metadata` wants those of the tests too.
  const tree = told('cargo', ['tree', '--locked', ...features, '--target', target, '-e', 'normal,no-proc-macro', '--prefix', 'none']);
  const metadata = told('cargo', ['metadata', '--locked', '--format-version', '1', ...features, '--filter-platform', target]);
  const { packages } = JSON.parse(metadata);
  const wanted = new Set(tree.split('\n').map((line) => line.split(' ').slice(0, 2).join(' ')));
  return packages
    .filter(({ name, version, source }) => source && wanted.has(`${name} v${version}`))
    .map(({ name, version, license, authors, manifest_path: manifest }) =>
      partIn({ name, version, license, folder: path.dirname(manifest) }, (licence) => standardText(licence, authors)),
    );
}

/** The text of a licence as the Rust toolchain has it, with the names of those who hold the rights. */
function standardText(licence, holders) {
  const file = path.join(docsOfRust(), 'licenses', `${licence}.txt`);
  if (!existsSync(file)) return undefined;
  const names = holders.length > 0 ? holders.map(withoutAddress).join(', ') : 'its contributors';
  return readFileSync(file, 'utf8').replace(/<year> <(copyright holders|owner)>/, names);
}

/** `Ann <ann@example.com>` → `Ann` */
const withoutAddress = (author) => author.replace(/\s*<[^>]*>/, '');

/** The standard library itself, and the crates in it that were compiled for wasm, by what the toolchain says about them. */
function standardLibrary() {
  const file = path.join(docsOfRust(), 'COPYRIGHT-library.html');
  if (!existsSync(file))
    throw new Failure(`the Rust toolchain lacks ${file}, which says how its standard library is licensed; rustup's have it`);
  const [own, ...sections] = readFileSync(file, 'utf8').split('<h3>📦 ');
  const compiled = readdirSync(path.join(sysroot(), 'lib', 'rustlib', 'wasm32-unknown-unknown', 'lib')).join(' ');
  const version = told('rustc', ['--version']).split(' ')[1];
  const files = own
    .split('File/Directory')
    .slice(1)
    .map((html) => {
      const [licence] = fieldsOf(html, 'License');
      return { licence, chosen: chosenOf(licence, 'the Rust standard library'), holders: fieldsOf(html, 'Copyright') };
    });
  const licences = [...new Set(files.map(({ licence }) => licence))];
  const chosen = [...new Set(files.flatMap((file) => file.chosen))];
  const holdersOf = (one) => [...new Set(files.flatMap((file) => (file.chosen.includes(one) ? file.holders : [])))];
  const texts = chosen.map((one) => standardText(one, holdersOf(one)) ?? '');
  const library = { name: 'Rust standard library', version, licence: licences.map((one) => `(${one})`).join(' AND '), chosen, texts };
  const others = sections
    .map((section) => ({ section, title: /^(.+?)-(\d[^<]*)</.exec(section) }))
    .filter(({ title }) => title && compiled.includes(`lib${title[1].replaceAll('-', '_')}-`))
    .map(({ section, title }) => crateOfLibrary(section, title?.[1] ?? '', title?.[2] ?? ''));
  return [library, ...others];
}

/** @returns {Part} */
function crateOfLibrary(section, name, version) {
  const [licence] = fieldsOf(section, 'License');
  const chosen = chosenOf(licence, `${name} ${version}`);
  const notices = [...section.matchAll(/<summary><code>(.*?)<\/code><\/summary>\s*<pre>([^<]*)</g)].map(([, file, text]) => ({
    file,
    text,
  }));
  const named = notices.filter(({ file }) => chosen.some((one) => ALLOWED[one].test(file)));
  const texts = (named.length > 0 ? named : notices).map(({ text }) => decoded(text));
  const standard = () => chosen.map((one) => standardText(one, fieldsOf(section, 'Authors')) ?? '');
  return { name: `${name} (in the Rust standard library)`, version, licence, chosen, texts: texts.length > 0 ? texts : standard() };
}

/** What stands behind a word in bold. */
function fieldsOf(html, word) {
  return [...html.matchAll(new RegExp(`<b>${word}:</b>\\s*([^<]*)`, 'g'))].map(([, text]) => decoded(text).trim());
}

function decoded(html) {
  return html.replace(/&#(\d+);/g, (_, code) => String.fromCodePoint(Number(code))).replaceAll('&amp;', '&');
}

const docsOfRust = () => path.join(sysroot(), 'share', 'doc', 'rust');
const sysroot = () => told('rustc', ['--print', 'sysroot']);

function told(program, args) {
  const { status, stdout, stderr, error } = spawnSync(program, args, { cwd: root, encoding: 'utf8', maxBuffer: 1 << 28 });
  if (status !== 0) throw new Failure(`${program} ${args[0]} failed: ${error?.message ?? stderr}`);
  return stdout.trim();
}

/** The text of the file, for everything that went into these bundles and into the artefacts. */
export function licences(metafiles) {
  const { name, version, license } = ourselves();
  return written(`${name} ${version}`, license, [
    { title: 'npm packages in the scripts and style sheets', parts: packagesOf(metafiles) },
    { title: 'Crates in the WebAssembly files', parts: linked() },
  ]);
}

/** A list of the parts, then each text once, with the names of those whose it is. */
function written(product, own, groups) {
  /** @type {Map<string, { text: string, of: string[] }>} */
  const texts = new Map();
  const lists = groups.map(({ title, parts }) => {
    const lines = parts
      .map((part) => ({ ...part, key: `${part.name} ${part.version}` }))
      .sort((a, b) => (a.key < b.key ? -1 : 1))
      .map(({ key, licence, chosen, texts: those }) => {
        const numbers = [...new Set(those.map((text) => numberOf(texts, text, key)))];
        const taken = chosen.join(' AND ');
        return `${key}\n    ${licence}${taken === licence ? '' : `, of which ${taken}`}; text ${numbers.join(', ')}`;
      });
    return `${title}\n\n${lines.join('\n')}`;
  });
  const full = [...texts.values()].map(({ text, of }, index) => `${RULE}\nText ${index + 1}: ${of.join(', ')}\n${RULE}\n\n${text}`);
  return `${[
    `Third-party licences of ${product}`,
    `${product} is licensed under ${own}. Its files contain what follows of others. Where they offer a choice of licences, the one that was taken is named.`,
    ...lists,
    ...full,
  ].join('\n\n')}\n`;
}

const RULE = '-'.repeat(80);

/** The number of a text, which is new or has been there already but for its spaces. */
function numberOf(texts, text, who) {
  const lines = text.replaceAll('\r', '').split('\n');
  const tidy = lines
    .map((line) => line.trimEnd())
    .join('\n')
    .replace(/^\n+|\n+$/g, '');
  const same = tidy.replaceAll(/\s+/g, ' ');
  if (!same.trim()) throw new Failure(`${who} has an empty licence`);
  const found = texts.get(same) ?? { text: tidy, of: [] };
  if (!found.of.includes(who)) found.of.push(who);
  texts.set(same, found);
  return [...texts.keys()].indexOf(same) + 1;
}
