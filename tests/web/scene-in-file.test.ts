import assert from 'node:assert/strict';
import { test } from 'node:test';
import { sceneInFile, sceneInText } from '../../www/export/origin/scene-in-file.ts';
import type { SceneInFile } from '../../www/export/origin/scene-in-file.ts';
import { glb, gltf, LINK, ORIGIN, PIXELS, png, SCENE, zip } from './scene-files.ts';

const found = (...parts: BlobPart[]): Promise<SceneInFile> => sceneInFile(new Blob(parts));

test('a scene comes out of each kind of file that says it', async () => {
  assert.deepEqual(await found(await png()), SCENE);
  assert.deepEqual(await found(glb(gltf({}, { extras: ORIGIN }))), SCENE);
  assert.deepEqual(await found(glb(gltf({ extras: ORIGIN }, {}))), SCENE);
  assert.deepEqual(await found(gltf({}, { extras: ORIGIN })), SCENE);
  assert.deepEqual(await found(gltf({ extras: ORIGIN }, {})), SCENE);
  assert.deepEqual(await found(`\ufeff\n${JSON.stringify(ORIGIN, null, 2)}`), SCENE);
  assert.deepEqual(await found('{"preset":"riverbed","layers":[]}'), { request: { preset: 'riverbed', layers: [] } });
});

test('a scene comes out of an archive, whatever lies beside it, stored or compressed, with a comment', async () => {
  const others: [string, Buffer][] = [
    ['notes.txt', Buffer.from('a=b')],
    ['package.json', Buffer.from('{"name":"foreign"}')],
    ['__MACOSX/._height.png', Buffer.from('\0\x05\x16\x07')],
    ['photo.png', PIXELS],
  ];
  for (const isDeflated of [false, true]) {
    for (const [name, bytes] of [
      ['maps/height.png', await png()],
      ['rocks.glb', glb(gltf({}, { extras: ORIGIN }))],
      ['scene.json', Buffer.from(JSON.stringify(ORIGIN))],
    ] as [string, Buffer][]) {
      assert.deepEqual(await found(zip([...others, [name, bytes, isDeflated]], 'made by an archiver')), SCENE, `${name} ${isDeflated}`);
    }
  }
});

test('the scene of a glTF file is found in its beginning or at its end however long its JSON is, and no more of it is read', async () => {
  const long = gltf({}, {}, 80_000);
  assert.ok(long.length > 4_500_000);
  const first = long.replace('{', `{"asset":${JSON.stringify({ version: '2.0', extras: ORIGIN })},`);
  for (const json of [first, gltf({}, { extras: ORIGIN }, 80_000)]) {
    const bytes = glb(json);
    let read = 0;
    const counted = {
      size: bytes.length,
      slice: (from: number, to: number) => {
        read += Math.min(to, bytes.length) - from;
        return new Blob([bytes.subarray(from, to)]);
      },
    } as Blob;
    assert.deepEqual(await sceneInFile(counted), SCENE);
    assert.ok(read < 4_500_000, `${read} bytes were read`);
  }
  await assert.rejects(found(glb(long)), { reason: 'foreign' });
});

test('a pasted text is a link, or parameters as JSON', () => {
  assert.deepEqual(sceneInText(` https://example.com/?a=b#${LINK}\n`), {
    link: `https://example.com/?a=b#${LINK}`,
    hash: '',
    version: '',
    options: {},
  });
  assert.deepEqual(sceneInText(' {"seed": 5}'), { request: { seed: 5 } });
  assert.throws(() => sceneInText('{"name": 5}'), { reason: 'foreign' });
  assert.throws(() => sceneInText('a'.repeat(300_000)), { reason: 'foreign' });
});

test('a file of others is foreign, one that is damaged is broken', async () => {
  const whole = await png();
  const archive = zip([['height.png', whole]]);
  const foreign: [string, BlobPart][] = [
    ['nothing', ''],
    ['pixels', PIXELS],
    ['a photograph', Buffer.from([0xff, 0xd8, 0xff, 0xe0, 0, 0x10, 0x4a, 0x46, 0x49, 0x46, ...Array<number>(300_000).fill(7)])],
    ['a model', glb(gltf({ generator: 'Blender' }, { extras: { link: 5 } }))],
    ['settings', '{"name":"foreign","version":1}'],
    ['a list', '[1,2,3]'],
    ['a link', LINK],
    ['an archive', zip([['photo.png', PIXELS]])],
    ['an archive in an archive', zip([['inner.png', archive]])],
    ['an empty archive', zip([])],
  ];
  for (const [name, bytes] of foreign) await assert.rejects(found(bytes), { reason: 'foreign' }, name);
  const broken: [string, BlobPart][] = [
    ['a text that is no JSON', await png('{"link":')],
    ['a text without a link', await png('{"seed":5}')],
    ['half a picture', whole.subarray(0, 60)],
    ['half a model', glb(gltf({}, { extras: ORIGIN })).subarray(0, 200)],
    ['a model of no JSON', glb('{"asset":{"version":}}')],
    ['half an archive', archive.subarray(0, archive.length - 30)],
    ['an archive of half a picture', zip([['height.png', whole.subarray(0, 60)]])],
  ];
  for (const [name, bytes] of broken) await assert.rejects(found(bytes), { reason: 'broken' }, name);
});
