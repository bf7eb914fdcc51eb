// The bench's numbers as a text for people, each beside what the project promises.
import { BUDGETS } from '../scripts/build/size.mjs';

const PEAK_SIDE = 4096;
const PEAK_LIMIT = 96 * 2 ** 20;

export function report({ fig1, scaling, sizes, engine, rounds }) {
  return [...speed(fig1, engine, rounds), '', ...growth(scaling), '', ...weight(sizes)].join('\n');
}

function speed(fig1, engine, rounds) {
  const perThousand = (ms, rocks) => (1000 * ms) / rocks;
  const npm = perThousand(fig1.npm, fig1.npmRocks);
  // Per rock; an edit stands for the whole field it shows.
  const ratio = (ms) => npm / perThousand(ms, fig1.rocks);
  const row = (name, ms, rocks, note = '') =>
    `${name.padEnd(24)}${fixed(ms, 2, 9)}${fixed(rocks, 0, 8)}${fixed(perThousand(ms, rocks), 2, 11)}   ${note}`.trimEnd();
  const stages = (prefix) => {
    const shares = Object.entries(fig1).filter(([name]) => name.startsWith(`${prefix}.`) && name !== `${prefix}.total`);
    return `  ${shares.map(([name, ms]) => `${name.slice(prefix.length + 1)} ${ms.toFixed(1)}`).join(' · ')}`;
  };
  return [
    `Journal Fig. 1, 1024 × 1024, medians of ${rounds} (${engine})`,
    `${'per rock, times npm'.padEnd(24)}       ms   rocks   ms/1,000`,
    row('full run', fig1.full, fig1.rocks, versus(ratio(fig1.full), 7, '10 wanted')),
    stages('full'),
    row('npm packages', fig1.npm, fig1.npmRocks),
    stages('npm'),
    row(
      "papers' literal loops",
      fig1.literal,
      fig1.literalRocks,
      `a full run is ${(perThousand(fig1.literal, fig1.literalRocks) / perThousand(fig1.full, fig1.rocks)).toFixed(1)}× faster`,
    ),
    row('edit of c_w or c_h', fig1.shapeEdit, fig1.rocks, versus(ratio(fig1.shapeEdit), 25)),
    row('edit of the finest A_s', fig1.selectEdit, fig1.rocks, versus(ratio(fig1.selectEdit), 10)),
  ];
}

function growth(scaling) {
  const per = scaling.map(({ ms, rocks }) => (1000 * ms) / rocks);
  const spread = Math.max(...per) / Math.min(...per);
  const rows = scaling.map(({ side, rocks, ms, peakBytes }, k) => {
    const peak = side === PEAK_SIDE ? verdict(peakBytes <= PEAK_LIMIT, `at most ${PEAK_LIMIT / 2 ** 20}`) : '';
    return `${`${side}²`.padEnd(24)}${fixed(ms, 1, 9)}${fixed(rocks, 0, 8)}${fixed(per[k], 2, 11)}${fixed(peakBytes / 2 ** 20, 1, 10)}   ${peak}`.trimEnd();
  });
  return [
    `${'Growth, same radii'.padEnd(24)}       ms   rocks   ms/1,000  peak MiB`,
    ...rows,
    `slowest ÷ fastest per rock: ${spread.toFixed(2)}   ${verdict(spread <= 1.5, 'at most 1.5, 1.2 wanted')}`,
  ];
}

function weight(sizes) {
  const rows = Object.entries(BUDGETS).map(([name, budget]) => {
    const kB = (bytes) => (bytes / 1000).toFixed(1);
    return `${name.padEnd(24)}${kB(sizes[name]).padStart(9)}   ${verdict(sizes[name] <= budget, `at most ${kB(budget)}`)}`;
  });
  return ['Sizes after brotli, kB', ...rows];
}

function versus(ratio, least, wish) {
  return `${ratio.toFixed(1)}×   ${verdict(ratio >= least, `at least ${least}${wish ? `, ${wish}` : ''}`)}`;
}

function verdict(isMet, target) {
  return `${isMet ? '✓' : '✗ MISSED:'} ${target}`;
}

function fixed(value, digits, width) {
  return value.toFixed(digits).padStart(width);
}
