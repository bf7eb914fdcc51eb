// What is loaded before a file that is imported later. The bundler does not ask, and cuts everything that the two share out into chunks of
// their own: a dozen of some hundred bytes each, which compress badly and are all fetched for the first picture.
import path from 'node:path';
import * as esbuild from 'esbuild';
import { root } from '../lib/env.mjs';
import { needed } from '../lib/run.mjs';

/** A plugin by which a file that is imported later also imports what is there already, whichever of `entryPoints` it is imported from: source files by the names of what is made of them. */
export async function loadedBefore(entryPoints, options) {
  const { metafile } = await esbuild.build({
    ...options,
    absWorkingDir: root,
    entryPoints,
    bundle: true,
    format: 'esm',
    outdir: 'nowhere',
    write: false,
    metafile: true,
  });
  const before = filesBefore(needed(metafile, 'list of what was built').inputs, Object.values(entryPoints));
  return {
    name: 'loaded-before',
    setup(build) {
      build.onResolve({ filter: /\.ts$/ }, ({ kind, path: file, resolveDir }) => {
        const name = path.relative(root, path.join(resolveDir, file)).replaceAll(path.sep, '/');
        return kind === 'dynamic-import' && before.get(name)?.length ? { path: name, namespace: 'later' } : undefined;
      });
      build.onLoad({ filter: /./, namespace: 'later' }, ({ path: name }) => ({
        contents: [...before.get(name).map((file) => `import './${file}';`), `export * from './${name}';`].join('\n'),
        resolveDir: root,
      }));
    },
  };
}

/**
 * For each file that is imported later: the files that every entry which leads to such an import imports at once. Those that one entry alone
 * imports are left in its file, unless what is imported later needs one of them: then they are cut out of it anyway.
 */
export function filesBefore(inputs, entryPoints) {
  const before = new Map();
  const entriesOf = new Map();
  for (const entryPoint of entryPoints) {
    const atOnce = reached(inputs, entryPoint, ['import-statement']);
    const all = reached(inputs, entryPoint, ['import-statement', 'dynamic-import']);
    const later = new Set([...all].flatMap((file) => imports(inputs, file, ['dynamic-import'])));
    for (const file of atOnce) entriesOf.set(file, (entriesOf.get(file) ?? 0) + 1);
    for (const file of later)
      before.set(
        file,
        (before.get(file) ?? [...atOnce]).filter((other) => atOnce.has(other)),
      );
  }
  const withoutAlone = (file, files) => {
    const needed = reached(inputs, file, ['import-statement']);
    const isAlone = (other) => entriesOf.get(other) === 1;
    return files.some((other) => isAlone(other) && needed.has(other)) ? files : files.filter((other) => !isAlone(other));
  };
  return new Map(
    [...before].map(([file, files]) => [file, withoutAlone(file, files).filter((other) => other.startsWith('www/') && other !== file)]),
  );
}

function reached(inputs, entryPoint, kinds) {
  const found = new Set([entryPoint]);
  for (const file of found) for (const imported of imports(inputs, file, kinds)) found.add(imported);
  return found;
}

function imports(inputs, file, kinds) {
  return (inputs[file]?.imports ?? [])
    .filter(({ kind, external }) => !external && kinds.includes(kind))
    .map(({ path: imported }) => imported);
}
