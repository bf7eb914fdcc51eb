// The ground in the files of rock-field/export: it fills the image between the rocks, and its edges are those of their rims.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { WebIO } from '@gltf-transform/core';
import type { Document, Node } from '@gltf-transform/core';
import validator from 'gltf-validator';
import { generate } from 'rock-field/core';
import { exportScene, exportWoodEar, RockFieldError } from 'rock-field/export';
import type { ExportOptions } from 'rock-field/export';
import { GROUND_KINDS } from '../../www/data/palette.gen.ts';
import { OPTIONS, TARGETS } from '../../www/export/options.ts';

type Point = [number, number, number];

const SIZE = { imageWidth: 150, imageHeight: 120 };
const METRES_PER_PIXEL = 0.01;
/** The papers' rocks, of one size and with gaps. */
const ONE_SIZE = { preset: 'journal-fig1', seed: 5, ...SIZE, layers: [{ radius: 12, areaFraction: 0.6 }] } as const;

const read = (bytes: Uint8Array): Promise<Document> => new WebIO().readBinary(bytes);

function nodeOf(document: Document, name: string): Node {
  const found = document
    .getRoot()
    .listNodes()
    .filter((node) => node.getName() === name);
  assert.equal(found.length, 1, `${found.length} nodes are called ${name}`);
  return found[0]!;
}

/** The triangles of a node, in metres about the middle of the file. */
function trianglesOf(node: Node): Point[][] {
  const [x, y, z] = node.getWorldTranslation();
  return node
    .getMesh()!
    .listPrimitives()
    .flatMap((primitive) => {
      const positions = primitive.getAttribute('POSITION')!;
      const corners = Array.from(primitive.getIndices()!.getArray()!, (index: number) => {
        const [px, py, pz] = positions.getElement<Point>(index, [0, 0, 0]);
        return [px + x, py + y, pz + z] as Point;
      });
      return Array.from({ length: corners.length / 3 }, (_, t) => corners.slice(3 * t, 3 * t + 3));
    });
}

test('between rocks of one size, rocks and ground are one sheet: every edge has two triangles, but those of the border', async () => {
  const document = await read((await exportScene(ONE_SIZE, { mesh: 'one', groundMesh: 'cut' })).bytes);
  const edges = new Map<string, number>();
  const isAtBorder = ([x, , z]: Point): boolean => Math.abs(x) === Math.fround(0.75) || Math.abs(z) === Math.fround(0.6);
  let all = 0;
  for (const name of ['layer-1', 'ground']) {
    for (const corners of trianglesOf(nodeOf(document, name))) {
      all += 1;
      for (let k = 0; k < 3; k++) {
        const [from, to] = [corners[k]!, corners[(k + 1) % 3]!];
        const [key, sign] = from.join() < to.join() ? [`${from} ${to}`, 1] : [`${to} ${from}`, -1];
        if (isAtBorder(from) && isAtBorder(to)) continue;
        edges.set(key, (edges.get(key) ?? 0) + sign);
      }
    }
  }
  assert.ok(all > 500, `${all} triangles`);
  assert.deepEqual([...edges].filter(([, sum]) => sum !== 0).slice(0, 3), [], 'edges that meet no other');
});

test('the ground lies at height 0, faces up, covers what its extras say, and has the colour of its kind', async () => {
  for (const [request, kind] of [
    [{ preset: 'riverbed', ...SIZE }, undefined],
    [{ preset: 'desert-pavement', ...SIZE }, undefined],
    [ONE_SIZE, 'ground'],
  ] as const) {
    for (const groundMesh of ['cut', 'whole'] as const) {
      const { bytes, report } = await exportScene(request, { groundMesh });
      const without = await exportScene(request);
      const node = nodeOf(await read(bytes), 'ground');
      const { area, size, material } = node.getExtras() as { area: number; size: Point; material: string };
      assert.deepEqual(size, [1.5, 0, 1.2]);
      const triangles = trianglesOf(node);
      assert.equal(report.triangles, without.report.triangles + triangles.length);
      assert.deepEqual([report.objects, report.meshes], [without.report.objects + 1, without.report.meshes + 1]);
      let twice = 0;
      for (const [a, b, c] of triangles as [Point, Point, Point][]) {
        assert.ok([a, b, c].every(([, y]) => y === 0));
        twice += (b[2] - a[2]) * (c[0] - a[0]) - (b[0] - a[0]) * (c[2] - a[2]);
      }
      assert.ok(Math.abs(twice / 2 - area) < 1e-3 * area, `${twice / 2} m² instead of ${area}`);
      if (groundMesh === 'whole') assert.equal(area, 1.8);
      const [primitive] = node.getMesh()!.listPrimitives();
      const normals = Array.from(primitive!.getAttribute('NORMAL')!.getArray()!);
      assert.ok(normals.every((value, k) => value === (k % 3 === 1 ? 1 : 0)));
      assert.deepEqual([primitive!.getMaterial()!.getName(), material], [kind ?? material, kind ?? material]);
      const natural = GROUND_KINDS.find(({ name }) => name === material);
      assert.equal(natural === undefined, kind === 'ground');
      if (natural) assert.deepEqual(primitive!.getMaterial()!.getBaseColorFactor(), [...natural.albedo, 1]);
    }
  }
});

test('seen from above, each place shows ground or is in the footprint of a rock', async () => {
  const request = { preset: 'scree', seed: 3, ...SIZE } as const;
  const field = await generate(request);
  const triangles = trianglesOf(nodeOf(await read((await exportScene(request, { groundMesh: 'cut' })).bytes), 'ground'));
  const rocks = Array.from(field.rockLayer, (_, rock) => sectionOf(field, rock));
  let open = 0;
  for (let column = 0; column < 60; column++) {
    for (let row = 0; row < 48; row++) {
      // Not on a vertex or border of anything.
      const [x, y] = [2.5 * column + 1.2345, 2.5 * row + 1.1119];
      const [east, south] = [METRES_PER_PIXEL * (x - 75), METRES_PER_PIXEL * (60 - y)];
      const found = triangles.filter((corners) =>
        isAround(
          corners.map((a, k) => [a, corners[(k + 1) % 3]!].map((at) => [at[0], at[2]] as const)),
          east,
          south,
        ),
      );
      const isCovered = rocks.some((segments) => isAround(segments, x, y));
      assert.equal(found.length, isCovered ? 0 : 1, `at (${x}, ${y})`);
      open += found.length;
    }
  }
  assert.ok(open > 100 && open < 2780, `${open} places of 2880 show ground`);
});

type Segment = (readonly [number, number])[];

/** Where the surface of a rock, closed by the fan under its rim, goes through the ground. */
function sectionOf({ positions, indices, rockStarts, vertexStarts }: Awaited<ReturnType<typeof generate>>, rock: number): Segment[] {
  const [first, last] = [vertexStarts[rock]!, vertexStarts[rock + 1]!];
  const own = indices.subarray(rockStarts[rock], rockStarts[rock + 1]);
  const rim = 2 * (last - first) - own.length / 3 - 2;
  const at = (v: number): Point => [positions[3 * v]!, positions[3 * v + 1]!, positions[3 * v + 2]!];
  const faces = Array.from({ length: own.length / 3 }, (_, t) => [0, 1, 2].map((k) => at(own[3 * t + k]!)));
  // A wall down from the rim: what stands on the ground with its rim has its section there.
  for (let v = 0; v < rim; v++) {
    const [a, b] = [at(first + v), at(first + ((v + 1) % rim))];
    const [c, d]: Point[] = [
      [a[0], a[1], a[2] - 1e6],
      [b[0], b[1], b[2] - 1e6],
    ];
    faces.push([a, c!, b], [b, c!, d!]);
  }
  return faces.flatMap((corners) => {
    const crossing = corners.flatMap((a, k) => {
      const b = corners[(k + 1) % 3]!;
      if (a[2]! >= 0 === b[2]! >= 0) return [];
      const share = a[2]! / (a[2]! - b[2]!);
      return [{ down: a[2]! >= 0, at: [a[0]! + share * (b[0]! - a[0]!), a[1]! + share * (b[1]! - a[1]!)] as const }];
    });
    if (crossing.length !== 2) return [];
    return [crossing.sort((a, b) => Number(b.down) - Number(a.down)).map((end) => end.at)];
  });
}

/** Whether segments that close go around a point. */
function isAround(segments: Segment[], x: number, y: number): boolean {
  let turns = 0;
  for (const [[ax, ay], [bx, by]] of segments as [Segment[number], Segment[number]][]) {
    if (ay <= y === by <= y) continue;
    if (ax + ((bx - ax) * (y - ay)) / (by - ay) < x) turns += ay <= y ? 1 : -1;
  }
  return turns !== 0;
}

test('with the ground, files of every target, mesh form and format are valid and equal from call to call', async () => {
  for (const [t, target] of (Object.keys(TARGETS) as (keyof typeof TARGETS)[]).entries()) {
    const mesh = OPTIONS.mesh.choices[t % 3]!;
    const options: ExportOptions = {
      target,
      format: 'glb',
      mesh,
      groundMesh: mesh === 'kit' ? 'whole' : 'cut',
      instancing: t % 2 === 0,
      lods: 1 + (t % 3),
    };
    const request = { preset: 'forest-floor', seed: t, ...SIZE } as const;
    const [{ bytes }, again] = [await exportScene(request, options), await exportScene(request, options)];
    assert.deepEqual(Buffer.from(bytes), Buffer.from(again.bytes));
    const { issues } = await validator.validateBytes(bytes);
    assert.deepEqual(
      issues.messages.filter(({ severity }) => severity < 2).map(({ message }) => message),
      [],
      JSON.stringify(options),
    );
  }
  const request = { preset: 'scree', seed: 1, ...SIZE } as const;
  const glb = await exportScene(request, { mesh: 'one', groundMesh: 'cut' });
  for (const format of ['obj', 'stl', 'ply'] as const) {
    const { bytes, report } = await exportScene(request, { format, groundMesh: 'cut' });
    assert.equal(report.triangles, glb.report.triangles);
    if (format === 'obj') assert.match(new TextDecoder().decode(bytes), /\no ground\n(g ground\n)?/);
  }
});

test('what does not go with the ground is refused or said', async () => {
  await assert.rejects(exportScene({ seed: -1 }, { mesh: 'kit', groundMesh: 'cut' }), (error: RockFieldError) => {
    assert.deepEqual([error.name, error.key, error.value], ['ExportImpossible', 'groundMesh', 'cut']);
    return error instanceof RockFieldError;
  });
  const { report } = await exportScene({ preset: 'scree', ...SIZE }, { target: 'print', groundMesh: 'whole' });
  assert.ok(report.notes.some(({ code }) => code === 'ground-is-open'));
});

test('a field without rocks is two triangles of ground, and a log lies on it', async () => {
  for (const groundMesh of ['cut', 'whole'] as const) {
    const { report } = await exportScene({ ...SIZE, layers: [] }, { groundMesh });
    assert.deepEqual([report.triangles, report.vertices, report.objects], [2, 4, 1]);
  }
  const request = { preset: 'thesis-fig4-8', ground: '' } as const;
  const [plain, { bytes, report }] = [await exportWoodEar(request), await exportWoodEar(request, { groundMesh: 'cut' })];
  assert.equal(report.triangles, plain.report.triangles + 2);
  const document = await read(bytes);
  assert.ok(
    trianglesOf(nodeOf(document, 'ground'))
      .flat()
      .every(([, y]) => Math.abs(y) < 1e-6),
  );
});
