// How much longer a run takes.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Estimate } from '../../www/generator/estimate.ts';
import { isSlowThesis, timeLeft } from '../../www/wood-ear/patience.ts';
import { woodEarPreset } from '../../www/wood-ear/request.ts';

test('the seconds left are those of the stage’s own pace, and none are told before it has one', () => {
  const estimate = new Estimate<'quick' | 'long'>();
  assert.equal(estimate.added({ stage: 'quick', fraction: 0 }, 0).secondsLeft, undefined);
  assert.equal(estimate.added({ stage: 'quick', fraction: 0.3 }, 100).secondsLeft, undefined);
  // The quick stage's pace is none of the long one's.
  assert.equal(estimate.added({ stage: 'long', fraction: 0.3 }, 200).secondsLeft, undefined);
  assert.equal(estimate.added({ stage: 'long', fraction: 0.32 }, 1100).secondsLeft, undefined);
  assert.equal(estimate.added({ stage: 'long', fraction: 0.324 }, 5200).secondsLeft, undefined);
  assert.ok(Math.abs(estimate.added({ stage: 'long', fraction: 0.374 }, 10_200).secondsLeft! - 62.6) < 1e-9);
});

test('a slow beginning of a stage is soon forgotten', () => {
  const estimate = new Estimate<'long'>();
  estimate.added({ stage: 'long', fraction: 0 }, 0);
  // One percent in a second, then ten percent a second.
  estimate.added({ stage: 'long', fraction: 0.01 }, 1000);
  assert.ok(Math.abs(estimate.added({ stage: 'long', fraction: 0.11 }, 2000).secondsLeft! - 8.9) < 1e-9);
  estimate.added({ stage: 'long', fraction: 0.21 }, 3000);
  assert.ok(Math.abs(estimate.added({ stage: 'long', fraction: 0.31 }, 4000).secondsLeft! - 6.9) < 1e-9);
});

test('the other rule is offered where the thesis’s takes long, and nowhere else', () => {
  const params = woodEarPreset('thesis-default');
  const slow = { stage: 'collide', fraction: 0.31, secondsLeft: 104 } as const;
  assert.equal(isSlowThesis(slow, params), true);
  assert.equal(isSlowThesis({ ...slow, secondsLeft: 3 }, params), false);
  assert.equal(isSlowThesis({ stage: 'collide', fraction: 0.3 }, params), false);
  assert.equal(isSlowThesis(slow, { ...params, collisions: 'pressed' }), false);
  assert.deepEqual(
    [timeLeft(slow, 'en'), timeLeft({ ...slow, secondsLeft: 34 }, 'en'), timeLeft(slow, 'ja')],
    ['1.7 minutes', '30 seconds', '1.7 分'],
  );
});
