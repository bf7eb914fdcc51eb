// Undo: one step per gesture.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { History } from '../../www/history.ts';

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
