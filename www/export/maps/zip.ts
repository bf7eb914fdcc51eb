/** ZIP without compression: what is in it is compressed already, or would hardly get smaller. */

import { zipSync } from 'fflate';

/**
 * The file. All of its entries are of 1 January 1980, the first day that there is in it, since the same scene is the same file on every day; a
 * ZIP has no time zone, and fflate takes the date as this machine's clock shows it.
 */
export function writeZip(files: Readonly<Record<string, Uint8Array>>): Uint8Array<ArrayBuffer> {
  return zipSync({ ...files }, { level: 0, mtime: new Date(1980, 0, 1) }) as Uint8Array<ArrayBuffer>;
}
