// Undo: one step per gesture.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { CODE, History } from '../../www/base/history.ts';

test('undo and redo walk through the steps; a new edit ends redo', () => {
  const history = new History(0);
  assert.deepEqual([history.undo(), history.redo(), history.canUndo, history.canRedo], [false, false, false, false]);
  history.record(1);
  history.record(2);
  assert.ok(history.undo());
  assert.deepEqual([history.present, history.canUndo, history.canRedo], [1, true, true]);
  assert.ok(history.redo());
  assert.equal(history.present, 2);
  history.undo();
  history.record(3);
  assert.deepEqual([history.present, history.canRedo], [3, false]);
  history.undo();
  history.undo();
  assert.deepEqual([history.present, history.undo()], [0, false]);
});

test('a drag is one step, however slow', () => {
  const history = new History(0);
  history.hold();
  for (let value = 1; value <= 9; value += 1) history.record(value, 'r 0', value * 5000);
  history.release();
  history.hold();
  history.record(10, 'r 0', 45_100);
  history.release();
  history.undo();
  assert.equal(history.present, 9);
  history.undo();
  assert.equal(history.present, 0);
});

test('a held arrow key is one step; a pause, or another control, begins the next', () => {
  const history = new History(0);
  for (let value = 1; value <= 5; value += 1) history.record(value, 'r 0', value * 30);
  history.record(6, 'a 0', 160);
  history.record(7, 'a 0', 5000);
  const seen = [history.present];
  while (history.undo()) seen.push(history.present);
  assert.deepEqual(seen, [7, 6, 5, 0]);
});

test('undo in the middle of a gesture does not let it go on', () => {
  const history = new History(0);
  history.record(1, 'r 0', 0);
  history.undo();
  history.record(2, 'r 0', 10);
  history.undo();
  assert.equal(history.present, 0);
});

test('old steps are forgotten, not new ones', () => {
  const history = new History(0);
  for (let value = 1; value <= 1000; value += 1) history.record(value);
  let steps = 0;
  while (history.undo()) steps += 1;
  assert.ok(steps >= 100 && steps < 1000);
  assert.equal(history.present, 1000 - steps);
});

/** All that can be seen of a history, without changing it for the test that asks. */
function steps(history: History<number>): number[] {
  const before: number[] = [];
  let undone = 0;
  for (; history.undo(); undone += 1) before.unshift(history.present);
  for (; undone > 0; undone -= 1) history.redo();
  return [...before, history.present];
}

test('a refused state is no step: the history is as it was when the last confirmed one was present, redo included', () => {
  const history = new History(0);
  history.settle((state) => state === 0);
  history.record(1);
  history.settle((state) => state === 1);
  history.undo();
  history.settle((state) => state === 0);
  history.record(2);
  assert.equal(history.settled, 0, 'what is tried is not confirmed');
  assert.ok(history.refuse());
  assert.deepEqual([steps(history), history.canRedo], [[0], true]);
  assert.equal(history.refuse(), false, 'what was confirmed cannot be refused');
});

test('an edit that no run has reached yet survives the refusal of a later one, and can still be refused itself', () => {
  const history = new History(0);
  history.settle((state) => state === 0);
  history.record(1, 'seed', 0);
  history.record(-1, 'r 0', 2000);
  assert.ok(history.refuse());
  assert.deepEqual([history.present, history.settled, steps(history)], [1, 0, [0, 1]]);
  assert.ok(history.refuse());
  assert.deepEqual(steps(history), [0]);
});

test('edits by code are one step, and yet a refusal takes back none before the run that was refused', () => {
  const history = new History(0);
  history.settle((state) => state === 0);
  history.record(1, CODE, 0);
  history.begin();
  history.record(-1, CODE, 100);
  history.record(-2, CODE, 100);
  history.begin();
  assert.ok(history.refuse());
  assert.equal(history.present, 1);
  history.record(3, CODE, 200);
  assert.deepEqual(steps(history), [0, 3], 'it goes on as the same step');
});

test('a drag goes back to the last result of it that was shown, and goes on as one step', () => {
  const history = new History(0);
  history.settle((state) => state === 0);
  history.hold();
  for (const value of [1, 2, -3, -4]) history.record(value, 'r 0');
  history.settle((state) => state === 2);
  assert.ok(history.refuse());
  assert.equal(history.present, 2);
  history.record(5, 'r 0');
  history.release();
  assert.deepEqual(steps(history), [0, 5]);
});

test('what is held and refused is not what a hand lets go to', () => {
  const history = new History(0);
  history.settle((state) => state === 0);
  history.record(-1);
  history.hold();
  assert.ok(history.refuse());
  assert.equal(history.abandon(), false);
  assert.equal(history.present, 0);
});

test('giving up goes back past everything that was not confirmed; before the first result there is nothing to go back to', () => {
  const history = new History(0);
  history.record(1);
  assert.equal(history.giveUp(), false);
  assert.equal(history.settled, 1);
  history.settle((state) => state === 1);
  history.record(2);
  history.record(3);
  assert.ok(history.giveUp());
  assert.deepEqual(steps(history), [0, 1]);
});
