/** OpenEXR 2 (Academy Software Foundation): one part of scan lines, not compressed, with one channel of 32-bit floats. */

import { ByteWriter } from '../formats/byte-writer.ts';

const MAGIC = [0x76, 0x2f, 0x31, 0x01];
/** Version 2, none of its flags. */
const VERSION = 2;
const FLOAT = 2;

/**
 * The file. Its channel is called Y, as the standard calls the only one of grey pictures.
 *
 * @param valueAt the value of a pixel, by its place in rows from the far side on.
 * @param text becomes attributes of the header.
 */
export function writeExr(
  width: number,
  height: number,
  valueAt: (at: number) => number,
  text: Readonly<Record<string, string>>,
): Uint8Array<ArrayBuffer> {
  const header = headerOf(width, height, text);
  // A row has its number and its length before it.
  const row = 8 + 4 * width;
  const bytes = new Uint8Array(header.length + height * (8 + row));
  bytes.set(header);
  const view = new DataView(bytes.buffer);
  const rows = header.length + 8 * height;
  for (let y = 0, at = 0; y < height; y++) {
    const begin = rows + y * row;
    view.setBigUint64(header.length + 8 * y, BigInt(begin), true);
    view.setInt32(begin, y, true);
    view.setInt32(begin + 4, 4 * width, true);
    for (let x = 0; x < width; x++, at++) view.setFloat32(begin + 8 + 4 * x, valueAt(at), true);
  }
  return bytes;
}

function headerOf(width: number, height: number, text: Readonly<Record<string, string>>): Uint8Array {
  const out = new ByteWriter();
  const numbers = (...values: readonly number[]): number[] => [...new Uint8Array(Int32Array.from(values).buffer)];
  const floats = (...values: readonly number[]): number[] => [...new Uint8Array(Float32Array.from(values).buffer)];
  const attribute = (name: string, type: string, content: readonly number[]): void => {
    out.text(`${name}\0${type}\0`);
    out.codes(...numbers(content.length));
    for (const code of content) out.codes(code);
  };
  const whole = numbers(0, 0, width - 1, height - 1);
  out.codes(...MAGIC, ...numbers(VERSION));
  // The channel's name, its type, linear or not, three bytes of nothing, and one sample for each pixel; then the end of the list.
  attribute('channels', 'chlist', [...new TextEncoder().encode('Y\0'), ...numbers(FLOAT, 0, 1, 1), 0]);
  attribute('compression', 'compression', [0]);
  attribute('dataWindow', 'box2i', whole);
  attribute('displayWindow', 'box2i', whole);
  attribute('lineOrder', 'lineOrder', [0]);
  attribute('pixelAspectRatio', 'float', floats(1));
  attribute('screenWindowCenter', 'v2f', floats(0, 0));
  attribute('screenWindowWidth', 'float', floats(1));
  for (const [name, value] of Object.entries(text)) attribute(name, 'string', [...new TextEncoder().encode(value)]);
  out.codes(0);
  return out.bytes();
}
