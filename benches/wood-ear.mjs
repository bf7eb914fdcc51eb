// What a wood-ear colony costs: the shipped wasm in Node, driven step by step as the worker does.
//
//   node benches/wood-ear.mjs [rounds]     on its own; `npm run bench` runs it too
import { readFile } from 'node:fs/promises';
import path from 'node:path';
import { pathToFileURL } from 'node:url';
import { pkg, root } from '../scripts/env.mjs';
import { isMain, main } from '../scripts/run.mjs';

const MAX_BYTES = 1.5 * 2 ** 30;
const STAGES = ['log', 'spawn', 'deform', 'collide', 'mesh'];
/** Individuals at one density: the range and the log's length grow, by numbers that give about so many. */
const GROWTH = [
  { individuals: 100, values: { range: 20, density: 50, logLength: 60, logRadius: 9 } },
  { individuals: 1000, values: { range: 87, density: 50 } },
  { individuals: 5000, values: { range: 200, density: 50, logLength: 400, logRadius: 29 } },
];

/** Medians of `rounds` runs, ms. */
export async function measureWoodEar(rounds) {
  const glue = await import(pathToFileURL(path.join(pkg, 'wood-ear.js')).href);
  await glue.default({ module_or_path: await readFile(path.join(pkg, 'wood-ear_bg.wasm')) });
  const table = await tableOf();
  const flat = (values) => flatOf(table, values);
  const result = { default: {}, maximum: {}, growth: [] };
  for (const [name, values] of [['default', {}], ['maximum', { density: 100, range: 200, size: 3, sizeSpread: 2, logLength: 400 }]]) {
    const count = name === 'default' ? rounds : Math.min(rounds, 3);
    for (const collisions of ['off', 'thesis', 'pressed']) {
      // An edit: the log and who stands where are in the cache.
      const generator = new glue.WoodEarGenerator();
      once(generator, flat({ ...values, collisions }));
      let moisture = 40;
      result[name][collisions] = median(count, () => once(generator, flat({ ...values, collisions, moisture: (moisture += 0.5) })));
      generator.free();
    }
    result[name].fresh = median(count, () => once(new glue.WoodEarGenerator(), flat({ ...values, collisions: 'off' })));
  }
  for (const { individuals, values } of GROWTH) {
    const each = Object.fromEntries(['off', 'thesis', 'pressed'].map((collisions) => [collisions, median(Math.min(rounds, 3), () => once(new glue.WoodEarGenerator(), flat({ ...values, collisions })))]));
    result.growth.push({ individuals, ...each });
  }
  return result;
}

/** One run: ms in all, until there is something to show, by stage, and of the longest step. */
function once(generator, params) {
  const ms = Object.fromEntries(STAGES.map((stage) => [stage, 0]));
  const start = performance.now();
  let preview;
  let longest = 0;
  generator.start(params, MAX_BYTES);
  for (let done = false; !done; ) {
    preview ??= generator.preview_ready() ? performance.now() - start : undefined;
    const stage = STAGES[generator.stage()];
    const before = performance.now();
    done = generator.step();
    const spent = performance.now() - before;
    ms[stage] += spent;
    longest = Math.max(longest, spent);
  }
  const total = performance.now() - start;
  const [individuals, triangles, crossing, , , kept, p10] = generator.summary();
  return { total, preview: preview ?? total, longest, ...ms, individuals, triangles, crossing, kept, p10 };
}

function median(rounds, run) {
  run();
  const runs = Array.from({ length: rounds }, run);
  return Object.fromEntries(Object.keys(runs[0]).map((key) => [key, runs.map((result) => result[key]).sort((a, b) => a - b)[runs.length >> 1]]));
}

/** The parameters' table, whose TypeScript this Node may not read. */
async function tableOf() {
  const { transform } = await import('esbuild');
  const source = await readFile(path.join(root, 'www', 'wood-ear.gen.ts'), 'utf8');
  const { code } = await transform(source, { loader: 'ts', format: 'esm' });
  return import(`data:text/javascript;base64,${Buffer.from(code).toString('base64')}`);
}

/** `[colony rows…, 1, base rows…]` of the default with these values. */
function flatOf({ WOOD_EAR_PARAMS: rows }, values) {
  const value = ({ key, default: standard, kind, choices }) => {
    const given = values[key] ?? standard ?? NaN;
    return kind === 'choice' && typeof given === 'string' ? choices.findIndex((choice) => choice.value === given) : given;
  };
  const of = (scope) => rows.filter((row) => row.scope === scope);
  return Float64Array.from([...of('field').map(value), 1, ...of('base').map((row) => row.default ?? NaN)]);
}

/** For people. */
export function reportWoodEar({ default: usual, maximum, growth }) {
  const ms = (value) => value.toFixed(1).padStart(9);
  const row = (name, run) => `${name.padEnd(24)}${ms(run.total)}${ms(run.preview)}${ms(run.deform)}${ms(run.collide)}${ms(run.mesh)}${ms(run.longest)}${String(run.individuals).padStart(8)}${String(run.crossing).padStart(9)}${run.kept.toFixed(2).padStart(7)}`;
  return [
    'Wood ears (edits of a cached log)  total  preview   deform  collide     mesh  longest  ears  crossing   kept',
    ...Object.entries(usual).map(([name, run]) => row(`default, ${name}`, run)),
    ...Object.entries(maximum).map(([name, run]) => row(`maximum, ${name}`, run)),
    ...growth.flatMap(({ individuals, ...each }) => Object.entries(each).map(([name, run]) => row(`${individuals}, ${name}, fresh`, run))),
  ].join('\n');
}

if (isMain(import.meta)) {
  await main(async () => {
    const rounds = Number(process.argv[2] ?? 5);
    console.log(reportWoodEar(await measureWoodEar(rounds)));
  });
}
