// The packed package in the pages of others: each host is built from the tarball alone, with no special configuration, and opened in Chromium.
import assert from 'node:assert/strict';
import { cpSync, mkdirSync, rmSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import * as esbuild from 'esbuild';
import { Failure, inLanes, isMain, main, messageOf, run, say, seconds } from '../../scripts/lib/run.mjs';
import { pack } from '../../scripts/package/package.mjs';
import { install, next, nextServer, tool, vite, vitePage, viteServer, webpack } from './projects.mjs';
import { showScenes } from './scenes.mjs';
import { openCdn, show } from './show.mjs';

const ELEMENT = '<rock-field preset="journal-fig1" seed="7" style="width: 400px; height: 300px"></rock-field>';

/** So many hosts at once: while one is built, another is looked at. */
const LANES = 2;

/** Everything from the page's own origin: what `rock-field` promises to get by with. The rest is this page's icon and the element's size. */
const STRICT =
  "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self'; connect-src 'self'; img-src data:; style-src-attr 'unsafe-inline'";

/** With everything in the scripts there is a worker without a file. */
const STRICT_BUT_BLOB = STRICT.replace("worker-src 'self'", 'worker-src blob:');

/** By name: what makes the host's page from the unpacked package in `folder`, in the empty folder `site`, and shows it. The slowest first. */
const HOSTS = {
  Next: async (_site, folder) => {
    const project = await install('next', folder);
    await next(project);
    const asked = await during(nextServer(project, 'start'), ({ url }) =>
      show({ url, live: true, look: (session) => withoutScripts(session, url) }),
    );
    assert.ok(
      asked.some((address) => /generator_bg[\w.-]+\.wasm$/.test(address)),
      `the wasm is no file of its own: ${asked.join(' ')}`,
    );
    // Only in development does React say what differs from the server's page.
    await during(nextServer(project, 'dev'), ({ url }) => show({ url, live: true }));
  },
  'scenes of three.js, React Three Fiber and Babylon.js': showScenes,
  Vue: (site, folder) => typed('vue', 'vue-tsc/bin/vue-tsc.js', site, folder),
  Svelte: (site, folder) => typed('svelte', 'svelte-check/bin/svelte-check', site, folder),
  React: async (site, folder) => {
    const project = await typed('react', 'typescript/bin/tsc', site, folder);
    await during(viteServer(project), ({ url }) => show({ url, live: true }));
  },
  'a module by its path': (site, folder) =>
    show({ site: vendor(site, folder, '<script type="module" src="./rock-field/rock-field.js"></script>') }),
  'an import map': (site, folder) =>
    show({
      site: vendor(
        site,
        folder,
        '<script type="importmap">{ "imports": { "rock-field": "./rock-field/rock-field.js" } }</script><script type="module">import "rock-field";</script>',
      ),
    }),
  'a strict policy': (site, folder) =>
    show({ site: vendor(site, folder, '<script type="module" src="./rock-field/rock-field.js"></script>'), policy: STRICT }),
  'a classic script': (site, folder) =>
    show({ site: vendor(site, folder, '<script src="./rock-field/cdn.js" defer></script>'), policy: STRICT }),
  'a classic script from another origin': async (site, folder) => {
    await during(openCdn(folder), (cdn) => show({ site: write(site, `<script src="${cdn.url}cdn.js"></script>`), cdn: cdn.url }));
  },
  esbuild: async (site, folder) => {
    await withEsbuild(folder, { outfile: path.join(site, 'out.js') });
    await show({ site: write(site, '<script src="./out.js" defer></script>'), policy: STRICT_BUT_BLOB });
  },
  'esbuild, in chunks': async (site, folder) => {
    await withEsbuild(folder, { format: 'esm', splitting: true, outdir: site });
    await show({ site: write(site, '<script type="module" src="./app.js"></script>'), policy: STRICT_BUT_BLOB });
  },
  'esbuild, the files of the package beside its output': async (site, folder) => {
    vendor(site, folder, '<script type="module" src="./rock-field/out.js"></script>');
    await withEsbuild(folder, { format: 'esm', conditions: ['production'], outfile: path.join(site, 'rock-field', 'out.js') });
    await show({ site, policy: STRICT });
  },
  Rollup: async (site, folder) => {
    const project = await install('rollup', folder);
    await tool(project, 'rollup/dist/bin/rollup', ['main.js', '--plugin', 'node-resolve', '--dir', site, '--silent']);
    await show({ site: write(site, '<script type="module" src="./main.js"></script>'), policy: STRICT_BUT_BLOB });
  },
  Vite: async (site, folder) => {
    await vitePage(await install('vite', folder), site, page('<script type="module" src="./main.js"></script>'));
    await show({ site, policy: STRICT });
  },
  'no browser: jsdom and happy-dom': async (_site, folder) => {
    const project = await install('no-browser', folder);
    for (const kind of ['jsdom', 'happy-dom']) await run(process.execPath, ['main.mjs', kind], { cwd: project });
  },
  webpack: async (site, folder) => {
    await webpack(await install('webpack', folder), site);
    await show({ site: write(site, '<script src="./main.js" defer></script>'), policy: STRICT });
  },
};

/** Not run by `npm test`: they take long, or say what another host says already. */
const MORE = {
  'Next, built by webpack': async (_site, folder) => {
    const project = await install('next', folder);
    await next(project, '--webpack');
    await during(nextServer(project, 'start'), ({ url }) => show({ url, live: true }));
  },
};

/** Shows the package that `pack` has packed in the hosts of these names. */
export async function check({ outside, folder }, chosen = Object.keys(HOSTS)) {
  const hosts = { ...HOSTS, ...MORE };
  const stranger = chosen.find((name) => !hosts[name]);
  if (stranger) throw new Failure(`no host is called ${stranger}; there are: ${Object.keys(hosts).join(' · ')}`);
  const failed = [];
  await inLanes(
    chosen.entries(),
    async ([number, name]) => {
      const site = path.join(outside, `site-${number}`);
      mkdirSync(site);
      const start = performance.now();
      try {
        await hosts[name](site, folder);
        say(`✓ ${name} (${seconds(performance.now() - start)} s)`);
      } catch (error) {
        say(`✗ ${name}: ${messageOf(error)}`);
        failed.push(name);
      }
    },
    LANES,
  );
  assert.deepEqual(failed, [], 'hosts in which there are no rocks');
  return chosen.length;
}

function page(scripts) {
  return `<!doctype html><html lang="en"><meta charset="utf-8"><title>host</title><link rel="icon" href="data:,">${ELEMENT}${scripts}`;
}

function write(site, scripts) {
  writeFileSync(path.join(site, 'index.html'), page(scripts));
  return site;
}

/** The package's files copied beside the page, as one does without a bundler. */
function vendor(site, folder, scripts) {
  cpSync(path.join(folder, 'dist'), path.join(site, 'rock-field'), { recursive: true });
  return write(site, scripts);
}

async function withEsbuild(folder, options) {
  const app = path.join(path.dirname(path.dirname(folder)), 'app.js');
  writeFileSync(app, "import 'rock-field';");
  await esbuild.build({ entryPoints: [app], bundle: true, logLevel: 'warning', ...options });
}

/** A framework's project, with types that let its template pass and refuse the wrong ones beside it. */
async function typed(name, checker, site, folder) {
  const project = await install(name, folder);
  await tool(project, checker, []);
  await vite(project, site);
  await show({ site, policy: STRICT, live: true });
  return project;
}

/** Works with a server, and closes it. */
async function during(opening, work) {
  const server = await opening;
  try {
    return await work(server);
  } finally {
    await server.close();
  }
}

/** What the server says is a picture already. */
async function withoutScripts(session, url) {
  const { page: still, close } = await session.open(url, { javaScriptEnabled: false });
  const { width, height } = await still.locator('rock-field[preset="journal-fig1"] > img').boundingBox();
  assert.deepEqual([width, height], [400, 300], 'the size of the poster');
  await close();
}

if (isMain(import.meta)) {
  await main(async () => {
    const names = process.argv.slice(2);
    const packed = await pack();
    try {
      const count = await check(packed, names.length > 0 ? names : undefined);
      say(`✓ ${count} hosts show rocks`);
    } finally {
      rmSync(packed.outside, { recursive: true, force: true });
    }
  });
}
