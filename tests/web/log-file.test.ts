// Log files: what each kind of file gives, and what a file that is refused is told. The files are in tests/data/logs.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { type Accessor, Document, type Node, type Primitive, WebIO } from '@gltf-transform/core';
import { MeshoptEncoder } from 'meshoptimizer';
import type { RockFieldError } from '../../www/base/errors.ts';
import { FARTHEST, MOST_LISTED, MOST_TRIANGLES, MOST_VERTICES } from '../../www/wood-ear/log-file/limits.ts';
import { readLogFile } from '../../www/wood-ear/log-file/read.ts';
import { shown } from '../../www/wood-ear/log-file/refusal.ts';
import type { LogMesh } from '../../www/wood-ear/log-mesh.ts';

const stored = (name: string) => new File([readFileSync(new URL(`../data/logs/${name}`, import.meta.url))], name);
const given = (name: string, ...parts: BlobPart[]) => new File(parts, name);
const meshOf = async (file: File): Promise<LogMesh> => (await readLogFile(file)).mesh;

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

function sides({ positions }: LogMesh): number[] {
  return [0, 1, 2].map((k) => {
    const axis = [...positions].filter((_, i) => i % 3 === k);
    return Math.max(...axis) - Math.min(...axis);
  });
}

/** Triangles as places, however vertices are numbered and wherever a triangle begins. */
function triangles({ positions, indices }: LogMesh): string[] {
  const place = (vertex: number) =>
    [...positions.subarray(3 * vertex, 3 * vertex + 3)].map((value) => value.toFixed(2).replace(/^-0\.00$/, '0.00')).join(' ');
  const all: string[] = [];
  for (let i = 0; i < indices.length; i += 3) {
    const corners = [0, 1, 2].map((k) => place(indices[i + k]!));
    const first = corners.indexOf([...corners].sort()[0]!);
    all.push([...corners.slice(first), ...corners.slice(0, first)].join(', '));
  }
  return all.sort();
}

const refusal = async (file: File): Promise<RockFieldError> =>
  readLogFile(file).then(
    () => assert.fail(`${file.name} was read`),
    (thrown: unknown) => thrown as RockFieldError,
  );

// The stored files.

test('a mirrored node leaves its surface facing outwards', async () => {
  const mirrored = await meshOf(stored('F01-negative-scale.glb'));
  const plain = await meshOf(stored('F06-external-image.glb'));
  assert.ok(volume(plain) > 0);
  assert.ok(Math.abs(volume(mirrored) - volume(plain)) < 1e-3 * volume(plain));
});

test('edges and points before faces are left out', async () => {
  const { positions, indices } = await meshOf(stored('F02-line-before-faces.obj'));
  assert.deepEqual([positions.length / 3, indices.length / 3], [6, 4]);
  assert.deepEqual(
    triangles({ positions, indices }),
    triangles(await meshOf(given('without.obj', (await stored('F02-line-before-faces.obj').text()).replace('l 1 2', '')))),
  );
});

test('triangles without an area are no log', async () => {
  assert.equal((await refusal(stored('F03-collinear.obj'))).name, 'LogNoArea');
  // Once it is scaled, nothing of its width is left.
  assert.equal((await refusal(new File(['v 0 0 0\nv 1e308 1 0\nv 0 0 1\nf 1 2 3'], 'needle.obj'))).name, 'LogNoArea');
});

test('large coordinates keep their shape: they are centred before they are rounded', async () => {
  const mesh = await meshOf(stored('F04-large-coordinates.obj'));
  const scale = 200 / 3;
  sides(mesh).forEach((side, k) => assert.ok(Math.abs(side - [200, 0.2 * scale, 0.2 * scale][k]!) < 1e-3, `${k}: ${side}`));
});

test('a vertex that no triangle uses decides neither size nor direction', async () => {
  const [length, width, height] = sides(await meshOf(stored('F05-unused-vertex.glb')));
  assert.deepEqual(
    [length, width, height].map((side) => Math.round(side!)),
    [120, 20, 30],
  );
});

test('a triangle without area decides neither size nor direction', async () => {
  const box = await stored('F02-line-before-faces.obj').text();
  const mesh = await meshOf(given('stray.obj', `${box}\nv 0 0 90000\nf 1 7 7\nf 1 1 7\n`));
  assert.deepEqual(sides(mesh), sides(await meshOf(given('box.obj', box))));
});

for (const name of ['F06-external-image.glb', 'F06-required-texture-extension.glb', 'F06-quantized.glb']) {
  test(`${name}: materials, textures and pictures are no reason to refuse a file, and quantized positions are read`, async () => {
    const mesh = await meshOf(stored(name));
    assert.deepEqual(sides(mesh).map(Math.round), [120, 20, 30]);
    assert.deepEqual(mesh.indices.length / 3, 12);
  });
}

for (const name of ['F07-comment-after-face.obj', 'F09-usemtl-without-name.obj', 'F10-cr-only.obj']) {
  test(`${name}: is read as if it were spelled the usual way`, async () => {
    assert.deepEqual(
      triangles(await meshOf(stored(name))),
      triangles(await meshOf(given('usual.obj', 'v 0 0 0\nv 100 0 0\nv 100 30 10\nv 0 30 10\nf 1 2 3 4\n'))),
    );
  });
}

test('a decimal comma is refused with its line, never cut off', async () => {
  const { name, message, value, words } = await refusal(stored('F08-decimal-comma.obj'));
  assert.equal(name, 'LogFileBroken');
  assert.match(message, /line 1: "0,0" is not a number; decimals are written with a point/);
  assert.match(words!.ja, /1 行目/);
  assert.equal(value, '0,0');
});

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

// OBJ.

const QUAD = 'v 0 0 0\nv 100 0 0\nv 100 30 10\nv 0 30 10\n';

test('OBJ: spellings of one mesh give one mesh', async () => {
  const usual = triangles(await meshOf(given('usual.obj', `${QUAD}f 1 2 3 4\n`)));
  const utf16 = (text: string, isBig: boolean, mark: boolean) => {
    const codes = [...((mark ? '\ufeff' : '') + text)].map((char) => char.charCodeAt(0));
    return Uint8Array.from(codes.flatMap((code) => (isBig ? [code >> 8, code & 255] : [code & 255, code >> 8])));
  };
  const spellings: Record<string, BlobPart> = {
    'negative indices': `${QUAD}f -4 -3 -2 -1`,
    'texture and normal numbers': `${QUAD}vt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 3//1 4/1`,
    'a line that is continued': `v 0 0 \\\n0\nv 100 \\\r\n 0 0\nv 100 30 10\nv 0 30 10\nf 1 2 \\\n 3 4`,
    'a path that ends in a backslash': `mtllib C:\\logs\\\n# from C:\\logs\\\n${QUAD}f 1 2 3 4`,
    'weights and colours': `${QUAD.replaceAll(/(v .*)\n/g, '$1 1.0\n').replace('v 0 0 0 1.0', 'v 0 0 0 0.5 0.5 0.5')}f 1 2 3 4`,
    exponents: 'v 0e0 -0.0 +0\nv 1e2 0 0\nv 1.0E+02 3.e1 .1e2\nv 0 300e-1 10\nf 1 2 3 4',
    'faces before their vertices': `f 1 2 3 4\n${QUAD}`,
    'tabs, blank lines and groups': `\n\ng log\no log\ns off\n${QUAD.replaceAll(' ', '\t')}\n\tf\t1 2 3 4  \n`,
    'statements that nobody knows': `curv 0 1 1 2 3\nfoo\n${QUAD}f 1 2 3 4\nend`,
    'a comment without a blank': `${QUAD}f 1 2 3 4#bark`,
    'lines that end in CR LF': `${QUAD}f 1 2 3 4\n`.replaceAll('\n', '\r\n'),
    'a mark of UTF-8': `\ufeff${QUAD}f 1 2 3 4`,
    'UTF-16': utf16(`${QUAD}f 1 2 3 4`, false, true),
    'UTF-16, big end first': utf16(`${QUAD}f 1 2 3 4`, true, true),
    'UTF-16 without a mark': utf16(`${QUAD}f 1 2 3 4`, false, false),
    'an edge and a point among the faces': `${QUAD}l 1 2 3\np 4\nf 1 2\nf 1 2 3 4`,
  };
  for (const [what, text] of Object.entries(spellings)) assert.deepEqual(triangles(await meshOf(given(`${what}.obj`, text))), usual, what);
});

test('OBJ: what cannot be meant is refused with its line', async () => {
  const cases: [string, RegExp][] = [
    ['v 0 0 0\nv 1 2\n', /line 2: a vertex has 2 coordinates/],
    ['v 0 0 0x10\n', /line 1: "0x10" is not a number/],
    ['v 0 0 nan\n', /line 1: "nan" is not a number/],
    ['v 0 0 1d5\n', /line 1: "1d5" is not a number/],
    ['v 0 0 1e999\n', /line 1: "1e999" is too large/],
    ['# \\\nv 0 \\\n0 x\n', /line 3: "x" is not a number/],
    [`${QUAD}f 1 2 9\n`, /line 5: a face names vertex 9, and there are 4/],
    [`${QUAD}f 1 2 0\n`, /line 5: a face names vertex 0/],
    [`${QUAD}f 1 2 -5\n`, /line 5: a face names vertex -5/],
    [`${QUAD}f 1 2 99999999999999999999\n`, /line 5: a face names vertex/],
    [`${QUAD}f 1 2 3.5\n`, /line 5: "3.5" is not the number of a vertex/],
    [`${QUAD}f 1,2,3\n`, /line 5: "1,2,3" is not the number of a vertex/],
    [`v 1e308 0 0\nv -1e308 0 0\nv 0 1 0\nf 1 2 3\n`, /infinitely far/],
  ];
  for (const [text, words] of cases) {
    const { name, message, key } = await refusal(given('log.obj', text));
    assert.deepEqual([name, key], ['LogFileBroken', 'log'], text);
    assert.match(message, words);
  }
});

test('a face of any number of corners becomes triangles that cover it once, whatever its shape', async () => {
  const ring = (count: number, radius: (k: number) => number) =>
    Array.from(
      { length: count },
      (_, k) =>
        `v ${(radius(k) * Math.cos((2 * Math.PI * k) / count)).toFixed(6)} 0 ${(-radius(k) * Math.sin((2 * Math.PI * k) / count)).toFixed(6)}`,
    ).join('\n');
  const face = (count: number) => `\nf ${Array.from({ length: count }, (_, k) => k + 1).join(' ')}\n`;
  const area = ({ positions: p, indices }: LogMesh) => {
    let [signed, unsigned] = [0, 0];
    for (let i = 0; i < indices.length; i += 3) {
      const [a, b, c] = [0, 1, 2].map((k) => 3 * indices[i + k]!) as [number, number, number];
      const each = ((p[b]! - p[a]!) * (p[c + 1]! - p[a + 1]!) - (p[c]! - p[a]!) * (p[b + 1]! - p[a + 1]!)) / 2;
      signed += each;
      unsigned += Math.abs(each);
    }
    return { signed, unsigned };
  };
  for (const [count, radius] of [
    [4, (k: number) => (k === 0 ? 10 : 50)],
    [12, (k: number) => (k % 2 ? 20 : 60)],
    [500, (k: number) => (k % 2 ? 60 : 61)],
    [60, () => 60],
  ] as const) {
    const mesh = await meshOf(given('face.obj', ring(count, radius) + face(count)));
    const { signed, unsigned } = area(mesh);
    assert.ok(Math.abs(Math.abs(signed) - unsigned) < 1e-3 * unsigned, `${count} corners: ${signed} of ${unsigned}`);
    assert.ok(signed > 0, 'it faces up as the face does');
  }
  const many = await refusal(given('comb.obj', ring(20_000, (k) => (k % 2 ? 20 : 60)) + face(20_000)));
  assert.deepEqual([many.name, many.value, many.max], ['LogFileUnsupported', 20_000, 10_000]);
  assert.equal((await meshOf(given('disc.obj', ring(100_000, () => 60) + face(100_000)))).indices.length / 3 > 90_000, true);
});

test('a face of 400,000 corners is counted, not tried', async () => {
  const { name, max } = await refusal(given('face.obj', `${QUAD}f ${'1 2 3 4 '.repeat(110_000)}\n`));
  assert.deepEqual([name, max], ['LogTooLarge', MOST_TRIANGLES]);
});

test('more vertices than a log may have are refused with both numbers, and many more before the file is read to its end', async () => {
  const grid = (columns: number, rows: number) => {
    const lines: string[] = [];
    for (let x = 0; x < columns; x += 1) for (let y = 0; y < rows; y += 1) lines.push(`v ${x} ${y} ${(x * y) % 7}`);
    for (let x = 0; x + 1 < columns; x += 1)
      for (let y = 0; y + 1 < rows; y += 1) lines.push(`f ${x * rows + y + 1} ${(x + 1) * rows + y + 1} ${(x + 1) * rows + y + 2}`);
    return lines.join('\n');
  };
  const { name, value, max, message } = await refusal(given('grid.obj', grid(700, 300)));
  assert.equal(name, 'LogTooLarge');
  assert.ok((value as number) > max! && max === MOST_VERTICES);
  assert.match(message, /grid\.obj has \d+ vertices; a log may have at most 200000/);
  const listed = await refusal(given('cloud.obj', 'v 1 2 3\n'.repeat(MOST_LISTED + 10)));
  assert.deepEqual([listed.name, listed.max], ['LogTooLarge', MOST_LISTED]);
});

test('the limits are the generator’s', () => {
  const rust = readFileSync(new URL('../../src/wood_ear/user_log.rs', import.meta.url), 'utf8');
  const constant = (name: string) => Number(new RegExp(`${name}: usize = ([\\d_]+)`).exec(rust)?.[1]?.replaceAll('_', ''));
  assert.deepEqual([constant('MOST_VERTICES'), constant('MOST_TRIANGLES')], [MOST_VERTICES, MOST_TRIANGLES]);
  assert.equal(Number(/REACH: f64 = ([\d_.]+)/.exec(rust)?.[1]?.replaceAll('_', '')), FARTHEST);
});

test('a log far higher than it is long is refused by the reader, before its numbers overflow', async () => {
  for (const height of ['1e38', '1e300', '20000']) {
    const { name, max } = await refusal(given('spike.obj', `v 0 ${height} 1\nv 1 0 0\nv 0 0 0\nf 1 2 3\n`));
    assert.deepEqual([name, max], ['LogBadPosition', FARTHEST], height);
  }
});

// glTF.

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

test('what a GLB file promises is compared with what it holds before anything is made of it', async () => {
  const view = { bufferView: 0, componentType: 5126, type: 'VEC3' };
  const cases: [Json, string, RegExp][] = [
    [{ accessors: [{ ...view, count: 1e7 }] }, 'LogFileBroken', /accessors\[0\] has 10000000 elements/],
    [{ accessors: [{ ...view, count: 100 }] }, 'LogFileBroken', /accessors\[0\] has 100 elements/],
    [{ accessors: [{ componentType: 5126, type: 'VEC3', count: 9e8 }] }, 'LogTooLarge', /900000000/],
    [
      {
        accessors: [
          { ...view, count: 3, sparse: { count: 1e7, indices: { bufferView: 0, componentType: 5121 }, values: { bufferView: 0 } } },
        ],
      },
      'LogFileBroken',
      /accessors\[0\]\.sparse\.indices/,
    ],
    [
      {
        accessors: [
          {
            ...view,
            count: 3,
            sparse: { count: 1, indices: { bufferView: 0, componentType: 5125, byteOffset: 12 }, values: { bufferView: 0 } },
          },
        ],
      },
      'LogFileBroken',
      /name element \d+ of 3/,
    ],
    [{ accessors: [{ ...view, count: -1 }] }, 'LogFileBroken', /count of accessors\[0\]/],
    [{ accessors: [{ ...view, count: 3, byteOffset: 40 }] }, 'LogFileBroken', /accessors\[0\]/],
    [{ accessors: [{ ...view, count: 3, componentType: 5125 }] }, 'LogFileBroken', /does not fit/],
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
  for (const [changes, expected, words] of cases) {
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

test('random scenes are read as glTF-Transform reads them: nested and mirrored transforms, strips and fans, all types, sparse, interleaved', async () => {
  let state = 7;
  const random = () => {
    state = (Math.imul(state, 1_103_515_245) + 12_345) >>> 0;
    return state / 2 ** 32;
  };
  const pick = <T>(list: readonly T[]): T => list[Math.floor(random() * list.length)]!;
  for (let round = 0; round < 120; round += 1) {
    const document = new Document();
    const buffer = document.createBuffer();
    const primitive = (): Primitive => {
      const count = 6 + Math.floor(random() * 20);
      const [type, isNormalized, full] = pick([
        [Float32Array, false, 1],
        [Int16Array, true, 30_000],
        [Int8Array, true, 120],
        [Uint16Array, true, 60_000],
        [Uint8Array, false, 200],
      ] as const);
      const values = Array.from(
        { length: 3 * count },
        () => (type === Uint16Array || type === Uint8Array ? random() : 2 * random() - 1) * full,
      );
      const position = document
        .createAccessor()
        .setType('VEC3')
        .setArray(type.from(values))
        .setNormalized(isNormalized)
        .setBuffer(buffer)
        .setSparse(random() < 0.2);
      const made = document
        .createPrimitive()
        .setAttribute('POSITION', position)
        .setMode(pick([4, 4, 5, 6, 1]) as 4);
      if (random() < 0.5)
        made.setAttribute(
          'NORMAL',
          document
            .createAccessor()
            .setType('VEC3')
            .setArray(new Float32Array(3 * count))
            .setBuffer(buffer),
        );
      if (random() < 0.7)
        made.setIndices(
          document
            .createAccessor()
            .setType('SCALAR')
            .setArray(
              pick([Uint8Array, Uint16Array, Uint32Array]).from(
                Array.from({ length: 9 + 3 * Math.floor(random() * 9) }, () => random() * count),
              ),
            )
            .setBuffer(buffer),
        );
      return made;
    };
    const meshes = [0, 1].map(() => [primitive(), primitive()].reduce((mesh, each) => mesh.addPrimitive(each), document.createMesh()));
    const node = (depth: number): Node => {
      const made = document
        .createNode()
        .setTranslation([random(), random(), random()])
        .setScale([pick([1, -1, 2]), pick([1, -0.5]), pick([1, 3, -1])]);
      const [x, y, z, w] = [random() - 0.5, random() - 0.5, random() - 0.5, random()];
      const norm = Math.hypot(x, y, z, w);
      made.setRotation([x / norm, y / norm, z / norm, w / norm]);
      if (random() < 0.7) made.setMesh(pick(meshes));
      if (depth < 3) made.addChild(node(depth + 1));
      return made;
    };
    document.createScene().addChild(node(0)).addChild(node(1));
    const file = (await new WebIO().writeBinary(document)) as Uint8Array<ArrayBuffer>;
    const expected = await oracle(file);
    if (expected === null) continue;
    // Triangles may all be without area.
    const outcome = (log: File) => meshOf(log).then(triangles, ({ name }: RockFieldError) => name);
    assert.deepEqual(await outcome(given('log.glb', file)), await outcome(given('log.obj', expected)), `round ${round}`);
  }
});

/** A GLB file as an OBJ file in centimetres, by another reader; null where it has no triangles. */
async function oracle(file: Uint8Array): Promise<string | null> {
  const root = (await new WebIO().readBinary(file)).getRoot();
  const [vertices, faces]: [string[], string[]] = [[], []];
  root.listScenes()[0]!.traverse((node) => {
    const m = node.getWorldMatrix();
    const det = m[0] * (m[5] * m[10] - m[9] * m[6]) - m[4] * (m[1] * m[10] - m[9] * m[2]) + m[8] * (m[1] * m[6] - m[5] * m[2]);
    for (const primitive of node.getMesh()?.listPrimitives() ?? []) {
      const mode = primitive.getMode();
      if (mode < 4) continue;
      const position = primitive.getAttribute('POSITION') as Accessor;
      const base = vertices.length;
      for (let i = 0; i < position.getCount(); i += 1) {
        const [x = 0, y = 0, z = 0] = position.getElement(i, []);
        const row = (k: number) => 100 * (m[k]! * x + m[k + 4]! * y + m[k + 8]! * z + m[k + 12]!);
        vertices.push(`v ${row(0)} ${row(1)} ${row(2)}`);
      }
      const indices = [...(primitive.getIndices()?.getArray() ?? Array.from({ length: position.getCount() }, (_, i) => i))];
      const add = (a: number, b: number, c: number) =>
        faces.push(det < 0 ? `f ${base + a + 1} ${base + c + 1} ${base + b + 1}` : `f ${base + a + 1} ${base + b + 1} ${base + c + 1}`);
      if (mode === 4) for (let i = 0; i + 2 < indices.length; i += 3) add(indices[i]!, indices[i + 1]!, indices[i + 2]!);
      if (mode === 5)
        for (let i = 0; i + 2 < indices.length; i += 1)
          i % 2 ? add(indices[i]!, indices[i + 2]!, indices[i + 1]!) : add(indices[i]!, indices[i + 1]!, indices[i + 2]!);
      if (mode === 6) for (let i = 1; i + 1 < indices.length; i += 1) add(indices[i]!, indices[i + 1]!, indices[0]!);
    }
  });
  return faces.length === 0 ? null : [...vertices, ...faces].join('\n');
}

// Names and other formats.

test('a file of another format is told what it is', async () => {
  const stl = new Uint8Array(84 + 50);
  stl[80] = 1;
  const cases: [string, BlobPart, RegExp][] = [
    ['log.fbx', 'Kaydara FBX Binary  \0', /is an FBX file/],
    ['log.stl', stl, /is an STL file/],
    ['text.stl', 'solid log\nfacet normal 0 0 1\n', /is an STL file/],
    ['log.ply', 'ply\nformat ascii 1.0\n', /is a PLY file/],
    ['log.blend', 'BLENDER-v400', /is a Blender file/],
    ['log.dae', '<?xml version="1.0"?>\n<COLLADA>', /is a COLLADA file/],
    ['log.glb.gz', Uint8Array.of(0x1f, 0x8b, 8, 0), /is a gzip archive; unpack it/],
    ['log.zip', 'PK\x03\x04', /is a ZIP archive; unpack it/],
    ['log.mtl', '# Blender\nnewmtl bark\nKd 1 1 1\n', /is a material library/],
    ['bark.png', Uint8Array.of(0x89, 0x50, 0x4e, 0x47), /is a picture/],
    ['page.glb', '<!doctype html><title>404</title>', /is a web page/],
    ['data.json', '{"a": 1}', /is JSON, but neither a glTF nor an OBJ/],
    ['empty.obj', '', /is empty/],
  ];
  for (const [file, content, words] of cases) {
    const { name, message } = await refusal(given(file, content));
    assert.equal(name, 'LogFileUnknown', file);
    assert.match(message, words);
  }
});

test('names and quotes of files are short in messages, and cannot break or reorder their line', async () => {
  const { message } = await refusal(given(`${'x'.repeat(5000)}\n\u202e.obj`, 'v 1 2'));
  assert.ok(message.length < 200, message);
  assert.match(message, /^x+….*\.obj, line 1/);
  assert.ok(!/[\n\u202e]/.test(message));
  assert.ok((await refusal(given('log.obj', `v ${'9,'.repeat(100_000)} 1 1`))).message.length < 250);
  assert.equal(shown('log.obj'), 'log.obj');
});

test('a file over the limit is not opened, one that is gone is said to be gone', async () => {
  const huge = given('huge.obj', 'v 0 0 0');
  Object.defineProperty(huge, 'size', { value: 62 * 2 ** 20 });
  Object.defineProperty(huge, 'arrayBuffer', { value: () => assert.fail('opened') });
  const { name, message, value, max } = await refusal(huge);
  assert.deepEqual([name, value, max], ['LogFileTooLarge', 62 * 2 ** 20, 48 * 2 ** 20]);
  assert.match(message, /^huge\.obj is 62 MB; a log file may be at most 48 MB$/);
  const gone = given('gone.obj', 'v 0 0 0');
  Object.defineProperty(gone, 'arrayBuffer', { value: () => Promise.reject(new DOMException('no', 'NotReadableError')) });
  assert.equal((await refusal(gone)).name, 'LogFileUnreadable');
});

test('how far the reading is goes from 0 up and never back', async () => {
  const told: number[] = [];
  await readLogFile(given('log.obj', `${QUAD}${'# bark\n'.repeat(5000)}f 1 2 3 4\n`), { onProgress: (fraction) => told.push(fraction) });
  assert.ok(told.length > 10 && told.every((fraction, k) => fraction >= (told[k - 1] ?? 0) && fraction <= 1));
});
