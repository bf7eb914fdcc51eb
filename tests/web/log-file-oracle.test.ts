// GLB files of random scenes are read as another reader, glTF-Transform, reads them.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { type Accessor, Document, type Node, type Primitive, WebIO } from '@gltf-transform/core';
import type { RockFieldError } from '../../www/base/errors.ts';
import { given, meshOf, triangles } from './log-files.ts';

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
