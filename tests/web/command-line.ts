// The command line in this process: as fast as a function, with the threads of the built package.
import path from 'node:path';
import { PassThrough } from 'node:stream';
import { fileURLToPath } from 'node:url';
import { Worker } from 'node:worker_threads';
import { main } from '../../www/cli/main.ts';

const dist = fileURLToPath(new URL('../../dist/', import.meta.url));
/** The command, for processes of their own. */
export const CLI = path.join(dist, 'cli.js');

export interface Ran {
  code: number;
  out: string;
  err: string;
  /** The lines of the standard output that are JSON. */
  lines: Record<string, unknown>[];
}

/** Runs `rock-field` with these arguments, as in a pipe or on a terminal. */
export async function rockField(args: readonly string[], { isTTY = false } = {}): Promise<Ran> {
  const [out, err] = [stream(isTTY), stream(isTTY)];
  const code = await main(args, {
    out: out.stream,
    err: err.stream,
    startWorker: () => new Worker(path.join(dist, 'cli-worker.js')),
  });
  const lines = out
    .text()
    .split('\n')
    .filter((line) => line.startsWith('{'))
    .map((line) => JSON.parse(line) as Record<string, unknown>);
  return { code, out: out.text(), err: err.text(), lines };
}

function stream(isTTY: boolean): { stream: NodeJS.WriteStream; text: () => string } {
  const pieces: Buffer[] = [];
  const through = new PassThrough();
  through.on('data', (piece: Buffer) => pieces.push(piece));
  return { stream: Object.assign(through, { isTTY }) as unknown as NodeJS.WriteStream, text: () => Buffer.concat(pieces).toString() };
}
