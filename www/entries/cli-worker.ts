/** A thread of the command line: it makes scenes and writes their files, one after the other. */

import { doItem } from '../cli/batch/item.ts';
import type { BatchTask, ItemDone } from '../cli/batch/item.ts';
import { onTasks } from '../cli/worker-scope.ts';
import { Work } from '../cli/work.ts';
import type { Made, Task } from '../cli/work.ts';
import { generate, growWoodEar } from './core.node.ts';
import { ground } from './ground.node.ts';

const work = new Work({ generate, grow: growWoodEar, soil: ground });

onTasks<Task | BatchTask, Made | ItemDone>(async (task, onProgress) => {
  if ('batch' in task) return { result: await doItem(task, work) };
  const result = await work.do(task, onProgress);
  return { result, transfer: result.data ? [result.data.buffer] : [] };
});
