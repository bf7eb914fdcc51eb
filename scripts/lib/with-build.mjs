// Runs a script once dist/ is up to date: `node scripts/lib/with-build.mjs benches/bench.mjs --json`. stdout is the script's alone.
import { existsSync } from 'node:fs';
import path from 'node:path';
import { build } from '../build/build.mjs';
import { root } from './env.mjs';
import { Failure, main, run } from './run.mjs';

await main(async () => {
  const [script, ...args] = process.argv.slice(2);
  if (!script || !existsSync(path.join(root, script))) throw new Failure(`there is no ${script ?? 'script named'}`);
  await build();
  await run(process.execPath, [path.join(root, script), ...args], { cwd: root, stdout: 'inherit' });
});
