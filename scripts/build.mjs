// `npm run build`: everything in dist/, the static page and the package's files.
import { Failure, isMain, main, say } from './run.mjs';
import { setup } from './setup.mjs';

export async function build() {
  await setup();
  // These need npm packages, which on a fresh machine only setup() has installed.
  const { buildWasm } = await import('./wasm.mjs');
  const { buildWeb } = await import('./web.mjs');
  await buildWasm();
  await buildWeb();
}

if (isMain(import.meta)) {
  await main(async () => {
    if (process.argv.length > 2) throw new Failure('npm run build takes no arguments');
    await build();
    say('✓ dist/ is ready: a static site, to be put on any web server');
  });
}
