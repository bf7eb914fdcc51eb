// How each host's project is built, by its own tools as their documentation has it; nothing in one is about this package.
import { spawn } from 'node:child_process';
import { cpSync, existsSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { cache, hashOf, root } from '../../scripts/lib/env.mjs';
import { Failure, npm, run, step } from '../../scripts/lib/run.mjs';

/** Nobody is told that a test ran. */
const QUIET = { NEXT_TELEMETRY_DISABLED: '1' };

/** A project in the cache: the sources and packages of `tests/hosts/<name>`, and ours as unpacked from the tarball. */
export async function install(name, folder) {
  const source = path.join(root, 'tests', 'hosts', name);
  const project = path.join(cache, 'hosts', `${name}-${hashOf(readFileSync(path.join(source, 'package-lock.json'))).slice(0, 12)}`);
  cpSync(source, project, { recursive: true });
  if (!existsSync(path.join(project, 'node_modules', '.package-lock.json'))) {
    await step(`Installing the packages of ${name}`, '10 s', () =>
      npm(['ci', '--ignore-scripts', '--no-audit', '--no-fund', '--loglevel=error'], { cwd: project }),
    );
  }
  // What bundlers remember of a package they know by its version, which a working copy does not change.
  for (const remembered of ['node_modules/rock-field', 'node_modules/.vite', '.next'])
    rmSync(path.join(project, remembered), { recursive: true, force: true });
  cpSync(folder, path.join(project, 'node_modules', 'rock-field'), { recursive: true });
  return project;
}

/** Runs a program of a project's packages. */
export function tool(project, program, args) {
  return run(process.execPath, [path.join('node_modules', ...program.split('/')), ...args], { cwd: project, env: QUIET });
}

export async function vite(project, site) {
  await tool(project, 'vite/bin/vite.js', ['build', '--logLevel', 'warn', '--outDir', site, '--emptyOutDir']);
}

export async function vitePage(project, site, page) {
  writeFileSync(path.join(project, 'index.html'), page);
  await vite(project, site);
}

export async function webpack(project, site) {
  await tool(project, 'webpack-cli/bin/cli.js', ['--mode', 'production', '--output-path', site, '--stats', 'errors-only']);
}

/** Next checks the types while it builds. Turbopack builds, unless the flags say `--webpack`. */
export async function next(project, ...flags) {
  await tool(project, 'next/dist/bin/next', ['build', ...flags]);
}

/** The project as its own server shows it: `{ url, close }`. */
export async function serverOf(project, program, args) {
  const env = { ...process.env, ...QUIET, NO_COLOR: '1' };
  const server = spawn(process.execPath, [path.join('node_modules', ...program.split('/')), ...args], {
    cwd: project,
    env,
    stdio: ['ignore', 'pipe', 2],
  });
  const ended = new Promise((resolve) => server.once('close', resolve));
  const close = async () => {
    server.kill();
    await ended;
  };
  const address = new Promise((resolve) => {
    let said = '';
    server.stdout?.on('data', (chunk) => {
      said += chunk;
      const [, url] = /(http:\/\/[\w.:]+\d)\/?\s/.exec(said) ?? [];
      if (url) resolve(url);
    });
  });
  const url = await Promise.race([address, ended]);
  if (typeof url !== 'string') throw new Failure(`${program} ended before it said where it listens`);
  return { url: `${url}/`, close };
}

export function nextServer(project, command) {
  return serverOf(project, 'next/dist/bin/next', [command, '--port', '0', '--hostname', '127.0.0.1']);
}

export function viteServer(project) {
  return serverOf(project, 'vite/bin/vite.js', ['--host', '127.0.0.1', '--port', '0']);
}
