// The wood ears' scene without a browser: links, attributes, what crosses from the worker, footprints, picking, logs from files.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Document, WebIO } from '@gltf-transform/core';
import { propertyOf } from '../../www/element/attribute-reader.ts';
import { subjectCamera } from '../../www/scene/camera/subject.ts';
import type { WoodEarColony, WoodEarLog } from '../../www/data/colony.ts';
import { randomWoodEars } from '../../www/wood-ear/controls/randomise.ts';
import { RockFieldError } from '../../www/base/errors.ts';
import { footprintOf } from '../../www/wood-ear/footprint.ts';
import { LoopHost } from '../../www/generator/host.ts';
import { RunLoop } from '../../www/generator/loop.ts';
import type { FromWorker } from '../../www/generator/protocol.ts';
import type { RunOptions } from '../../www/generator/session.ts';
import { woodEarLoop } from '../../www/wood-ear/session.ts';
import { readLogFile } from '../../www/wood-ear/log-file/read.ts';
import { firstHit, project, rayThrough } from '../../www/scene/camera/pick.ts';
import { same } from '../../www/table/table.ts';
import { readWoodEarAttributes } from '../../www/wood-ear/attributes.ts';
import { woodEarLook } from '../../www/wood-ear/look.ts';
import { encodeColony, flatColony } from '../../www/wood-ear/request.ts';
import { decodeWoodEarLink, encodeWoodEarLink } from '../../www/wood-ear/link.ts';
import { colonyRequest, groundOf, WOOD_EARS } from '../../www/wood-ear/table.ts';
import type { WoodEarSceneParams } from '../../www/wood-ear/table.ts';

const PRESETS = WOOD_EARS.presets.map(({ name }) => name);

// The ground.

test('no snow and no water of the ground is drawn round a log', () => {
  for (const preset of ['first-snow', 'mountain-stream'] as const) {
    const params = { ...WOOD_EARS.presetParams(PRESETS[0]!), ground: groundOf(preset, 3) };
    const { snow, water } = woodEarLook(params);
    assert.deepEqual({ snow, water }, { snow: 0, water: 0 });
  }
});

// Links.

test('every preset is a link of its name alone, and comes back', () => {
  for (const preset of PRESETS) {
    const params = WOOD_EARS.presetParams(preset);
    const link = encodeWoodEarLink({ params, preset, view: '3d', color: null, camera: null });
    assert.equal(link, `v=1&preset=${preset}`);
    assert.deepEqual(decodeWoodEarLink(link), { params, preset, view: '3d', color: null, camera: null, notices: [] });
  }
});

test('what is edited comes back from a link: every row, bases more or fewer, the ground, view, colour and camera', () => {
  for (let seed = 0; seed < 60; seed += 1) {
    const preset = PRESETS[seed % PRESETS.length]!;
    let params = randomWoodEars(WOOD_EARS.presetParams(preset), { seed, preset });
    for (const row of WOOD_EARS.rows) {
      const other =
        row.kind === 'choice'
          ? row.choices[seed % row.choices.length]!.value
          : Math.max(row.min, Math.min(row.max, (row.default ?? 0) + row.step * (seed % 3)));
      if (seed % 4 === 0) params = WOOD_EARS.written(params, row, other);
    }
    const bases = Array.from({ length: 1 + (seed % 16) }, (_, k) => ({
      position: [k * 1.5, -10 - k, 20] as [number, number, number],
      range: k % 2 ? null : 20 + k,
    }));
    params = { ...params, bases, ground: seed % 3 === 0 ? '' : groundOf('shingle', seed) };
    const state = {
      params,
      preset,
      view: 'wireframe' as const,
      color: 'plain' as const,
      camera: { azimuth: 1, elevation: 0.5, distance: 300, target: [1, 2, 3] as [number, number, number] },
    };
    const read = decodeWoodEarLink(`https://example.org/wood-ear.html#${encodeWoodEarLink(state)}`);
    assert.deepEqual(read.notices, []);
    assert.ok(same(WOOD_EARS, read.params, params));
    assert.deepEqual(read.params, params);
    assert.deepEqual([read.view, read.camera], [state.view, state.camera]);
  }
});

test('what is wrong with a link is named, and the rest is read', () => {
  const codes = (link: string) => decodeWoodEarLink(link).notices.map(({ code }) => code);
  assert.deepEqual(codes('#d=900'), ['clamped']);
  assert.deepEqual(codes('#preset=fig1'), ['unknown-preset']);
  assert.deepEqual(codes('#bx=1,2&by=3'), ['unequal-lists']);
  assert.deepEqual(codes('#bx='), ['unequal-lists']);
  assert.deepEqual(codes(`#bx=${Array(17).fill(1).join()}`), ['too-many-bases']);
  assert.deepEqual(codes('#co=never'), ['unknown-choice']);
  assert.deepEqual(codes(`#ground=${encodeURIComponent('preset=riverbed&cd=9')}`), ['clamped']);
  assert.deepEqual(decodeWoodEarLink('#d=900&m=20').params.moisture, 20);
});

test('no text makes reading throw', () => {
  for (const text of [
    '',
    '#',
    '#ground',
    '#ground=%',
    '#ground=#ground=#ground=',
    `#ground=${'x'.repeat(1e5)}`,
    '#bx=,,,',
    '#bx=NaN&by=Infinity',
    '#br=-,-',
  ]) {
    const { params } = decodeWoodEarLink(text);
    assert.ok(flatColony(colonyRequest(params), 1).params.length > 0, text);
  }
});

// Attributes.

const read = (given: Record<string, string>) => readWoodEarAttributes((name) => given[name] ?? null);

test('attributes: every row by its name, bases as a list, a ground by name, link or none', () => {
  assert.deepEqual(read({}).params, WOOD_EARS.presetParams(PRESETS[0]!));
  const { params, notices } = read({
    preset: 'wet-colony',
    'log-length': '120',
    collisions: 'thesis',
    bases: '0 -15 20, 60 -15 20 30',
    ground: 'shingle',
  });
  assert.deepEqual(notices, []);
  assert.deepEqual([params.log.length, params.collisions, params.ground], [120, 'thesis', groundOf('shingle')]);
  assert.deepEqual(params.bases, [
    { position: [0, -15, 20], range: null },
    { position: [60, -15, 20], range: 30 },
  ]);
  assert.equal(read({ preset: 'wet-colony', ground: 'none' }).params.ground, '');
  assert.equal(read({ ground: '#preset=scree&seed=4' }).params.ground, 'v=1&preset=scree&seed=4');
});

test('a malformed attribute is its default, or the nearest legal value, and exactly one notice that names it', () => {
  for (const [name, text] of Object.entries({ density: 'much', 'log-bend': '99', bases: '1 2', collisions: 'never', ground: '#cd=9' })) {
    const { notices, params } = read({ [name]: text });
    assert.equal(notices.length, 1, name);
    assert.ok(notices[0]!.message.startsWith(`${name}: `), notices[0]!.message);
    assert.doesNotThrow(() => WOOD_EARS.resolve(params));
  }
});

test('what is assigned is checked: key, value and bounds are named', () => {
  const params = WOOD_EARS.presetParams('wet-colony');
  for (const row of WOOD_EARS.rows.filter(({ kind }) => kind !== 'choice')) {
    assert.throws(
      () => WOOD_EARS.resolve(WOOD_EARS.written(params, row, row.max + 1)),
      ({ key, value, max }: RockFieldError) => key === row.key && value === row.max + 1 && max === row.max,
      propertyOf(row),
    );
  }
  assert.throws(() => WOOD_EARS.resolve({ ...params, ground: 3 } as unknown as WoodEarSceneParams), { name: 'WrongType', key: 'ground' });
  assert.throws(() => WOOD_EARS.resolve({ ...params, bases: [] }), { name: 'OutOfRange', key: 'bases' });
});

test('parameters written by row are flat as those asked for in words', () => {
  for (const preset of PRESETS) {
    const { ground: _, mesh: __, ...params } = WOOD_EARS.presetParams(preset);
    assert.deepEqual(encodeColony(params), flatColony({ preset }, 1).params);
  }
});

// From the worker.

function colonyOn(log: WoodEarLog, individuals: number): WoodEarColony {
  const none = { log: 0, spawn: 0, deform: 0, collide: 0, mesh: 0, total: 0 };
  return {
    positions: new Float32Array(3),
    normals: new Float32Array(3),
    indices: new Uint32Array(3),
    individualStarts: new Uint32Array(2),
    vertexStarts: new Uint32Array(2),
    foot: new Uint32Array(1),
    size: new Float32Array(1),
    base: new Uint8Array(1),
    log,
    bases: new Float64Array(3),
    stats: { individuals, triangles: 1, crossingPairs: 0, sweeps: 0, rounds: 0, keptMedian: 1, keptP10: 1, ms: none },
  };
}

const aLog = (): WoodEarLog => ({
  positions: new Float32Array(9),
  normals: new Float32Array(9),
  indices: new Uint32Array(3),
  kinds: new Uint8Array(3),
  coords: new Float32Array(6),
  turned: false,
  scale: 1,
});

test('a log crosses once, and again when it is another; its buffers stay with the worker', () => {
  const { pack } = woodEarLoop();
  const [one, other] = [aLog(), aLog()];
  const logs = [one, one, other, one].map((log) => {
    const { result, transfer } = pack(colonyOn(log, 1));
    assert.ok(transfer.every((buffer) => buffer !== log.positions.buffer));
    return (result as WoodEarColony).log;
  });
  assert.deepEqual(
    logs.map((log) => log !== null),
    [true, false, true, true],
  );
});

/** A host whose runs show a preview, then wait until they are told to end. */
function setUp() {
  const said: FromWorker[] = [];
  const ends: (() => void)[] = [];
  const log = aLog();
  const host = new LoopHost(
    async () => ({ fresh_seed: () => 7 }),
    (module, post) =>
      new RunLoop(
        module,
        {
          open: () => ({
            broken: false,
            free: () => {},
            run: (request: number, { signal, onPreview }: RunOptions<WoodEarColony, string>) =>
              new Promise<WoodEarColony>((resolve, reject) => {
                signal?.addEventListener('abort', () => reject(signal.reason as unknown));
                onPreview?.(colonyOn(log, -request));
                ends.push(() => resolve(colonyOn(log, request)));
              }),
          }),
          pack: (colony: WoodEarColony) => ({ result: colony.stats.individuals, transfer: [] }),
        },
        post,
      ),
    (message) => said.push(message),
  );
  const start = (id: number) => host.receive({ type: 'start', client: 1, id, request: id });
  const told = () =>
    said.flatMap((message) =>
      'id' in message ? [`${message.type} ${message.id}${'result' in message ? ` ${String(message.result)}` : ''}`] : [],
    );
  const settle = () => new Promise((resolve) => setTimeout(resolve, 0));
  return { start, ends, told, settle };
}

test('a preview comes before its result, and a run that has shown one gives way to a newer request at once', async () => {
  const { start, ends, told, settle } = setUp();
  start(1);
  await settle();
  start(2);
  await settle();
  start(3);
  await settle();
  ends.at(-1)!();
  await settle();
  assert.deepEqual(told(), ['preview 1 -1', 'dropped 1', 'preview 2 -2', 'dropped 2', 'preview 3 -3', 'result 3 3']);
});

// On the ground, and under the pointer.

test('a footprint is what of the log is low, from above, without what stands upright', () => {
  const log: WoodEarLog = {
    ...aLog(),
    positions: Float32Array.of(0, 0, 0, 10, 0, 0, 0, 10, 0, 0, 0, 50, 10, 0, 50, 0, 10, 50, 10, 0, 5),
    indices: Uint32Array.of(0, 1, 2, 3, 4, 5, 0, 1, 6),
  };
  assert.deepEqual([...footprintOf(log, [100, 200, 0, 2], 9)], [100, 200, 120, 200, 100, 220]);
  assert.deepEqual([...footprintOf(log, [0, 0, 20, 1], 9)], []);
});

test('what a ray meets first is where it is seen', () => {
  const camera = subjectCamera({ low: [0, 0, 0], high: [100, 40, 30] }, 1.5);
  // Two squares across the view, of which the nearer hides the other.
  const square = (y: number) => [-200, y, -200, 300, y, -200, 300, y, 300, -200, y, 300];
  const positions = Float32Array.from([...square(60), ...square(20)]);
  const indices = Uint32Array.of(0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7);
  for (const [x, y] of [
    [0, 0],
    [0.4, -0.3],
    [-0.7, 0.2],
  ] as const) {
    const hit = firstHit(rayThrough(camera, x, y, 1.5), positions, indices);
    assert.ok(hit && Math.abs(hit[1] - 20) < 1e-3);
    const [px, py] = project(camera, hit, 1.5)!;
    assert.ok(Math.hypot(px - x, py - y) < 1e-4);
  }
  assert.equal(project(camera, [camera.target[0] - 1e4 * Math.sin(camera.azimuth) * -1, -1e4, 1e4], 1.5), null);
});

test('a subject is in the picture whole, whatever the picture’s shape', () => {
  const [low, high] = [
    [-130, 100, 0],
    [140, 150, 40],
  ] as [[number, number, number], [number, number, number]];
  for (const aspect of [0.4, 0.75, 1, 1.6, 3]) {
    const camera = subjectCamera({ low, high }, aspect);
    for (let corner = 0; corner < 8; corner += 1) {
      const [x, y] = project(camera, low.map((value, k) => (corner & (1 << k) ? high[k]! : value)) as [number, number, number], aspect)!;
      assert.ok(Math.abs(x) <= 0.9 && Math.abs(y) <= 0.9, `${aspect}: ${x}, ${y}`);
    }
  }
});

// Files.

const file = (name: string, ...parts: BlobPart[]) => new File(parts, name);

async function glb(change: (positions: Float32Array) => void = () => {}): Promise<Uint8Array<ArrayBuffer>> {
  const document = new Document();
  const buffer = document.createBuffer();
  // A roof 1.2 m long, y up, its ridge doubled as by a seam.
  const positions = Float32Array.of(0, 0, 0, 1.2, 0, 0, 1.2, 0.3, 0.1, 0, 0.3, 0.1, 1.2, 0.3, 0.1, 0, 0.3, 0.1, 0, 0, 0.2, 1.2, 0, 0.2);
  change(positions);
  const position = document.createAccessor().setType('VEC3').setArray(positions).setBuffer(buffer);
  const indices = document
    .createAccessor()
    .setType('SCALAR')
    .setArray(Uint16Array.of(0, 1, 2, 0, 2, 3, 5, 4, 7, 5, 7, 6))
    .setBuffer(buffer);
  const primitive = document.createPrimitive().setAttribute('POSITION', position).setIndices(indices);
  const node = document.createNode().setMesh(document.createMesh().addPrimitive(primitive)).setTranslation([5, 5, 5]);
  document.createScene().addChild(node);
  return (await new WebIO().writeBinary(document)) as Uint8Array<ArrayBuffer>;
}

test('a GLB file is in centimetres, z up, along x, centred, and whole across its seams', async () => {
  const { mesh, notices } = await readLogFile(file('roof.glb', await glb()));
  assert.deepEqual(notices, []);
  assert.equal(mesh.positions.length / 3, 6);
  assert.equal(mesh.indices.length / 3, 4);
  const axis = (k: number) => mesh.positions.filter((_, i) => i % 3 === k);
  const span = (k: number) => [Math.min(...axis(k)), Math.max(...axis(k))].map((value) => Math.round(value * 10) / 10);
  assert.deepEqual(
    [span(0), span(1), span(2)],
    [
      [-60, 60],
      [-10, 10],
      [-15, 15],
    ],
  );
});

test('an OBJ file may have quads, negative indices, comments and no faces’ normals; one in other units is scaled, which is said', async () => {
  const obj = '# planks\nv 0 0 0\nv 0 0 3\nv 0 1 3\nv 0 1 0\nv 1 0 0\nf 1 2 3 4\nf -1 -5 -4\n';
  const { mesh, notices } = await readLogFile(file('planks.obj', obj));
  assert.equal(mesh.indices.length / 3, 3);
  assert.equal(mesh.positions.length / 3, 5);
  assert.match(notices[0]!.en, /planks\.obj is 3 cm long; it is shown 200 cm long/);
  const along = mesh.positions.filter((_, i) => i % 3 === 0);
  assert.deepEqual([Math.min(...along), Math.max(...along)], [-100, 100]);
});

test('whatever else a file is, it is refused by name and nothing hangs', async () => {
  const whole = await glb();
  const cases: [File, string][] = [
    [file('empty.obj'), 'LogFileUnknown'],
    [file('words.txt', 'v'), 'LogFileUnknown'],
    [file('page.glb', '<!doctype html><title>404</title>'), 'LogFileUnknown'],
    [file('points.obj', 'v 0 0 0\nv 1 0 0\n'), 'LogFileNoMesh'],
    [file('far.obj', 'v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 9\n'), 'LogFileBroken'],
    [file('letters.obj', 'v a b c\nv 1 0 0\nv 1 1 0\nf 1 2 3\n'), 'LogFileBroken'],
    [file('half.glb', whole.slice(0, whole.length / 2)), 'LogFileBroken'],
    [file('head.glb', whole.slice(0, 12)), 'LogFileBroken'],
    [file('nowhere.glb', await glb((positions) => (positions[3] = NaN))), 'LogFileBroken'],
    [file('flat.glb', await glb((positions) => positions.fill(1))), 'LogNoArea'],
  ];
  for (const [given, name] of cases) await assert.rejects(readLogFile(given), { name, key: 'log' }, given.name);
  const huge = file('huge.obj', 'v 0 0 0');
  Object.defineProperty(huge, 'size', { value: 2 ** 30 });
  await assert.rejects(readLogFile(huge), { name: 'LogFileTooLarge' });
  // Any byte may be wrong, anywhere.
  let state = 1;
  for (let round = 0; round < 300; round += 1) {
    const bytes = whole.slice();
    for (let k = 0; k < 4; k += 1) {
      state = (Math.imul(state, 1_103_515_245) + 12_345) >>> 0;
      bytes[state % bytes.length] = state >>> 24;
    }
    await readLogFile(file('bent.glb', bytes)).catch((thrown: unknown) =>
      assert.ok(thrown instanceof RockFieldError && thrown.name.startsWith('LogFile'), String(thrown)),
    );
  }
});
