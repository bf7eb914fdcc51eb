import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { crc32 as crcOfZlib } from 'node:zlib';
import { PNG } from 'pngjs';
import { KEYWORD, originOf } from '../../www/export/origin/origin.ts';
import { crc32, isPng, MOST_TEXT, textChunk, textOf, withText } from '../../www/export/origin/png-text.ts';
import { hashInSlices, hashOf } from '../../www/export/origin/hash.ts';
import { VERSION } from '../../www/data/version.ts';

const TEXT = '{"link":"v=1&preset=riverbed&seed=7","words":"河原 – Æ"}';

/** A picture of noise, which no filter makes small. */
function picture(width = 40, height = 30): Buffer<ArrayBuffer> {
  const png = new PNG({ width, height });
  for (let k = 0; k < png.data.length; k += 1) png.data[k] = k % 4 === 3 ? 255 : (k * 2_654_435_761) >>> 24;
  return Buffer.from(PNG.sync.write(png));
}

async function bytesOf(blob: Blob): Promise<Buffer<ArrayBuffer>> {
  return Buffer.from(await blob.arrayBuffer());
}

interface Chunk {
  type: string;
  bytes: Buffer;
}

/** Every chunk, whose checksum has to be right. */
function chunksOf(png: Buffer): Chunk[] {
  const chunks: Chunk[] = [];
  for (let at = 8; at < png.length; ) {
    const length = png.readUInt32BE(at);
    const bytes = png.subarray(at, at + 12 + length);
    assert.equal(bytes.readUInt32BE(8 + length), crcOfZlib(bytes.subarray(4, 8 + length)));
    chunks.push({ type: bytes.toString('latin1', 4, 8), bytes });
    at += bytes.length;
  }
  return chunks;
}

test('a text is added to a PNG file as one whole chunk after the header; every other byte and every pixel stays', async () => {
  const before = picture();
  const after = await bytesOf(withText(new Blob([before], { type: 'image/png' }), KEYWORD, TEXT));
  const chunks = chunksOf(after);
  assert.deepEqual(
    chunks.slice(0, 3).map(({ type }) => type),
    ['IHDR', 'iTXt', 'IDAT'],
  );
  assert.deepEqual(
    Buffer.concat([before.subarray(0, 8), ...chunks.filter(({ type }) => type !== 'iTXt').map(({ bytes }) => bytes)]),
    before,
  );
  assert.deepEqual(PNG.sync.read(after).data, PNG.sync.read(before).data);
});

test('a text is read where it was written, wherever in the file, between texts of others', async () => {
  const [header, ...rest] = chunksOf(picture());
  const file = (...chunks: Uint8Array[]) => new Blob([picture().subarray(0, 8), ...chunks] as Uint8Array<ArrayBuffer>[]);
  const [own, other] = [textChunk(KEYWORD, TEXT), textChunk('Title', 'rock-field')];
  const others = rest.map(({ bytes }) => bytes);
  for (const chunks of [
    [header!.bytes, own, ...others],
    [header!.bytes, other, other, own, ...others],
    [header!.bytes, ...others.slice(0, -1), own, others.at(-1)!],
  ]) {
    assert.equal(await textOf(file(...chunks), KEYWORD), TEXT);
  }
  assert.equal(await textOf(file(header!.bytes, other, ...others), KEYWORD), undefined);
  assert.equal(await textOf(new Blob([picture()]), KEYWORD), undefined);
});

test('what is broken is refused: a checksum, a length, a file that ends too early', async () => {
  const whole = await bytesOf(withText(new Blob([picture()]), KEYWORD, TEXT));
  const at = whole.indexOf('iTXt');
  const broken = (change: (bytes: Buffer<ArrayBuffer>) => Buffer<ArrayBuffer> | undefined): Blob => {
    const copy = Buffer.from(whole);
    return new Blob([change(copy) ?? copy]);
  };
  for (const file of [
    broken((bytes) => void bytes.writeUInt8(bytes[at + 30]! ^ 1, at + 30)),
    broken((bytes) => void bytes.writeUInt32BE(0xffff_ffff, at - 4)),
    broken((bytes) => void bytes.writeUInt32BE(0, at)),
    broken((bytes) => bytes.subarray(0, at + 20)),
    broken((bytes) => bytes.subarray(0, 10)),
  ]) {
    await assert.rejects(textOf(file, KEYWORD), { reason: 'broken' });
  }
});

test('the checksum is that of zlib, the head that of PNG, and a text that nobody would read is not written', () => {
  const bytes = picture();
  assert.equal(crc32(bytes), crcOfZlib(bytes));
  assert.equal(crc32(bytes.subarray(5), crc32(bytes.subarray(0, 5))), crcOfZlib(bytes));
  assert.equal(isPng(bytes), true);
  assert.equal(isPng(bytes.subarray(0, 7)), false);
  assert.throws(() => textChunk(KEYWORD, ' '.repeat(MOST_TEXT)), RangeError);
});

test('the hash of buffers is the SHA-256 of their bytes one after the other, in slices too, where the browser has none', async ({
  mock,
}) => {
  const random = Float32Array.from({ length: 700_000 }, (_, k) => Math.fround(k / 7));
  const buffers = [random.subarray(3, 600_001), Uint8Array.of(1, 2, 3), new Uint32Array(0), random];
  const digest = await crypto.subtle.digest(
    'SHA-256',
    Buffer.concat(buffers.map(({ buffer, byteOffset, byteLength }) => Buffer.from(buffer as ArrayBuffer, byteOffset, byteLength))),
  );
  const expected = Buffer.from(digest).toString('hex');
  assert.equal(hashOf(buffers), expected);
  assert.equal(await hashInSlices(buffers), expected);
  mock.getter(crypto, 'subtle', () => undefined);
  assert.equal(await hashInSlices(buffers), expected);
});

test('files say the version of package.json', () => {
  const { version } = JSON.parse(readFileSync(new URL('../../package.json', import.meta.url), 'utf8')) as { version: string };
  assert.equal(VERSION, version);
  assert.deepEqual(Object.keys(originOf({ link: '', hash: '', metresPerPixel: 0.01 })), ['link', 'version', 'hash', 'metresPerPixel']);
});
