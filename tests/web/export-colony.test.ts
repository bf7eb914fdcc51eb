// exportWoodEar: colonies of wood ears, their log and the rocks around it, read back by others' readers.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { WebIO } from '@gltf-transform/core';
import type { Document, Node, Primitive } from '@gltf-transform/core';
import validator from 'gltf-validator';
import { growWoodEar, woodEarPresets } from 'rock-field/core';
import type { WoodEarColony } from 'rock-field/core';
import { exportScene, exportWoodEar } from 'rock-field/export';
import type { ExportOptions, WoodEarExportRequest } from 'rock-field/export';
import { crossesItself, isClosed } from '../../www/export/shapes/crossings.ts';
import { decodeWoodEarLink } from '../../www/wood-ear/link.ts';

type PresetName = keyof typeof woodEarPresets;
type Point = [number, number, number];

const PRESETS = Object.keys(woodEarPresets) as PresetName[];
/** Little to do, but every kind of thing there is. */
const SMALL = { rings: 4, meridians: 9, range: 20, density: 10, log: { length: 40, radius: 6, spacing: 3 } };
const OLD = { preset: 'wet-colony', ground: '', ...SMALL } as const satisfies WoodEarExportRequest;
const THIN = { preset: 'thesis-default', ...SMALL } as const satisfies WoodEarExportRequest;

const read = (bytes: Uint8Array): Promise<Document> => new WebIO().readBinary(bytes);
const objects = (document: Document): Node[] =>
  document
    .getRoot()
    .listNodes()
    .filter((node) => node.getMesh() !== null);
const grown = ({ ground: _, ...request }: WoodEarExportRequest): Promise<WoodEarColony> => growWoodEar(request);

/** The vertices and the triangles of all of an object's parts, in the file's axes. */
function meshOf(node: Node): { positions: Float32Array; indices: Uint32Array } {
  const [positions, indices]: [number[], number[]] = [[], []];
  const [x, y, z] = node.getWorldTranslation();
  for (const primitive of node.getMesh()!.listPrimitives()) {
    const first = positions.length / 3;
    const list = primitive.getAttribute('POSITION')!;
    for (let v = 0; v < list.getCount(); v++) {
      const [px, py, pz] = list.getElement<Point>(v, [0, 0, 0]);
      positions.push(px + x, py + y, pz + z);
    }
    indices.push(...Array.from(primitive.getIndices()!.getArray()!, (index: number) => first + index));
  }
  return { positions: Float32Array.from(positions), indices: Uint32Array.from(indices) };
}

test('every preset is valid glTF in each form, open and solid, with the rocks that its log lies on', async () => {
  for (const [p, preset] of PRESETS.entries()) {
    for (const [m, mesh] of (['rocks', 'one'] as const).entries()) {
      const solid = (p + m) % 2 === 0;
      const { bytes } = await exportWoodEar(
        { preset, ...SMALL, bases: [{ position: [0, 0, 6] }], ...(!solid && { ground: '' }) },
        { mesh, solid },
      );
      const { issues } = await validator.validateBytes(bytes);
      const found = issues.messages.filter(({ severity }) => severity < 2).map(({ message }) => message);
      assert.deepEqual(found, [], `${preset}, ${mesh}, ${solid}`);
    }
  }
});

test('each ear is an object of two parts in the group of its colony, and the log one object with a part for each kind of wood', async () => {
  const bases = [{ position: [-15, 0, 6] as Point }, { position: [15, 0, 6] as Point, range: 20 }];
  const request = { ...OLD, bases };
  const [colony, { bytes, report, name }] = await Promise.all([grown(request), exportWoodEar(request)]);
  const document = await read(bytes);
  assert.equal(name, 'wet-colony-0.glb');
  const groups = document
    .getRoot()
    .listScenes()[0]!
    .listChildren()
    .map((group) => [group.getName(), group.listChildren().length]);
  const of = (base: number): number => colony.base.filter((one) => one === base).length;
  assert.ok(of(0) > 0 && of(1) > 0);
  assert.deepEqual(groups, [
    ['colony-1', of(0)],
    ['colony-2', of(1)],
    ['log', 0],
  ]);
  const names = objects(document).map((node) => node.getName());
  assert.deepEqual(names.sort(), [...Array.from(colony.foot, (_, k) => `ear-${k + 1}`), 'log'].sort());
  const materials = (node: Node): string[] =>
    node
      .getMesh()!
      .listPrimitives()
      .map((primitive: Primitive) => primitive.getMaterial()!.getName());
  for (const node of objects(document)) {
    if (node.getName() === 'log') assert.deepEqual(materials(node), ['bark', 'end-grain', 'splinter']);
    else assert.match(materials(node).join(), /^flesh-(young|grown|old),velvet-\1$/);
  }
  assert.equal(report.triangles, (colony.indices.length + colony.log.indices.length) / 3);
  assert.equal(report.objects, names.length);
});

test('an ear has the triangles that were grown, in metres about its foot, which is on the log', async () => {
  const [colony, { bytes }] = await Promise.all([grown(OLD), exportWoodEar(OLD)]);
  const { log } = colony;
  const document = await read(bytes);
  const ears = objects(document).filter((node) => node.getName() !== 'log');
  assert.ok(ears.length > 10);
  for (const node of ears) {
    const { id, radius } = node.getExtras() as { id: number; radius: number };
    const [first, last] = [colony.individualStarts[id - 1]!, colony.individualStarts[id]!];
    const { positions, indices } = meshOf(node);
    assert.equal(indices.length, last - first);
    // In the file y is up.
    const off = Array.from(indices, (index, k) => {
      const [x, y, z] = positions.subarray(3 * index, 3 * index + 3) as unknown as Point;
      const [gx, gy, gz] = colony.positions.subarray(3 * colony.indices[first + k]!) as unknown as Point;
      return Math.hypot(100 * x - gx, 100 * y - gz, 100 * z + gy);
    });
    assert.ok(Math.max(...off) < 1e-3, `${node.getName()} differs by ${Math.max(...off)} cm`);
    const [x, y, z] = node.getTranslation();
    const onLog = Array.from({ length: log.positions.length / 3 }, (_, v) =>
      Math.hypot(log.positions[3 * v]! - 100 * x, log.positions[3 * v + 1]! + 100 * z, log.positions[3 * v + 2]! - 100 * y),
    );
    assert.ok(Math.min(...onLog) < 1e-3, `${node.getName()} stands ${Math.min(...onLog)} cm off the log`);
    assert.ok(Math.abs(radius - colony.size[id - 1]! / 100) < 1e-4);
  }
});

test('the log is as long as it was asked to be, in metres, and lies where the file has its origin', async () => {
  for (const metresPerPixel of [0.01, 0.02]) {
    const document = await read((await exportWoodEar(OLD, { metresPerPixel })).bytes);
    const log = objects(document).find((node) => node.getName() === 'log')!;
    const { size } = log.getExtras() as { size: Point };
    const { positions } = meshOf(log);
    const ends = [0, 1, 2].map((axis) => positions.filter((_, k) => k % 3 === axis));
    assert.ok(Math.abs(size[0] - 40 * metresPerPixel) < 5 * metresPerPixel, `${size[0]} m long`);
    assert.ok(Math.abs(ends[0]!.reduce((sum, x) => sum + x, 0) / ends[0]!.length) < 0.1 * size[0]);
    assert.ok(ends[1]!.reduce((least, y) => Math.min(least, y), Infinity) > -0.05);
    assert.equal(document.getRoot().listScenes()[0]!.getExtras().metresPerPixel, metresPerPixel);
  }
});

test('the link in a file brings the same file back', async () => {
  const { bytes } = await exportWoodEar({ ...OLD, seed: 5 });
  const { link } = (await read(bytes)).getRoot().listScenes()[0]!.getExtras();
  const { params, preset, notices } = decodeWoodEarLink(String(link));
  assert.deepEqual(notices, []);
  const { mesh: _, ...request } = params;
  assert.deepEqual(Buffer.from((await exportWoodEar({ ...request, preset })).bytes), Buffer.from(bytes));
});

test('the rocks around the log are numbered from 1 on, and none grows through it', async () => {
  const { bytes, report } = await exportWoodEar({ preset: 'fallen-log', ...SMALL, bases: [{ position: [0, -6, 6] }] });
  const document = await read(bytes);
  const rocks = objects(document).filter((node) => node.getName().startsWith('rock-'));
  assert.ok(rocks.length > 100, `${rocks.length} rocks`);
  const numbers = rocks.map((node) => Number(node.getName().slice('rock-'.length))).sort((a, b) => a - b);
  assert.deepEqual(
    numbers,
    [...rocks.keys()].map((k) => k + 1),
  );
  assert.ok(rocks.every((node) => node.getName() === `rock-${(node.getExtras() as { id: number }).id}`));
  const { positions } = meshOf(objects(document).find((node) => node.getName() === 'log')!);
  for (const rock of rocks) {
    const [x, , z] = rock.getTranslation();
    let near = Infinity;
    for (let v = 0; v < positions.length; v += 3) {
      if (positions[v + 1]! < 0.02) near = Math.min(near, Math.hypot(positions[v]! - x, positions[v + 2]! - z));
    }
    assert.ok(near > 0.005, `${rock.getName()} is under the log`);
  }
  assert.deepEqual(
    report.notes.map(({ code }) => code),
    ['plain-colours'],
  );
});

test('what is solid is closed, has a volume, and tells if it passes through itself, or else does not', async () => {
  for (const request of [OLD, THIN, { ...THIN, foot: 0.5 }, { ...OLD, wrinkles: 95 }]) {
    const { bytes, report } = await exportWoodEar(request, { solid: true });
    const document = await read(bytes);
    let crossing = 0;
    for (const node of objects(document)) {
      const mesh = meshOf(node);
      assert.ok(isClosed(mesh), `${request.preset}, ${node.getName()}`);
      const { solid, volume } = node.getExtras() as { solid?: boolean; volume?: number };
      if (node.getName() === 'log') continue;
      assert.ok(volume! > 0, `${request.preset}, ${node.getName()}: ${volume} m³`);
      if (solid === false) crossing += 1;
    }
    const noted = report.notes.find(({ code }) => code === 'crosses-itself')?.count ?? 0;
    assert.equal(noted, crossing);
    assert.equal(
      report.notes.some(({ code }) => code === 'thickened'),
      request.preset === 'thesis-default',
    );
  }
});

/** How many edges have more triangles on one side than on the other; vertices at one place count as one. */
function openEdges({ positions, indices }: { positions: Float32Array; indices: Uint32Array }): number {
  const placeOf = (index: number): string => positions.subarray(3 * index, 3 * index + 3).join();
  const sides = new Map<string, number>();
  for (let i = 0; i < indices.length; i++) {
    const [from, to] = [placeOf(indices[i]!), placeOf(indices[i % 3 === 2 ? i - 2 : i + 1]!)];
    if (from === to) continue;
    const [edge, side] = from < to ? [`${from} ${to}`, 1] : [`${to} ${from}`, -1];
    sides.set(edge, (sides.get(edge) ?? 0) + side);
  }
  return [...sides.values()].filter((sum) => sum !== 0).length;
}

test('levels of detail of what is solid have no open edge, and fewer triangles', async () => {
  const document = await read((await exportWoodEar(OLD, { solid: true, lods: 3 })).bytes);
  const triangles = [0, 0, 0];
  for (const node of objects(document)) {
    const level = Number(/_LOD(\d)$/.exec(node.getName())![1]);
    const mesh = meshOf(node);
    assert.equal(openEdges(mesh), 0, node.getName());
    triangles[level] = triangles[level]! + mesh.indices.length / 3;
  }
  assert.ok(triangles[0]! > 1.5 * triangles[1]! && triangles[1]! > 1.5 * triangles[2]!, triangles.join());
});

test('an ear has one hull around both of its parts, and the log none', async () => {
  const document = await read((await exportWoodEar(OLD, { hulls: 'unreal' })).bytes);
  const spans = (node: Node): number[] => {
    const { positions } = meshOf(node);
    return [0, 1, 2].flatMap((axis) => {
      const list = positions.filter((_, k) => k % 3 === axis);
      return [
        list.reduce((least, value) => Math.min(least, value), Infinity),
        list.reduce((most, value) => Math.max(most, value), -Infinity),
      ];
    });
  };
  const all = new Map(objects(document).map((node) => [node.getName(), node]));
  const ears = [...all.keys()].filter((name) => name.startsWith('ear-'));
  assert.equal(all.size, 2 * ears.length + 1);
  for (const name of ears) {
    const [ear, hull] = [spans(all.get(name)!), spans(all.get(`UCX_${name}_00`)!)];
    const size = Math.max(...[0, 2, 4].map((k) => ear[k + 1]! - ear[k]!));
    const off = Math.max(...ear.map((value, k) => Math.abs(value - hull[k]!)));
    assert.ok(off < 0.03 * size, `${name}: its hull differs by ${off} m of ${size}`);
  }
});

test('triangles cross where an edge of one passes through the other, not where they touch', () => {
  const flat = [0, 0, 0, 2, 0, 0, 0, 2, 0];
  const two = (other: number[]): boolean =>
    crossesItself({ positions: Float32Array.from([...flat, ...other]), indices: Uint32Array.of(0, 1, 2, 3, 4, 5) });
  assert.equal(two([0.5, 0.5, -1, 0.5, 0.5, 1, 3, 3, 1]), true);
  assert.equal(two([0.5, 0.5, 0, 0.5, 0.5, 1, 3, 3, 1]), false, 'a corner touches');
  assert.equal(two([1.5, 1.5, -1, 1.5, 1.5, 1, 3, 3, 1]), false, 'beside it');
  assert.equal(two([0, 0, 1, 2, 0, 1, 0, 2, 1]), false, 'above it');
});

/** A box 40 cm long, its top open or not. */
function box(isOpen: boolean): { positions: number[]; indices: number[] } {
  const positions = [0, 1].flatMap((z) => [-20, -8, 16 * z, 20, -8, 16 * z, 20, 8, 16 * z, -20, 8, 16 * z]);
  const sides = [0, 1, 2, 3].flatMap((k) => [k, (k + 1) % 4, 4 + ((k + 1) % 4), k, 4 + ((k + 1) % 4), 4 + k]);
  return { positions, indices: [0, 2, 1, 0, 3, 2, ...sides, ...(isOpen ? [] : [4, 5, 6, 4, 6, 7])] };
}

test('a log of one’s own is one part, its ears stand on it, and an open one says that it is not solid', async () => {
  for (const isOpen of [false, true]) {
    const { bytes, report } = await exportWoodEar({ ...OLD, log: box(isOpen), base: { position: [0, -8, 8] } }, { solid: true });
    const document = await read(bytes);
    const all = objects(document);
    const log = all.find((node) => node.getName() === 'log')!;
    const [bark, ...more] = log.getMesh()!.listPrimitives();
    assert.deepEqual([bark!.getMaterial()!.getName(), bark!.getMaterial()!.getDoubleSided(), more.length], ['bark', isOpen, 0]);
    assert.equal((log.getExtras() as { solid?: boolean }).solid, isOpen ? false : undefined);
    const codes = report.notes.map(({ code }) => code);
    assert.deepEqual([codes.includes('open-log'), codes.includes('log-not-in-link')], [isOpen, true]);
    // 2 cm of it are in the soil.
    const height = (y: number): number => 100 * y + 2;
    for (const node of all.filter((one) => one !== log)) {
      const [x, y, z] = node.getTranslation();
      const off = Math.max(Math.abs(100 * x) - 20, Math.abs(100 * z) - 8, Math.abs(height(y) - 8) - 8);
      assert.ok(Math.abs(off) < 1e-3, `${node.getName()} stands ${off} cm off the box`);
    }
    assert.ok(all.length > 5);
  }
});

test('one mesh for each colony tells which ear a vertex is of, both parts alike', async () => {
  const [colony, { bytes }] = await Promise.all([grown(OLD), exportWoodEar(OLD, { mesh: 'one' })]);
  const document = await read(bytes);
  const mesh = objects(document)
    .find((node) => node.getName() === 'colony-1')!
    .getMesh()!;
  for (const side of ['flesh', 'velvet']) {
    const ids = mesh
      .listPrimitives()
      .filter((primitive) => primitive.getMaterial()!.getName().startsWith(side))
      .flatMap((primitive) => [...new Set<number>(primitive.getAttribute('_FEATURE_ID_0')!.getArray()!)]);
    assert.deepEqual(
      ids.sort((a, b) => a - b),
      [...colony.foot.keys()],
    );
  }
});

test('sheets are seen from both sides; plain colours have one flesh', async () => {
  const [thin, plain] = await Promise.all([exportWoodEar(THIN), exportWoodEar(OLD, { color: 'layer' })]);
  const materials = async ({ bytes }: { bytes: Uint8Array }) => (await read(bytes)).getRoot().listMaterials();
  const [flesh] = await materials(thin);
  assert.deepEqual([flesh!.getName(), flesh!.getDoubleSided()], ['flesh', true]);
  assert.deepEqual(
    (await materials(plain)).map((material) => [material.getName(), material.getDoubleSided()]),
    [
      ['flesh', false],
      ['velvet', false],
      ['bark', false],
      ['end-grain', false],
      ['splinter', false],
    ],
  );
});

test('OBJ, STL and PLY have as many triangles as the GLB', async () => {
  const { triangles } = (await exportWoodEar(OLD)).report;
  for (const format of ['obj', 'stl', 'ply'] as const) assert.equal((await exportWoodEar(OLD, { format })).report.triangles, triangles);
});

test('what cannot be had is an error before anything is grown', async () => {
  const cases: [WoodEarExportRequest, ExportOptions, object][] = [
    [{ seed: -1 }, { mesh: 'kit' }, { name: 'ExportImpossible', key: 'mesh', value: 'kit' }],
    [{ seed: -1 }, { mesh: 'points', format: 'csv' }, { name: 'ExportImpossible', key: 'mesh', value: 'points' }],
    [{ seed: -1 }, { format: 'csv' }, { name: 'ExportImpossible', key: 'format', value: 'csv' }],
    [{ seed: -1 }, { format: 'png' }, { name: 'ExportImpossible', key: 'format', value: 'png' }],
    [{ seed: -1 }, { textures: '1k' }, { name: 'ExportImpossible', key: 'textures', value: '1k' }],
    [{ seed: -1 }, {}, { name: 'OutOfRange', key: 'seed' }],
    [{ ground: 5 as unknown as string }, {}, { name: 'WrongType', key: 'ground' }],
  ];
  for (const [request, options, error] of cases) await assert.rejects(exportWoodEar(request, options), error);
  const reason = new Error('enough');
  await assert.rejects(exportWoodEar(OLD, {}, { signal: AbortSignal.abort(reason) }), reason);
});

test('a footprint is nothing that a request for rocks can have', async () => {
  await assert.rejects(exportScene({ footprint: new Float64Array(6) } as object), { name: 'UnknownKey', key: 'footprint' });
});
