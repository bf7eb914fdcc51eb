// Levels of detail, hulls and colours of vertices: what is in the files, read back.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { WebIO } from '@gltf-transform/core';
import type { Document, Mesh, Node, Primitive } from '@gltf-transform/core';
import validator from 'gltf-validator';
import { MeshoptDecoder } from 'meshoptimizer/decoder';
import { exportScene } from 'rock-field/export';
import type { ExportOptions, RockFieldError } from 'rock-field/export';
import { hullOf } from '../../www/export/shapes/hull.ts';
import { resolveOptions } from '../../www/export/options.ts';

type Point = [number, number, number];

const REQUEST = { preset: 'riverbed', seed: 7, imageWidth: 120, imageHeight: 90 } as const;

const read = (bytes: Uint8Array): Promise<Document> => new WebIO().readBinary(bytes);
const nodesOf = (document: Document): Node[] =>
  document
    .getRoot()
    .listNodes()
    .filter((node) => node.getMesh());

function only(mesh: Mesh): Primitive {
  const primitives = mesh.listPrimitives();
  assert.equal(primitives.length, 1, mesh.getName());
  return primitives[0]!;
}

function pointsOf(primitive: Primitive): Point[] {
  const positions = primitive.getAttribute('POSITION')!;
  return Array.from({ length: positions.getCount() }, (_, v) => positions.getElement<Point>(v, [0, 0, 0]));
}

const cornersOf = (primitive: Primitive): number[] => [...primitive.getIndices()!.getArray()!];

/** The directed edges that have no triangle on their other side, as places; no edge may have two on one side. */
function borderOf(primitive: Primitive): string[] {
  const points = pointsOf(primitive).map(String);
  const corners = cornersOf(primitive).map((v) => points[v]!);
  const edges = new Set<string>();
  for (let k = 0; k < corners.length; k++) {
    const edge = `${corners[k]} → ${corners[k % 3 === 2 ? k - 2 : k + 1]}`;
    assert.ok(!edges.has(edge), `two triangles on one side of ${edge}`);
    edges.add(edge);
  }
  return [...edges].filter((edge) => !edges.has(edge.split(' → ').reverse().join(' → '))).sort();
}

/** Six times the volume inside. */
function volumeOf(primitive: Primitive): number {
  const points = pointsOf(primitive);
  const corners = cornersOf(primitive);
  let volume = 0;
  for (let i = 0; i < corners.length; i += 3) {
    const [a, b, c] = [points[corners[i]!]!, points[corners[i + 1]!]!, points[corners[i + 2]!]!];
    volume += a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return volume;
}

/** Objects by name, each with its levels, the finest first. */
function levelsIn(nodes: readonly Node[]): Map<string, Node[]> {
  const objects = new Map<string, Node[]>();
  for (const node of nodes) {
    const [, name, level] = /^(.*)_LOD(\d)$/.exec(node.getName())!;
    const levels = objects.get(name!) ?? [];
    assert.equal(levels.length, Number(level), node.getName());
    objects.set(name!, [...levels, node]);
  }
  return objects;
}

const trianglesOf = (node: Node): number => only(node.getMesh()!).getIndices()!.getCount() / 3;

async function assertValid(bytes: Uint8Array, options: ExportOptions): Promise<void> {
  const { issues } = await validator.validateBytes(bytes);
  const found = issues.messages.filter(({ severity }) => severity < 2).map(({ message }) => message);
  assert.deepEqual(found, [], JSON.stringify(options));
}

test('every level of a rock has at most as many triangles as the one before, on the same rim, at the same place', async () => {
  for (const solid of [false, true]) {
    const options = { lods: 4, solid };
    const { bytes, report } = await exportScene(REQUEST, options);
    await assertValid(bytes, options);
    const objects = levelsIn(nodesOf(await read(bytes)));
    assert.equal(objects.size, report.objects);
    const sums = [0, 0, 0, 0];
    for (const [name, levels] of objects) {
      assert.equal(levels.length, 4, name);
      const [finest] = levels as [Node];
      const border = borderOf(only(finest.getMesh()!));
      assert.equal(border.length === 0, solid, name);
      for (const [level, node] of levels.entries()) {
        assert.deepEqual(node.getTranslation(), finest.getTranslation());
        assert.equal(node.getParentNode(), finest.getParentNode());
        assert.deepEqual(borderOf(only(node.getMesh()!)), border, node.getName());
        if (level > 0) assert.ok(trianglesOf(node) <= trianglesOf(levels[level - 1]!), node.getName());
        sums[level]! += trianglesOf(node);
      }
    }
    assert.deepEqual([report.levels, report.triangles], [sums, sums[0]]);
    assert.ok(solid || sums[1]! < 0.4 * sums[0]!, `the second level has ${sums[1]} of ${sums[0]} triangles`);
  }
});

test('levels reach as far as the rock to all sides, and as high', async () => {
  const objects = levelsIn(nodesOf(await read((await exportScene(REQUEST, { lods: 3 })).bytes)));
  for (const [name, levels] of objects) {
    const [finest, ...coarser] = levels.map((node) => only(node.getMesh()!).getAttribute('POSITION')!);
    for (const level of coarser) assert.equal(level.getMax([])[1], finest!.getMax([])[1], name);
  }
});

test('every triangle of a coarser level reaches off the ground, and what is closed has a volume', async () => {
  const request = { ...REQUEST, preset: 'conference-fig10c', seed: 3, imageWidth: 100, imageHeight: 75 } as const;
  const open = levelsIn(nodesOf(await read((await exportScene(request, { lods: 4 })).bytes)));
  for (const [, ...coarser] of open.values()) {
    for (const node of coarser) {
      const primitive = only(node.getMesh()!);
      const rim = new Set(borderOf(primitive).flatMap((edge) => edge.split(' → ')));
      const corners = cornersOf(primitive).map((v) => rim.has(String(pointsOf(primitive)[v])));
      const flat = corners.filter((isRim, i) => i % 3 === 0 && isRim && corners[i + 1] && corners[i + 2]);
      assert.equal(flat.length, 0, node.getName());
    }
  }
  const closed = nodesOf(await read((await exportScene(request, { lods: 4, solid: true })).bytes));
  for (const node of closed) assert.ok(volumeOf(only(node.getMesh()!)) > 0, node.getName());
});

test('a level that is as the one before it is in the file once, under both names', async () => {
  for (const options of [{ lods: 4 }, { lods: 4, solid: true, vertexColors: true }, { lods: 4, mesh: 'kit', kinds: 4 }] as const) {
    const { bytes } = await exportScene(REQUEST, options);
    await assertValid(bytes, options);
    const seen = { shared: 0, own: 0 };
    const meshes = new Set<Mesh>();
    for (const levels of levelsIn(nodesOf(await read(bytes))).values()) {
      for (const [level, node] of levels.entries()) {
        meshes.add(node.getMesh()!);
        if (level === 0) continue;
        const [own, before] = [only(node.getMesh()!), only(levels[level - 1]!.getMesh()!)];
        const isSame = trianglesOf(node) === trianglesOf(levels[level - 1]!);
        assert.equal(own.getIndices() === before.getIndices(), isSame, node.getName());
        for (const semantic of own.listSemantics())
          assert.equal(own.getAttribute(semantic) === before.getAttribute(semantic), isSame, `${node.getName()}: ${semantic}`);
        seen[isSame ? 'shared' : 'own'] += 1;
      }
    }
    assert.ok(seen.shared > 0 && seen.own > 0, JSON.stringify(seen));
    const names = [...meshes].map((mesh) => mesh.getName());
    assert.equal(new Set(names).size, names.length, 'each mesh has its name');
  }
});

test('kits, layers and instances have levels too, and so does OBJ', async () => {
  const forms: ExportOptions[] = [
    { mesh: 'kit', kinds: 4, lods: 3 },
    { mesh: 'kit', kinds: 4, lods: 3, instancing: true },
    { mesh: 'one', lods: 3 },
  ];
  for (const options of forms) {
    const { bytes, report } = await exportScene(REQUEST, options);
    await assertValid(bytes, options);
    if (!options.instancing) {
      const objects = levelsIn(nodesOf(await read(bytes)));
      assert.ok([...objects.values()].every((levels) => levels.length === 3));
      assert.equal(objects.size, report.objects);
    }
    const [finest, next, coarsest] = report.levels as Point;
    assert.ok(finest === report.triangles && next < finest && coarsest <= next, JSON.stringify(report.levels));
  }
  const { bytes, report } = await exportScene(REQUEST, { format: 'obj', lods: 2 });
  const lines = new TextDecoder().decode(bytes).split('\n');
  const names = lines.filter((line) => line.startsWith('o ')).map((line) => line.slice(2));
  assert.deepEqual(
    names.slice().sort(),
    [0, 1].flatMap((level) => names.slice(0, report.objects).map((name) => name.replace(/\d$/, String(level)))).sort(),
  );
  assert.equal(lines.filter((line) => line.startsWith('f ')).length, report.levels![0]! + report.levels![1]!);
  const vertices = lines.filter((line) => line.startsWith('v ')).length;
  const last = Math.max(
    ...lines.filter((line) => line.startsWith('f ')).flatMap((line) => line.split(' ').slice(1).map(Number.parseFloat)),
  );
  assert.equal(last, vertices);
});

/** How far the points stand out of a hull, and whether no corner of it does: convex, seen from outside. */
function standingOut(hull: Primitive, points: readonly Point[]): { out: number; own: number } {
  const places = pointsOf(hull);
  const corners = cornersOf(hull).map((v) => places[v]!);
  let [out, own] = [0, 0];
  for (let k = 0; k < corners.length; k += 3) {
    const [a, b, c] = corners.slice(k, k + 3) as [Point, Point, Point];
    const [u, v] = [b, c].map((point) => point.map((value, axis) => value - a[axis]!)) as [Point, Point];
    const normal: Point = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    const length = Math.hypot(...normal);
    if (length === 0) continue;
    const height = (point: Point): number => normal.reduce((sum, value, axis) => sum + (value * (point[axis]! - a[axis]!)) / length, 0);
    out = Math.max(out, ...points.map(height));
    own = Math.max(own, ...places.map(height));
  }
  return { out, own };
}

/** A hull leaves out no more of its rock, as a share of its longest side. */
const MARGIN = 0.04;

test('every rock has a convex hull of at most 32 vertices by the name that the program knows, where the rock is', async () => {
  const names = { unreal: (rock: string) => `UCX_${rock}_00`, godot: (rock: string) => `${rock}-convcolonly` };
  for (const hulls of ['unreal', 'godot'] as const) {
    for (const mesh of ['rocks', 'kit'] as const) {
      const options = { hulls, mesh, kinds: 6, solid: hulls === 'unreal' };
      const { bytes, report } = await exportScene(REQUEST, options);
      await assertValid(bytes, options);
      const nodes = new Map(nodesOf(await read(bytes)).map((node) => [node.getName(), node]));
      const rocks = [...nodes.keys()].filter((name) => /^rock-\d+$/.test(name));
      assert.equal(nodes.size, 2 * rocks.length);
      assert.deepEqual([report.objects, report.hulls!.objects], [rocks.length, rocks.length]);
      for (const name of rocks) {
        const [rock, node] = [nodes.get(name)!, nodes.get(names[hulls](name))!];
        assert.deepEqual(node.getWorldMatrix(), rock.getWorldMatrix(), name);
        const hull = only(node.getMesh()!);
        assert.deepEqual([hull.listSemantics(), hull.getMaterial(), borderOf(hull)], [['POSITION'], null, []], name);
        const points = pointsOf(only(rock.getMesh()!));
        const size = Math.max(
          ...[0, 1, 2].map((axis) => Math.max(...points.map((p) => p[axis]!)) - Math.min(...points.map((p) => p[axis]!))),
        );
        const { out, own } = standingOut(hull, points);
        assert.ok(pointsOf(hull).length <= 32 && own < 1e-5 * size, `${name}: a corner stands out by ${own / size}`);
        assert.ok(out < MARGIN * size, `${name} stands out of its hull by ${out / size}`);
      }
    }
  }
});

test('a hull of as many corners as it takes has all points in it, and there is none of points in a plane', () => {
  let state = 5;
  const random = (): number => {
    state = (Math.imul(state, 1_664_525) + 1_013_904_223) >>> 0;
    return state / 2 ** 32;
  };
  // Among them many in common planes, as on the ground that rocks stand on.
  for (let round = 0; round < 60; round++) {
    const points = Array.from({ length: 3 * (4 + round) }, () => (round % 3 === 0 ? Math.floor(4 * random()) : random()));
    if (round % 3 === 1) for (let k = 2; k < points.length / 2; k += 3) points[k] = 0;
    const hull = hullOf(points, Infinity, 0);
    if (!hull) continue;
    const at = (k: number): Point => points.slice(3 * k, 3 * k + 3) as Point;
    const corners = hull.triangles.map((corner) => at(hull.corners[corner]!));
    for (let k = 0; k < corners.length; k += 3) {
      const [a, b, c] = corners.slice(k, k + 3) as [Point, Point, Point];
      for (let p = 0; p < points.length / 3; p++) assert.ok(sixfold(a, b, c, at(p)) < 1e-5, `point ${p} of round ${round} is outside`);
    }
    assert.equal(hull.triangles.length / 3, 2 * hull.corners.length - 4);
  }
  assert.equal(hullOf([0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 3, 2, 0], 32, 0), undefined);
  assert.equal(hullOf([0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3], 32, 0), undefined);
  assert.equal(hullOf([], 32, 0), undefined);
});

/** Six times the volume of a tetrahedron. */
function sixfold(a: Point, b: Point, c: Point, d: Point): number {
  const [u, v, w] = [b, c, d].map((point) => point.map((value, axis) => value - a[axis]!)) as [Point, Point, Point];
  return w[0] * (u[1] * v[2] - u[2] * v[1]) + w[1] * (u[2] * v[0] - u[0] * v[2]) + w[2] * (u[0] * v[1] - u[1] * v[0]);
}

test('vertices have the linear colours of their materials, which are white then', async () => {
  const materialsOf = (document: Document): Map<string, number[]> =>
    new Map(
      document
        .getRoot()
        .listMaterials()
        .map((material) => [material.getName(), material.getBaseColorFactor()]),
    );
  for (const mesh of ['rocks', 'kit', 'one'] as const) {
    const [plain, document] = await Promise.all(
      [false, true].map(async (vertexColors) => {
        const options: ExportOptions = { mesh, vertexColors, hulls: mesh === 'rocks' ? 'godot' : 'none' };
        const { bytes } = await exportScene(REQUEST, options);
        await assertValid(bytes, options);
        return read(bytes);
      }),
    );
    const colors = materialsOf(plain!);
    assert.ok([...materialsOf(document!).values()].every((color) => color.every((part) => part === 1)));
    for (const primitive of nodesOf(document!).flatMap((node) => node.getMesh()!.listPrimitives())) {
      const material = primitive.getMaterial();
      if (!material) continue;
      const found = primitive.getAttribute('COLOR_0')!;
      assert.equal(found.getCount(), primitive.getAttribute('POSITION')!.getCount());
      for (const v of [0, found.getCount() - 1]) {
        const color = found.getElement(v, [0, 0, 0, 0]);
        assert.ok(
          color.every((part, k) => Math.abs(part - colors.get(material.getName())![k]!) < 1e-4),
          `${color}`,
        );
      }
    }
  }
  await assert.rejects(exportScene(REQUEST, { format: 'obj', vertexColors: true }), { name: 'ExportImpossible', key: 'vertexColors' });
});

test('a compressed file is smaller, and is the same to the last bit when it is unpacked', async () => {
  await MeshoptDecoder.ready;
  const forms: ExportOptions[] = [
    { mesh: 'one', vertexColors: true },
    { lods: 2, hulls: 'unreal', solid: true },
    { mesh: 'kit', instancing: true },
  ];
  for (const options of forms) {
    const [plain, compressed] = await Promise.all([false, true].map((compress) => exportScene(REQUEST, { ...options, compress })));
    await assertValid(compressed!.bytes, options);
    assert.ok(compressed!.bytes.length < plain!.bytes.length);
    assert.ok(compressed!.report.notes.some(({ code }) => code === 'compressed'));
    const [from, to] = [partsOf(plain!.bytes), partsOf(compressed!.bytes)];
    assert.deepEqual([to.json.accessors, to.json.nodes, to.json.meshes], [from.json.accessors, from.json.nodes, from.json.meshes]);
    assert.ok((to.json.extensionsRequired as string[]).includes('EXT_meshopt_compression'));
    const unpacked = new Uint8Array(to.json.buffers[1]!.byteLength);
    for (const { byteOffset, byteLength, extensions } of to.json.bufferViews) {
      const { count, byteStride, mode, ...stored } = extensions!.EXT_meshopt_compression;
      const source = to.bin.subarray(stored.byteOffset, stored.byteOffset + stored.byteLength);
      const target = unpacked.subarray(byteOffset, byteOffset + byteLength);
      MeshoptDecoder.decodeGltfBuffer(target, count, byteStride, source, mode);
    }
    assert.ok(trianglesIn(from).equals(trianglesIn({ json: from.json, bin: unpacked })), JSON.stringify(options));
  }
  const refused = { name: 'ExportImpossible', key: 'compress', value: true };
  await assert.rejects(exportScene(REQUEST, { format: 'stl', mesh: 'one', compress: true }), refused);
});

interface Parts {
  json: {
    accessors: { bufferView: number }[];
    bufferViews: {
      byteOffset: number;
      byteLength: number;
      target?: number;
      extensions?: { EXT_meshopt_compression: { byteOffset: number; byteLength: number; count: number; byteStride: number; mode: string } };
    }[];
    buffers: { byteLength: number }[];
    [key: string]: unknown;
  };
  bin: Uint8Array;
}

function partsOf(bytes: Uint8Array): Parts {
  const length = new DataView(bytes.buffer).getUint32(12, true);
  return { json: JSON.parse(new TextDecoder().decode(bytes.subarray(20, 20 + length))) as Parts['json'], bin: bytes.subarray(28 + length) };
}

/** The binary part, whose triangles begin with their lowest corner: the encoder turns them. */
function trianglesIn({ json, bin }: Parts): Buffer {
  const bytes = bin.slice();
  for (const [view, { byteOffset, byteLength, target }] of json.bufferViews.entries()) {
    if (target !== 34_963) continue;
    const isShort =
      (json.accessors.find(({ bufferView }) => bufferView === view) as unknown as { componentType: number }).componentType === 5123;
    const indices = new (isShort ? Uint16Array : Uint32Array)(bytes.buffer, byteOffset, byteLength / (isShort ? 2 : 4));
    for (let k = 0; k < indices.length; k += 3) {
      const corners = [...indices.subarray(k, k + 3)];
      const lowest = corners.indexOf(Math.min(...corners));
      indices.set([...corners.slice(lowest), ...corners.slice(0, lowest)], k);
    }
  }
  return Buffer.from(bytes);
}

test('levels and hulls are refused where a file cannot have them, and a target’s own give way', async () => {
  const refused: [ExportOptions, keyof ExportOptions][] = [
    [{ format: 'stl', mesh: 'one', lods: 2 }, 'lods'],
    [{ format: 'ply', lods: 2 }, 'lods'],
    [{ format: 'obj', hulls: 'unreal' }, 'hulls'],
    [{ mesh: 'one', hulls: 'godot' }, 'hulls'],
    [{ mesh: 'kit', instancing: true, hulls: 'godot' }, 'hulls'],
  ];
  for (const [options, key] of refused) {
    await assert.rejects(
      exportScene(REQUEST, options),
      (error: RockFieldError) => error.name === 'ExportImpossible' && error.key === key && error.value === options[key],
    );
  }
  await assert.rejects(exportScene(REQUEST, { lods: 5 }), { name: 'OutOfRange', key: 'lods', value: 5, min: 1, max: 4 });
  assert.equal(resolveOptions({ target: 'unreal' }).hulls, 'unreal');
  assert.equal(resolveOptions({ target: 'unreal', mesh: 'one' }).hulls, 'none');
  assert.equal(resolveOptions({ target: 'godot', format: 'obj' }).hulls, 'none');
});
