// How long files and functions may be, where no linter says so: Biome and clippy have the same limits for the rest (biome.jsonc, clippy.toml).
import { readFileSync, readdirSync } from 'node:fs';
import path from 'node:path';
import { root } from '../lib/env.mjs';
import { Failure } from '../lib/run.mjs';

/** Lines. */
const LONGEST_FILE = 450;
const LONGEST_FUNCTION = 80;

/** What is not written by us. */
const FOREIGN = /^(node_modules|target|dist|pkg|\..*)$/;

/** Returns which Rust and WGSL files below `folder` are too long, and which functions of WGSL. */
export function lengthProblems(folder) {
  return filesBelow(folder).flatMap((file) => {
    const name = path.relative(folder, file).replaceAll(path.sep, '/');
    const lines = readFileSync(file, 'utf8').trimEnd().split('\n');
    const problems = [];
    if (lines.length > LONGEST_FILE)
      problems.push(`${name} has ${lines.length} lines; a file has at most ${LONGEST_FILE}: split it by idea`);
    if (!file.endsWith('.wgsl')) return problems;
    const long = functionsOf(lines).filter(({ length }) => length > LONGEST_FUNCTION);
    return [
      ...problems,
      ...long.map(
        (found) =>
          `${name}:${found.line} ${found.name} has ${found.length} lines; a function has at most ${LONGEST_FUNCTION}: give its parts names`,
      ),
    ];
  });
}

function filesBelow(folder) {
  return readdirSync(folder, { withFileTypes: true }).flatMap((entry) => {
    const file = path.join(folder, entry.name);
    if (entry.isDirectory()) return FOREIGN.test(entry.name) ? [] : filesBelow(file);
    return /\.(rs|wgsl)$/.test(entry.name) ? [file] : [];
  });
}

/** The functions of a shader, from the line with `fn` to the brace that closes the body. */
function functionsOf(lines) {
  const found = [];
  for (const [index, text] of lines.entries()) {
    const name = /^\s*(?:@[^/]*\s)?fn\s+(\w+)/.exec(text)?.[1];
    if (name) found.push({ name, line: index + 1, length: lengthOf(lines.slice(index)) });
  }
  return found;
}

/** How many lines there are up to the end of the first block. */
function lengthOf(lines) {
  let depth = 0;
  for (const [index, text] of lines.entries()) {
    const code = text.replace(/\/\/.*/, '');
    depth += (code.match(/\{/g) ?? []).length - (code.match(/\}/g) ?? []).length;
    if (depth === 0 && code.includes('}')) return index + 1;
  }
  return lines.length;
}

export function check() {
  const problems = lengthProblems(root);
  if (problems.length > 0) throw new Failure(`too long:\n${problems.map((text) => `  ${text}`).join('\n')}`);
  console.log(`no Rust or WGSL file over ${LONGEST_FILE} lines, no function of a shader over ${LONGEST_FUNCTION}`);
}
