/** The module worker of the full generator, which takes the place of `worker.ts` where a field asks for what the plain one lacks. */

import * as glue from '../../pkg/generator-full.js';
import { FULL_LOOPS } from '../rocks/full-session.ts';
import { LoopHost } from '../generator/host.ts';
import { RunLoop } from '../generator/loop.ts';
import { loadGenerator } from '../generator/wasm.ts';
import { listen } from '../generator/worker-scope.ts';

listen(
  (post) =>
    new LoopHost(
      // Bundlers copy the file when they see it in this literal form.
      () => loadGenerator(glue, new URL('./generator-full_bg.wasm', import.meta.url)),
      (module, postLoop) => new RunLoop(module, FULL_LOOPS, postLoop),
      post,
    ),
);
