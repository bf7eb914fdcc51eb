/** A thread of the command line: it makes scenes and writes their files, one after the other. */

import { onTasks } from '../cli/worker-scope.ts';
import { Work } from '../cli/work.ts';
import type { Made, Task } from '../cli/work.ts';
import { generate, growWoodEar } from './core.node.ts';
import { ground } from './ground.node.ts';

const work = new Work({ generate, grow: growWoodEar, soil: ground });

onTasks<Task, Made>(async (task, onProgress) => {
  const result = await work.do(task, onProgress);
  return { result, transfer: result.data ? [result.data.buffer] : [] };
});
