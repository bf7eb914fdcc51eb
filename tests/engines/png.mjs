// A screenshot's pixels: PNG as browsers write it, 8 bits per channel, not interlaced. Node built-ins only.
import { inflateSync } from 'node:zlib';

const SIGNATURE = Buffer.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]);
/** Colour type → bytes per pixel: RGB, and RGB with alpha. */
const CHANNELS = { 2: 3, 6: 4 };

/**
 * @param {Uint8Array} file
 * @returns {{ width: number, height: number, channels: number, data: Uint8Array }} rows from the top, without padding
 */
export function decodePng(file) {
  const bytes = Buffer.from(file.buffer, file.byteOffset, file.byteLength);
  if (!bytes.subarray(0, 8).equals(SIGNATURE)) throw new Error('this is no PNG file');
  let header;
  const packed = [];
  for (const { type, body } of chunks(bytes)) {
    if (type === 'IHDR') header = body;
    if (type === 'IDAT') packed.push(body);
  }
  if (!header) throw new Error('this PNG file has no header');
  const [width, height] = [header.readUInt32BE(0), header.readUInt32BE(4)];
  const [depth, color, , , interlaced] = header.subarray(8);
  const channels = CHANNELS[color];
  if (depth !== 8 || !channels || interlaced)
    throw new Error(`PNG of colour type ${color}, ${depth} bits${interlaced ? ', interlaced' : ''} is not read here`);
  return { width, height, channels, data: unfilter(inflateSync(Buffer.concat(packed)), width * channels, height, channels) };
}

function* chunks(bytes) {
  for (let at = 8; at + 12 <= bytes.length; ) {
    const length = bytes.readUInt32BE(at);
    yield { type: bytes.toString('latin1', at + 4, at + 8), body: bytes.subarray(at + 8, at + 8 + length) };
    at += 12 + length;
  }
}

/** Undoes the filters (PNG specification, section 9): every byte was written as its difference from a guess. */
function unfilter(filtered, stride, height, channels) {
  if (filtered.length !== (stride + 1) * height)
    throw new Error(`this PNG file has ${filtered.length} bytes of pixels where ${(stride + 1) * height} are due`);
  const data = new Uint8Array(stride * height);
  for (let row = 0; row < height; row += 1) {
    const filter = filtered[row * (stride + 1)];
    const guess = GUESSES[filter];
    if (!guess) throw new Error(`PNG has no filter ${filter}`);
    for (let column = 0; column < stride; column += 1) {
      const at = row * stride + column;
      const left = column < channels ? 0 : data[at - channels];
      const above = row === 0 ? 0 : data[at - stride];
      const corner = row === 0 || column < channels ? 0 : data[at - stride - channels];
      data[at] = filtered[row * (stride + 1) + 1 + column] + guess(left, above, corner);
    }
  }
  return data;
}

const GUESSES = [() => 0, (left) => left, (_left, above) => above, (left, above) => (left + above) >> 1, paeth];

function paeth(left, above, corner) {
  const sum = left + above - corner;
  const [a, b, c] = [Math.abs(sum - left), Math.abs(sum - above), Math.abs(sum - corner)];
  if (a <= b && a <= c) return left;
  return b <= c ? above : corner;
}
