// `node scripts/pictures/orbit.mjs`: whether anything pops while a camera moves in small steps: rocks that change their level of detail, or copies of the
// field whose smallest rocks come and go.
//
//   node scripts/pictures/orbit.mjs                                riverbed and quarry-rubble, high and low, on WebGPU
//   node scripts/pictures/orbit.mjs --only scree --quality low     another preset, one quality
//   node scripts/pictures/orbit.mjs --steps 40 --camera low        more steps; a camera of the gallery
//
// Each step turns the camera by a quarter of a degree, or takes it nearer by half a percent. Of all pixels, those are counted that change by more than
// 8 of 255. Most of them change because the camera moves, and that share is nearly the same from step to step; what a step has more than the steps
// around it, something else did. That is what is printed as popped, and no step may have more than 2 % of it.
import { parseArgs } from 'node:util';
import { CAMERAS } from './gallery.mjs';
import { openStudio } from './studio.mjs';
import { Failure, isMain, main, say } from '../lib/run.mjs';
import { readPicture } from '../lib/pixels.mjs';

const SIZE = { width: 480, height: 300 };
/** How much a pixel changes that is seen to change, of 255, and how many may pop, per cent. */
const SEEN = 8;
const MOST = 2;
const MOVES = {
  turned: (camera) => ({ ...camera, azimuth: camera.azimuth + Math.PI / 720 }),
  nearer: (camera) => ({ ...camera, distance: camera.distance * 0.995 }),
};

/** Per cent of the pixels that are seen to differ. */
function changed(one, other) {
  let count = 0;
  for (let at = 0; at < one.data.length; at += 4) {
    const differs = [at, at + 1, at + 2].some((place) => Math.abs(one.data[place] - other.data[place]) > SEEN);
    if (differs) count += 1;
  }
  return (100 * count) / (one.width * one.height);
}

/** What each step has more than the middle one of it and the two before and after it. */
export function popped(shares) {
  return shares.map((share, step) => {
    const around = shares.slice(Math.max(0, step - 2), step + 3).sort((a, b) => a - b);
    return Math.max(0, share - around[Math.floor((around.length - 1) / 2)]);
  });
}

/** Pictures before and after each of the steps: how many pixels changed. */
async function walked(studio, start, move, steps) {
  const draw = async (camera) => readPicture((await studio.take('webgpu', { ...SIZE, camera })).png);
  const shares = [];
  let camera = start;
  let last = await draw(camera);
  for (let step = 0; step < steps; step += 1) {
    camera = move(camera);
    const next = await draw(camera);
    shares.push(changed(last, next));
    last = next;
  }
  return shares;
}

function readArguments() {
  const { values } = parseArgs({
    options: {
      only: { type: 'string', default: 'riverbed,quarry-rubble' },
      quality: { type: 'string', default: 'high,low' },
      camera: { type: 'string' },
      steps: { type: 'string', default: '16' },
    },
  });
  const { camera } = values;
  if (camera !== undefined && !(camera in CAMERAS))
    throw new Failure(`there is no camera called ${camera}: ${Object.keys(CAMERAS).join(', ')}`);
  if (!/^[1-9]\d*$/.test(values.steps)) throw new Failure(`--steps takes a number, not ${values.steps}`);
  return { presets: values.only.split(','), qualities: values.quality.split(','), camera, steps: Number(values.steps) };
}

if (isMain(import.meta)) {
  await main(async () => {
    const { presets, qualities, camera, steps } = readArguments();
    const studio = await openStudio({ backends: ['webgpu'] });
    let worst = 0;
    try {
      for (const preset of presets) {
        for (const quality of qualities) {
          const scene = await studio.show('webgpu', { preset, quality, color: 'natural', seed: '3' });
          // As far away as an orbit begins, unless a camera of the gallery is asked for.
          const far = { azimuth: Math.PI / 6, elevation: 0.66, distance: 1.1 * scene.imageWidth, target: [...scene.middle, 0] };
          for (const [name, move] of Object.entries(MOVES)) {
            const shares = await walked(studio, (camera && CAMERAS[camera](scene)) ?? far, move, steps);
            const most = Math.max(...popped(shares));
            worst = Math.max(worst, most);
            const mean = shares.reduce((sum, share) => sum + share) / steps;
            say(`${preset}, ${quality}, ${name}: ${mean.toFixed(1)} % of the pixels change a step, at most ${most.toFixed(2)} % popped`);
          }
        }
      }
    } finally {
      await studio.close();
    }
    if (worst > MOST) throw new Failure(`${worst.toFixed(2)} % of the pixels popped in a step, ${MOST} are allowed`);
  });
}
