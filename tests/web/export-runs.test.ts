// The third argument of exportScene and exportWoodEar: who waits for a file, and how much memory it may take.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { exportScene, exportWoodEar } from 'rock-field/export';
import type { RockFieldError } from 'rock-field/export';

test('what a run cannot be is refused by name, before anything is generated', async () => {
  const wrong: [unknown, Partial<RockFieldError>][] = [
    [null, { name: 'WrongType', key: 'run', value: null }],
    [3, { name: 'WrongType', key: 'run', value: 3 }],
    [{ onProgress: 3 }, { name: 'WrongType', key: 'onProgress', value: 3 }],
    [{ signal: {} }, { name: 'WrongType', key: 'signal' }],
    [{ maxBytes: Number.NaN }, { name: 'OutOfRange', key: 'maxBytes', min: 0 }],
  ];
  for (const [run, error] of wrong) {
    await assert.rejects(exportScene({}, {}, run as object), error);
    await assert.rejects(exportWoodEar({}, {}, run as object), error);
  }
});
