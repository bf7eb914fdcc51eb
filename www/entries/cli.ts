#!/usr/bin/env node
/** `rock-field`, the command. What makes scenes is in `cli-worker.ts`, which is started where something is made. */

import { Worker } from 'node:worker_threads';
import { main } from '../cli/main.ts';

process.exitCode = await main(process.argv.slice(2), {
  out: process.stdout,
  err: process.stderr,
  startWorker: () => new Worker(new URL('./cli-worker.js', import.meta.url)),
});
