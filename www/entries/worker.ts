/** The rocks' module worker: wires the run loops to the messages of this worker and to the wasm that lies beside it. */

import * as glue from '../../pkg/generator.js';
import { FIELD_LOOPS } from '../rocks/session.ts';
import { LoopHost } from '../generator/host.ts';
import { RunLoop } from '../generator/loop.ts';
import { loadGenerator } from '../generator/wasm.ts';
import { listen } from '../generator/worker-scope.ts';

listen(
  (post) =>
    new LoopHost(
      // Bundlers copy the file when they see it in this literal form.
      () => loadGenerator(glue, new URL('./generator_bg.wasm', import.meta.url)),
      (module, postLoop) => new RunLoop(module, FIELD_LOOPS, postLoop),
      post,
    ),
);
