// rock-field/export: what is in the files, read back by others' readers and by plain ones.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { WebIO } from '@gltf-transform/core';
import type { Document, Node, Primitive } from '@gltf-transform/core';
import validator from 'gltf-validator';
import { generate, presets, schema } from 'rock-field/core';
import type { Field } from 'rock-field/core';
import { exportScene, exportSchema, RockFieldError } from 'rock-field/export';
import type { ExportOptions } from 'rock-field/export';
import { fieldBuffers } from '../../www/data/buffers.ts';
import { VERSION } from '../../www/data/version.ts';
import { exportModel } from '../../www/export/file.ts';
import { hashOf } from '../../www/export/origin/hash.ts';
import type { Model } from '../../www/export/model.ts';
import { STONE_KINDS } from '../../www/data/palette.gen.ts';
import { FORMS, resolveOptions, TARGETS } from '../../www/export/options.ts';
import type { Params } from '../../www/rocks/params.ts';
import { stoneKinds } from '../../www/rocks/stone-kinds.ts';

type Point = [number, number, number];

const SMALL = { imageWidth: 200, imageHeight: 150 };
const REQUEST = { preset: 'riverbed', seed: 7, ...SMALL } as const;
const METRES_PER_PIXEL = 0.01;

const fieldOf = (): Promise<Field> => generate(REQUEST);
const read = (bytes: Uint8Array): Promise<Document> => new WebIO().readBinary(bytes);

/** The nodes that have a mesh. */
const bodies = (document: Document): Node[] =>
  document
    .getRoot()
    .listNodes()
    .filter((node) => node.getMesh() !== null);

/** The corners of all triangles in the file's axes, in the order of nodes. */
function corners(document: Document): Point[] {
  return bodies(document).flatMap((node) => {
    const matrix = node.getWorldMatrix();
    return node
      .getMesh()!
      .listPrimitives()
      .flatMap((primitive) => cornersOf(primitive, matrix));
  });
}

function cornersOf(primitive: Primitive, matrix: readonly number[]): Point[] {
  const positions = primitive.getAttribute('POSITION')!;
  const placed = Array.from({ length: positions.getCount() }, (_, v) => {
    const [x, y, z] = positions.getElement<Point>(v, [0, 0, 0]);
    return [0, 1, 2].map((row) => matrix[row]! * x + matrix[4 + row]! * y + matrix[8 + row]! * z + matrix[12 + row]!) as Point;
  });
  return Array.from(primitive.getIndices()!.getArray()!, (index: number) => placed[index]!);
}

/** The corners of the field's triangles as glTF wants them. */
function expectedCorners({ positions, indices, imageWidth, imageHeight }: Field): Point[] {
  return Array.from(indices, (index) => {
    const [x, y, z] = positions.subarray(3 * index, 3 * index + 3) as unknown as Point;
    return [x - imageWidth / 2, z, imageHeight / 2 - y].map((value) => METRES_PER_PIXEL * value) as Point;
  });
}

function assertNear(found: readonly Point[], expected: readonly Point[], within: number): void {
  assert.equal(found.length, expected.length);
  const off = found.findIndex((point, k) => point.some((value, axis) => !(Math.abs(value - expected[k]![axis]!) <= within)));
  assert.equal(off, -1, `corner ${off}: ${found[off]} instead of ${expected[off]}`);
}

test('an object for each rock: named, standing where it touches the ground, with its mesh about that point, in groups by layer', async () => {
  const [field, { bytes, report }] = await Promise.all([fieldOf(), exportScene(REQUEST)]);
  const document = await read(bytes);
  const nodes = bodies(document);
  assert.equal(nodes.length, field.stats.rocks);
  assert.deepEqual(nodes.map((node) => node.getName()).sort(), nodes.map((_, k) => `rock-${k + 1}`).sort());
  assertNear(corners(document), expectedCorners(field), 1e-6);
  for (const node of nodes) {
    const [x, y, z] = node.getTranslation();
    assert.equal(y, 0);
    const positions = node.getMesh()!.listPrimitives()[0]!.getAttribute('POSITION')!;
    const [min, max] = [positions.getMin([]), positions.getMax([])];
    assert.ok(
      [0, 2].every((axis) => Math.abs(min[axis]! + max[axis]!) < 1e-5),
      `the mesh of ${node.getName()} is not about its origin`,
    );
    assert.ok(Math.abs(x) <= 1 && Math.abs(z) <= 0.75, 'the field is not about the middle of the file');
  }
  const [scene] = document.getRoot().listScenes();
  assert.deepEqual(
    scene!.listChildren().map((group) => [group.getName(), group.listChildren().length]),
    field.layers
      .map((_, layer) => [`layer-${layer + 1}`, field.rockLayer.filter((of) => of === layer).length])
      .filter(([, rocks]) => rocks),
  );
  const { triangles, objects, nodes: all } = report;
  assert.deepEqual(
    [triangles, objects, all, report.bytes],
    [field.stats.triangles, nodes.length, document.getRoot().listNodes().length, bytes.length],
  );
});

test('every object says what it is, and the scene which link it came from, and its hash', async () => {
  const document = await read((await exportScene(REQUEST)).bytes);
  assert.deepEqual(document.getRoot().listScenes()[0]!.getExtras(), {
    link: 'v=1&preset=riverbed&seed=7&w=200&h=150',
    version: VERSION,
    hash: hashOf(fieldBuffers(await fieldOf())),
    metresPerPixel: METRES_PER_PIXEL,
  });
  for (const node of bodies(document)) {
    const { id, layer, area, volume, size } = node.getExtras() as { id: number; layer: number; area: number; volume: number; size: Point };
    assert.equal(node.getName(), `rock-${id}`);
    assert.equal(node.getParentNode()!.getName(), `layer-${layer + 1}`);
    assert.ok(area > 0 && area <= size[0] * size[2] * 1.001, `${node.getName()} has a footprint of ${area} m² in ${size} m`);
    assert.ok(volume > 0 && volume <= size[0] * size[1] * size[2], `${node.getName()} has ${volume} m³ in ${size} m`);
  }
});

test('one mesh for each layer has the same triangles, and its vertices tell which rock they are of', async () => {
  const [field, { bytes }, apart] = await Promise.all([fieldOf(), exportScene(REQUEST, { mesh: 'one' }), exportScene(REQUEST)]);
  const kinds: string[] = [];
  for (const node of bodies(await read(apart.bytes))) {
    kinds[Number(node.getName().slice('rock-'.length)) - 1] = node.getMesh()!.listPrimitives()[0]!.getMaterial()!.getName();
  }
  const document = await read(bytes);
  assert.equal(bodies(document).length, new Set(field.rockLayer).size);
  const sorted = (points: readonly Point[]): string[] => points.map((point) => point.map(Math.fround).join()).sort();
  assert.deepEqual(sorted(corners(document)), sorted(expectedCorners(field)));
  for (const node of bodies(document)) {
    for (const primitive of node.getMesh()!.listPrimitives()) {
      const kind = primitive.getMaterial()!.getName();
      const ids = new Set<number>(primitive.getAttribute('_FEATURE_ID_0')!.getArray()!);
      for (const id of ids) assert.deepEqual([`layer-${field.rockLayer[id]! + 1}`, kinds[id]], [node.getName(), kind]);
    }
  }
});

test('a rock of a mixture is of the kind that the renderer draws', () => {
  const samples = JSON.parse(readFileSync(new URL('../data/stone-kinds.json', import.meta.url), 'utf8')) as [number, number, number][];
  assert.equal(new Set(samples.map(([, , kind]) => kind)).size, STONE_KINDS.length, 'the samples lack a kind');
  for (const [id, site, kind] of samples) {
    const field = { layers: [{ id, selected: Uint32Array.of(site) }], rockLayer: Uint8Array.of(0) } as unknown as Field;
    const params = { layers: [{ material: 'mixed' }] } as unknown as Params;
    assert.deepEqual([...stoneKinds(field, params)], [kind], `layer ${id}, site ${site}`);
  }
});

test('natural rocks are of the material that the picture shows, by name; the papers’ have the colours of their layers', async () => {
  const [slate, layers, chosen] = await Promise.all([
    exportScene({ ...REQUEST, layers: [{ ...presets.riverbed.layers[1], material: 'slate' }] }),
    exportScene({ preset: 'journal-fig1', ...SMALL }),
    exportScene(REQUEST, { color: 'layer' }),
  ]);
  const names = async ({ bytes }: { bytes: Uint8Array }): Promise<string[]> =>
    (await read(bytes))
      .getRoot()
      .listMaterials()
      .map((material) => material.getName())
      .sort();
  assert.deepEqual(await names(slate), ['slate']);
  assert.deepEqual(await names(layers), ['layer-1', 'layer-2', 'layer-3']);
  assert.ok((await names(chosen)).every((name) => name.startsWith('layer-')));
  assert.ok((await names(await exportScene(REQUEST))).includes('granite'));
});

/** Width and depth along the axes of the file, and height, of each rock by its name. */
function boxes(document: Document): Map<string, { middle: Point; size: Point }> {
  let at = 0;
  const all = corners(document);
  return new Map(
    bodies(document).map((node) => {
      const begin = at;
      at += node.getMesh()!.listPrimitives()[0]!.getIndices()!.getCount();
      const own = all.slice(begin, at);
      const ends = [0, 1, 2].map((axis) => [Math.min(...own.map((point) => point[axis]!)), Math.max(...own.map((point) => point[axis]!))]);
      return [
        node.getName(),
        { middle: ends.map(([low, high]) => (low! + high!) / 2) as Point, size: ends.map(([low, high]) => high! - low!) as Point },
      ];
    }),
  );
}

test('a kit has at most so many meshes for each layer, and each rock is about as large as its own and stands where it stood', async () => {
  const [own, { bytes, report }] = await Promise.all([exportScene(REQUEST), exportScene(REQUEST, { mesh: 'kit', kinds: 5 })]);
  const document = await read(bytes);
  // At least one for each of the seven kinds of stone.
  const layers = presets.riverbed.layers.length;
  assert.ok(report.meshes <= 7 * layers && report.meshes > layers, `${report.meshes} meshes`);
  const [before, after] = [boxes(await read(own.bytes)), boxes(document)];
  assert.deepEqual([...after.keys()].sort(), [...before.keys()].sort());
  const ratios: number[] = [];
  for (const [name, { middle, size }] of before) {
    const other = after.get(name)!;
    const far = Math.hypot(middle[0] - other.middle[0], middle[2] - other.middle[2]);
    assert.ok(far < 0.35 * Math.max(size[0], size[2]), `${name} has moved by ${far} m`);
    // The height is that above the ground, which the box of an embedded rock goes below.
    ratios.push(other.size[0] / size[0], other.size[2] / size[2]);
  }
  ratios.sort((a, b) => a - b);
  const quantile = (share: number): number => ratios[Math.floor(share * (ratios.length - 1))]!;
  assert.ok(
    Math.abs(quantile(0.5) - 1) < 0.1 && quantile(0.02) > 0.6 && quantile(0.98) < 1.6,
    `sizes differ by ${quantile(0.02)}…${quantile(0.98)}`,
  );
});

/** How each rock lies on the ground, by its name: the second moments of its vertices about its origin, xx, xz and zz. */
function momentsOf(document: Document): Map<string, Point> {
  return new Map(
    bodies(document).map((node) => {
      const positions = node.getMesh()!.listPrimitives()[0]!.getAttribute('POSITION')!;
      const matrix = node.getWorldMatrix();
      const moments: Point = [0, 0, 0];
      for (let v = 0; v < positions.getCount(); v++) {
        const [x, y, z] = positions.getElement<Point>(v, [0, 0, 0]);
        const [east, south] = [0, 2].map((row) => matrix[row]! * x + matrix[4 + row]! * y + matrix[8 + row]! * z) as [number, number];
        for (const [k, product] of [east * east, east * south, south * south].entries()) moments[k] += product / positions.getCount();
      }
      return [node.getName(), moments];
    }),
  );
}

test('a rock of a kit points where the rock points that it stands for, and is as long and as wide', async () => {
  const own = momentsOf(await read((await exportScene(REQUEST)).bytes));
  const kit = momentsOf(await read((await exportScene(REQUEST, { mesh: 'kit', kinds: 5 })).bytes));
  for (const [name, [xx, xz, zz]] of own) {
    const off = kit.get(name)!.map((moment, k) => Math.abs(moment - [xx, xz, zz][k]!));
    assert.ok(Math.max(...off) < 1e-3 * (xx + zz), `${name}: ${kit.get(name)} instead of ${[xx, xz, zz]}`);
  }
});

test('with instancing the rocks of a kit are the same, placed by attributes', async () => {
  const options = { mesh: 'kit', kinds: 4 } as const;
  const linked = await read((await exportScene(REQUEST, options)).bytes);
  const { bytes, report } = await exportScene(REQUEST, { ...options, instancing: true });
  const view = new DataView(bytes.buffer);
  const json = JSON.parse(new TextDecoder().decode(bytes.subarray(20, 20 + view.getUint32(12, true)))) as {
    extensionsRequired: string[];
    nodes: { mesh?: number; extensions?: { EXT_mesh_gpu_instancing: { attributes: Record<string, number> } } }[];
    accessors: { bufferView: number; byteOffset: number; count: number }[];
    bufferViews: { byteOffset: number }[];
  };
  assert.deepEqual(json.extensionsRequired, ['EXT_mesh_gpu_instancing']);
  const bin = 28 + view.getUint32(12, true);
  const places = json.nodes.flatMap(({ mesh, extensions }) => {
    if (mesh === undefined) return [];
    const { TRANSLATION } = extensions!.EXT_mesh_gpu_instancing.attributes;
    const { bufferView, byteOffset, count } = json.accessors[TRANSLATION!]!;
    const at = bin + json.bufferViews[bufferView]!.byteOffset + byteOffset;
    return Array.from({ length: count }, (_, k) => [0, 4, 8].map((offset) => view.getFloat32(at + 12 * k + offset, true)).join());
  });
  const expected = bodies(linked).map((node) => node.getTranslation().map(Math.fround).join());
  assert.deepEqual(places.sort(), expected.sort());
  assert.ok(report.nodes <= report.meshes + presets.riverbed.layers.length, `${report.nodes} nodes`);
});

test('closed rocks are closed: every edge has two triangles that agree, and the volume is that of the extras', async () => {
  for (const preset of ['journal-fig1', 'riverbed', 'scree'] as const) {
    const document = await read((await exportScene({ preset, seed: 3, ...SMALL }, { solid: true })).bytes);
    for (const node of bodies(document)) {
      const [primitive] = node.getMesh()!.listPrimitives();
      const positions = primitive!.getAttribute('POSITION')!;
      const points = Array.from(primitive!.getIndices()!.getArray()!, (index: number) => positions.getElement<Point>(index, [0, 0, 0]));
      const edges = new Map<string, number>();
      let sixfold = 0;
      for (let k = 0; k < points.length; k += 3) {
        const [a, b, c] = points.slice(k, k + 3) as [Point, Point, Point];
        for (const [from, to] of [
          [a, b],
          [b, c],
          [c, a],
        ] as const) {
          edges.set(`${from}→${to}`, (edges.get(`${from}→${to}`) ?? 0) + 1);
        }
        sixfold += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
      }
      const open = [...edges].filter(([edge, count]) => count !== 1 || edges.get(edge.split('→').reverse().join('→')) !== 1);
      assert.deepEqual(open, [], `${preset}, ${node.getName()}`);
      const { volume } = node.getExtras() as { volume: number };
      assert.ok(Math.abs(sixfold / 6 / volume - 1) < 1e-3, `${preset}, ${node.getName()}: ${sixfold / 6} m³ instead of ${volume}`);
    }
  }
});

/** The corners of the triangles of an OBJ file. */
function objCorners(bytes: Uint8Array): Point[] {
  const lines = new TextDecoder().decode(bytes).split('\n');
  const vertices = lines.filter((line) => line.startsWith('v ')).map((line) => line.split(' ').slice(1).map(Number) as Point);
  return lines
    .filter((line) => line.startsWith('f '))
    .flatMap((line) =>
      line
        .split(' ')
        .slice(1)
        .map((corner) => vertices[Number(corner.split('//')[0]) - 1]!),
    );
}

function stlCorners(bytes: Uint8Array): Point[] {
  const view = new DataView(bytes.buffer);
  return Array.from({ length: 3 * view.getUint32(80, true) }, (_, corner) => {
    const at = 84 + 50 * Math.floor(corner / 3) + 12 + 12 * (corner % 3);
    return [0, 4, 8].map((offset) => view.getFloat32(at + offset, true)) as Point;
  });
}

function plyCorners(bytes: Uint8Array): Point[] {
  const text = new TextDecoder('latin1').decode(bytes);
  const begin = text.indexOf('end_header\n') + 'end_header\n'.length;
  const [, vertices, faces] = /element vertex (\d+)[\s\S]*element face (\d+)/.exec(text)!.map(Number) as [number, number, number];
  const view = new DataView(bytes.buffer, begin);
  return Array.from({ length: 3 * faces }, (_, corner) => {
    const face = 27 * vertices + 13 * Math.floor(corner / 3);
    assert.equal(view.getUint8(face), 3);
    const at = 27 * view.getInt32(face + 1 + 4 * (corner % 3), true);
    return [0, 4, 8].map((offset) => view.getFloat32(at + offset, true)) as Point;
  });
}

test('OBJ, STL and PLY have the triangles of the GLB, in the axes and units that are asked for', async () => {
  const expected = expectedCorners(await fieldOf());
  const readers = { obj: objCorners, stl: stlCorners, ply: plyCorners };
  for (const [format, cornersOf] of Object.entries(readers) as ['obj' | 'stl' | 'ply', (bytes: Uint8Array) => Point[]][]) {
    const yUp = await exportScene(REQUEST, { format });
    assertNear(cornersOf(yUp.bytes), expected, 1e-6);
    const zUp = await exportScene(REQUEST, { format, up: 'z', scale: 1000 });
    const turned = expected.map(([x, y, z]) => [1000 * x, -1000 * z, 1000 * y] as Point);
    assertNear(cornersOf(zUp.bytes), turned, 1e-3);
    assert.equal(yUp.report.triangles, expected.length / 3);
  }
});

test('an OBJ file has an object for each rock, and normals of length 1', async () => {
  const field = await fieldOf();
  const lines = new TextDecoder().decode((await exportScene(REQUEST, { format: 'obj' })).bytes).split('\n');
  assert.equal(lines.filter((line) => line.startsWith('o rock-')).length, field.stats.rocks);
  const normals = lines.filter((line) => line.startsWith('vn ')).map((line) => line.split(' ').slice(1).map(Number) as Point);
  assert.equal(normals.length, field.positions.length / 3);
  assert.ok(normals.every((normal) => Math.abs(Math.hypot(...normal) - 1) < 1e-5));
});

test('a target is a set of defaults, which options replace', () => {
  assert.deepEqual(resolveOptions({ target: 'print' }), { ...resolveOptions(), ...TARGETS.print.options });
  assert.equal(resolveOptions({ target: 'print', scale: 1 }).scale, 1);
  // What the format cannot hold gives way, unless it was asked for.
  assert.equal(resolveOptions({ target: 'blender', format: 'ply' }).mesh, 'one');
});

test('what is wrong with an option is an error with its key, value and bounds, before anything is generated', async () => {
  const cases: [object, Partial<RockFieldError>][] = [
    [{ target: 'maya' }, { name: 'OutOfRange', key: 'target', value: 'maya' }],
    [{ format: 'fbx' }, { name: 'OutOfRange', key: 'format', value: 'fbx' }],
    [{ kinds: 0 }, { name: 'OutOfRange', key: 'kinds', value: 0, min: 1, max: 256 }],
    [{ kinds: 1.5 }, { name: 'NotAnInteger', key: 'kinds', value: 1.5 }],
    [{ solid: 1 }, { name: 'WrongType', key: 'solid', value: 1 }],
    [{ scale: Number.NaN }, { name: 'OutOfRange', key: 'scale' }],
    [{ mehs: 'one' }, { name: 'UnknownKey', key: 'mehs', value: 'one' }],
    [
      { mesh: 'kit', format: 'obj' },
      { name: 'ExportImpossible', key: 'mesh', value: 'kit' },
    ],
    [
      { mesh: 'rocks', format: 'stl' },
      { name: 'ExportImpossible', key: 'mesh', value: 'rocks' },
    ],
  ];
  for (const [options, expected] of cases) {
    await assert.rejects(exportScene({ seed: -1 }, options as ExportOptions), (error: RockFieldError) => {
      assert.deepEqual(Object.fromEntries(Object.keys(expected).map((key) => [key, error[key as keyof RockFieldError]])), expected);
      return error instanceof RockFieldError;
    });
  }
  await assert.rejects(exportScene({ seed: -1 }, {}), { name: 'OutOfRange', key: 'seed' });
});

test('a file that would be too large is refused before anything is allocated, with the numbers', async () => {
  const [rocks, each] = [100_000, 10_000];
  const starts = (length: number): Uint32Array => Uint32Array.from({ length: rocks + 1 }, (_, k) => k * length);
  const numbers = (length: number): object => ({ length, subarray: (from: number, to: number) => new Float32Array(to - from) });
  const model = {
    unit: 1,
    positions: numbers(3 * each * rocks),
    normals: numbers(3 * each * rocks),
    indices: { length: 3 * each * rocks },
    vertexStarts: starts(each),
    indexStarts: starts(3 * each),
    groupOf: new Uint8Array(rocks),
    groups: [{ name: 'layer-1', noun: 'rock', isOpenBelow: true, extras: {} }],
    materialOf: new Uint8Array(rocks),
    materials: [{ name: 'stone', color: [0, 0, 0] }],
    origins: new Float64Array(3 * rocks),
    centre: [0, 0, 0],
  } as unknown as Model;
  const hash = (): never => assert.fail('something was done before');
  const source = { title: '', link: '', hash, hasPatterns: false, extrasOf: () => ({}) };
  for (const format of ['glb', 'obj', 'stl', 'ply'] as const) {
    await assert.rejects(
      exportModel(model, source, resolveOptions({ format })),
      (error: RockFieldError) => error.name === 'ExportTooLarge' && (error.value as number) > error.max!,
    );
  }
});

test('an aborted export rejects with the reason, and what the caller changes afterwards does not count', async () => {
  const reason = new Error('enough');
  await assert.rejects(exportScene(REQUEST, {}, { signal: AbortSignal.abort(reason) }), reason);
  const [request, options]: [{ seed: number }, ExportOptions] = [{ ...REQUEST }, { mesh: 'one' }];
  const file = exportScene(request, options);
  request.seed = 8;
  options.mesh = 'rocks';
  assert.deepEqual(Buffer.from((await file).bytes), Buffer.from((await exportScene(REQUEST, { mesh: 'one' })).bytes));
});

test('a field without rocks is a file without meshes', async () => {
  const nothing = { ...REQUEST, layers: [] };
  for (const mesh of FORMS.glb!) {
    const { bytes, report } = await exportScene(nothing, { mesh });
    const { issues } = await validator.validateBytes(bytes);
    assert.deepEqual([issues.numErrors, issues.numWarnings, report.triangles], [0, 0, 0]);
  }
  for (const format of ['obj', 'stl', 'ply'] as const) assert.equal((await exportScene(nothing, { format })).report.triangles, 0);
});

test('the schema has every option, and its defaults are those of an empty request', () => {
  const { properties } = exportSchema as { properties: Record<string, { default: unknown }> };
  const { target, ...options } = properties;
  assert.equal(target!.default, 'gltf');
  assert.deepEqual(Object.fromEntries(Object.entries(options).map(([key, row]) => [key, row.default])), { ...resolveOptions() });
  assert.ok(
    Object.keys(options).every((key) => !Object.hasOwn((schema as { properties: object }).properties, key)),
    'an option is called like a parameter',
  );
});
