// What is compared of pictures: four bytes a pixel, of which the last, alpha, is looked at by nobody.
import pixelmatch from 'pixelmatch';
import { PNG } from 'pngjs';

/**
 * Rows from the top, without padding.
 *
 * @typedef {{ width: number, height: number, data: Uint8Array }} Picture
 * @typedef {{ x: number, y: number, width: number, height: number }} Box in pixels of a picture
 */

/**
 * The pixels of a PNG file.
 *
 * @param {Buffer} file
 * @returns {Picture}
 */
export const readPicture = (file) => PNG.sync.read(file);

/**
 * The share of a box's pixels in which two pictures can be told apart: those that are farther from each other than from 8 levels of grey to the
 * next, since less is noise of a device.
 *
 * @param {Picture} a
 * @param {Picture} b
 * @param {Box} [box]
 */
export function changedShare(a, b, box = { x: 0, y: 0, width: a.width, height: a.height }) {
  checkSizes(a, b);
  const { x, y, width, height } = box;
  const [one, other] = [a, b].map((picture) => {
    const part = new PNG({ width, height });
    PNG.bitblt(/** @type {PNG} */ (picture), part, x, y, width, height, 0, 0);
    return part.data;
  });
  return pixelmatch(one, other, null, width, height, { threshold: 0.03, includeAA: true }) / (width * height);
}

/**
 * Mean absolute difference over all colour channels, per cent of full scale. pixelmatch counts pixels; devices differ a little in many of them.
 *
 * @param {Picture} a
 * @param {Picture} b
 */
export function meanDifference(a, b) {
  checkSizes(a, b);
  const sum = a.data.reduce((total, value, at) => total + (at % 4 === 3 ? 0 : Math.abs(value - b.data[at])), 0);
  return (100 * sum) / (255 * 3 * a.width * a.height);
}

/**
 * @param {Picture} a
 * @param {Picture} b
 */
function checkSizes(a, b) {
  if (a.width !== b.width || a.height !== b.height)
    throw new Error(`${a.width} × ${a.height} pixels cannot be compared with ${b.width} × ${b.height}`);
}

/**
 * The picture in tiles, `columns` across and `rows` down, each its mean colour: as a picture of so many pixels.
 *
 * @param {Picture} picture
 * @param {number} columns
 * @param {number} rows
 * @returns {Picture}
 */
export function tiles({ width, height, data }, columns, rows) {
  const sums = new Float64Array(4 * columns * rows);
  const counts = new Float64Array(columns * rows);
  for (let y = 0; y < height; y += 1) {
    for (let x = 0; x < width; x += 1) {
      const tile = Math.floor((y * rows) / height) * columns + Math.floor((x * columns) / width);
      counts[tile] += 1;
      for (let channel = 0; channel < 4; channel += 1) sums[4 * tile + channel] += data[4 * (y * width + x) + channel];
    }
  }
  return { width: columns, height: rows, data: Uint8Array.from(sums, (sum, at) => Math.round(sum / counts[Math.floor(at / 4)])) };
}

/**
 * A small picture to be stored: a line for each row, in hexadecimal digits, six for a pixel.
 *
 * @param {Picture} picture
 */
export function asText({ width, height, data }) {
  const colors = data.filter((_, at) => at % 4 !== 3);
  return Array.from({ length: height }, (_, row) => Buffer.from(colors.subarray(3 * width * row, 3 * width * (row + 1))).toString('hex'));
}

/**
 * And back; throws where nothing of that size was stored.
 *
 * @param {string[] | undefined} rows
 * @param {number} width
 * @param {number} height
 * @returns {Picture}
 */
export function asPicture(rows, width, height) {
  if (rows?.length !== height || rows.some(({ length }) => length !== 6 * width))
    throw new Error('nothing of its kind is stored; UPDATE=1 stores it');
  return { width, height, data: Buffer.from(rows.join('').replace(/.{6}/g, '$&ff'), 'hex') };
}
