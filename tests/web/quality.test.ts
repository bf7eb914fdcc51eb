// How well a scene is drawn, by what its frames took.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { AutoQuality } from '../../www/renderer/quality.ts';
import type { Quality } from '../../www/base/view.ts';

/** A motion of frames that take as long as the level's entry says, and its levels in the order they came. */
function move(auto: AutoQuality, frames: number, ms: Record<Quality, number>, from = 0): { levels: Quality[]; end: number } {
  const levels: Quality[] = [auto.moving];
  let now = from;
  for (let frame = 0; frame < frames; frame += 1) {
    auto.frame(now);
    if (auto.moving !== levels.at(-1)) levels.push(auto.moving);
    now += ms[auto.moving];
  }
  return { levels, end: now };
}

test('it begins in the middle, or where it is told to', () => {
  assert.deepEqual([new AutoQuality().moving, new AutoQuality('low').moving], ['medium', 'low']);
});

test('a motion that does not flow goes down, each step on evidence of its own', () => {
  const auto = new AutoQuality();
  assert.deepEqual(move(auto, 8, { low: 12, medium: 40, high: 90 }).levels, ['medium', 'low']);
  const slow = new AutoQuality();
  assert.deepEqual(move(slow, 7, { low: 60, medium: 60, high: 60 }).levels, ['medium'], 'seven frames have six intervals');
  assert.deepEqual(move(slow, 30, { low: 60, medium: 60, high: 60 }, 420).levels, ['medium', 'low'], 'there is nothing below the lowest');
});

test('a few late frames are no slow motion', () => {
  const auto = new AutoQuality();
  for (let frame = 0, now = 0; frame < 60; frame += 1) {
    now += frame % 3 === 0 ? 80 : 16.7;
    auto.frame(now);
    assert.equal(auto.moving, 'medium');
  }
});

test('a motion that flows goes up, on a screen of 60 Hz and on a faster one', () => {
  for (const ms of [16.7, 8.3]) {
    const auto = new AutoQuality();
    assert.deepEqual(move(auto, 40, { low: ms, medium: ms, high: ms }).levels, ['medium']);
    assert.deepEqual(move(auto, 60, { low: ms, medium: ms, high: ms }, 1000).levels, ['medium', 'high']);
  }
});

test('between 19 and 25 ms nothing changes', () => {
  assert.deepEqual(move(new AutoQuality(), 500, { low: 10, medium: 22, high: 40 }).levels, ['medium']);
});

test('a level that did not flow is tried again, at longer and longer intervals', () => {
  const auto = new AutoQuality();
  const times: number[] = [];
  let before: Quality = auto.moving;
  for (let now = 0; now < 120_000; now += auto.moving === 'high' ? 40 : 16) {
    auto.frame(now);
    if (auto.moving === 'high' && before !== 'high') times.push(now);
    before = auto.moving;
  }
  const waits = times.slice(1).map((time, index) => time - times[index]!);
  assert(times.length >= 4 && times.length <= 6, times.join(', '));
  waits.forEach((wait, index) => assert(wait >= 4000 * 2 ** index && wait < 4000 * 2 ** index + 1500, waits.join(', ')));
});

test('a pause is no interval', () => {
  const auto = new AutoQuality();
  for (let now = 0; now < 60_000; now += 2000) {
    auto.frame(now);
    auto.frame(now + 17);
    auto.rest();
  }
  assert.equal(auto.moving, 'medium');
});
