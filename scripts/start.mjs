// `npm start`: from a fresh clone to the page in the browser. Sets up, builds what changed, serves dist/.
//
//   npm start -- --port 8080      another first choice of port
//   npm start -- --host 0.0.0.0   seen from other machines too (without https, browsers give those neither WebGPU nor offline use)
//   npm start -- --watch          rebuilds when a source file changes
import { watch } from 'node:fs';
import path from 'node:path';
import { parseArgs } from 'node:util';
import { build } from './build/build.mjs';
import { dist, root } from './lib/env.mjs';
import { Failure, main, messageOf, say, seconds } from './lib/run.mjs';
import { serve } from './lib/serve.mjs';

await main(async () => {
  const { port, host, watch: watching } = options();
  const begin = performance.now();
  say('rock-field: setting up, building and serving. The first time takes 5–15 minutes, later ones seconds.');
  await build();
  const server = await serve(dist, { port: Number(port), host });
  process.stdout.write(`\n✓ ready after ${seconds(performance.now() - begin)} s\n\n  ${server.url}\n\n  Ctrl+C stops the server.\n`);
  if (watching) rebuildOnChange();
});

function options() {
  try {
    const { values } = parseArgs({
      options: {
        port: { type: 'string', default: '5173' },
        host: { type: 'string', default: '127.0.0.1' },
        watch: { type: 'boolean', default: false },
      },
    });
    if (/^\d{1,5}$/.test(values.port) && Number(values.port) < 65536) return values;
    throw new Error(`--port ${values.port} is not a port number`);
  } catch (error) {
    throw new Failure(messageOf(error));
  }
}

/** One rebuild at a time; what changes meanwhile is built after it. */
function rebuildOnChange() {
  let wanted = false;
  let building = false;
  const rebuild = async () => {
    wanted = true;
    if (building) return;
    building = true;
    while (wanted) {
      wanted = false;
      await new Promise((resolve) => setTimeout(resolve, 100)); // editors write a file in several steps
      // Pages that are open still ask for files of the build they came from.
      await build({ keep: true }).then(
        () => say('✓ rebuilt; reload the page'),
        (error) => say(`✗ ${error.message}`),
      );
    }
    building = false;
  };
  for (const folder of ['src', 'www']) watch(path.join(root, folder), { recursive: true }, rebuild);
  watch(path.join(root, 'index.html'), rebuild);
  say('  watching src/, www/ and index.html');
}
