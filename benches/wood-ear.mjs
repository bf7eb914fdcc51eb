// What a wood-ear colony costs: the shipped wasm in Node, driven step by step as the worker does.
//
//   node benches/wood-ear.mjs [rounds]     on its own; `npm run bench` runs it too
import { readFile } from 'node:fs/promises';
import path from 'node:path';
import { pathToFileURL } from 'node:url';
import { pkg, root } from '../scripts/lib/env.mjs';
import { isMain, main } from '../scripts/lib/run.mjs';

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
  for (const [name, values] of [
    ['default', {}],
    ['maximum', { density: 100, range: 200, size: 3, sizeSpread: 2, logLength: 400 }],
  ]) {
    const count = name === 'default' ? rounds : Math.min(rounds, 3);
    for (const collisions of ['off', 'thesis', 'pressed']) {
      // An edit: the log and who stands where are in the cache.
      const generator = new glue.WoodEarGenerator();
      once(generator, flat({ ...values, collisions }));
      let moisture = 40;
      result[name][collisions] = median(count, () => {
        moisture += 0.5;
        return once(generator, flat({ ...values, collisions, moisture }));
      });
      generator.free();
    }
    result[name].fresh = median(count, () => once(new glue.WoodEarGenerator(), flat({ ...values, collisions: 'off' })));
  }
  for (const { individuals, values } of GROWTH) {
    const each = Object.fromEntries(
      ['off', 'thesis', 'pressed'].map((collisions) => [
        collisions,
        median(Math.min(rounds, 3), () => once(new glue.WoodEarGenerator(), flat({ ...values, collisions }))),
      ]),
    );
    result.growth.push({ individuals, ...each });
  }
  result.ownLogs = measureOwnLogs(glue, flat, rounds);
  return result;
}

/** A cylinder like the default's log, of so many vertices, in turn with that log: what a mesh takes over it does not drift with the machine. */
function measureOwnLogs(glue, flat, rounds) {
  const params = flat({ logBark: 0, logBend: 0 });
  return CYLINDERS.map((vertices) => {
    const { positions, indices } = cylinder(vertices);
    const own = () => {
      const generator = new glue.WoodEarGenerator();
      const start = performance.now();
      generator.set_log(positions, indices);
      const read = performance.now() - start;
      const run = once(generator, params);
      generator.free();
      return { ...run, read, total: run.total + read };
    };
    const made = () => {
      const generator = new glue.WoodEarGenerator();
      const run = once(generator, params);
      generator.free();
      return run;
    };
    [own, made].forEach((run) => run());
    const pairs = Array.from({ length: Math.max(rounds, 9) }, () => [made(), own()]);
    const middle = (of) => pairs.map(of).sort((a, b) => a - b)[pairs.length >> 1];
    return {
      vertices: positions.length / 3,
      total: middle(([, run]) => run.total),
      read: middle(([, run]) => run.read),
      times: middle(([of, run]) => run.total / of.total),
      individuals: pairs[0][1].individuals,
      ofMade: pairs[0][0].individuals,
    };
  });
}

const CYLINDERS = [800, 3_200, 12_800, 51_200, 199_811];

/** Closed, along x, 2 m long and of radius 14 cm: squares along the side, a fan at each end. */
function cylinder(vertices) {
  const around = Math.max(6, Math.round(Math.sqrt((vertices * 88) / 200)));
  const rows = Math.floor((vertices - 2) / around);
  const positions = [];
  const indices = [];
  for (let row = 0; row < rows; row++) {
    for (let k = 0; k < around; k++) {
      const angle = (2 * Math.PI * k) / around;
      positions.push((200 * row) / (rows - 1) - 100, 14 * Math.cos(angle), 14 * Math.sin(angle) + 14);
    }
  }
  const at = (row, k) => row * around + (k % around);
  for (let row = 0; row < rows - 1; row++) {
    for (let k = 0; k < around; k++) {
      const [a, b, c, d] = [at(row, k), at(row + 1, k), at(row + 1, k + 1), at(row, k + 1)];
      indices.push(a, c, b, a, d, c);
    }
  }
  const ends = rows * around;
  positions.push(-100, 0, 14, 100, 0, 14);
  for (let k = 0; k < around; k++) indices.push(ends, at(0, k + 1), at(0, k), ends + 1, at(rows - 1, k), at(rows - 1, k + 1));
  return { positions: Float32Array.from(positions), indices: Uint32Array.from(indices) };
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
  return Object.fromEntries(
    Object.keys(runs[0]).map((key) => [key, runs.map((result) => result[key]).sort((a, b) => a - b)[runs.length >> 1]]),
  );
}

/** The parameters' table, whose TypeScript this Node may not read. */
async function tableOf() {
  const { transform } = await import('esbuild');
  const source = await readFile(path.join(root, 'www', 'wood-ear', 'params.gen.ts'), 'utf8');
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
export function reportWoodEar({ default: usual, maximum, growth, ownLogs }) {
  const ms = (value) => value.toFixed(1).padStart(9);
  const row = (name, run) =>
    `${name.padEnd(24)}${ms(run.total)}${ms(run.preview)}${ms(run.deform)}${ms(run.collide)}${ms(run.mesh)}${ms(run.longest)}${String(run.individuals).padStart(8)}${String(run.crossing).padStart(9)}${run.kept.toFixed(2).padStart(7)}`;
  return [
    'Wood ears (edits of a cached log)  total  preview   deform  collide     mesh  longest  ears  crossing   kept',
    ...Object.entries(usual).map(([name, run]) => row(`default, ${name}`, run)),
    ...Object.entries(maximum).map(([name, run]) => row(`maximum, ${name}`, run)),
    ...growth.flatMap(({ individuals, ...each }) => Object.entries(each).map(([name, run]) => row(`${individuals}, ${name}, fresh`, run))),
    "Logs of one's own         total     read  times the made log    ears of the made log",
    ...ownLogs.map(
      (of) =>
        `${`${of.vertices} vertices`.padEnd(24)}${ms(of.total)}${ms(of.read)}${of.times.toFixed(2).padStart(20)}${String(of.individuals).padStart(8)}${String(of.ofMade).padStart(17)}`,
    ),
  ].join('\n');
}

if (isMain(import.meta)) {
  await main(async () => {
    const rounds = Number(process.argv[2] ?? 5);
    console.log(reportWoodEar(await measureWoodEar(rounds)));
  });
}
