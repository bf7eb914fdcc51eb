// Any bytes at all are a log that the generator can take, or an error of ours in a short sentence.
import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { RockFieldError } from '../../www/base/errors.ts';
import { MOST_TRIANGLES, MOST_VERTICES } from '../../www/wood-ear/log-file/limits.ts';
import { readLogFile } from '../../www/wood-ear/log-file/read.ts';
import { fuzz } from './fuzz.ts';

const FOLDER = fileURLToPath(new URL('../data/logs', import.meta.url));
const stored = (ending: string) =>
  readdirSync(FOLDER)
    .filter((name) => name.endsWith(ending))
    .map((name) => readFileSync(`${FOLDER}/${name}`));
const GLBS = stored('.glb');
const OBJS = stored('.obj').map(String);

const WORDS = [
  'v 0 0 0\n',
  'v 1 2',
  'v 1e308 1 1\n',
  'f 1 2 3\n',
  'f 1 2 3 4 5\n',
  'f -1 -2 -3\n',
  'f 1//2 2/1 3/1/1',
  'f 999999999999 1 2\n',
  'l 1 2\n',
  'fo 1 2 3\n',
  '\\\n',
  '\\\r\n',
  '\\',
  '#',
  '\r',
  '\u0000',
  '\ufeff',
  '\ufffe',
  ',',
  '.',
  'e',
  '-',
  '/',
  '1'.repeat(400),
  'NaN',
  'Infinity',
  '0x10',
  'glTF',
  '{',
  'solid',
  'newmtl a\n',
  'ply\n',
  '\u202e',
];
const NUMBERS = [
  '0',
  '1',
  '2',
  '3',
  '-1',
  '1e7',
  '9e8',
  '1e400',
  '0.5',
  'null',
  '"x"',
  '[]',
  '{}',
  '[0]',
  'true',
  '4294967296',
  '9007199254740993',
  '5121',
  '5126',
  '6',
];
const KEYS = [
  ',"sparse":{"count":1,"indices":{"bufferView":0,"componentType":5121},"values":{"bufferView":0}}',
  ',"normalized":true',
  ',"byteOffset":4',
  ',"byteStride":4',
  ',"extensions":{"EXT_meshopt_compression":{"buffer":0,"byteLength":20,"byteStride":12,"count":4,"mode":"ATTRIBUTES","filter":"NONE"}}',
  ',"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":0}}}',
  ',"extensions":{"KHR_draco_mesh_compression":{}}',
  ',"children":[0]',
  ',"skin":0',
  ',"mode":5',
  ',"mode":6',
  ',"matrix":[0]',
];

fuzz({
  name: 'any text is a log, or an error in a short sentence',
  cases: 3000,
  make: (random) => random.mutatedText(random.pick(OBJS), WORDS),
  check: (text) => check(new File([text], 'log.obj')),
});

fuzz({
  name: 'any bytes are a log, or an error in a short sentence',
  cases: 3000,
  make: (random) => random.mutatedBytes(random.pick(GLBS)),
  check: (bytes) => check(new File([bytes as Uint8Array<ArrayBuffer>], 'log.glb')),
});

fuzz({
  name: 'any description of a GLB file’s bytes gives a log, or an error in a short sentence',
  cases: 4000,
  make(random) {
    // As a .gltf file with its bytes in it, whose JSON stays JSON mostly.
    const glb = random.pick(GLBS);
    const length = glb.readUInt32LE(12);
    const binary = glb.subarray(20 + length + 8);
    let json = glb
      .subarray(20, 20 + length)
      .toString()
      .trim()
      .replace('"buffers":[{', `"buffers":[{"uri":"data:;base64,${binary.toString('base64')}",`);
    for (let count = 1 + random.integer(3); count > 0; count -= 1) {
      const values = [...json.matchAll(/(?<=[:[,])-?\d+(\.\d+)?(?=[,}\]])/g)];
      if (values.length === 0) break;
      const { index = 0, 0: value = '' } = random.pick(values);
      if (random.chance(0.7)) json = json.slice(0, index) + random.pick(NUMBERS) + json.slice(index + value.length);
      else json = json.replace(new RegExp(`(?<=^(?:[^}]*\\}){${random.integer(12)}}[^}]*)(?=\\})`), random.pick(KEYS));
    }
    return json;
  },
  check: (text) => check(new File([text], 'log.gltf')),
});

async function check(file: File): Promise<void> {
  try {
    const {
      mesh: { positions, indices },
      notices,
    } = await readLogFile(file);
    assert.ok(
      indices.length > 0 && indices.length % 3 === 0 && indices.length <= 3 * MOST_TRIANGLES && positions.length <= 3 * MOST_VERTICES,
    );
    assert.ok(positions.every(Number.isFinite));
    // Every vertex is used, and none that is not there.
    assert.equal(new Set(indices).size, positions.length / 3);
    assert.ok(indices.every((index) => index < positions.length / 3));
    for (const notice of notices) assertShort(notice);
  } catch (thrown) {
    assert.ok(thrown instanceof RockFieldError && /^Log/.test(thrown.name), thrown instanceof Error ? thrown.stack : String(thrown));
    assert.ok(thrown.words);
    assertShort(thrown.words);
  }
}

function assertShort(words: { en: string; ja: string }): void {
  for (const text of [words.en, words.ja]) assert.ok(text.length < 300 && !/[\p{Cc}\u202e]/u.test(text), text);
}
