/** The page's side of the wood ears' export worker. */

import { exporter } from '../element/export-client.ts';
import { taskWorker } from '../generator/one-task.ts';
import { colonyOptions } from './export-options.ts';
import type { WoodEars } from './table.ts';

export const exportInWorker = exporter<WoodEars>(
  {
    what: 'that writes files',
    file: 'wood-ear-export-worker.js',
    // This literal form is the one that bundlers recognise.
    spawn: () => taskWorker(() => new Worker(new URL('./wood-ear-export-worker.js', import.meta.url), { type: 'module' })),
  },
  colonyOptions,
);
