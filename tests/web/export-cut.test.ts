// Rocks that are cut off at the ground: what is left of them, and that it is closed where it should be.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { WebIO } from '@gltf-transform/core';
import type { Node } from '@gltf-transform/core';
import validator from 'gltf-validator';
import { exportScene } from 'rock-field/export';
import type { ExportedFile, ExportOptions, FieldRequest } from 'rock-field/export';

const SMALL = { seed: 7, imageWidth: 150, imageHeight: 110 } as const;
const WORN = ['riverbed', 'scree', 'quarry-rubble', 'desert-pavement'] as const;

interface Rock {
  name: string;
  /** In metres from the node, y up; numbers as texts. */
  points: [number, number, number][];
  triangles: [number, number, number][];
  node: Node;
}

async function rocksOf(request: FieldRequest, options: ExportOptions): Promise<Rock[]> {
  const { bytes } = await exportScene(request, options);
  const { issues } = await validator.validateBytes(bytes);
  assert.deepEqual(
    issues.messages.filter(({ severity }) => severity < 2),
    [],
    JSON.stringify(options),
  );
  const nodes = (await new WebIO().readBinary(bytes))
    .getRoot()
    .listNodes()
    .filter((node) => node.getMesh());
  return nodes.map((node) => {
    const [primitive] = node.getMesh()!.listPrimitives();
    const positions = primitive!.getAttribute('POSITION')!;
    const indices = primitive!.getIndices()!.getArray()!;
    return {
      name: node.getName(),
      points: Array.from({ length: positions.getCount() }, (_, v) => positions.getElement<[number, number, number]>(v, [0, 0, 0])),
      triangles: Array.from({ length: indices.length / 3 }, (_, t) => [indices[3 * t]!, indices[3 * t + 1]!, indices[3 * t + 2]!]),
      node,
    };
  });
}

/** The border, as the vertices that follow one another. */
function nextOnBorder({ triangles }: Rock): Map<number, number> {
  const edges = new Set(triangles.flatMap(([a, b, c]) => [`${a} ${b}`, `${b} ${c}`, `${c} ${a}`]));
  const border = [...edges].map((edge) => edge.split(' ').map(Number) as [number, number]).filter(([a, b]) => !edges.has(`${b} ${a}`));
  const next = new Map(border);
  assert.equal(next.size, border.length);
  return next;
}

const heightOf = ({ points }: Rock): number => Math.max(...points.map(([, y]) => y));
/** How high its vertices are that are above the ground, which stay where they are. */
const heightsOf = ({ points }: Rock): number[] => points.map(([, y]) => y).filter((y) => y > 0);
/** How many triangles have no others. */
const countAbove = ({ points, triangles }: Rock): number => triangles.filter((triangle) => triangle.every((v) => points[v]![1] > 0)).length;

test('a cut rock ends at the ground in one closed line, and is above it as it was', async () => {
  let crumbled = 0;
  for (const preset of WORN) {
    const request = { ...SMALL, preset };
    const [kept, cut] = [await rocksOf(request, {}), await rocksOf(request, { belowGround: 'cut' })];
    assert.deepEqual(
      cut.map(({ name }) => name),
      kept.map(({ name }) => name),
    );
    assert.ok(
      kept.some(({ points }) => points.some(([, y]) => y < 0)),
      'there is something to cut',
    );
    for (const [k, rock] of cut.entries()) {
      const whole = kept[k]!;
      const next = nextOnBorder(rock);
      const [start] = next.keys();
      let [count, v] = [0, start!];
      do {
        assert.equal(rock.points[v]![1], 0, `${preset} ${rock.name}`);
        v = next.get(v)!;
        count += 1;
      } while (v !== start);
      assert.equal(count, next.size, `${preset} ${rock.name} has one border`);
      assert.equal(heightOf(rock), heightOf(whole));
      // But for crumbs that are hardly above the ground, and apart from the rock.
      const left = new Set(heightsOf(rock));
      const lost = heightsOf(whole).filter((y) => !left.has(y));
      assert.ok(Math.max(0, ...lost) < 0.01 * heightOf(whole), `${preset} ${rock.name} has lost ${lost.join()}`);
      if (lost.length === 0) assert.equal(countAbove(rock), countAbove(whole), `${preset} ${rock.name}`);
      else crumbled += 1;
      for (const axis of [0, 2] as const) {
        const along = rock.points.map((point) => point[axis]);
        assert.ok(Math.abs(Math.max(...along) + Math.min(...along)) < 1e-5, `${rock.name} stands in the middle of its box`);
      }
    }
  }
  assert.ok(crumbled < 5, `${crumbled} rocks have lost crumbs`);
});

/** What is in a file but for its texts, which say with what options it was written. */
function withoutText({ bytes, name }: ExportedFile): Buffer {
  const begin = name.endsWith('.glb') ? 20 + Buffer.from(bytes).readUInt32LE(12) : 80;
  assert.ok(bytes.length > begin + 1000);
  return Buffer.from(bytes).subarray(begin);
}

test('rocks that end at the ground are not touched', async () => {
  const request = { preset: 'journal-fig1', seed: 7, imageWidth: 400, imageHeight: 300 } as const;
  for (const options of [{}, { solid: true, lods: 3 }, { format: 'stl' }] as const) {
    const [kept, cut] = [await exportScene(request, options), await exportScene(request, { ...options, belowGround: 'cut' })];
    assert.ok(withoutText(kept).equals(withoutText(cut)), JSON.stringify(options));
  }
});

test('closed, cut rocks are flat below, without a hole at any level of detail', async () => {
  const rocks = await rocksOf({ ...SMALL, preset: 'quarry-rubble' }, { belowGround: 'cut', solid: true, lods: 3 });
  for (const rock of rocks) {
    // The bottom has corners of its own.
    const numbers = new Map<string, number>();
    const merged = rock.points.map((point) => {
      const place = point.join();
      if (!numbers.has(place)) numbers.set(place, numbers.size);
      return numbers.get(place)!;
    });
    const triangles = rock.triangles.map((triangle) => triangle.map((v) => merged[v]!) as [number, number, number]);
    assert.equal(nextOnBorder({ ...rock, triangles }).size, 0, rock.name);
    assert.equal(Math.min(...rock.points.map(([, y]) => y)), 0, rock.name);
    const volume = rock.triangles.reduce((sum, triangle) => {
      const [a, b, c] = triangle.map((v) => rock.points[v]!) as Rock['points'];
      const [p, q, r] = [a!, b!, c!];
      return sum + p[0] * (q[1] * r[2] - q[2] * r[1]) - p[1] * (q[0] * r[2] - q[2] * r[0]) + p[2] * (q[0] * r[1] - q[1] * r[0]);
    }, 0);
    assert.ok(volume > 0, rock.name);
  }
});

test('the ground that is cut out around rocks has the corners of their borders', async () => {
  const all = await rocksOf({ ...SMALL, preset: 'moraine' }, { belowGround: 'cut', groundMesh: 'cut' });
  const ground = all.find(({ name }) => name === 'ground')!;
  const near = new Set(
    ground.points.flatMap(([x, , z]) => cellsAround(x + ground.node.getWorldTranslation()[0]!, z + ground.node.getWorldTranslation()[2]!)),
  );
  const [west, south] = [0, 2].map((axis) => Math.max(...ground.points.map((point) => Math.abs(point[axis]!)))) as [number, number];
  let [found, missing] = [0, 0];
  for (const rock of all) {
    if (rock === ground) continue;
    const [x, , z] = rock.node.getWorldTranslation();
    for (const v of nextOnBorder(rock).keys()) {
      const [px, pz] = [rock.points[v]![0] + x!, rock.points[v]![2] + z!];
      // What is outside of the image has no ground, nor what is below another rock.
      if (Math.abs(px) >= west - 1e-4 || Math.abs(pz) >= south - 1e-4) continue;
      if (near.has(cellOf(px, pz))) found += 1;
      else missing += 1;
    }
  }
  assert.ok(found > 1000 && missing < 0.1 * found, `${found} of ${found + missing}`);
});

/** A tenth of a millimetre wide. */
const cellOf = (x: number, z: number): string => `${Math.floor(1e4 * x)} ${Math.floor(1e4 * z)}`;
const cellsAround = (x: number, z: number): string[] => {
  const [column, row] = [Math.floor(1e4 * x), Math.floor(1e4 * z)];
  return [-1, 0, 1].flatMap((i) => [-1, 0, 1].map((j) => `${column + i} ${row + j}`));
};
