/** The module worker that reads one log file. It is started when somebody brings a file, and ended when the file is read. */

import { onTask } from '../generator/task-scope.ts';
import type { FileTask } from '../wood-ear/log-file/protocol.ts';
import { readLogFile } from '../wood-ear/log-file/read.ts';
import type { LogFile } from '../wood-ear/log-file/read.ts';

onTask<FileTask, LogFile>(async ({ file, name }, onProgress) => {
  // A file keeps its name when it is posted, except in some old browsers.
  const result = await readLogFile(named(file, name), { onProgress });
  return { result, transfer: [result.mesh.positions.buffer, result.mesh.indices.buffer] };
});

function named(file: Blob, name: string): Blob & { name: string } {
  return { size: file.size, arrayBuffer: () => file.arrayBuffer(), name } as Blob & { name: string };
}
