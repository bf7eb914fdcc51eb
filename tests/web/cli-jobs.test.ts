/** Tasks on threads: which are made, which fail, and what is left when they are stopped. The threads are small programs of their own. */

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Worker } from 'node:worker_threads';
import type { Failure } from '../../www/cli/failures.ts';
import { Jobs } from '../../www/cli/jobs.ts';

/** Answers a number with its double; a word says what else it does. */
const PROGRAM = `
const { parentPort } = require('node:worker_threads');
parentPort.on('message', ({ task }) => {
  if (task === 'die') process.exit(3);
  else if (task === 'throw') setTimeout(() => { throw new Error('fault'); });
  else if (task === 'fail') parentPort.postMessage({ failure: { name: 'OutOfRange', message: 'no', isStorage: false } });
  else if (task === 'full') parentPort.postMessage({ failure: { name: 'ENOSPC', message: 'full', isStorage: true } });
  else if (task !== 'never') {
    parentPort.postMessage({ fraction: 0.5 });
    parentPort.postMessage({ result: 2 * task });
  }
});`;

type Task = number | 'die' | 'throw' | 'fail' | 'full' | 'never';

interface Told {
  results: Map<Task, number>;
  failures: [Task, string][];
  started: number;
}

function jobsOf(tasks: Iterable<Task>, jobs: number): { all: Jobs<Task, number>; told: Told } {
  const told: Told = { results: new Map(), failures: [], started: 0 };
  const all = new Jobs<Task, number>({
    tasks,
    jobs,
    startWorker: () => {
      told.started += 1;
      return new Worker(PROGRAM, { eval: true });
    },
    onResult: (task, result) => void told.results.set(task, result),
    onFailure: (task, { name, isStorage }: Failure) => {
      told.failures.push([task, name]);
      return isStorage;
    },
  });
  return { all, told };
}

test('every task is done once, by no more threads than were asked for, which take them as they become free', async () => {
  let taken = 0;
  let done = 0;
  let most = 0;
  function* numbers(): Generator<number> {
    for (let k = 0; k < 50; k++) {
      taken += 1;
      most = Math.max(most, taken - done);
      yield k;
    }
  }
  const { all, told } = jobsOf(numbers(), 3);
  const counted = new Proxy(told.results, {});
  const set = told.results.set.bind(told.results);
  counted.set = (task, result) => {
    done += 1;
    return set(task, result);
  };
  await all.run();
  assert.deepEqual(
    [...told.results].sort(([a], [b]) => Number(a) - Number(b)),
    Array.from({ length: 50 }, (_, k) => [k, 2 * k]),
  );
  assert.deepEqual([told.failures, told.started], [[], 3]);
  assert.ok(most <= 3, `${most} were taken before they could be done`);
});

test('a task that fails fails alone; a thread that ends fails its task, and another takes its place', async () => {
  const { all, told } = jobsOf([1, 'fail', 2, 'die', 3, 'throw', 4], 1);
  await all.run();
  assert.deepEqual([...told.results.values()], [2, 4, 6, 8]);
  assert.deepEqual(told.failures, [
    ['fail', 'OutOfRange'],
    ['die', 'WorkerLost'],
    ['throw', 'WorkerLost'],
  ]);
  assert.equal(told.started, 3);
});

test('where a failure would be that of all others, no other task is begun', async () => {
  const { all, told } = jobsOf([1, 'full', 2, 3, 4], 1);
  await all.run();
  assert.deepEqual([[...told.results.keys()], told.failures], [[1], [['full', 'ENOSPC']]]);
});

test('when they are stopped, all threads end, and the tasks that were under way are told', async () => {
  const { all, told } = jobsOf([1, 'never', 'never', 2, 3], 2);
  const running = all.run();
  while (told.results.size === 0) await new Promise((resolve) => setTimeout(resolve, 5));
  await new Promise((resolve) => setTimeout(resolve, 20));
  assert.deepEqual(await all.stop(), ['never', 'never']);
  await running;
  assert.deepEqual([...told.results.keys(), ...told.failures], [1]);
});
