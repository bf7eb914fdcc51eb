/** The module worker that writes one file of wood ears; see `export-worker.ts`. */

import type { ExportTask } from '../element/export-client.ts';
import type { ExportedFile } from '../export/file.ts';
import { onTask } from '../generator/task-scope.ts';
import { groundRealm } from '../rocks/ground-realm.ts';
import { exportColony } from '../wood-ear/export.ts';
import type { WoodEars } from '../wood-ear/table.ts';

onTask<ExportTask<WoodEars>, ExportedFile>(async ({ result: scene, options, ...source }, onProgress) => {
  const result = await exportColony(scene, source, options, groundRealm, { onProgress });
  return { result, transfer: [result.bytes.buffer] };
});
