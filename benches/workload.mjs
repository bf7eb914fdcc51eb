// What is measured, and how: the same in Node and in a worker of a browser.
//
// Ours is the shipped wasm driven by the shipped session, so slices, cache and copying the buffers out are all included.
import { flatRequest, presetParams } from '../www/rocks/request.ts';
import { fieldSession } from '../www/rocks/session.ts';
import { npmStack } from './npm-stack.mjs';

const WARM_UP = 3;
const MAX_BYTES = 1.5 * 2 ** 30;

/** Radii of Fig. 1, and how often a round runs each side: the short ones are the noisy ones. */
const SIDES = [
  { side: 512, runs: 4 },
  { side: 1024, runs: 2 },
  { side: 2048, runs: 1 },
  { side: 4096, runs: 1 },
  { side: 8192, runs: 1 },
];

/**
 * Everything in turn, `rounds` times, and the medians.
 *
 * `read` gets the address of a wasm file, which lies beside this script's bundle; `say` is told what is going on.
 */
export async function measure({ read, rounds, say }) {
  const open = (name) => openArtefact(name, read);
  say(`Journal Fig. 1 at 1024 × 1024, ${rounds} rounds`);
  const fig1 = await measureFig1(open, rounds);
  say('The same at 512² … 8192²');
  return { fig1, scaling: await measureScaling(open, rounds) };
}

let instances = 0;

/** A new instance of an artefact: its glue and its memory. A glue holds one instance, so it is imported anew. */
async function openArtefact(name, read) {
  const glue = await import(new URL(`./${name}.js?instance=${instances++}`, import.meta.url).href);
  const { memory } = await glue.default({ module_or_path: await read(new URL(`./${name}_bg.wasm`, import.meta.url)) });
  return { glue, memory };
}

async function measureFig1(open, rounds) {
  const { glue } = await open('generator');
  const { glue: bench } = await open('bench');
  const editor = await Editor.open(glue);
  const times = new Samples();
  for (let round = -WARM_UP; round < rounds; round++) {
    const seed = round + WARM_UP;
    const params = fig1(seed);
    const samples = round < 0 ? new Samples() : times;

    const full = await timed(() => generate(glue, params));
    samples.add({ full: full.ms, rocks: full.result.stats.rocks });
    samples.add(prefixed('full', full.result.stats.ms));

    const npm = await timed(() => npmStack(params));
    samples.add({ npm: npm.ms, npmRocks: rocksOf(npm.result) });
    samples.add(prefixed('npm', npm.result.ms));

    samples.add({ shapeEdit: await editor.shapeEdit(1 + 0.01 * seed) });

    const literal = await timed(() => generateLiterally(bench, params));
    samples.add({ literal: literal.ms, literalRocks: rocksOf(literal.result) });

    samples.add({ selectEdit: await editor.selectEdits(1000 + seed) });
  }
  return times.medians();
}

/** Times edits of a field whose stages are in the cache. */
class Editor {
  static async open(glue) {
    const editor = new Editor();
    editor.shapes = fieldSession(new glue.Generator());
    editor.selections = fieldSession(new glue.Generator());
    await editor.shapes.run(request(fig1(0)));
    return editor;
  }

  /** c_h1 and c_w2 of all layers by a factor that was not there before. */
  async shapeEdit(factor) {
    const params = fig1(0);
    for (const { height, taper } of params.layers) {
      height[0] *= factor;
      taper[1] *= factor;
    }
    return (await timed(() => this.shapes.run(request(params)))).ms;
  }

  /** A_s of r = 10 to .20 and to .35, neither of which this seed has seen. */
  async selectEdits(seed) {
    const params = fig1(seed);
    await this.selections.run(request(params));
    const times = [];
    for (const areaFraction of [0.2, 0.35]) {
      params.layers.find(({ radius }) => radius === 10).areaFraction = areaFraction;
      times.push((await timed(() => this.selections.run(request(params)))).ms);
    }
    return times;
  }
}

/** Every side in an instance of its own, so that its memory tells the peak of the first run, output included. */
async function measureScaling(open, rounds) {
  const sides = [];
  for (const { side, runs } of SIDES) {
    const { glue, memory } = await open('generator');
    const { stats } = await generate(glue, fig1(0, side));
    sides.push({ side, runs, glue, rocks: stats.rocks, peakBytes: memory.buffer.byteLength, times: new Samples() });
  }
  for (let round = 0; round < rounds; round++) {
    for (const { side, runs, glue, times } of sides) {
      for (let run = 0; run < runs; run++) {
        const { ms, result } = await timed(() => generate(glue, fig1(1 + round * runs + run, side)));
        times.add({ ms, rocks: result.stats.rocks });
      }
    }
  }
  return sides.map(({ side, peakBytes, times }) => ({ side, ...times.medians(), peakBytes }));
}

function fig1(seed, side = 1024) {
  return { ...presetParams('journal-fig1'), seed, imageWidth: side, imageHeight: side };
}

function request(params) {
  return flatRequest(params, MAX_BYTES);
}

/** A full run with an empty cache. */
async function generate(glue, params) {
  const session = fieldSession(new glue.Generator());
  try {
    return await session.run(request(params));
  } finally {
    session.free();
  }
}

function generateLiterally(glue, params) {
  const field = new glue.Literal(request(params).params);
  const buffers = { positions: field.positions(), indices: field.indices(), rockStarts: field.rock_starts() };
  field.free();
  return buffers;
}

function rocksOf({ rockStarts }) {
  return rockStarts.length - 1;
}

async function timed(work) {
  const start = performance.now();
  const result = await work();
  return { ms: performance.now() - start, result };
}

function prefixed(prefix, values) {
  return Object.fromEntries(Object.entries(values).map(([key, value]) => [`${prefix}.${key}`, value]));
}

/** Numbers by name. */
class Samples {
  #all = new Map();

  /** A number, or several, per name. */
  add(values) {
    for (const [name, value] of Object.entries(values)) {
      if (!this.#all.has(name)) this.#all.set(name, []);
      this.#all.get(name).push(...[value].flat());
    }
  }

  medians() {
    return Object.fromEntries([...this.#all].map(([name, values]) => [name, median(values)]));
  }
}

function median(values) {
  const sorted = values.toSorted((a, b) => a - b);
  const middle = sorted.length >> 1;
  return sorted.length % 2 === 1 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
}
