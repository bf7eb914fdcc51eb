// Scripts that are fetched when they are wanted: how long they may take.
import assert from 'node:assert/strict';
import { mock, test } from 'node:test';
import { lazily } from '../../www/base/lazy.ts';

/** Timers that fire when the test says so, the first that was set first. */
function heldTimers(): (() => void)[] {
  const held: (() => void)[] = [];
  mock.method(globalThis, 'setTimeout', (act: () => void) => held.push(act));
  mock.method(globalThis, 'clearTimeout', () => {});
  return held;
}

test('a script that arrived while the page was busy is taken, although its time is over', async () => {
  const timers = heldTimers();
  try {
    let arrive = (_: string) => {};
    const asked = lazily(() => new Promise<string>((resolve) => (arrive = resolve)));
    timers.shift()?.();
    arrive('the module');
    assert.equal(await asked, 'the module');
  } finally {
    mock.restoreAll();
  }
});

test('a script that does not arrive is given up by name', async () => {
  const timers = heldTimers();
  try {
    const asked = lazily(() => new Promise(() => {}));
    for (let fire = timers.shift(); fire; fire = timers.shift()) fire();
    await assert.rejects(asked, { name: 'ScriptUnavailable' });
  } finally {
    mock.restoreAll();
  }
});
