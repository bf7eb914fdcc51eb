// What a frame of natural colours costs, measured in a page, started by frames.mjs.
//
// Nothing is left out of a frame to be timed: what is cheaper then would be another frame. Frames differ by what they show, and by whether
// the sun has moved since the one before, after which its maps are drawn anew.
import { generate } from '../www/entries/core.ts';
import { defaultCamera } from '../www/scene/camera/camera.ts';
import { lookOf } from '../www/rocks/look.ts';
import { presetParams } from '../www/rocks/request.ts';
import { loadRenderer } from '../www/renderer/load.ts';

/** So many frames are drawn for a sample that it takes this long: waiting for the last of them then counts for little. */
const SAMPLE_MS = 200;

/** Medians over `rounds` by what is drawn, ms per frame. */
globalThis.measureFrames = async ({ backend, preset, side, width, height, rounds }) => {
  const params = { ...presetParams(preset), imageWidth: side, imageHeight: side };
  const renderer = await loadRenderer(() => document.createElement('canvas'), backend);
  const field = await generate(params);
  const look = lookOf(params);
  renderer.setStyle({ view: '3d', color: 'natural', dark: false });
  renderer.setLook(look);
  renderer.setField(field);
  renderer.resize(width, height);

  const framed = defaultCamera(side, side, width / height);
  const above = { azimuth: 0, elevation: Math.PI / 2, distance: side / 2, target: [side / 2, side / 2, 0] };
  const cases = {
    low: { quality: 'low', camera: framed },
    medium: { quality: 'medium', camera: framed },
    high: { quality: 'high', camera: framed },
    stones: { quality: 'high', camera: above },
    ground: { quality: 'high', camera: { ...above, target: [20 * side, side / 2, 0] } },
    sun: { quality: 'high', camera: framed, turns: 1 },
  };
  const finish = finisher(renderer);
  let { sunAzimuth } = look;
  const draw = (frames, { quality, camera, turns = 0 }) => {
    renderer.setQuality(quality);
    renderer.setCamera(camera);
    for (let frame = 0; frame < frames; frame += 1) {
      sunAzimuth = (sunAzimuth + turns) % 360;
      if (turns > 0) renderer.setLook({ ...look, sunAzimuth });
      renderer.render();
    }
  };
  const timed = (frames, shown) => {
    const start = performance.now();
    draw(frames, shown);
    finish();
    return performance.now() - start;
  };
  const samples = Object.fromEntries(Object.keys(cases).map((name) => [name, []]));
  for (let round = 0; round < rounds; round += 1) {
    for (const [name, shown] of Object.entries(cases)) {
      // After the one that brings about what this case needs.
      timed(1, shown);
      let frames = 1;
      let ms = timed(frames, shown);
      while (ms < SAMPLE_MS) {
        frames *= 2;
        ms = timed(frames, shown);
      }
      samples[name].push(ms / frames);
      await new Promise((resolve) => setTimeout(resolve));
    }
  }
  renderer.dispose();
  const { sun, ...whole } = samples;
  const maps = sun.map((ms, round) => ms - whole.high[round]);
  const medians = Object.fromEntries(Object.entries({ ...whole, maps }).map(([name, times]) => [name, median(times)]));
  return { ...medians, triangles: field.stats.triangles };
};

/** Waits for the GPU: a pixel of the picture is asked for, which cannot be known before. */
function finisher(renderer) {
  const context = new OffscreenCanvas(1, 1).getContext('2d', { willReadFrequently: true });
  return () => {
    context.drawImage(renderer.canvas, 0, 0, 1, 1);
    context.getImageData(0, 0, 1, 1);
  };
}

function median(values) {
  return values.toSorted((a, b) => a - b)[values.length >> 1];
}
