// `npm run bench -- --browser`: what a frame of natural colours costs, on both backends. The GPU is software here: real ones are faster by
// much, and what is dear on the one is mostly so on the other.
import { launch } from '../tests/e2e/browser.mjs';
import { folder } from './artefact.mjs';

/** Little, since a frame of a software GPU takes seconds otherwise; they differ little from each other. */
const SCENE = { preset: 'riverbed', side: 320, width: 320, height: 200 };
const MOST_ROUNDS = 3;

const ROWS = {
  low: 'whole frame, low',
  medium: 'whole frame, medium',
  high: 'whole frame, high',
  stones: 'stones alone, from above, high',
  ground: 'ground alone, beside the field, high',
  maps: 'shadow and height map, when the sun moves',
};

/** `{ webgpu, webgl }`, ms by row. */
export async function measureFrames(rounds, say) {
  const session = await launch({ webgpu: true, folder });
  try {
    const measured = {};
    for (const backend of ['webgpu', 'webgl']) {
      say(`Frames of ${SCENE.preset}, ${backend}`);
      const { page, close } = await session.open('index.html', { deviceScaleFactor: 1 });
      await page.addScriptTag({ url: 'frames-page.mjs', type: 'module' });
      measured[backend] = await page.evaluate((scene) => globalThis.measureFrames(scene), {
        ...SCENE,
        backend,
        rounds: Math.min(rounds, MOST_ROUNDS),
      });
      await close();
    }
    return measured;
  } finally {
    await session.close();
  }
}

export function reportFrames({ webgpu, webgl }) {
  const title = `Frames of ${SCENE.preset}, ${SCENE.width} × ${SCENE.height}`;
  const rows = Object.entries(ROWS).map(
    ([name, text]) => `${text.padEnd(44)}${webgpu[name].toFixed(0).padStart(9)}${webgl[name].toFixed(0).padStart(9)}`,
  );
  return [`${title.padEnd(44)}   WebGPU   WebGL2   ms, software GPU, ${webgpu.triangles.toLocaleString('en')} triangles`, ...rows].join(
    '\n',
  );
}
