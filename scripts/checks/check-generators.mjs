// What a generator still lacks: its own files, and its lines in files for people, which cannot be derived from generators.mjs.
// `npm test -- --only generators` says all of it.
import { existsSync, readFileSync } from 'node:fs';
import path from 'node:path';
import { root } from '../lib/env.mjs';
import { GENERATORS, addressFunction, entriesOf, entryFile, inRust, pageScript, workersOf } from '../lib/generators.mjs';
import { Failure, needed } from '../lib/run.mjs';

const TYPINGS = ['jsx', 'svelte', 'vue'].map((name) => `www/typings/${name}.d.ts`);

/** Returns a sentence for everything that the generators lack; `read` gives the text of a file by its name in the repository, null without one. */
export function generatorProblems(generators = GENERATORS, read = readText) {
  const texts = [...namesTwice(generators), ...generators.flatMap((generator) => ownFiles(generator, read))];
  const manifest = JSON.parse(needed(read('package.json'), 'package.json'));
  texts.push(...generators.flatMap((generator) => packageLines(generator, manifest, generator === generators[0])));
  texts.push(...generators.flatMap((generator) => textLines(generator, read)));
  return texts;
}

/** Two files in dist/ of one name would be one. */
function namesTwice(generators) {
  const names = generators.flatMap((generator) => [
    ...new Set([...entriesOf(generator), ...workersOf(generator), generator.panel, generator.cdn, generator.page.script]),
    `${generator.wasm}_bg.wasm`,
    generator.page.file,
  ]);
  return names.filter((name, index) => names.indexOf(name) !== index).map((name) => `two generators have a ${name}`);
}

function ownFiles(generator, read) {
  const { name, tag, wasm, goldens, docs, table, paramDocs } = generator;
  const files = [
    `src/${inRust(name)}/mod.rs`,
    `src/params/${inRust(name)}/mod.rs`,
    `src/bindings/${inRust(wasm)}.rs`,
    `tests/${goldens}.rs`,
    ...['element', 'panel', 'load-panel', 'load-panel.cdn', 'table', 'param-docs.gen'].map((file) => `www/${name}/${file}.ts`),
    pageScript(generator),
    ...[...entriesOf(generator), ...workersOf(generator)].map(entryFile),
    ...(docs ? [`www/docs/pages/${tag}.md`] : []),
  ];
  const missing = files.filter((file) => read(file) === null).map((file) => `there is no ${file}`);
  const contents = [
    [entryFile(tag), `customElements.define('${tag}'`],
    [entryFile(generator.worker), `'./${wasm}_bg.wasm'`],
    [`www/${name}/table.ts`, `export const ${table}:`],
    [`www/${name}/param-docs.gen.ts`, `export const ${paramDocs}:`],
    [`tests/${goldens}.rs`, 'every_preset_has_its_golden_hash'],
  ];
  return [...missing, ...lacking(contents, read)];
}

/** What package.json has to say, which npm reads before any script runs. */
function packageLines({ tag, wasm, cdn, worker, otherWorkers, panel, classEntry }, { exports, files, sideEffects }, isFirst) {
  const wanted = {
    ...Object.fromEntries([...new Set([tag, classEntry])].map((name) => [isFirst && name === tag ? '.' : `./${name}`, entryExport(name)])),
    [`./${cdn}.js`]: `./dist/${cdn}.js`,
    [`./${wasm}_bg.wasm`]: `./dist/${wasm}_bg.wasm`,
  };
  const hashed = [panel, worker, ...otherWorkers].map((name) => `dist/${name}-A1B2C3D4.js`);
  const named = [tag, cdn].map((name) => `dist/${name}.js`);
  const packed = [...new Set([...hashed, ...named, `dist/${classEntry}.js`, `dist/${wasm}_bg.wasm`])];
  return [
    ...Object.entries(wanted)
      .filter(([entry, targets]) => JSON.stringify(exports[entry]) !== JSON.stringify(targets))
      .map(([entry, targets]) => `package.json: exports has to have "${entry}": ${JSON.stringify(targets)}`),
    ...packed
      .filter((file) => !files.some((pattern) => covers(pattern, file)))
      .map((file) => `package.json: files has nothing for ${file}`),
    // Bundlers would leave out what registers an element, and what is loaded for what it does.
    ...[...named, ...hashed]
      .filter((file) => !sideEffects.some((pattern) => covers(pattern, `./${file}`)))
      .map((file) => `package.json: sideEffects has nothing for ./${file}`),
  ];
}

/** What package.json exports for an entry of www/entries/. */
function entryExport(name) {
  const [own, inlined] = [`./dist/${name}.js`, `./dist/inline/${name}.js`];
  return {
    types: `./dist/types/www/entries/${name}.d.ts`,
    node: own,
    webpack: own,
    browser: { production: own, default: inlined },
    default: inlined,
  };
}

function covers(pattern, file) {
  const source = pattern.replace(/[.+?^${}()|[\]\\]/g, '\\$&').replaceAll(/\*+/g, '.*');
  return new RegExp(`^${source}$`).test(file);
}

/** Lines in files that name every generator. */
function textLines(generator, read) {
  const { tag, wasm, compile, cdn, page } = generator;
  const href = page.file === 'index.html' ? './' : page.file;
  const lines = [
    ['Cargo.toml', `\n${wasm} = [`],
    ['Cargo.toml', `[profile.${compile.profile}]`],
    ['src/bindings/mod.rs', `\nmod ${inRust(wasm)};`],
    ...['src/lib.rs', 'src/params/mod.rs'].map((file) => [file, `mod ${inRust(generator.name)};`]),
    ['www/controls/site.ts', `href: '${href}'`],
    ['www/controls/clipboard.ts', `'${tag}': '${cdn}.js'`],
    ...TYPINGS.map((file) => [file, `'${tag}':`]),
    ['www/entries/core.ts', `'../../pkg/${wasm}.js'`],
    ['www/entries/core.node.ts', `'../../pkg/${wasm}.js'`],
    ...workersOf(generator).flatMap((worker) => [
      ['www/entries/variants/inline-worker.ts', `export function ${addressFunction(worker)}()`],
      ['www/entries/variants/inlined.d.ts', `declare module 'inlined:${worker}'`],
    ]),
    ['www/cli/generators.ts', `'../${generator.name}/table.ts'`],
    ['README.md', `<${tag}`],
  ];
  return lacking(lines, read);
}

/** Of pairs of a file and a text: those where the file is there, and lacks the text. */
function lacking(pairs, read) {
  return pairs.filter(([file, text]) => read(file)?.includes(text) === false).map(([file, text]) => `${file} has to have ${text.trim()}`);
}

function readText(name) {
  const file = path.join(root, name);
  return existsSync(file) ? readFileSync(file, 'utf8') : null;
}

export function check() {
  const problems = generatorProblems();
  if (problems.length > 0) throw new Failure(`generators.mjs and the rest differ:\n${problems.map((text) => `  ${text}`).join('\n')}`);
  console.log(`${GENERATORS.length} generators, complete`);
}
