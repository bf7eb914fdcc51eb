// Before `npm pack` and `npm publish`: a build, and beside it what only the package needs.
import { build } from '../build/build.mjs';
import { isMain, main } from '../lib/run.mjs';

export async function packageFiles() {
  await build();
  // These need npm packages, which on a fresh machine only the build has installed.
  const { writeTypes } = await import('./types.mjs');
  const { writeManifest } = await import('./manifest.mjs');
  const { buildInline } = await import('../build/inline.mjs');
  await writeTypes();
  await writeManifest();
  await buildInline();
}

if (isMain(import.meta)) await main(packageFiles);
