// `npm run package`: packs the package into a new folder and looks at it as those who install it would.
import { existsSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, renameSync, rmSync, statSync, symlinkSync } from 'node:fs';
import { spawnSync } from 'node:child_process';
import os from 'node:os';
import path from 'node:path';
import * as esbuild from 'esbuild';
import { LICENCES_FILE } from '../build/licences.mjs';
import { root } from '../lib/env.mjs';
import { PEERS } from '../lib/generators.mjs';
import { Failure, isMain, main, needed, npm, run, say, step } from '../lib/run.mjs';

/** Files that a browser asks for beside those it imports. */
const ADDRESSES = /new URL\("(\.\/[^"]+)",/g;

/** `{ outside, tarball, folder }`: a temporary folder, the tarball in it, and that unpacked as `node_modules/rock-field`. */
export async function pack() {
  const outside = mkdtempSync(path.join(os.tmpdir(), 'rock-field-'));
  await step('Packing the package', '5 s', () => npm(['pack', '--silent', '--pack-destination', outside], { cwd: root }));
  const name = needed(
    readdirSync(outside).find((file) => file.endsWith('.tgz')),
    `tarball in ${outside}`,
  );
  const tarball = path.join(outside, name);
  const modules = path.join(outside, 'node_modules');
  mkdirSync(modules);
  // Every system has a tar by now. By a relative name, since GNU's takes C:\ for another machine.
  await run('tar', ['-xzf', `../${path.basename(tarball)}`], { cwd: modules });
  const folder = path.join(modules, 'rock-field');
  renameSync(path.join(modules, 'package'), folder);
  // Whoever uses the entries that need them has these.
  for (const peer of PEERS) symlinkSync(path.join(root, 'node_modules', peer), path.join(modules, peer), 'junction');
  return { outside, tarball, folder };
}

/** Looks at what `pack` has packed; throws when something is wrong with it. */
export async function examine({ outside, tarball, folder }) {
  const { exports, bin } = JSON.parse(readFileSync(path.join(folder, 'package.json'), 'utf8'));
  await publint(folder);
  await types(tarball, exports);
  importEach(outside, exports);
  await graph(folder, exports, Object.values(bin));
  if (!existsSync(path.join(folder, 'dist', LICENCES_FILE))) throw new Failure(`the package has no dist/${LICENCES_FILE}`);
  const files = readdirSync(folder, { recursive: true, encoding: 'utf8' }).filter((name) => statSync(path.join(folder, name)).isFile());
  say(`• ${path.basename(tarball)}: ${files.length} files, ${(statSync(tarball).size / 1000).toFixed(0)} kB`);
}

function publint(folder) {
  return node(['publint', 'src', 'cli.js'], ['run', folder, '--strict', '--pack', 'false']);
}

/** That every entry's types are found and mean what the file is. ES modules alone: that is what the package has. */
function types(tarball, exports) {
  const untyped = Object.entries(exports)
    .filter(([, targets]) => typeof targets === 'string')
    .map(([entry]) => entry);
  return node(
    ['@arethetypeswrong', 'cli', 'dist', 'index.js'],
    [tarball, '--profile', 'esm-only', '--no-definitely-typed', '--no-emoji', '--format', 'ascii', '--exclude-entrypoints', ...untyped],
  );
}

function node(program, args) {
  return run(process.execPath, [path.join('node_modules', ...program), ...args], { cwd: root });
}

/** Importing says and needs nothing on a server, be it Node's build or that of browsers. */
function importEach(outside, exports) {
  const entries = scripts(exports).map((entry) => path.posix.join('rock-field', entry));
  const forBrowsers = filesFor(exports, 'browser').map((file) => `./node_modules/rock-field/${file}`);
  for (const name of [...entries, ...forBrowsers]) {
    const { status, stdout, stderr } = spawnSync(
      process.execPath,
      ['--input-type=module', '--eval', `await import(${JSON.stringify(name)})`],
      { cwd: outside, encoding: 'utf8' },
    );
    if (status !== 0 || stdout || stderr) throw new Failure(`importing ${name} in Node is not silent:\n${stdout}${stderr}`);
  }
  say(`• Imported in Node, silently: ${entries.join(' ')}`);
}

/** What browsers get holds no module of Node, and asks for nothing that is not there; the package holds nothing that nobody asks for. */
async function graph(folder, exports, commands) {
  const workers = readdirSync(path.join(folder, 'dist'))
    .filter((name) => /worker-\w+\.js$/.test(name))
    .map((name) => `./dist/${name}`);
  const entryPoints = [...filesFor(exports, 'browser'), ...workers];
  const bundled = async (options) => {
    try {
      const { metafile } = await esbuild.build({
        absWorkingDir: folder,
        bundle: true,
        write: false,
        metafile: true,
        format: 'esm',
        outdir: 'out',
        external: PEERS,
        logLevel: 'error',
        ...options,
      });
      return Object.keys(needed(metafile, 'list of what was bundled').inputs);
    } catch {
      throw new Failure('the package cannot be bundled; the reasons stand above');
    }
  };
  const browser = await bundled({ entryPoints, platform: 'browser' });
  // A command and the threads that it starts.
  const programs = commands.flatMap((file) => [`./${file}`, `./${file.replace(/\.js$/, '-worker.js')}`]);
  const server = await bundled({ entryPoints: [...filesFor(exports, 'node'), ...programs], platform: 'node' });
  for (const file of browser) {
    for (const [, address] of readFileSync(path.join(folder, file), 'utf8').matchAll(ADDRESSES)) {
      const target = path.posix.join(path.posix.dirname(file), address);
      if (!existsSync(path.join(folder, target))) throw new Failure(`${file} asks for ${target}, which is not in the package`);
    }
  }
  const idle = readdirSync(path.join(folder, 'dist'), { recursive: true })
    .map((name) => name.replaceAll(path.sep, '/'))
    .filter((name) => name.endsWith('.js') && !browser.includes(`dist/${name}`) && !server.includes(`dist/${name}`));
  if (idle.length > 0) throw new Failure(`in the package for nothing: ${idle.join(', ')}; see files in package.json`);
  say(`• Nothing of Node in the ${browser.length} scripts of the browser`);
}

/** The entries that can be imported. */
function scripts(exports) {
  return Object.keys(exports).filter((entry) => filesOf(exports[entry]).some(([, file]) => file.endsWith('.js')));
}

/** The scripts that Node (`node`) or anything else (`browser`) may be given, each once. */
function filesFor(exports, platform) {
  const files = scripts(exports).flatMap((entry) => filesOf(exports[entry]));
  return [
    ...new Set(
      files
        .filter(([conditions]) => !conditions.includes('types') && conditions.includes('node') === (platform === 'node'))
        .map(([, file]) => file),
    ),
  ];
}

/** Every file of an entry, with the conditions that lead to it. */
function filesOf(target, conditions = []) {
  if (typeof target === 'string') return [[conditions, target]];
  return Object.entries(target).flatMap(([condition, inner]) => filesOf(inner, [...conditions, condition]));
}

if (isMain(import.meta)) {
  await main(async () => {
    const packed = await pack();
    try {
      await examine(packed);
    } finally {
      rmSync(packed.outside, { recursive: true, force: true });
    }
    say('✓ the package is in order');
  });
}
