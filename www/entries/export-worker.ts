/** The module worker that writes one file of rocks. It is started when somebody exports, and ended when the file is written. */

import type { ExportedFile } from '../export/file.ts';
import { onTask } from '../generator/task-scope.ts';
import { exportField } from '../rocks/export.ts';
import type { ExportTask } from '../rocks/export-client.ts';

onTask<ExportTask, ExportedFile>(async ({ field, source, options }, onProgress) => {
  const result = await exportField(field, source, options, { onProgress });
  return { result, transfer: [result.bytes.buffer] };
});
