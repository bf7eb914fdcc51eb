// The type declarations of the package: www/ → dist/types/, by tsc; only those that an entry leads to.
import { existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { dist, pkg, root } from '../lib/env.mjs';
import { GENERATORS, HEADLESS, entriesOf } from '../lib/generators.mjs';
import { Failure, needed, run } from '../lib/run.mjs';

const ENTRIES = [
  ...[...GENERATORS.flatMap(entriesOf), ...HEADLESS].map((name) => `www/entries/${name}.d.ts`),
  'www/typings/jsx.d.ts',
  'www/typings/svelte.d.ts',
  'www/typings/vue.d.ts',
];

export async function writeTypes() {
  const emitted = path.join(pkg, '.types');
  rmSync(emitted, { recursive: true, force: true });
  const tsc = path.join('node_modules', 'typescript', 'bin', 'tsc');
  await run(process.execPath, [tsc, '--noEmit', 'false', '--declaration', '--emitDeclarationOnly', '--rootDir', '.', '--outDir', emitted], {
    cwd: root,
  });
  const types = path.join(dist, 'types');
  rmSync(types, { recursive: true, force: true });
  for (const name of reachable(emitted)) {
    const target = path.join(types, name);
    mkdirSync(path.dirname(target), { recursive: true });
    // Of the glue one type alone is named; the rest of it is nobody's, and needs a newer library.
    if (name.startsWith('pkg/'))
      writeFileSync(target, `${needed(/^export type InitInput = .*$/m.exec(read(emitted, name)), `type InitInput in ${name}`)[0]}\n`);
    // The files stand beside no sources any more.
    else
      writeFileSync(
        target,
        read(emitted, name).replaceAll(RELATIVE, (all, address) => all.replace(address, address.replace(/\.ts$/, '.js'))),
      );
  }
  rmSync(emitted, { recursive: true, force: true });
  // So that the typings, which declare and do nothing, may also be imported.
  writeFileSync(path.join(types, 'nothing.js'), 'export {};\n');
}

const RELATIVE = /(?:\bfrom\s+|\bimport\s*\(?\s*)['"](\.[^'"]+)['"]/g;

/** The entries and every declaration that they name, relative to the root. */
function reachable(emitted) {
  const found = new Set(ENTRIES);
  for (const name of found) {
    for (const [, address] of read(emitted, name).matchAll(RELATIVE)) {
      found.add(path.posix.join(path.posix.dirname(name), address.replace(/\.[jt]s$/, '.d.ts')));
    }
  }
  return [...found].sort();
}

/** What tsc wrote, or what was a declaration from the start. */
function read(emitted, name) {
  const file = [path.join(emitted, name), path.join(root, name)].find((candidate) => existsSync(candidate));
  if (!file) throw new Failure(`there is no declaration ${name}`);
  return readFileSync(file, 'utf8');
}
