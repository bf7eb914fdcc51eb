// The modules of www/: every import points down, none leads back in a circle, and few files touch wasm, packages or the page's address.
import { readFileSync, readdirSync } from 'node:fs';
import path from 'node:path';
// The one TypeScript parser here that can be called: TypeScript 7 is a program without an API, so dependency-cruiser cannot read types with it.
import { ts } from '@custom-elements-manifest/analyzer';
import { GENERATORS, withGround } from '../lib/generators.mjs';

const NAMES = GENERATORS.map(({ name }) => name).join('|');

/**
 * The rooms of www/, from the lowest floor up. Files may import from their own room and from all floors below; rooms that share a floor
 * know nothing of each other. What is imported as a type, or later, counts like any other import.
 */
export const FLOORS = [
  ['styles'],
  ['base'],
  ['data'],
  ['table'],
  ['generator', 'renderer', 'export'],
  ['scene'],
  ['element'],
  ['controls'],
  ...generatorFloors(),
  // The command line, and meshes of three.js.
  ['cli', 'three'],
  ['entries'],
  ['pages', 'typings'],
  ['docs'],
];

/** Rooms that a room may not use although they lie below it. */
const UNKNOWN_TO = {
  // What is drawn comes as numbers.
  renderer: ['table'],
};

/** Packages, each with the files that may import them. A name that ends in a colon stands for all that begin so. */
const PACKAGES = {
  lit: new RegExp(`^((${NAMES})/)?controls/`),
  '@noble/hashes': /^export\/origin\/hash\.ts$/,
  fflate: /^export\/(maps|formats)\//,
  'lean-qr': /^controls\/postcard\.ts$/,
  earcut: /^wood-ear\/log-file\//,
  meshoptimizer: /^(wood-ear\/log-file|export)\//,
  three: /^three\//,
  react: /^typings\//,
  svelte: /^typings\//,
  vue: /^typings\//,
  'node:': /^cli\/|^entries\/((core|ground)\.node|cli(-worker)?)\.ts$/,
  'inlined:': /^entries\/variants\/inline-worker\.ts$/,
};

/** The files that import the glue of wasm-bindgen or start wasm. */
const WASM_USERS = [
  ...GENERATORS.map(({ worker }) => `entries/${worker}.ts`),
  'entries/full-worker.ts',
  'entries/core.ts',
  'entries/core.node.ts',
  'entries/ground.node.ts',
  'rocks/ground-realm.ts',
  'renderer/artefact.ts',
];
const WASM = /_bg\.wasm|\bWebAssembly\.(instantiate|compile|Module|Instance)/;

/** Elements, and what they are made of, leave the page's address alone: they stand in pages of others. */
const ELEMENTS = new RegExp(`^(base|data|table|generator|renderer|scene|element)/|^(${NAMES})/(?!controls/)`);
const ADDRESS =
  /(?<![\w#.-])(location\s*[.[=]|history\.(push|replace)State)|\b(window|document|globalThis)\.(location|history)\b|\bURLSearchParams\b|['"](hashchange|popstate)['"]/;

/** Generators do not know each other, but for those that they stand on. */
function generatorFloors() {
  const heights = GENERATORS.map((generator) => withGround(generator).length);
  return [...new Set(heights)].sort().map((height) => GENERATORS.filter((_, index) => heights[index] === height).map(({ name }) => name));
}

/** Returns what is wrong with the modules below `folder`, which is www/. */
export function webProblems(folder) {
  const sources = new Map(modulesOf(folder).map((file) => [file, readModule(folder, file)]));
  const graph = new Map(
    [...sources].map(([file, { imports }]) => [
      file,
      imports.filter(isRelative).map((name) => path.posix.join(path.posix.dirname(file), name)),
    ]),
  );
  return [
    ...[...sources].flatMap(([file, source]) => [
      ...problemsOf(file, source),
      ...(graph.get(file) ?? []).flatMap((imported) => arrowProblems(file, imported, sources)),
    ]),
    ...circles(graph).map((files) => `a circle of imports: ${[...files, files[0]].join(' → ')}`),
  ];
}

/** TypeScript files below a folder, relative to it, with forward slashes. */
function modulesOf(folder) {
  return readdirSync(folder, { recursive: true, withFileTypes: true })
    .filter((entry) => entry.isFile() && entry.name.endsWith('.ts'))
    .map((entry) => path.relative(folder, path.join(entry.parentPath ?? entry.path, entry.name)).replaceAll(path.sep, '/'))
    .sort();
}

/** `imports`: all names that the file imports. `code`: its text without comments. `uses`: names whose values it imports. */
function readModule(folder, file) {
  const text = readFileSync(path.join(folder, file), 'utf8');
  const imports = [...new Set(ts.preProcessFile(text, true, true).importedFiles.map(({ fileName }) => fileName))];
  const code = ts.transpileModule(text, {
    compilerOptions: { target: ts.ScriptTarget.ES2022, removeComments: true, verbatimModuleSyntax: true },
  }).outputText;
  return { imports, code, uses: ts.preProcessFile(code, true, true).importedFiles.map(({ fileName }) => fileName) };
}

function isRelative(name) {
  return name.startsWith('.');
}

/** What is wrong with a file by itself. */
function problemsOf(file, { imports, code, uses }) {
  const problems = [];
  if (floorOf(file) === -1) problems.push(`${file} is in no room: put it into a folder of FLOORS (scripts/checks/check-web-deps.mjs)`);
  for (const name of imports.filter((imported) => !isRelative(imported))) {
    const known = Object.keys(PACKAGES).find((known) => name === known || name.startsWith(known.endsWith(':') ? known : `${known}/`));
    if (!known) problems.push(`${file} imports ${name}, a package that is not in PACKAGES`);
    else if (!PACKAGES[known].test(file)) problems.push(`${file} imports ${name}; only files that match ${PACKAGES[known]} may`);
  }
  if (!WASM_USERS.includes(file) && (uses.some((name) => /\/pkg\//.test(name)) || WASM.test(code))) {
    problems.push(`${file} touches wasm; only ${WASM_USERS.join(', ')} may`);
  }
  if (ELEMENTS.test(file) && ADDRESS.test(code)) problems.push(`${file} touches the page's address; only pages and controls may`);
  return problems;
}

function roomOf(file) {
  return file.includes('/') ? file.split('/')[0] : '';
}

function floorOf(file) {
  return FLOORS.findIndex((rooms) => rooms.includes(roomOf(file)));
}

/** What is wrong with one import. The glue in pkg/ is outside of www/, and has a rule of its own. */
function arrowProblems(file, imported, sources) {
  if (imported.startsWith('../pkg/')) return [];
  if (!imported.endsWith('.css') && !sources.has(imported)) return [`${file} imports ${imported}, which is no module of www/`];
  const [from, to] = [roomOf(file), roomOf(imported)];
  if (from === to || floorOf(file) === -1) return [];
  if (UNKNOWN_TO[from]?.includes(to)) return [`${file} imports ${imported}; ${from} knows nothing of ${to}`];
  return floorOf(imported) < floorOf(file)
    ? []
    : [`${file} imports ${imported}, which is not below it: ${FLOORS.map((rooms) => rooms.join(' and ')).join(' ← ')}`];
}

/** The groups of files that import each other, each as one way round. */
function circles(graph) {
  const done = new Set();
  const found = [];
  const walk = (file, trail) => {
    const at = trail.indexOf(file);
    if (at >= 0) found.push(trail.slice(at));
    if (at >= 0 || done.has(file)) return;
    for (const imported of graph.get(file) ?? []) walk(imported, [...trail, file]);
    done.add(file);
  };
  for (const file of graph.keys()) walk(file, []);
  return found;
}
