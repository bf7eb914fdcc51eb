// What follows the best picture at rest: the mean of samples, which it passes into.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { inTurn } from '../../www/scene/turns.ts';
import { Device, pass, present, Samplers, screen, setUp, setUpSoftware } from './fake-screen.ts';
import type { Mock } from './fake-screen.ts';

/** A scene at rest, whose best picture is on the screen. */
async function atRest(mock: Mock, ms: number, samples = 64) {
  const stills = new Samplers(ms);
  const set = await setUpSoftware(mock, 20_000, stills);
  set.pacer.samples = samples;
  set.pacer.invalidate();
  await pass(mock, set.device, 600);
  assert.equal(set.device.shown.at(-1), '800×600');
  return { ...set, stills };
}

test('the best picture passes into the mean of samples without a step, and then nothing is drawn', async ({ mock }) => {
  const { device, stills } = await atRest(mock, 8);
  assert.equal(stills.begun, 0, 'somebody may only pause');
  await pass(mock, device, 4000);
  assert.deepEqual([stills.samples, stills.share, stills.ended], [64, 1, 1]);
  const steps = stills.shares.slice(0, stills.shares.indexOf(1) + 1).map((share, k, all) => share - (all[k - 1] ?? 0));
  assert(steps.length > 20 && steps.every((step) => step >= 0 && step < 0.06), steps.join(' '));
  const { begun } = device;
  await pass(mock, device, 2000);
  assert.deepEqual([device.begun, stills.begun, screen.frames.length], [begun, 1, 0]);
});

test('a change ends it at once, is answered by a picture of the motion, and begins it anew', async ({ mock }) => {
  const { device, pacer, stills } = await atRest(mock, 100);
  await pass(mock, device, 1500);
  assert(stills.samples > 2 && stills.share === 0, 'under way');
  const { length } = device.shown;
  pacer.invalidate();
  await pass(mock, device, 80);
  assert.deepEqual([stills.ended, device.shown.length], [1, length + 1]);
  assert.match(device.shown.at(-1)!, /rough/);
  await pass(mock, device, 12_000);
  assert.deepEqual([stills.begun, stills.share], [2, 1]);
});

test('a change while one picture passes into the other is answered as well', async ({ mock }) => {
  const { device, pacer, stills } = await atRest(mock, 8, 16);
  for (let k = 0; k < 300 && stills.shares.length < 5; k += 1) await pass(mock, device, 16);
  pacer.invalidate();
  await pass(mock, device, 80);
  const { length } = stills.shares;
  assert.match(device.shown.at(-1)!, /rough/);
  await pass(mock, device, 200);
  assert.equal(stills.shares.length, length);
});

test('a device that would be busy for too long keeps the picture it has; one that is nearly too slow ends early', async ({ mock }) => {
  const slow = await atRest(mock, 5000);
  await pass(mock, slow.device, 20_000);
  assert.deepEqual([slow.stills.begun, slow.stills.ended, slow.stills.shares], [1, 1, []]);
  assert(slow.stills.samples < 4, String(slow.stills.samples));
  await pass(mock, slow.device, 2000);
  assert.equal(slow.stills.begun, 1);
  const late = await atRest(mock, 1000);
  await pass(mock, late.device, 40_000);
  const { samples, share } = late.stills;
  assert(samples >= 16 && samples < 64 && share === 1, `${samples} samples, ${share}`);
});

test('with no samples, at a lower quality and in the papers’ style nothing is refined', async ({ mock }) => {
  const { device, pacer, scene, stills } = await atRest(mock, 8, 0);
  await pass(mock, device, 2000);
  pacer.samples = 64;
  pacer.wanted = 'medium';
  await pass(mock, device, 2000);
  scene.graded = false;
  pacer.wanted = 'high';
  await pass(mock, device, 2000);
  assert.equal(stills.begun, 0);
  scene.graded = true;
  pacer.invalidate();
  await pass(mock, device, 3000);
  assert.equal(stills.begun, 1, 'a quality that is named is refined as auto is');
});

test('out of sight it ends, and back in sight it begins anew, with the picture that is there', async ({ mock }) => {
  const { device, pacer, scene, stills } = await atRest(mock, 100);
  await pass(mock, device, 1500);
  scene.visible = false;
  await pass(mock, device, 500);
  assert.deepEqual([stills.begun, stills.ended], [1, 1]);
  const { begun } = device;
  scene.visible = true;
  pacer.look(false);
  await pass(mock, device, 11_000);
  assert.deepEqual([device.begun, stills.begun, stills.share], [begun, 2, 1]);
});

test('a still that somebody waits for comes first', async ({ mock }) => {
  const { device, stills } = await atRest(mock, 100);
  await pass(mock, device, 1500);
  let isMade = false;
  void inTurn(async () => {
    assert.equal(stills.ended, 1);
    await new Promise((resolve) => setTimeout(resolve, 500));
    isMade = true;
  });
  await pass(mock, device, 400);
  assert.deepEqual([isMade, stills.begun], [false, 1]);
  await pass(mock, device, 11_000);
  assert.deepEqual([isMade, stills.begun, stills.share], [true, 2, 1]);
});

test('a fast device draws whole pictures, and one of them in pieces to be refined', async ({ mock }) => {
  mock.method(performance, 'now', () => screen.clock);
  const stills = new Samplers(4);
  const device = new Device(1e6);
  const { drawn, pacer } = setUp({ pieces: device, stills });
  pacer.samples = 16;
  present();
  await pass(mock, device, 400);
  assert.deepEqual([drawn, device.begun], [['medium', 'high'], 0]);
  await pass(mock, device, 2500);
  assert.deepEqual([drawn.length, device.shown, stills.share], [2, ['800×600'], 1]);
  pacer.redraw();
  assert.deepEqual([drawn.length, device.shown.length], [2, 2], 'what is refined stays on the screen');
  pacer.invalidate();
  await pass(mock, device, 40);
  assert.equal(drawn.length, 3);
});
