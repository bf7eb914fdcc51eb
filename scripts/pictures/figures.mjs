// `npm run figures`: one sheet with every preset of the papers, from above and obliquely, to be looked at beside the
// papers' figures. `-- --out FILE.png` writes elsewhere; `-- --webgl` draws with WebGL2.
import { writeFile } from 'node:fs/promises';
import path from 'node:path';
import { root } from '../lib/env.mjs';
import { isMain, main, say } from '../lib/run.mjs';
import { fromAbove, openStudio, photograph } from './studio.mjs';
import { tables } from '../lib/tables.mjs';

const HEIGHT = 180;
const RATIO = 2;
const PRESETS_PER_ROW = 4;
const VIEWS = [
  { width: HEIGHT, camera: ({ middle, imageHeight }) => fromAbove(middle, 1.04 * imageHeight) },
  {
    width: 300,
    camera: ({ middle, imageHeight }) => ({
      azimuth: (30 * Math.PI) / 180,
      elevation: (35 * Math.PI) / 180,
      distance: 1.46 * imageHeight,
      target: [...middle, 0],
    }),
  },
];

async function shoot({ backend, names, type }) {
  const studio = await openStudio({ backends: [backend], ratio: RATIO });
  try {
    const cells = [];
    for (const preset of names) {
      const scene = await studio.show(backend, { preset });
      const pictures = [];
      for (const { width, camera } of VIEWS) {
        const { png } = await studio.take(backend, { width: RATIO * width, height: RATIO * HEIGHT, camera: camera(scene) });
        pictures.push(png.toString('base64'));
      }
      const caption = `${scene.rocks.toLocaleString('en')} rocks · ${scene.triangles.toLocaleString('en')} triangles`;
      cells.push({ preset, caption, pictures });
      say(`  ${preset}: ${caption}`);
    }
    return await compose(studio.browser, cells, type);
  } finally {
    await studio.close();
  }
}

function compose(browser, cells, type) {
  const figures = cells.map(
    ({ preset, caption, pictures }) => `<figure>${pictures.map((data) => `<img src="data:image/png;base64,${data}" alt="">`).join('')}
      <figcaption><b>${preset}</b> ${caption}</figcaption></figure>`,
  );
  const gap = 12;
  const width = PRESETS_PER_ROW * (VIEWS[0].width + VIEWS[1].width + 2 + gap) + gap;
  const html = `<!doctype html><meta charset="utf-8"><style>
    body { margin: 0; padding: ${gap}px; background: #fff; color: #222; font: 12px/1.3 system-ui, sans-serif }
    main { display: grid; grid-template-columns: repeat(${PRESETS_PER_ROW}, max-content); gap: ${gap}px }
    figure { margin: 0; display: grid; grid-template-columns: max-content max-content; gap: 2px }
    img { height: ${HEIGHT}px; display: block }
    figcaption { grid-column: 1 / -1; white-space: nowrap } b { font-weight: 600; margin-inline-end: .6em }
  </style><main>${figures.join('')}</main>`;
  return photograph(browser, html, { width, type, ...(type === 'jpeg' && { quality: 76 }) });
}

if (isMain(import.meta)) {
  await main(async () => {
    const args = process.argv.slice(2);
    const at = args.indexOf('--out');
    const out = path.resolve(root, at >= 0 ? args[at + 1] : 'www/pictures/figures.jpg');
    const { PRESETS } = await tables();
    const sheet = await shoot({
      backend: args.includes('--webgl') ? 'webgl' : 'webgpu',
      names: PRESETS.filter(({ natural }) => !natural).map(({ name }) => name),
      type: out.endsWith('.png') ? 'png' : 'jpeg',
    });
    await writeFile(out, sheet);
    say(`✓ ${path.relative(root, out)}`);
  });
}
