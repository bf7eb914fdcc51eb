// rock-field/three, without a browser: what is in the group, and what becomes of it. tests/hosts draws it.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { WebIO } from '@gltf-transform/core';
import * as THREE from 'three';
import { exportScene } from 'rock-field/export';
import type { ExportOptions } from 'rock-field/export';
import { RockField } from 'rock-field/three';
import type { RockFieldOptions } from 'rock-field/three';
import { KEPT_MS, workers } from '../../www/three/in-workers.ts';
import { levelFor, limitOf } from '../../www/three/levels.ts';
import { OPTION_KEYS, resolve } from '../../www/three/options.ts';
import { checkRevision, FIRST_REVISION } from '../../www/three/revision.ts';
import packageJson from '../../package.json' with { type: 'json' };

const REQUEST = { preset: 'riverbed', seed: 7, imageWidth: 96, imageHeight: 64 } as const;

const fieldOf = (options: RockFieldOptions = {}): RockField => new RockField({ ...REQUEST, ...options });

/** The one child of this type. */
function child<Kind extends THREE.Object3D>(group: THREE.Group, isOfKind: (object: THREE.Object3D) => boolean): Kind {
  const found = group.children.filter(isOfKind);
  assert.equal(found.length, 1);
  return found[0] as Kind;
}

const batchIn = (group: THREE.Group): THREE.BatchedMesh =>
  child<THREE.BatchedMesh>(group, (object) => (object as THREE.BatchedMesh).isBatchedMesh === true);

/** The corners of the triangles between `start` and `start + count` of a geometry's indices. */
function corners(geometry: THREE.BufferGeometry, name: string, { start, count } = { start: 0, count: Infinity }): number[] {
  const attribute = geometry.getAttribute(name);
  const index = geometry.getIndex()!;
  const found: number[] = [];
  for (let i = start; i < Math.min(start + count, index.count); i++)
    for (let part = 0; part < 3; part++) found.push(attribute.getComponent(index.getX(i), part));
  return found;
}

/** By the name of each node that has a mesh: the corners of its triangles, primitive by primitive, and its matrix. */
async function fileOf(options: ExportOptions) {
  const document = await new WebIO().readBinary((await exportScene(REQUEST, options)).bytes);
  const nodes = document.getRoot().listNodes();
  return new Map(
    nodes.flatMap((node) => {
      const primitives = node.getMesh()?.listPrimitives();
      if (!primitives) return [];
      const read = (semantic: string): number[] =>
        primitives.flatMap((primitive) => {
          const attribute = primitive.getAttribute(semantic)!;
          return Array.from(primitive.getIndices()!.getArray()!, (v: number) => attribute.getElement(v, []).slice(0, 3)).flat();
        });
      const color = primitives[0]!.getMaterial()!.getBaseColorFactor().slice(0, 3);
      return [[node.getName(), { read, color, matrix: node.getWorldMatrix() }]];
    }),
  );
}

test('a mesh for each layer has the corners, normals and colours of the exported file, in this order', async () => {
  const options = { groundMesh: 'cut', belowGround: 'cut' } as const;
  const group = await fieldOf(options).build();
  const file = await fileOf({ target: 'three', ...options, vertexColors: true });
  assert.deepEqual(
    group.children.map(({ name }) => name),
    [...file.keys()],
  );
  for (const mesh of group.children as THREE.Mesh[]) {
    const { read } = file.get(mesh.name)!;
    for (const [name, semantic] of [
      ['position', 'POSITION'],
      ['normal', 'NORMAL'],
      ['color', 'COLOR_0'],
    ] as const)
      assert.deepEqual(corners(mesh.geometry, name), read(semantic), `${semantic} of ${mesh.name}`);
  }
});

test('rocks of a batch have the shapes, places and colours of the objects in the exported file, at each level of detail', async () => {
  const group = await fieldOf({ mesh: 'rocks', groundMesh: 'whole' }).build();
  const batch = batchIn(group);
  const file = await fileOf({ mesh: 'rocks', lods: 3, groundMesh: 'whole' });
  const ground = child<THREE.Mesh>(group, ({ name }) => name === 'ground');
  assert.deepEqual(corners(ground.geometry, 'position'), file.get('ground_LOD0')!.read('POSITION'));
  const [matrix, color] = [new THREE.Matrix4(), new THREE.Color()];
  assert.deepEqual((ground.material as THREE.MeshStandardMaterial).color.toArray(), file.get('ground_LOD0')!.color);
  for (let rock = 0; rock < batch.instanceCount; rock++) {
    const finest = batch.getGeometryIdAt(rock);
    for (const level of [0, 1, 2]) {
      const { read, matrix: placed, color: painted } = file.get(`rock-${rock + 1}_LOD${level}`)!;
      const range = batch.getGeometryRangeAt(finest + level)!;
      assert.deepEqual(corners(batch.geometry, 'position', range), read('POSITION'), `rock ${rock + 1}, level ${level}`);
      assert.deepEqual(batch.getMatrixAt(rock, matrix).toArray(), Array.from(placed, Math.fround));
      batch.getColorAt(rock, color);
      assert.deepEqual(color.toArray(), painted.map(Math.fround));
    }
  }
});

test('rocks of a kit are placed, turned and stretched as in the exported file, and those of a shape follow each other', async () => {
  const field = fieldOf({ mesh: 'kit', kinds: 3, lods: 1 });
  const batch = batchIn(await field.build());
  const file = await fileOf({ mesh: 'kit', kinds: 3 });
  const matrix = new THREE.Matrix4();
  const shapes = Array.from({ length: batch.instanceCount }, (_, at) => batch.getGeometryIdAt(at));
  assert.deepEqual(
    shapes,
    shapes.toSorted((a, b) => a - b),
  );
  for (const [at, shape] of shapes.entries()) {
    const { id } = field.rockOf({ object: batch, batchId: at, face: null })!;
    const { read, matrix: placed } = file.get(`rock-${id}`)!;
    assert.deepEqual(corners(batch.geometry, 'position', batch.getGeometryRangeAt(shape)!), read('POSITION'));
    for (const [k, value] of batch.getMatrixAt(at, matrix).toArray().entries())
      assert.ok(Math.abs(value - placed[k]!) < 1e-6, `rock ${id}: ${matrix.toArray()}`);
  }
});

test('a group says where its scene comes from, and its meshes which layer they are', async () => {
  const field = fieldOf();
  const group = await field.build();
  const { link, hash, metresPerPixel } = group.userData as Record<string, unknown>;
  assert.equal(metresPerPixel, 0.01);
  assert.match(String(link), /preset=riverbed/);
  assert.match(String(hash), /^[0-9a-f]{64}$/);
  assert.deepEqual(
    group.children.map(({ userData }) => userData.layer),
    group.children.map((_, layer) => layer),
  );
  const size = new THREE.Box3().setFromObject(group).getSize(new THREE.Vector3());
  assert.ok(size.x > 0.5 && size.x < 1.5 && size.z > 0.4 && size.z < 1.1 && size.y > 0.01 && size.y < 0.3, `metres: ${size.toArray()}`);
});

test('a ray from above meets the same rock in every form', async () => {
  const ray = new THREE.Raycaster(new THREE.Vector3(), new THREE.Vector3(0, -1, 0));
  const found = [];
  for (const mesh of ['one', 'rocks', 'kit'] as const) {
    const field = fieldOf({ mesh, kinds: 256, groundMesh: 'whole' });
    const group = await field.build();
    group.updateMatrixWorld(true);
    // Above the middle of the largest rock.
    const largest = await fieldOf({ mesh: 'rocks' }).build();
    ray.ray.origin.setFromMatrixPosition(batchIn(largest).getMatrixAt(0, new THREE.Matrix4())).setY(5);
    const hits = ray.intersectObject(group);
    found.push(field.rockOf(hits[0]!));
    assert.equal(field.rockOf(hits.find(({ object }) => object.name === 'ground')!), null);
    assert.equal(fieldOf().rockOf(hits[0]!), null);
  }
  assert.deepEqual(found, [found[0], found[0], found[0]]);
  assert.equal(found[0]?.id, 1);
});

/** Draws a batch without a device. */
function look(batch: THREE.BatchedMesh, camera: THREE.Camera, height = 1000): void {
  camera.updateMatrixWorld(true);
  batch.updateWorldMatrix(true, false);
  const renderer = { getRenderTarget: () => null, getDrawingBufferSize: (size: THREE.Vector2) => size.set(height, height) };
  batch.onBeforeRender(renderer as never, new THREE.Scene(), camera, batch.geometry, batch.material as THREE.Material, undefined as never);
}

const levelsOf = (batch: THREE.BatchedMesh): number[] =>
  Array.from({ length: batch.instanceCount }, (_, rock) => batch.getGeometryIdAt(rock) % 3);

test('rocks are drawn with fewer triangles the smaller they are on the screen, whatever the scale of the scene', async () => {
  const mixed: number[][] = [];
  for (const scale of [1, 100]) {
    const group = await fieldOf({ mesh: 'rocks' }).build();
    group.scale.setScalar(scale);
    const batch = batchIn(group);
    const camera = new THREE.PerspectiveCamera(50, 1, 0.01, 1e6);
    camera.position.set(0, 0.05 * scale, 0);
    look(batch, camera);
    const near = levelsOf(batch);
    assert.ok(near.includes(0), 'the nearest is fine');
    camera.position.set(0, 100 * scale, 0);
    look(batch, camera);
    assert.deepEqual(new Set(levelsOf(batch)), new Set([2]));
    camera.position.set(0, 0.05 * scale, 0);
    look(batch, camera);
    assert.ok(levelsOf(batch).every((level, rock) => level <= near[rock]! + 1));
    const flat = new THREE.OrthographicCamera(-scale, scale, scale, -scale, 0, 1000 * scale);
    flat.position.set(0, 10 * scale, 0);
    look(batch, flat, 100_000);
    assert.deepEqual(new Set(levelsOf(batch)), new Set([0]));
    look(batch, flat, 400);
    mixed.push(levelsOf(batch));
    look(batch, flat, 10);
    assert.deepEqual(new Set(levelsOf(batch)), new Set([2]));
  }
  assert.deepEqual(mixed[0], mixed[1]);
  assert.ok(new Set(mixed[0]).size > 1, `levels ${mixed[0]}`);
});

test('shadows are those of the levels that are seen: the camera of a light chooses none', async () => {
  const batch = batchIn(await fieldOf({ mesh: 'rocks' }).build());
  const camera = new THREE.PerspectiveCamera(50, 1, 0.01, 1e6);
  camera.position.set(0, 100, 0);
  look(batch, camera);
  const light = new THREE.OrthographicCamera(-0.01, 0.01, 0.01, -0.01);
  const [object, material] = [new THREE.Scene(), batch.material as THREE.Material];
  batch.onBeforeShadow({} as never, object, camera, light, batch.geometry, material, undefined as never);
  // As WebGPURenderer does then.
  look(batch, light, 100_000);
  assert.deepEqual(new Set(levelsOf(batch)), new Set([2]));
});

test('a level holds on: what takes a rock to the next does not take it back', () => {
  const limits = [500, 40, 40, 10, 4].map(limitOf);
  const found = new Set<number>();
  for (let pixels = 1; pixels < 300; pixels += 0.5) {
    for (const present of limits.keys()) {
      const level = levelFor(pixels, present, limits);
      found.add(level);
      assert.equal(levelFor(pixels, level, limits), level);
      for (const near of [0.9, 1.1]) {
        const moved = levelFor(pixels * near, level, limits);
        if (moved !== level)
          assert.equal(levelFor(pixels, moved, limits), moved, `${pixels} px: ${present} → ${level} → ${moved} and back`);
      }
    }
  }
  assert.deepEqual([...found].sort(), [0, 1, 2, 3, 4]);
});

test('after dispose() the group is empty, and every geometry and material of its own has been freed', async () => {
  const mine = new THREE.MeshBasicMaterial();
  for (const options of [{ groundMesh: 'cut' }, { mesh: 'rocks', groundMesh: 'cut' }, { mesh: 'kit', material: mine }] as const) {
    const field = fieldOf(options);
    const group = await field.build();
    const own = new THREE.Object3D();
    group.add(own);
    const meshes = group.children.filter((object) => object !== own) as THREE.Mesh[];
    const held = new Set([...meshes.map(({ geometry }) => geometry), ...meshes.map(({ material }) => material as THREE.Material)]);
    const freed = new Set<unknown>();
    for (const one of held) (one as THREE.BufferGeometry).addEventListener('dispose', () => freed.add(one));
    field.dispose();
    held.delete(mine);
    assert.deepEqual(freed, held);
    assert.deepEqual([group.children, group.userData], [[own], {}]);
    // As in three's own generators, it can be built again.
    assert.equal((await field.build()).children.length, meshes.length + 1);
  }
});

test('another build takes the place of the one before, in the same group; what is refused leaves it as it was', async () => {
  const field = fieldOf();
  const group = await field.build();
  const [before, { hash }] = [[...group.children], group.userData];
  const cases = [
    [{ seed: -1 }, 'OutOfRange', 'seed'],
    [{ mesh: 'one', lods: 2 }, 'ExportImpossible', 'lods'],
    [{ mesh: 'points' }, 'ExportImpossible', 'mesh'],
    [{ mesh: 'kit', groundMesh: 'cut' }, 'ExportImpossible', 'groundMesh'],
    [{ metresPerPixel: 0 }, 'OutOfRange', 'metresPerPixel'],
    [{ colour: 'natural' }, 'UnknownKey', 'colour'],
    [{ preset: 'river bed' }, 'UnknownPreset', 'preset'],
    [{ material: { color: 'red' } }, 'WrongType', 'material'],
    [{ lods: 9, mesh: 'kit' }, 'OutOfRange', 'lods'],
  ] as const;
  for (const [wrong, name, key] of cases) {
    Object.assign(field.parameters, wrong);
    await assert.rejects(field.build(), { name, key });
    for (const option of Object.keys(wrong)) delete (field.parameters as Record<string, unknown>)[option];
    Object.assign(field.parameters, REQUEST);
    assert.deepEqual(group.children, before);
  }
  assert.equal(await field.setSeed(8).build(), group);
  assert.ok(group.children.every((mesh) => !before.includes(mesh)));
  assert.notEqual(group.userData.hash, hash);
});

test('a build ends with an AbortError when the field is disposed of, a newer one begins, or its signal says so', async (t) => {
  // Every slice is over at once, so that there is progress to hear of.
  let now = 0;
  t.mock.method(performance, 'now', () => (now += 20));
  const field = fieldOf();
  const first = field.build();
  const second = field.setSeed(8).build();
  await assert.rejects(first, { name: 'AbortError' });
  await second;
  const controller = new AbortController();
  const third = field.setMesh('rocks').build({ signal: controller.signal, onProgress: () => controller.abort() });
  await assert.rejects(third, { name: 'AbortError' });
  assert.equal(field.group.userData.link, 'v=1&preset=riverbed&seed=8&w=96&h=64');
  for (const stage of ['mesh', 'scene'] as const) {
    const late = fieldOf({ mesh: 'rocks' });
    await assert.rejects(late.build({ onProgress: (progress) => progress.stage === stage && late.dispose() }), { name: 'AbortError' });
    assert.deepEqual(late.group.children, []);
  }
});

test('progress goes up to the last stage, in which the meshes are made', async (t) => {
  let now = 0;
  t.mock.method(performance, 'now', () => (now += 20));
  const told: { stage: string; fraction: number }[] = [];
  await fieldOf({ mesh: 'rocks' }).build({ onProgress: (progress) => told.push(progress) });
  assert.ok(told.every(({ fraction }, k) => fraction <= 1 && (k === 0 || fraction >= told[k - 1]!.fraction)));
  assert.equal(told.at(-1)?.stage, 'scene');
});

test('a worker keeps the stages of a run for the next one, and is left when there is none for a while, or the field is disposed of', async (t) => {
  t.mock.timers.enable({ apis: ['setTimeout'] });
  const told: string[] = [];
  let clients = 0;
  let fail = (): void => {};
  const grower = workers(() => {
    const name = `client ${++clients}`;
    return {
      generate: () => {
        told.push(`${name} generates`);
        return new Promise((_, reject) => {
          fail = () => reject(new Error('no field'));
        });
      },
      dispose: () => told.push(`${name} ends`),
    };
  });
  const grow = async (ms: number): Promise<void> => {
    const run = grower.grow(resolve(REQUEST), {});
    t.mock.timers.tick(10 * KEPT_MS);
    fail();
    await assert.rejects(run, /no field/);
    t.mock.timers.tick(ms);
  };
  await grow(KEPT_MS - 1);
  await grow(KEPT_MS);
  await grow(0);
  grower.dispose();
  t.mock.timers.tick(KEPT_MS);
  assert.deepEqual(told, ['client 1 generates', 'client 1 generates', 'client 1 ends', 'client 2 generates', 'client 2 ends']);
});

test('there is a method for every parameter and option', async () => {
  const field = new RockField() as unknown as Record<string, (value: unknown) => { parameters: Record<string, unknown> }>;
  for (const key of OPTION_KEYS) {
    const name = `set${key[0]!.toUpperCase()}${key.slice(1)}`;
    assert.equal(field[name]!('x').parameters[key], 'x', name);
  }
});

test('an older three.js is refused by name, with the revision that is needed: the one of package.json', () => {
  for (const revision of ['125', '168', '168dev', undefined])
    assert.throws(() => checkRevision(revision ?? 'none'), { name: 'ThreeUnsuitable', min: FIRST_REVISION });
  for (const revision of [THREE.REVISION, '169', '200dev']) checkRevision(revision);
  assert.equal(packageJson.peerDependencies.three, `>=0.${FIRST_REVISION}.0`);
});
