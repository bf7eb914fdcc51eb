/** Makes one shard of a batch. */

import path from 'node:path';
import { Ending } from '../failures.ts';
import type { Exit } from '../failures.ts';
import { Jobs } from '../jobs.ts';
import { flushed, jobsOf, whenStopped } from '../make.ts';
import type { Surroundings } from '../make.ts';
import { clearOwn } from '../whole-file.ts';
import { batchOf, claim, idOf } from './batch-file.ts';
import { inFolder, recordPath, scenePath } from './folder.ts';
import type { BatchTask, ItemDone } from './item.ts';
import { keyOf } from './list.ts';
import type { Item, List } from './list.ts';
import { Teller } from './teller.ts';

export interface ShardRun {
  folder: string;
  list: List;
  options: Readonly<Record<string, unknown>>;
  /** As it was typed. */
  jobs: string | undefined;
  isJson: boolean;
  isQuiet: boolean;
}

/**
 * Makes what is missing. It depends on its arguments and the folder alone, so any shard may be repeated anywhere, also while it is being made.
 *
 * @throws {Ending} when the folder is another batch's, and when the run was stopped or cannot write; what is there is whole then.
 */
export async function runShard(run: ShardRun, { startWorker, ...streams }: Surroundings): Promise<Exit> {
  const { folder, list, options, jobs: typed, isQuiet, isJson } = run;
  const jobCount = jobsOf(typed, list.items.length);
  const batch = batchOf(list.count, list.hash, options);
  claim(folder, batch);
  const id = idOf(batch);
  const teller = new Teller(streams, { total: list.items.length, isJson, isQuiet });
  let storage: string | undefined;
  const jobs = new Jobs<BatchTask, ItemDone>({
    tasks: tasksOf(list.items, folder, id),
    jobs: jobCount,
    startWorker,
    onResult: (task, done) => teller.done(task, done),
    onFailure: (task, failure) => {
      teller.failed(task, failure);
      if (failure.isStorage) storage ??= failure.message;
      return failure.isStorage;
    },
  });
  const stopped = whenStopped(streams);
  try {
    await Promise.race([jobs.run().then(() => flushed(streams)), stopped.promise]);
  } catch (thrown) {
    const begun = await jobs.stop();
    clearOwn(begun.flatMap(({ index }) => [scenePath(index, ''), recordPath(index)].map((file) => path.dirname(inFolder(folder, file)))));
    throw thrown instanceof Ending ? new Ending(thrown.exit, `${thrown.message}; ${goOn(teller)}`, { cause: thrown }) : thrown;
  } finally {
    stopped.forget();
    teller.end();
  }
  if (storage !== undefined) throw new Ending('storage', `files cannot be written (${storage}); ${goOn(teller)}`);
  return teller.counts.failed > 0 ? 'failed' : 'done';
}

function goOn({ counts }: Teller): string {
  return `${counts.made + counts.skipped} files are there, each of them whole, and the same command makes the others`;
}

function* tasksOf(items: readonly Item[], folder: string, batch: string): Generator<BatchTask> {
  for (const item of items) yield { ...item, folder, batch, key: keyOf(item) };
}
