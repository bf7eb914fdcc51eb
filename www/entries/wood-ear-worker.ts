/** The wood ears' module worker; see `worker.ts`. */

import * as glue from '../../pkg/wood-ear.js';
import { LoopHost } from '../generator/host.ts';
import { RunLoop } from '../generator/loop.ts';
import { loadGenerator } from '../generator/wasm.ts';
import { woodEarLoop } from '../wood-ear/session.ts';
import { listen } from '../generator/worker-scope.ts';

listen(
  (post) =>
    new LoopHost(
      // Bundlers copy the file when they see it in this literal form.
      () => loadGenerator(glue, new URL('./wood-ear_bg.wasm', import.meta.url)),
      (module, postLoop) => new RunLoop(module, woodEarLoop(), postLoop),
      post,
    ),
);
