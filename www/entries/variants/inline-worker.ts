/** The workers of the build with everything in it: their scripts are texts of this one. Put by scripts/build/inline.mjs in the place of the workers' addresses. */

import exportScript from 'inlined:export-worker';
import fullScript from 'inlined:full-worker';
import fileScript from 'inlined:wood-ear-file-worker';
import woodEarExportScript from 'inlined:wood-ear-export-worker';
import woodEarScript from 'inlined:wood-ear-worker';
import script from 'inlined:worker';

let address: string | undefined;
let fullAddress: string | undefined;
let woodEarAddress: string | undefined;
let fileAddress: string | undefined;
let exportAddress: string | undefined;
let woodEarExportAddress: string | undefined;

/** One for all workers of the page. Needs `worker-src blob:`, where the page has a Content-Security-Policy. */
export function workerAddress(): string {
  address ??= addressOf(script);
  return address;
}

/** As `workerAddress`. */
export function fullWorkerAddress(): string {
  fullAddress ??= addressOf(fullScript);
  return fullAddress;
}

/** As `workerAddress`. */
export function woodEarWorkerAddress(): string {
  woodEarAddress ??= addressOf(woodEarScript);
  return woodEarAddress;
}

/** As `workerAddress`. */
export function woodEarFileWorkerAddress(): string {
  fileAddress ??= addressOf(fileScript);
  return fileAddress;
}

/** As `workerAddress`. */
export function exportWorkerAddress(): string {
  exportAddress ??= addressOf(exportScript);
  return exportAddress;
}

/** As `workerAddress`. */
export function woodEarExportWorkerAddress(): string {
  woodEarExportAddress ??= addressOf(woodEarExportScript);
  return woodEarExportAddress;
}

function addressOf(text: string): string {
  return URL.createObjectURL(new Blob([text], { type: 'text/javascript' }));
}
