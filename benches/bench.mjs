// `npm run bench`: speed, memory and sizes beside two baselines, all in one run so that the ratios hold.
//
//   npm run bench -- --json      one JSON object on stdout (npm's own two lines go away with npm run -s)
//   npm run bench -- --browser   the same in a worker of Chromium instead of Node, and what frames cost
//   npm run bench -- --embed     what an embed makes its visitors wait for, in Chromium
//   npm run bench -- --shaders DIR   nothing is measured: writes the complete WGSL of every pipeline at each quality, for offline compilers
//   npm run bench -- --flow      whether the page answers without a GPU, in plain Chromium; needs an idle machine
//   npm run bench -- --rounds 9  fewer runs of each than the usual 15; medians are of these
import { readFile } from 'node:fs/promises';
import path from 'node:path';
import { pathToFileURL } from 'node:url';
import { parseArgs } from 'node:util';
import { Failure, main, say } from '../scripts/lib/run.mjs';
import { measure as measureSizes } from '../scripts/build/size.mjs';
import { buildBench, folder } from './artefact.mjs';
import { measureFrames, reportFrames } from './frames.mjs';
import { report } from './report.mjs';
import { measureWoodEar, reportWoodEar } from './wood-ear.mjs';

const FIG1 = ['rocks', 'full', 'literal', 'npmRocks', 'npm', 'shapeEdit', 'selectEdit'];

await main(async () => {
  const { json, browser, embed, flow, shaders, rounds } = readArguments();
  if (shaders !== undefined) {
    const { writeShaders } = await import('./shaders.mjs');
    const files = await writeShaders(shaders);
    say(`✓ ${files.length} shaders are in ${shaders}`);
    return;
  }
  if (flow) {
    const { measureFlow, reportFlow } = await import('./flow.mjs');
    const measured = await measureFlow(Math.min(rounds, 3));
    console.log(json ? JSON.stringify(measured) : reportFlow(measured));
    return;
  }
  if (embed) {
    const { measureEmbed, reportEmbed } = await import('./embed.mjs');
    const measured = await measureEmbed(rounds);
    console.log(json ? JSON.stringify(measured) : reportEmbed(measured, rounds));
    return;
  }
  await buildBench();
  const measured = await (browser ? measureInBrowser(rounds) : measureInNode(rounds));
  say('Wood-ear colonies, in Node');
  const woodEar = await measureWoodEar(Math.min(rounds, 5));
  const sizes = await measureSizes();
  const frames = browser ? await measureFrames(rounds, say) : undefined;
  if (json) {
    console.log(JSON.stringify({ ...asJson(measured, sizes), woodEar, frames }));
    return;
  }
  console.log(report({ ...measured, sizes, rounds, engine: browser ? 'Chromium, worker' : `Node ${process.versions.node}` }));
  console.log(`\n${reportWoodEar(woodEar)}`);
  if (frames) console.log(`\n${reportFrames(frames)}`);
});

function readArguments() {
  let values;
  try {
    const options = {
      json: { type: 'boolean' },
      browser: { type: 'boolean' },
      embed: { type: 'boolean' },
      shaders: { type: 'string' },
      flow: { type: 'boolean' },
      rounds: { type: 'string', default: '15' },
    };
    ({ values } = parseArgs({ options }));
  } catch (error) {
    throw new Failure(error.message);
  }
  const rounds = Number(values.rounds);
  if (!Number.isInteger(rounds) || rounds < 1) throw new Failure(`--rounds takes a whole number, not ${values.rounds}`);
  return { ...values, rounds };
}

async function measureInNode(rounds) {
  const { measure } = await import(pathToFileURL(path.join(folder, 'workload.mjs')).href);
  return measure({ read: (url) => readFile(url), rounds, say });
}

async function measureInBrowser(rounds) {
  const { launch } = await import('../tests/e2e/browser.mjs');
  // Isolated pages get a clock of 5 µs instead of 100.
  const isolate = (_request, response) => {
    response.setHeader('Cross-Origin-Opener-Policy', 'same-origin');
    response.setHeader('Cross-Origin-Embedder-Policy', 'require-corp');
    return false;
  };
  const session = await launch({ folder, gpu: false, intercept: isolate });
  try {
    const { page } = await session.open('index.html', { deviceScaleFactor: 1 });
    await page.exposeFunction('say', say);
    return await page.evaluate(runWorker, rounds);
  } finally {
    await session.close();
  }
}

/** Runs in the page. */
function runWorker(rounds) {
  return new Promise((resolve, reject) => {
    const worker = new Worker('worker.mjs', { type: 'module' });
    worker.onmessage = ({ data: { text, result, error } }) => {
      if (text) window.say(text);
      if (result) resolve(result);
      if (error) reject(new Error(error));
    };
    worker.onerror = (event) => reject(new Error(event.message ?? 'the worker could not be started'));
    worker.postMessage({ rounds });
  });
}

function asJson({ fig1, scaling }, sizes) {
  return {
    fig1: Object.fromEntries(FIG1.map((key) => [key, round(fig1[key])])),
    scaling: scaling.map(({ side, rocks, ms, peakBytes }) => ({ side, rocks: round(rocks), ms: round(ms), peakBytes })),
    sizes,
  };
}

function round(value) {
  return Math.round(value * 1000) / 1000;
}
