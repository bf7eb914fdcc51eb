/** The module worker that reads one log file. It is started when somebody brings a file, and ended when the file is read. */

import { errorInfo } from '../base/errors.ts';
import { readLogFile } from '../wood-ear/log-file/read.ts';
import type { FromFileWorker, ToFileWorker } from '../wood-ear/log-file/protocol.ts';

const scope = globalThis as unknown as {
  postMessage(message: FromFileWorker, transfer?: Transferable[]): void;
  onmessage: ((event: MessageEvent<ToFileWorker>) => void) | null;
};

/** A page shows no more, ms. */
const REPORT_EVERY_MS = 50;

scope.onmessage = ({ data }) => {
  let told = performance.now();
  const onProgress = (fraction: number): void => {
    if (performance.now() - told < REPORT_EVERY_MS) return;
    told = performance.now();
    scope.postMessage({ type: 'progress', fraction });
  };
  // A file keeps its name when it is posted, except in some old browsers.
  readLogFile(named(data.file, data.name), { onProgress }).then(
    ({ mesh, notices }) => scope.postMessage({ type: 'read', mesh, notices }, [mesh.positions.buffer, mesh.indices.buffer]),
    (thrown: unknown) => scope.postMessage({ type: 'failed', error: errorInfo(thrown) }),
  );
};

scope.postMessage({ type: 'ready' });

function named(file: Blob, name: string): Blob & { name: string } {
  return { size: file.size, arrayBuffer: () => file.arrayBuffer(), name } as Blob & { name: string };
}
