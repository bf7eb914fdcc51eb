// A mesh that is no log is refused where it is assigned, in the words of the generator.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { RockFieldError } from '../../www/base/errors.ts';
import { meshOf } from '../../www/wood-ear/log-mesh.ts';
import { resolveColony } from '../../www/wood-ear/request.ts';
import type { WoodEarLogMesh } from '../../www/wood-ear/request.ts';
import { WOOD_EARS } from '../../www/wood-ear/table.ts';

/** A tetrahedron, cm. */
const GOOD = { positions: [0, 0, 0, 100, 0, 0, 0, 50, 0, 0, 0, 50], indices: [0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2] };

/** What is wrong with a mesh, and the error that says so. */
const BAD: Record<string, [mesh: WoodEarLogMesh, name: string, value: number | undefined, min?: number, max?: number]> = {
  'positions not in threes': [{ ...GOOD, positions: [...GOOD.positions, 1] }, 'LogNotInThrees', 13],
  'indices not in threes': [{ ...GOOD, indices: [0, 1] }, 'LogNotInThrees', 2],
  'too many vertices': [{ ...GOOD, positions: new Float32Array(600_003) }, 'LogTooLarge', 200_001, 0, 200_000],
  'too many triangles': [{ ...GOOD, indices: new Uint32Array(1_200_003) }, 'LogTooLarge', 400_001, 0, 400_000],
  'a coordinate that is NaN': [
    { ...GOOD, positions: GOOD.positions.map((c, k) => (k === 4 ? NaN : c)) },
    'LogBadPosition',
    NaN,
    -10_000,
    10_000,
  ],
  'a coordinate that is infinite': [
    { ...GOOD, positions: Float32Array.of(...GOOD.positions, 0, -Infinity, 0) },
    'LogBadPosition',
    -Infinity,
    -10_000,
    10_000,
  ],
  'a log that is far away': [
    { ...GOOD, positions: GOOD.positions.map((c, k) => (k % 3 === 0 ? c + 20_000 : c)) },
    'LogBadPosition',
    20_000,
    -10_000,
    10_000,
  ],
  'an index past the last vertex': [{ ...GOOD, indices: [0, 1, 2, 0, 1, 4] }, 'LogBadIndex', 4, 0, 3],
  'an index without any vertex': [{ positions: [], indices: [0, 0, 0] }, 'LogBadIndex', 0, 0, -1],
  'triangles that are points': [{ ...GOOD, indices: [0, 0, 0, 1, 1, 1] }, 'LogNoArea', undefined],
  'triangles that are lines': [{ positions: [0, 0, 0, 30, 30, 30, 60, 60, 60], indices: [0, 1, 2] }, 'LogNoArea', undefined],
  'no triangle': [{ positions: GOOD.positions, indices: [] }, 'LogNoArea', undefined],
};

/** Indices that no unsigned number is. */
const ODD: [index: number, as: number][] = [
  [-1, -1],
  [1.5, 1.5],
  [NaN, NaN],
  [2 ** 32, 2 ** 32],
];

function refusal(run: () => unknown): RockFieldError {
  try {
    run();
  } catch (thrown) {
    assert.ok(thrown instanceof RockFieldError, String(thrown));
    return thrown;
  }
  throw new assert.AssertionError({ message: 'it was taken' });
}

test('a mesh that cannot be a log is refused where it is assigned, with key, value and bounds', () => {
  for (const [what, [mesh, ...wanted]] of Object.entries(BAD)) {
    const scene = WOOD_EARS.presetParams('fallen-log');
    const { positions, indices } = mesh;
    const ways = [
      () => resolveColony({ log: mesh }),
      () => WOOD_EARS.resolve({ log: mesh }),
      () => WOOD_EARS.resolve({ ...scene, mesh: { positions: Float32Array.from(positions), indices: Uint32Array.from(indices) } }),
    ];
    for (const way of ways) {
      const { key, name, value, min, max } = refusal(way);
      assert.deepEqual([key, name, value, min, max], ['log', ...wanted, ...Array<undefined>(4 - wanted.length).fill(undefined)], what);
    }
  }
  for (const [index, value] of ODD) {
    const error = refusal(() => resolveColony({ log: { ...GOOD, indices: [0, 1, index] } }));
    assert.deepEqual([error.name, error.value, error.min, error.max], ['LogBadIndex', value, 0, 3]);
  }
  assert.equal(resolveColony({ log: GOOD }).mesh?.scale, 1);
});

test('the generator refuses the same meshes in the same words, and takes what is let through', async () => {
  const pkg = new URL('../../pkg/', import.meta.url);
  const glue = (await import(new URL('wood-ear.js', pkg).href)) as {
    default(options: { module_or_path: Uint8Array }): Promise<unknown>;
    WoodEarGenerator: new () => { set_log(positions: Float32Array, indices: Uint32Array): void };
  };
  await glue.default({ module_or_path: readFileSync(new URL('wood-ear_bg.wasm', pkg)) });
  const generator = new glue.WoodEarGenerator();
  for (const [what, [mesh]] of Object.entries(BAD)) {
    const ours = refusal(() => meshOf({ ...mesh }));
    assert.throws(
      () => generator.set_log(Float32Array.from(mesh.positions), Uint32Array.from(mesh.indices)),
      ({ name, message, key, value, min, max }: RockFieldError) => {
        assert.deepEqual([name, message, key], [ours.name, ours.message, ours.key], what);
        const told = [value, min, max].map((n) => (Number.isNaN(n) ? undefined : n));
        assert.deepEqual(
          told,
          [ours.value, ours.min, ours.max].map((n) => (Number.isNaN(n) ? undefined : n)),
          what,
        );
        return true;
      },
    );
  }
  const { positions, indices } = meshOf({ ...GOOD });
  generator.set_log(positions, indices);
});

test('a mesh is scaled by the length of what its triangles use, wherever in it that is', () => {
  // A strip of 3,000 squares that a log's length is found in early, late or never, with and without vertices that nothing uses.
  const strip = (from: number, to: number, unused: number[] = []): WoodEarLogMesh => {
    const positions: number[] = [];
    const indices: number[] = [];
    for (let k = 0; k <= 3_000; k += 1) {
      const x = k < 2_900 ? (from * k) / 2_900 : from + ((to - from) * (k - 2_900)) / 100;
      positions.push(x, 0, 0, x, 0, 1);
      if (k > 0) indices.push(2 * k - 2, 2 * k, 2 * k - 1, 2 * k - 1, 2 * k, 2 * k + 1);
    }
    return { positions: Float32Array.from([...positions, ...unused]), indices: Uint32Array.from(indices) };
  };
  const cases: [WoodEarLogMesh, number][] = [
    [strip(300, 500), 1],
    [strip(10, 19), 200 / 19],
    [strip(10, 25), 1],
    [strip(500, 2_000), 0.1],
    [strip(19, 1_001), 200 / 1_001],
    [strip(10, 19, [500, 0, 0]), 200 / 19],
    [strip(300, 500, [9_000, 0, 0]), 1],
    [strip(300, 500, [0, -9_000, 0]), 1],
    [strip(1, 2, [0, 100, 0]), 100],
  ];
  for (const [mesh, scale] of cases)
    assert.ok(Math.abs(meshOf({ ...mesh }).scale! / scale - 1) < 1e-6, `${meshOf({ ...mesh }).scale} instead of ${scale}`);
});
