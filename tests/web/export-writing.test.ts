// How files are written: numbers as bytes, in slices between which a caller hears of it and can call it off.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { TestContext } from 'node:test';
import { exportScene } from 'rock-field/export';
import type { ExportOptions } from 'rock-field/export';
import { ByteWriter } from '../../www/export/formats/byte-writer.ts';
import { rounded } from '../../www/export/formats/significant.ts';

const REQUEST = { preset: 'journal-fig1', seed: 3, imageWidth: 150, imageHeight: 100 } as const;

/** Between 0 and 1, the same each time. */
function randomly(seed: number): () => number {
  let state = seed;
  return () => {
    state = (Math.imul(state, 1_664_525) + 1_013_904_223) >>> 0;
    return state / 2 ** 32;
  };
}

/** Numbers of all sizes, among them those between two roundings, and those that are rounded up to a power of ten. */
function* numbers(): Generator<number> {
  const random = randomly(1);
  yield* [
    0, -0, 1, -1, 10, 0.1, 1e-6, 9.999_999_999e-7, 1e-7, 1e9, 123_456_789, 5e-324, 1.7e308, 999_999.999_99, 9_999_999.7, 0.000_012_345,
  ];
  for (let k = 0; k < 20_000; k++) {
    const sized = (random() - 0.5) * 10 ** Math.round(40 * random() - 25);
    yield sized;
    yield Math.fround(sized);
    yield Math.round(sized * 1000) / 2000;
    yield 10 ** Math.round(12 * random() - 8) * (1 - 10 ** -Math.round(12 * random()));
  }
}

test('a number with so many significant digits is written as JSON has it', () => {
  for (const digits of [4, 7, 9]) {
    for (const value of numbers()) {
      const out = new ByteWriter();
      out.significant(value, digits);
      const expected = Number(value.toPrecision(digits));
      assert.equal(new TextDecoder().decode(out.bytes()), JSON.stringify(expected), `${value} with ${digits} digits`);
      assert.ok(Object.is(rounded(value, digits), expected), `${value} with ${digits} digits`);
    }
  }
});

test('nine digits bring every 32-bit float back', () => {
  for (const value of numbers()) {
    const out = new ByteWriter();
    const float = Math.fround(value);
    if (!Number.isFinite(float)) continue;
    out.significant(float, 9);
    assert.equal(Math.fround(Number(new TextDecoder().decode(out.bytes()))), float === 0 ? 0 : float);
  }
});

test('texts of all lengths and letters are written as UTF-8, and moved as a whole', () => {
  const texts = ['', 'a'.repeat(1e5), '岩', `${'b'.repeat(255)}é`, 'c'.repeat(256), '"\\\n', 'd'];
  const out = new ByteWriter();
  for (const text of texts) out.text(text);
  for (const text of texts) out.quoted(text);
  const expected = Buffer.from(texts.join('') + texts.map((text) => JSON.stringify(text)).join(''));
  assert.equal(out.length, expected.length);
  const to = new Uint8Array(expected.length + 5);
  assert.equal(out.moveTo(to, 5), to.length);
  assert.ok(expected.equals(to.subarray(5)));
  assert.equal(out.length, 0);
});

/** A clock by which every slice is over as soon as it has begun. */
function hurry({ mock }: TestContext): void {
  let now = 0;
  mock.method(performance, 'now', () => (now += 100));
}

const WRITTEN_IN_SLICES: ExportOptions[] = [
  {},
  { mesh: 'kit' },
  { mesh: 'one' },
  { format: 'obj' },
  { format: 'obj', lods: 2 },
  { format: 'stl' },
  { format: 'ply' },
  { format: 'csv' },
  { format: 'ply', mesh: 'points' },
  { format: 'zip', side: 64 },
];

test('progress goes on while a file is written, and the file is the same', async (context) => {
  for (const options of WRITTEN_IN_SLICES) {
    const calm = await exportScene(REQUEST, options);
    hurry(context);
    const told: [string, number][] = [];
    const { bytes } = await exportScene(REQUEST, options, { onProgress: ({ stage, fraction }) => told.push([stage, fraction]) });
    context.mock.restoreAll();
    assert.ok(Buffer.from(bytes).equals(Buffer.from(calm.bytes)));
    const stages = told.map(([stage]) => stage);
    assert.ok(stages.slice(stages.indexOf('file')).every((stage) => stage === 'file') && stages.at(-1) === 'file', stages.join());
    const fractions = told.map(([, fraction]) => fraction);
    assert.deepEqual(
      fractions,
      [...fractions].sort((a, b) => a - b),
      JSON.stringify(options),
    );
    assert.ok(fractions.at(-1)! <= 1 && fractions.at(-1)! > 0.9, `${JSON.stringify(options)} ends at ${fractions.at(-1)}`);
  }
});

test('a file can be called off while it is written', async (context) => {
  hurry(context);
  for (const options of WRITTEN_IN_SLICES) {
    const calling = new AbortController();
    const reason = new Error('enough');
    const run = {
      signal: calling.signal,
      onProgress: ({ stage }: { stage: string }) => {
        // Not in it: by whoever has a turn between the slices.
        if (stage === 'file') setImmediate(() => calling.abort(reason));
      },
    };
    await assert.rejects(exportScene(REQUEST, options, run), reason, JSON.stringify(options));
  }
});
