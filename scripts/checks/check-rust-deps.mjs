// The modules of the crate: which room of src/ may use which other room, and that no modules use each other in a circle.
import { readFileSync, readdirSync } from 'node:fs';
import path from 'node:path';
import { GENERATORS, inRust } from '../lib/generators.mjs';

const BASE = ['cached', 'error', 'noise', 'params', 'rng'];
const CRATES = GENERATORS.map(({ name }) => inRust(name));

/**
 * The rooms of src/, each with the rooms that it may use. A room is a file or a folder; `bindings` has rules for each of its files. Tests
 * may use everything. `validate` is for tests alone, so that no room may use it.
 *
 * @type {Record<string, string[]>}
 */
export const ROOMS = {
  cached: [],
  error: [],
  noise: [],
  rng: [],
  params: ['error'],
  ...Object.fromEntries(CRATES.map((name) => [name, BASE])),
  ground: [],
  validate: [...BASE, ...CRATES],
  shading: [],
  render: ['shading'],
  'bindings/allocator': [],
  'bindings/error': ['error'],
  'bindings/ground_mesh': ['ground'],
  'bindings/literal': ['params', 'rocks'],
  ...Object.fromEntries(GENERATORS.map(({ name, wasm }) => [`bindings/${inRust(wasm)}`, [...BASE, 'bindings/error', inRust(name)]])),
  'bindings/renderer': ['render', 'shading'],
  'bindings/renderer_bake': ['bindings/renderer', 'render'],
  'bindings/renderer_wood': ['bindings/renderer', 'render', 'shading'],
};

/** Files that only declare modules and re-export names. */
const DECLARATIONS = ['lib', 'bindings'];

/** Returns what is wrong with the modules below `folder`, the crate's src/, each with its file and line. */
export function rustProblems(folder, rooms = ROOMS) {
  const crate = readCrate(folder);
  const problems = [];
  const uses = new Map();
  for (const [module, { file, code }] of crate) {
    const room = roomOf(module, rooms);
    if (room === undefined && !DECLARATIONS.includes(module)) {
      problems.push(`${file} belongs to no room: add it to ROOMS in scripts/checks/check-rust-deps.mjs, with what it may use`);
      continue;
    }
    const used = usesOf(module, code, crate);
    uses.set(module, new Set(used.map((use) => use.module).filter((other) => other !== module)));
    for (const { module: other, line } of used) {
      const theirs = roomOf(other, rooms);
      if (room === undefined || theirs === room || rooms[room].includes(theirs)) continue;
      problems.push(`${file}:${line} uses ${other}; ${room} may use ${rooms[room].join(', ') || 'no other room'}`);
    }
  }
  const unused = Object.keys(rooms).filter((room) => ![...crate.keys()].some((module) => roomOf(module, rooms) === room));
  problems.push(...unused.map((room) => `ROOMS in scripts/checks/check-rust-deps.mjs has a rule for ${room}, which is not there`));
  return [...problems, ...circles(uses).map((circle) => `modules of src/ use each other in a circle: ${circle.join(' → ')}`)];
}

/** The longest name in `rooms` that the module is or lies in. */
function roomOf(module, rooms) {
  const containing = Object.keys(rooms).filter((room) => module === room || module.startsWith(`${room}/`));
  return containing.sort((a, b) => b.length - a.length)[0];
}

/** Module (`rocks/grid`, and `rocks` for rocks/mod.rs) → its file and its code without comments, texts and tests. */
function readCrate(folder) {
  const names = readdirSync(folder, { recursive: true })
    .map((name) => name.replaceAll(path.sep, '/'))
    .filter((name) => name.endsWith('.rs'));
  const crate = new Map();
  for (const name of names.sort()) {
    const module = name.replace(/(\/mod)?\.rs$/, '');
    crate.set(module, { file: `src/${name}`, code: withoutTests(withoutTexts(readFileSync(path.join(folder, name), 'utf8'))) });
  }
  // A module that is declared for tests alone may use everything, as the tests beside other code may.
  for (const [module, { code }] of [...crate]) {
    for (const [, child] of code.matchAll(/#\[cfg\(test\)\]\s*mod\s+(\w+)\s*;/g)) crate.delete(childOf(module, child));
  }
  return crate;
}

/** Blanks comments and texts, so that lines keep their numbers. */
function withoutTexts(source) {
  const blank = (text) => text.replaceAll(/[^\n]/g, ' ');
  return source.replaceAll(/\/\/[^\n]*|\/\*[\s\S]*?\*\/|"(?:\\[\s\S]|[^"\\])*"|'(?:\\.|[^'\\\n])'/g, blank);
}

/** Blanks the blocks of modules that are compiled for tests alone. */
function withoutTests(code) {
  const start = /#\[cfg\(test\)\]\s*mod\s+\w+\s*\{/.exec(code);
  if (start === null) return code;
  let depth = 1;
  let end = start.index + start[0].length;
  for (; end < code.length && depth > 0; end++) depth += code[end] === '{' ? 1 : code[end] === '}' ? -1 : 0;
  const blanked = code.slice(start.index, end).replaceAll(/[^\n]/g, ' ');
  return withoutTests(code.slice(0, start.index) + blanked + code.slice(end));
}

const childOf = (module, name) => (module === 'lib' ? name : `${module}/${name}`);
const parentOf = (module) => (module.includes('/') ? module.slice(0, module.lastIndexOf('/')) : 'lib');

/** The modules that a file names in paths that begin with `crate`, `super` or `self`, or with a module declared in it; re-exports are no uses. */
function usesOf(module, code, crate) {
  const children = [...code.matchAll(/\bmod\s+(\w+)\s*;/g)].map(([, name]) => name);
  const roots = ['crate', 'super', 'self', ...children].join('|');
  const uses = [];
  for (const found of code.matchAll(new RegExp(`(?<![\\w:.$])(?:\\$)?(${roots})\\s*::\\s*`, 'g'))) {
    if (/\bpub(\([^)]*\))?\s+use\s+$/.test(code.slice(0, found.index))) continue;
    const line = code.slice(0, found.index).split('\n').length;
    for (const steps of pathsAt(code.slice(found.index).replace(/^\$/, ''))) uses.push({ module: resolve(module, steps, crate), line });
  }
  return uses.filter(({ module: other }) => other !== 'lib');
}

/** The paths that begin here, `a::{b, c::d}` being two: lists of names. */
function pathsAt(text) {
  const steps = [];
  let rest = text;
  for (;;) {
    const name = /^\s*(\w+|\*)\s*/.exec(rest);
    if (name === null) return [steps];
    steps.push(name[1]);
    rest = rest.slice(name[0].length);
    if (!rest.startsWith('::')) return [steps];
    rest = rest.slice(2).trimStart();
    if (rest.startsWith('{')) return listAt(rest).flatMap((item) => pathsAt(item).map((more) => [...steps, ...more]));
  }
}

/** The items of a list in braces, split at its own commas. */
function listAt(text) {
  const items = [''];
  let depth = 0;
  for (const c of text) {
    if (c === '{') depth += 1;
    if (c === '}') depth -= 1;
    if (depth === 0) break;
    if (c === ',' && depth === 1) items.push('');
    else if (!(c === '{' && depth === 1)) items[items.length - 1] += c;
  }
  return items.filter((item) => item.trim() !== '');
}

/** The module in which the last name of a path is defined, also where others re-export it. */
function resolve(from, steps, crate) {
  let at = from;
  for (const [index, name] of steps.entries()) {
    if (name === 'crate') at = 'lib';
    else if (name === 'super') at = parentOf(at);
    else if (name === 'self') continue;
    else if (crate.has(childOf(at, name))) at = childOf(at, name);
    else {
      const source = reexports(at, crate).get(name);
      return source === undefined ? at : resolve(at, [...source, ...steps.slice(index + 1)], crate);
    }
  }
  return at;
}

/** What a module re-exports: name → the path of where it comes from. */
function reexports(module, crate) {
  const names = new Map();
  for (const found of (crate.get(module)?.code ?? '').matchAll(/\bpub(?:\([^)]*\))?\s+use\s+/g)) {
    for (const steps of pathsAt(crate.get(module).code.slice(found.index + found[0].length))) {
      if (steps.length > 1) names.set(steps.at(-1), steps);
    }
  }
  return names;
}

/** The circles of a graph, each as the names along it. */
function circles(uses) {
  const found = [];
  const done = new Set();
  const visit = (module, trail) => {
    const at = trail.indexOf(module);
    if (at >= 0) found.push([...trail.slice(at), module]);
    if (at >= 0 || done.has(module)) return;
    for (const other of [...(uses.get(module) ?? [])].sort()) visit(other, [...trail, module]);
    done.add(module);
  };
  for (const module of [...uses.keys()].sort()) visit(module, []);
  return found;
}
