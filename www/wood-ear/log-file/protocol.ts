/** What page and file worker say to each other. */

import type { ErrorInfo } from '../../base/errors.ts';
import type { Words } from '../../base/language.ts';
import type { LogMesh } from '../log-mesh.ts';

export interface ToFileWorker {
  file: Blob;
  name: string;
}

export type FromFileWorker =
  | { type: 'ready' }
  | { type: 'progress'; fraction: number }
  | { type: 'read'; mesh: LogMesh; notices: Words[] }
  | { type: 'failed'; error: ErrorInfo };
