// What is compared of pictures: pixels as `decodePng` gives them, colours without alpha.

/** Mean absolute difference over all colour channels, per cent of full scale. */
export function meanDifference(a, b) {
  if (a.width !== b.width || a.height !== b.height)
    throw new Error(`${a.width} × ${a.height} pixels cannot be compared with ${b.width} × ${b.height}`);
  let sum = 0;
  for (let pixel = 0; pixel < a.width * a.height; pixel += 1) {
    for (let channel = 0; channel < 3; channel += 1)
      sum += Math.abs(a.data[pixel * a.channels + channel] - b.data[pixel * b.channels + channel]);
  }
  return (100 * sum) / (255 * 3 * a.width * a.height);
}

/** The picture in tiles, `columns` across and `rows` down, each its mean colour: as a picture of so many pixels. */
export function tiles({ width, height, channels, data }, columns, rows) {
  const sums = new Float64Array(3 * columns * rows);
  const counts = new Float64Array(columns * rows);
  for (let y = 0; y < height; y += 1) {
    for (let x = 0; x < width; x += 1) {
      const tile = Math.floor((y * rows) / height) * columns + Math.floor((x * columns) / width);
      counts[tile] += 1;
      for (let channel = 0; channel < 3; channel += 1) sums[3 * tile + channel] += data[(y * width + x) * channels + channel];
    }
  }
  return {
    width: columns,
    height: rows,
    channels: 3,
    data: Uint8Array.from(sums, (sum, at) => Math.round(sum / counts[Math.floor(at / 3)])),
  };
}

/** A small picture to be stored: a line for each row, in hexadecimal digits. */
export function asText({ width, height, data }) {
  return Array.from({ length: height }, (_, row) => Buffer.from(data.subarray(3 * width * row, 3 * width * (row + 1))).toString('hex'));
}

/** And back; throws where nothing of that size was stored. */
export function asPicture(rows, width, height) {
  if (rows?.length !== height || rows.some(({ length }) => length !== 6 * width))
    throw new Error('nothing of its kind is stored; UPDATE=1 stores it');
  return { width, height, channels: 3, data: Buffer.from(rows.join(''), 'hex') };
}
