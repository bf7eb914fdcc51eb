// Any bytes at all bring a scene back, or are refused, and little of them is read.
import assert from 'node:assert/strict';
import { Refused } from '../../www/export/origin/refused.ts';
import { sceneInFile } from '../../www/export/origin/scene-in-file.ts';
import { fuzz } from './fuzz.ts';
import { glb, gltf, ORIGIN, PIXELS, png, zip } from './scene-files.ts';

const PICTURE = await png();
const MODEL = glb(gltf({ extras: ORIGIN }, { extras: ORIGIN }));
const SEEDS = [
  PICTURE,
  PIXELS,
  MODEL,
  zip([
    ['height.png', PICTURE, true],
    ['rocks.glb', MODEL],
    ['scene.json', Buffer.from(JSON.stringify(ORIGIN)), true],
  ]),
  Buffer.from(JSON.stringify(ORIGIN)),
  Buffer.from('{"preset":"riverbed","layers":[{"radius":5}]}'),
];

/** Of a file of any size, this much may be read at once, and this much in all, bytes. */
const [MOST_AT_ONCE, MOST_IN_ALL] = [5_000_000, 12_000_000];

/** A file that counts what is read of it, and claims to be of any size: what it lacks is zero. */
class CountedFile {
  readonly type = '';
  readonly bytes: Uint8Array;
  readonly size: number;
  readonly told: { read: number };
  readonly from: number;

  constructor(bytes: Uint8Array, size: number, told: { read: number }, from = 0) {
    [this.bytes, this.size, this.told, this.from] = [bytes, size, told, from];
  }

  slice(from = 0, to = this.size): CountedFile {
    const [start, end] = [from, to].map((at) => Math.min(at < 0 ? this.size + at : at, this.size)) as [number, number];
    return new CountedFile(this.bytes, Math.max(0, end - start), this.told, this.from + start);
  }

  async arrayBuffer(): Promise<ArrayBuffer> {
    assert.ok(this.size <= MOST_AT_ONCE, `${this.size} bytes at once`);
    this.told.read += this.size;
    const copy = new Uint8Array(this.size);
    copy.set(this.bytes.subarray(this.from, this.from + this.size));
    return copy.buffer;
  }

  async text(): Promise<string> {
    return new TextDecoder().decode(await this.arrayBuffer());
  }

  stream(): ReadableStream {
    const part = this.slice(0, 300_000);
    return new ReadableStream({
      async start(controller) {
        controller.enqueue(new Uint8Array(await part.arrayBuffer()));
        controller.close();
      },
    });
  }
}

fuzz({
  name: 'files that are damaged anywhere, of any size, are scenes or are refused, and little of them is read',
  cases: 3000,
  make: (random) => {
    const bytes = random.mutatedBytes(random.pick(SEEDS));
    // The last four bytes say how many more the file claims to have.
    const claimed = random.pick([0, 0, 0, 70_000, 50_000_000, 2 ** 31]);
    return Uint8Array.from([...bytes, ...new Uint8Array(Uint32Array.of(claimed).buffer)]);
  },
  check: async (input) => {
    const bytes = input.subarray(0, -4);
    const claimed = new DataView(Uint8Array.from(input.subarray(-4)).buffer).getUint32(0, true);
    const told = { read: 0 };
    const file = new CountedFile(bytes, bytes.length + claimed, told) as unknown as Blob;
    try {
      const scene = await sceneInFile(file);
      assert.ok('request' in scene || typeof scene.link === 'string');
    } catch (thrown) {
      assert.ok(thrown instanceof Refused, String(thrown));
      assert.ok(!(thrown.cause instanceof assert.AssertionError), String(thrown.cause));
    }
    assert.ok(told.read <= MOST_IN_ALL, `${told.read} bytes in all`);
  },
});
