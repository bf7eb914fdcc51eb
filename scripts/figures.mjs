// `npm run figures`: one sheet with every preset of the papers, from above and obliquely, to be looked at beside the
// papers' figures. `-- --out FILE.png` writes elsewhere; `-- --webgl` draws with WebGL2.
import { writeFile } from 'node:fs/promises';
import path from 'node:path';
import { launch } from '../tests/e2e/browser.mjs';
import { root } from './env.mjs';
import { isMain, main, say } from './run.mjs';

const HEIGHT = 180;
const PRESETS_PER_ROW = 4;
/** Half the height of the picture at the target, over the distance: tan(18°), as in www/camera.ts. */
const TAN = Math.tan(Math.PI / 10);
/** Every preset is 1024 px wide and deep. */
const SIDE = 1024;
const VIEWS = [
  { width: HEIGHT, camera: { azimuth: 0, elevation: Math.PI / 2, distance: (1.04 * SIDE) / 2 / TAN } },
  { width: 300, camera: { azimuth: (30 * Math.PI) / 180, elevation: (35 * Math.PI) / 180, distance: 1.46 * SIDE } },
];

/** A page of nothing but the element. */
const STUDIO = `<!doctype html><meta charset="utf-8"><title>figures</title><link rel="icon" href="data:,">
<style>body { margin: 0 } rock-field { width: 100vw; height: 100vh }</style>
<script type="module" src="./rock-field.js"></script><rock-field preset="journal-fig1" theme="light"></rock-field>`;

/** Sets a preset and a camera and waits until it is painted. */
async function pose({ preset, camera }) {
  const element = document.querySelector('rock-field');
  await customElements.whenDefined('rock-field');
  await element.ready;
  if (element.getAttribute('preset') !== preset) element.setAttribute('preset', preset);
  await new Promise((resolve) => setTimeout(resolve));
  const { imageWidth, imageHeight, stats } = await element.getField();
  element.camera = { ...camera, target: [imageWidth / 2, imageHeight / 2, 0] };
  for (let frame = 0; frame < 3; frame += 1) await new Promise((resolve) => requestAnimationFrame(resolve));
  return `${stats.rocks.toLocaleString('en')} rocks · ${stats.triangles.toLocaleString('en')} triangles`;
}

async function shoot({ webgpu, names, type, onPicture }) {
  const intercept = (request, response) => {
    if (!request.url.startsWith('/studio.html')) return false;
    response.writeHead(200, { 'content-type': 'text/html' }).end(STUDIO);
    return true;
  };
  const session = await launch({ webgpu, intercept });
  try {
    const { page, errors } = await session.open('studio.html', { viewport: { width: HEIGHT, height: HEIGHT }, deviceScaleFactor: 2, colorScheme: 'light' });
    const cells = [];
    for (const preset of names) {
      const pictures = [];
      let caption = '';
      for (const { width, camera } of VIEWS) {
        await page.setViewportSize({ width, height: HEIGHT });
        caption = await page.evaluate(pose, { preset, camera });
        pictures.push((await page.screenshot({ type: 'png' })).toString('base64'));
      }
      cells.push({ preset, caption, pictures });
      onPicture(preset, caption);
    }
    if (errors.length > 0) throw new Error(errors.join('\n'));
    return await compose(session, cells, type);
  } finally {
    await session.close();
  }
}

async function compose(session, cells, type) {
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
  const context = await session.browser.newContext({ viewport: { width, height: 800 } });
  const page = await context.newPage();
  await page.setContent(html, { waitUntil: 'load' });
  return page.screenshot({ fullPage: true, type, ...(type === 'jpeg' ? { quality: 76 } : {}) });
}

if (isMain(import.meta)) {
  await main(async () => {
    const args = process.argv.slice(2);
    const at = args.indexOf('--out');
    const out = path.resolve(root, at >= 0 ? args[at + 1] : 'www/pictures/figures.jpg');
    const { presets } = await import(new URL('../dist/core.node.js', import.meta.url));
    const names = Object.keys(presets);
    const sheet = await shoot({
      webgpu: !args.includes('--webgl'),
      names,
      type: out.endsWith('.png') ? 'png' : 'jpeg',
      onPicture: (preset, caption) => say(`  ${preset}: ${caption}`),
    });
    await writeFile(out, sheet);
    say(`✓ ${path.relative(root, out)}`);
  });
}
