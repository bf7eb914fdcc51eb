// `npm run build`: everything in dist/, the static page and the package's files.
//
//   npm run build -- --keep   leaves files with hashed names of the last month's builds in dist/: for hosts that replace the whole site at
//                             once, so that pages that are open at that moment still find theirs
import { Failure, isMain, main, say } from '../lib/run.mjs';
import { setup } from '../setup.mjs';

export async function build(options) {
  await setup();
  // These need npm packages, which on a fresh machine only setup() has installed.
  const { buildWasm } = await import('./wasm.mjs');
  const { buildWeb } = await import('./web.mjs');
  await buildWasm();
  await buildWeb(options);
}

if (isMain(import.meta)) {
  await main(async () => {
    const args = process.argv.slice(2);
    if (args.some((arg) => arg !== '--keep')) throw new Failure(`npm run build takes --keep alone, not ${args.join(' ')}`);
    await build({ keep: args.includes('--keep') });
    say('✓ dist/ is ready: a static site, to be put on any web server');
  });
}
