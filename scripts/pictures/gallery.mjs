// `npm run gallery`: pictures of every natural preset through four cameras, to be looked at, into .cache/gallery/: one sheet for each, and one of all.
//
//   npm run gallery                                    both backends, which have to show the same: else it fails
//   npm run gallery -- --only riverbed,scree --webgpu  some presets, natural or not, with one backend
//   npm run gallery -- --size 800x500 --out DIR        smaller, elsewhere
//   npm run gallery -- --seed 3 --sun 240,12           another field, with the sun elsewhere: azimuth and elevation, degrees
//   npm run gallery -- --cameras low,close             some of the cameras
//   npm run gallery -- --samples 64                    with so many samples of light
//   npm run gallery -- --beside SHORE.png@4 --only riverbed   a render beside a photograph, both 4 metres across; see beside.mjs
import { mkdir, writeFile } from 'node:fs/promises';
import path from 'node:path';
import { pathToFileURL } from 'node:url';
import { parseArgs } from 'node:util';
import { besides } from './beside.mjs';
import { root } from '../lib/env.mjs';
import { meanDifference, readPicture } from '../lib/pixels.mjs';
import { Failure, isMain, main, messageOf, say } from '../lib/run.mjs';
import { fromAbove, openStudio, photograph } from './studio.mjs';
import { tables } from '../lib/tables.mjs';

/** How far the backends may be apart, mean over all pixels and channels, per cent of full scale. */
const MOST_DIFFERENT = 2;
/** The papers' fields, as in the papers and as natural ground. */
const BOTH_STYLES = ['journal-fig1', 'journal-fig12a'];
const NATURAL = { color: 'natural', quality: 'high' };
const WORN = { weathering: 0.6, roughness: 0.3, detail: 30, embedding: 0.15 };
const BACKENDS = ['webgpu', 'webgl'];

export const CAMERAS = {
  framed: () => null,
  low: lowCamera,
  close: closeCamera,
  above: ({ middle, imageWidth }) => fromAbove(middle, 0.7 * imageWidth),
};

/** 12° above the ground, a few of the largest stones in front. */
export function lowCamera({ rock, radius, imageWidth }) {
  const distance = Math.min(0.45 * imageWidth, Math.max(0.2 * imageWidth, 6 * radius));
  return { azimuth: (30 * Math.PI) / 180, elevation: (12 * Math.PI) / 180, distance, target: [...rock, 0.3 * radius] };
}

/** 20 centimetres before one of the largest stones, seen a little from above. */
function closeCamera({ rock, radius, metresPerPixel }) {
  return {
    azimuth: (30 * Math.PI) / 180,
    elevation: (28 * Math.PI) / 180,
    distance: 0.8 * radius + 0.2 / metresPerPixel,
    target: [...rock, 0.2 * radius],
  };
}

async function gallery({ backends, subjects, size, samples, out }) {
  const studio = await openStudio({ backends });
  try {
    const pictures = [];
    for (const subject of subjects) {
      for (const backend of backends) {
        const scene = await studio.show(backend, subject.attributes);
        for (const camera of subject.cameras) {
          const { png, ms } = await studio.take(backend, { ...size, samples, camera: CAMERAS[camera](scene) });
          const name = `${subject.name}-${camera}-${backend}`;
          await writeFile(path.join(out, `${name}.png`), png);
          say(
            `  ${name.padEnd(40)}${ms.toFixed(0).padStart(7)} ms   ${scene.rocks.toLocaleString('en')} rocks · ${scene.triangles.toLocaleString('en')} triangles`,
          );
          pictures.push({ subject: subject.name, camera, backend, file: `${name}.png`, png });
        }
      }
    }
    const differences = compare(pictures);
    await sheets(studio.browser, pictures, differences, { size, out });
    return differences;
  } finally {
    await studio.close();
  }
}

/** Pictures of the same by two backends: `{ subject, camera, percent }`. */
function compare(pictures) {
  const [first, second] = BACKENDS.map((wanted) => pictures.filter(({ backend }) => backend === wanted));
  return first.flatMap(({ subject, camera, png }) => {
    const other = second.find((picture) => picture.subject === subject && picture.camera === camera);
    return other ? [{ subject, camera, percent: meanDifference(readPicture(png), readPicture(other.png)) }] : [];
  });
}

async function sheets(browser, pictures, differences, { size, out }) {
  const rows = [...new Set(pictures.map(({ subject }) => subject))].map((subject) => ({
    subject,
    shown: pictures.filter((picture) => picture.subject === subject),
  }));
  const note = ({ subject, camera }) =>
    differences
      .filter((found) => found.subject === subject && found.camera === camera)
      .map(({ percent }) => ` · ${percent.toFixed(2)} % apart`);
  const all = rows.map(({ subject, shown }) =>
    row(
      subject,
      shown.map((picture) => ({ file: picture.file, text: `${picture.camera}, ${picture.backend}${note(picture)}` })),
    ),
  );
  await sheet(browser, path.join(out, 'index.html'), 'Natural grounds', all, 400);
  // Of one, at full size: two pictures in a row, which are of the same camera where both backends draw.
  for (const { subject, shown } of rows) {
    const text = ({ camera, backend }) => `${camera}, ${backend}`;
    const pairs = Array.from({ length: Math.ceil(shown.length / 2) }, (_, k) => shown.slice(2 * k, 2 * k + 2));
    const figures = pairs.map((pair) =>
      row(
        '',
        pair.map((picture) => ({ file: picture.file, text: text(picture) })),
      ),
    );
    await sheet(browser, path.join(out, `${subject}.html`), subject, figures, size.width);
  }
  const [backend] = new Set(pictures.map((picture) => picture.backend));
  const both = BOTH_STYLES.filter((name) => rows.some(({ subject }) => subject === `${name}-paper`)).map((name) =>
    row(
      name,
      ['paper', 'natural'].map((style) => ({ file: `${name}-${style}-framed-${backend}.png`, text: style })),
    ),
  );
  if (both.length > 0) await sheet(browser, path.join(out, 'styles.html'), 'As in the papers, and as natural ground', both, 900);
}

function row(title, figures) {
  const cells = figures.map(
    ({ file, text }) => `<figure><a href="${file}"><img src="${file}" alt=""></a><figcaption>${text}</figcaption></figure>`,
  );
  return `<h2>${title}</h2><section>${cells.join('')}</section>`;
}

/** Written as a page and, beside it, as a picture of the page. */
async function sheet(browser, file, title, rows, width) {
  const html = `<!doctype html><html lang="en"><meta charset="utf-8"><title>${title}</title><style>
    body { margin: 12px; background: #fff; color: #222; font: 13px/1.4 system-ui, sans-serif }
    h2 { font-size: 15px; margin: 12px 0 4px } section { display: flex; gap: 8px } figure { margin: 0 } img { width: ${width}px; display: block }
  </style>${rows.join('\n')}\n`;
  await writeFile(file, html);
  const columns = Math.max(...rows.map((text) => text.split('<figure>').length - 1));
  await writeFile(file.replace(/html$/, 'png'), await photograph(browser, pathToFileURL(file).href, { width: columns * (width + 8) + 16 }));
}

/** What is shown: natural presets through all cameras, and the papers' in both styles. `look` has further attributes. */
async function chooseSubjects({ only, cameras, look }) {
  const { PRESETS, presetParams } = await tables();
  const natural = PRESETS.filter((preset) => preset.natural).map(({ name }) => name);
  const known = PRESETS.map(({ name }) => name);
  const stranger = only?.find((name) => !known.includes(name));
  if (stranger) throw new Failure(`there is no preset called ${stranger}; there are: ${known.join(', ')}`);
  const worn = (preset) => {
    const { layers } = presetParams(preset);
    return Object.fromEntries(Object.entries(WORN).map(([name, value]) => [name, layers.map(() => value).join(' ')]));
  };
  return (only ?? [...natural, ...BOTH_STYLES]).flatMap((preset) => {
    if (natural.includes(preset)) return [{ name: preset, cameras, attributes: { preset, ...NATURAL, ...look } }];
    return [
      { name: `${preset}-paper`, cameras: ['framed'], attributes: { preset, quality: 'high', color: 'layer', ...look } },
      { name: `${preset}-natural`, cameras, attributes: { preset, ...NATURAL, ...worn(preset), ...look } },
    ];
  });
}

function readArguments() {
  const options = /** @type {const} */ ({
    only: { type: 'string' },
    webgpu: { type: 'boolean' },
    webgl: { type: 'boolean' },
    size: { type: 'string', default: '1600x1000' },
    out: { type: 'string', default: '.cache/gallery' },
    cameras: { type: 'string', default: Object.keys(CAMERAS).join(',') },
    samples: { type: 'string' },
    seed: { type: 'string' },
    sun: { type: 'string' },
    beside: { type: 'string', multiple: true },
  });
  let values, positionals;
  try {
    ({ values, positionals } = parseArgs({ options, allowPositionals: true }));
  } catch (error) {
    throw new Failure(messageOf(error));
  }
  const [width, height] = (/^(\d+)x(\d+)$/.exec(values.size) ?? []).slice(1).map(Number);
  if (!(width > 0 && height > 0)) throw new Failure(`--size takes a size like 1600x1000, not ${values.size}`);
  if (positionals.length > 0 && !values.beside) throw new Failure(`${positionals[0]} is no option`);
  const cameras = values.cameras.split(',');
  const unknown = cameras.find((name) => !(name in CAMERAS));
  if (unknown !== undefined) throw new Failure(`there is no camera called ${unknown}; there are: ${Object.keys(CAMERAS).join(', ')}`);
  const [azimuth, elevation] = (values.sun ?? '').split(',');
  if (values.sun !== undefined && !/^-?[\d.]+,-?[\d.]+$/.test(values.sun))
    throw new Failure(`--sun takes azimuth and elevation in degrees, like 240,12, not ${values.sun}`);
  if (values.samples !== undefined && !/^\d+$/.test(values.samples)) throw new Failure(`--samples takes a number, not ${values.samples}`);
  const look = { ...(values.seed && { seed: values.seed }), ...(values.sun && { 'sun-azimuth': azimuth, 'sun-elevation': elevation }) };
  const asked = BACKENDS.filter((backend) => values[backend]);
  return {
    only: values.only?.split(',').filter(Boolean),
    backends: asked.length > 0 ? asked : BACKENDS,
    size: { width, height },
    cameras,
    samples: values.samples === undefined ? undefined : Number(values.samples),
    look,
    out: path.resolve(root, values.out),
    photos: values.beside && [...values.beside, ...positionals],
  };
}

if (isMain(import.meta)) {
  await main(async () => {
    const { only, photos, backends, size, samples, cameras, look, out } = readArguments();
    await mkdir(out, { recursive: true });
    if (photos) {
      await besides({ photos, presets: only, backend: backends[0], attributes: { ...NATURAL, ...look }, out });
      return;
    }
    const differences = await gallery({ backends, subjects: await chooseSubjects({ only, cameras, look }), size, samples, out });
    for (const { subject, camera, percent } of differences)
      say(`${`${subject}, ${camera}`.padEnd(42)}${percent.toFixed(3).padStart(7)} %${percent > MOST_DIFFERENT ? '   ✗' : ''}`);
    const apart = differences.filter(({ percent }) => percent > MOST_DIFFERENT);
    if (apart.length > 0)
      throw new Failure(`WebGPU and WebGL2 differ by more than ${MOST_DIFFERENT} % in ${apart.length} of ${differences.length} pictures`);
    say(`✓ ${path.join(path.relative(root, out), 'index.html')}`);
  });
}
