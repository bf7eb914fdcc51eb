// glTF and GLB files: nodes, strips, packed and quantized positions are read, and what a file promises is checked before anything is made of it.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { MeshoptEncoder } from 'meshoptimizer';
import type { LogMesh } from '../../www/wood-ear/log-mesh.ts';
import { given, meshOf, refusal, sides, stored, triangles } from './log-files.ts';

/** Six times the volume that the triangles enclose: its sign tells whether they face outwards. */
function volume({ positions: p, indices }: LogMesh): number {
  let sum = 0;
  for (let i = 0; i < indices.length; i += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => 3 * indices[i + k]!) as [number, number, number];
    sum +=
      p[a]! * (p[b + 1]! * p[c + 2]! - p[b + 2]! * p[c + 1]!) +
      p[a + 1]! * (p[b + 2]! * p[c]! - p[b]! * p[c + 2]!) +
      p[a + 2]! * (p[b]! * p[c + 1]! - p[b + 1]! * p[c]!);
  }
  return sum;
}

interface Json {
  [key: string]: unknown;
}

function glbOf(json: Json, binary: Uint8Array = new Uint8Array()): Uint8Array<ArrayBuffer> {
  const text = new TextEncoder().encode(JSON.stringify(json));
  const padded = (bytes: Uint8Array, fill: number) =>
    Uint8Array.from([...bytes, ...Array<number>((4 - (bytes.length % 4)) % 4).fill(fill)]);
  const [description, body] = [padded(text, 32), padded(binary, 0)];
  const head = (...values: number[]) => new Uint8Array(Uint32Array.from(values).buffer);
  const length = 12 + 8 + description.length + (body.length > 0 ? 8 + body.length : 0);
  return Uint8Array.from([
    ...head(0x4654_6c67, 2, length),
    ...head(description.length, 0x4e4f_534a),
    ...description,
    ...(body.length > 0 ? [...head(body.length, 0x004e_4942), ...body] : []),
  ]);
}

const CORNERS = Float32Array.of(0, 0, 0, 1.2, 0, 0, 1.2, 0.3, 0.1, 0, 0.3, 0.1);
const scene = (changes: Json = {}): Json => ({
  asset: { version: '2.0' },
  scene: 0,
  scenes: [{ nodes: [0] }],
  nodes: [{ mesh: 0 }],
  meshes: [{ primitives: [{ attributes: { POSITION: 0 } }] }],
  accessors: [{ bufferView: 0, componentType: 5126, count: 3, type: 'VEC3' }],
  bufferViews: [{ buffer: 0, byteLength: 48 }],
  buffers: [{ byteLength: 48 }],
  ...changes,
});
const bytes = new Uint8Array(CORNERS.buffer);

test('a mirrored node leaves its surface facing outwards', async () => {
  const mirrored = await meshOf(stored('F01-negative-scale.glb'));
  const plain = await meshOf(stored('F06-external-image.glb'));
  assert.ok(volume(plain) > 0);
  assert.ok(Math.abs(volume(mirrored) - volume(plain)) < 1e-3 * volume(plain));
});

test('a vertex that no triangle uses decides neither size nor direction', async () => {
  const [length, width, height] = sides(await meshOf(stored('F05-unused-vertex.glb')));
  assert.deepEqual(
    [length, width, height].map((side) => Math.round(side!)),
    [120, 20, 30],
  );
});

for (const name of ['F06-external-image.glb', 'F06-required-texture-extension.glb', 'F06-quantized.glb']) {
  test(`${name}: materials, textures and pictures are no reason to refuse a file, and quantized positions are read`, async () => {
    const mesh = await meshOf(stored(name));
    assert.deepEqual(sides(mesh).map(Math.round), [120, 20, 30]);
    assert.deepEqual(mesh.indices.length / 3, 12);
  });
}

test('a strip becomes triangles that all face the same way', async () => {
  const { positions: p, indices } = await meshOf(stored('F11-strip.glb'));
  assert.equal(indices.length / 3, 12);
  // It is a flat ribbon.
  const ups = Array.from({ length: 12 }, (_, t) => {
    const [a, b, c] = [0, 1, 2].map((k) => 3 * indices[3 * t + k]!) as [number, number, number];
    return Math.sign((p[b]! - p[a]!) * (p[c + 1]! - p[a + 1]!) - (p[b + 1]! - p[a + 1]!) * (p[c]! - p[a]!));
  });
  assert.deepEqual(new Set(ups).size, 1, ups.join());
});

const VIEW = { bufferView: 0, componentType: 5126, type: 'VEC3' };

/** What a file changes of `scene`, the name of the error, and what is said. */
const PROMISES: [Json, string, RegExp][] = [
  [{ accessors: [{ ...VIEW, count: 1e7 }] }, 'LogFileBroken', /accessors\[0\] has 10000000 elements/],
  [{ accessors: [{ ...VIEW, count: 100 }] }, 'LogFileBroken', /accessors\[0\] has 100 elements/],
  [{ accessors: [{ componentType: 5126, type: 'VEC3', count: 9e8 }] }, 'LogTooLarge', /900000000/],
  [
    {
      accessors: [
        { ...VIEW, count: 3, sparse: { count: 1e7, indices: { bufferView: 0, componentType: 5121 }, values: { bufferView: 0 } } },
      ],
    },
    'LogFileBroken',
    /accessors\[0\]\.sparse\.indices/,
  ],
  [
    {
      accessors: [
        {
          ...VIEW,
          count: 3,
          sparse: { count: 1, indices: { bufferView: 0, componentType: 5125, byteOffset: 12 }, values: { bufferView: 0 } },
        },
      ],
    },
    'LogFileBroken',
    /name element \d+ of 3/,
  ],
  [{ accessors: [{ ...VIEW, count: -1 }] }, 'LogFileBroken', /count of accessors\[0\]/],
  [{ accessors: [{ ...VIEW, count: 3, byteOffset: 40 }] }, 'LogFileBroken', /accessors\[0\]/],
  [{ accessors: [{ ...VIEW, count: 3, componentType: 5125 }] }, 'LogFileBroken', /does not fit/],
  [{ bufferViews: [{ buffer: 0, byteLength: 4800 }] }, 'LogFileBroken', /bufferViews\[0\] ends at byte 4800/],
  [{ bufferViews: [{ buffer: 0, byteLength: 48, byteStride: 4 }] }, 'LogFileBroken', /accessors\[0\]/],
  [{ buffers: [{ byteLength: 1e9 }] }, 'LogFileBroken', /buffers\[0\] has/],
  [{ nodes: [{ mesh: 0, children: [0] }] }, 'LogFileBroken', /nodes\[0\] is the child/],
  [{ nodes: [{ mesh: 7 }] }, 'LogFileBroken', /no meshes\[7\]/],
  [{ nodes: [{ mesh: 0, scale: [1, 1] }] }, 'LogFileBroken', /scale of nodes\[0\]/],
  [{ scenes: 3 }, 'LogFileBroken', /scenes is not a list/],
  [
    {
      bufferViews: [
        {
          buffer: 0,
          byteLength: 48,
          extensions: { EXT_meshopt_compression: { buffer: 0, byteLength: 48, byteStride: 256, count: 1e7, mode: 'ATTRIBUTES' } },
        },
      ],
    },
    'LogFileTooLarge',
    /unpacks to/,
  ],
  [
    {
      bufferViews: [
        {
          buffer: 0,
          byteLength: 48,
          extensions: { EXT_meshopt_compression: { buffer: 0, byteLength: 48, byteStride: 12, count: 3, mode: 'ATTRIBUTES' } },
        },
      ],
    },
    'LogFileBroken',
    /cannot be unpacked/,
  ],
];

test('what a GLB file promises is compared with what it holds before anything is made of it', async () => {
  for (const [changes, expected, words] of PROMISES) {
    const { name, message, words: said } = await refusal(given('log.glb', glbOf(scene(changes), bytes)));
    assert.equal(name, expected, message);
    assert.match(message, words);
    assert.doesNotMatch(said!.ja, /\b(is|of|has|not|names|cannot)\b/, 'there are English pieces in the Japanese words');
  }
  // As many nodes as there are may show one mesh.
  const nodes = Array.from({ length: 1000 }, () => ({ mesh: 0 }));
  const primitives = Array.from({ length: 1000 }, () => ({ attributes: { POSITION: 0 } }));
  assert.equal(
    (
      await refusal(
        given('many.glb', glbOf(scene({ nodes, scenes: [{ nodes: nodes.map((_, k) => k) }], meshes: [{ primitives }] }), bytes)),
      )
    ).name,
    'LogTooLarge',
  );
});

test('geometry that cannot be read is refused with the true reason and what helps', async () => {
  const cases: [string, Json, RegExp][] = [
    [
      'draco.glb',
      {
        accessors: [{ componentType: 5126, count: 3, type: 'VEC3' }],
        meshes: [
          {
            primitives: [
              { attributes: { POSITION: 0 }, extensions: { KHR_draco_mesh_compression: { bufferView: 0, attributes: { POSITION: 0 } } } },
            ],
          },
        ],
        extensionsRequired: ['KHR_draco_mesh_compression'],
      },
      /Draco; save it without, or with meshopt/,
    ],
    ['beside.glb', { buffers: [{ byteLength: 48, uri: 'scene.bin' }] }, /another file, scene\.bin; save it as one GLB file/],
    ['old.glb', { asset: { version: '1.0' } }, /glTF 1\.0; save it as glTF 2\.0/],
    [
      'coded.glb',
      { bufferViews: [{ buffer: 0, byteLength: 48, extensions: { ACME_packed: {} } }], extensionsRequired: ['ACME_packed'] },
      /extension ACME_packed/,
    ],
  ];
  for (const [file, changes, words] of cases) {
    const { name, message } = await refusal(given(file, glbOf(scene(changes), bytes)));
    assert.equal(name, 'LogFileUnsupported', message);
    assert.match(message, words);
  }
});

test('a glTF file with its buffers in it is read, with a mark of UTF-8 too', async () => {
  const uri = `data:application/octet-stream;base64,${Buffer.from(bytes).toString('base64')}`;
  const json = JSON.stringify(scene({ buffers: [{ byteLength: 48, uri }] }));
  const plain = triangles(await meshOf(given('log.glb', glbOf(scene(), bytes))));
  for (const text of [json, `\ufeff${json}`, ` \n${json}`]) assert.deepEqual(triangles(await meshOf(given('log.gltf', text))), plain);
});

test('positions packed by meshopt are read, under both names', async () => {
  await MeshoptEncoder.ready;
  const packed = MeshoptEncoder.encodeGltfBuffer(bytes, 4, 12, 'ATTRIBUTES');
  for (const name of ['EXT_meshopt_compression', 'KHR_meshopt_compression']) {
    const extension = { buffer: 0, byteLength: packed.length, byteStride: 12, count: 4, mode: 'ATTRIBUTES' };
    const json = scene({
      accessors: [{ bufferView: 0, componentType: 5126, count: 3, type: 'VEC3' }],
      bufferViews: [{ buffer: 1, byteLength: 48, extensions: { [name]: extension } }],
      buffers: [{ byteLength: packed.length }, { byteLength: 48, extensions: { [name]: { fallback: true } } }],
      extensionsUsed: [name],
      extensionsRequired: [name],
    });
    assert.deepEqual(
      triangles(await meshOf(given('packed.glb', glbOf(json, packed)))),
      triangles(await meshOf(given('log.glb', glbOf(scene(), bytes)))),
    );
  }
});

test('a skinned mesh ignores its node’s transform, a hidden node is not read, instances are', async () => {
  const plain = triangles(await meshOf(given('log.glb', glbOf(scene(), bytes))));
  const skinned = scene({ nodes: [{ mesh: 0, skin: 0, scale: [1, -1, 3] }], skins: [{ joints: [0] }] });
  assert.deepEqual(triangles(await meshOf(given('skin.glb', glbOf(skinned, bytes)))), plain);
  const hidden = scene({
    nodes: [{ mesh: 0 }, { mesh: 0, scale: [9, 9, 9], extensions: { KHR_node_visibility: { visible: false } } }],
    scenes: [{ nodes: [0, 1] }],
  });
  assert.deepEqual(triangles(await meshOf(given('hidden.glb', glbOf(hidden, bytes)))), plain);
  const instanced = scene({
    nodes: [{ mesh: 0, extensions: { EXT_mesh_gpu_instancing: { attributes: { TRANSLATION: 1 } } } }],
    accessors: [
      { bufferView: 0, componentType: 5126, count: 3, type: 'VEC3' },
      { bufferView: 0, componentType: 5126, count: 2, type: 'VEC3' },
    ],
  });
  assert.equal((await meshOf(given('instances.glb', glbOf(instanced, bytes)))).indices.length / 3, 2);
});

test('the scene that a file opens with is read; without scenes all nodes are', async () => {
  const two = { nodes: [{ mesh: 0, scale: [9, 9, 9] }, { mesh: 0 }], scenes: [{ nodes: [0] }, { nodes: [1] }] };
  const plain = sides(await meshOf(given('log.glb', glbOf(scene(), bytes))));
  assert.deepEqual(sides(await meshOf(given('second.glb', glbOf(scene({ ...two, scene: 1 }), bytes)))), plain);
  const { scene: _, scenes: __, ...rest } = scene({ nodes: [{ children: [1] }, { mesh: 0 }] });
  assert.deepEqual(sides(await meshOf(given('none.glb', glbOf(rest, bytes)))), plain);
});
