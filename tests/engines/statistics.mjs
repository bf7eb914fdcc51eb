// What can be said of a picture of the default element without comparing pixels, which no two devices draw alike.

/**
 * The rocks of a layer by their hue, in degrees, and by how much of it there is at least: terracotta, ochre and slate of the
 * palette. The brown ground and the blue sky have less of it.
 */
const LAYERS = [
  { hue: [0, 22], saturation: 0.42 },
  { hue: [32, 50], saturation: 0.4 },
  { hue: [190, 220], saturation: 0.24 },
];

/** What is asked of each picture alone. The element covers its box; the layers take 9, 13 and 17 % of it in these hues. */
const LEAST = { covered: 0.99, colors: 300, layer: 0.02 };

/**
 * By how much engines may differ. Devices place their samples, round and filter the shadow's edge each in its own way, so pixels at
 * edges change sides; inside of a face nothing may. Between SwiftShader and Mesa, on either backend, shares were seen to differ by
 * 0.0004, means by 0.9 of 255 and the number of colours by one in 710; real cards get some more. A gamma applied twice moves the
 * means by 20 and more.
 */
const TOLERANCE = { covered: 0.005, layer: 0.01, mean: 4, colors: 0.15 };

/**
 * @param {import('../../scripts/lib/pixels.mjs').Picture} picture
 * @param {import('../../scripts/lib/pixels.mjs').Box} box the element's
 * @param {number[]} background of the page around it, red, green, blue
 * @returns {{ covered: number, colors: number, layers: { share: number, mean: number[] }[], quarters: number[][] }}
 *   `colors` counts those that differ in the upper five bits of a channel; `quarters` are the mean colours of the box's four
 */
export function statistics(picture, box, background) {
  const layers = LAYERS.map(() => new Mean());
  const quarters = [0, 1, 2, 3].map(() => new Mean());
  const colors = new Set();
  let covered = 0;
  for (let row = 0; row < box.height; row += 1) {
    for (let column = 0; column < box.width; column += 1) {
      const at = ((box.y + row) * picture.width + box.x + column) * 4;
      const color = [picture.data[at], picture.data[at + 1], picture.data[at + 2]];
      if (color.some((value, channel) => value !== background[channel])) covered += 1;
      colors.add(color.reduce((bits, value) => (bits << 5) | (value >> 3), 0));
      layers[layerOf(color)]?.add(color);
      quarters[2 * Number(2 * row >= box.height) + Number(2 * column >= box.width)].add(color);
    }
  }
  const pixels = box.width * box.height;
  return {
    covered: covered / pixels,
    colors: colors.size,
    layers: layers.map((layer) => ({ share: layer.count / pixels, mean: layer.value })),
    quarters: quarters.map((quarter) => quarter.value),
  };
}

/** @param {number[]} color */
function layerOf([red, green, blue]) {
  const max = Math.max(red, green, blue);
  const range = max - Math.min(red, green, blue);
  if (range === 0) return -1;
  let sixth = (red - green) / range + 4;
  if (max === red) sixth = ((green - blue) / range + 6) % 6;
  else if (max === green) sixth = (blue - red) / range + 2;
  return LAYERS.findIndex(({ hue, saturation }) => 60 * sixth >= hue[0] && 60 * sixth <= hue[1] && range / max >= saturation);
}

class Mean {
  count = 0;
  #sums = [0, 0, 0];

  add(color) {
    this.count += 1;
    for (let channel = 0; channel < 3; channel += 1) this.#sums[channel] += color[channel];
  }

  get value() {
    return this.#sums.map((sum) => sum / Math.max(1, this.count));
  }
}

/** What is wrong with a picture by itself, in sentences. */
export function faults({ covered, colors, layers }) {
  const found = [];
  if (covered < LEAST.covered) found.push(`only ${percent(covered)} of the element differ from the page behind it`);
  if (colors < LEAST.colors) found.push(`there are only ${colors} colours in it`);
  layers.forEach(({ share }, index) => {
    if (share < LEAST.layer) found.push(`rocks of layer ${index} take only ${percent(share)} of it`);
  });
  return found;
}

/** In what two pictures differ by more than they may, in sentences. */
export function differences(a, b) {
  const found = [];
  /** @param {(value: number) => string} [show] */
  const compare = (what, x, y, tolerance, show = String) => {
    if (Math.abs(x - y) > tolerance) found.push(`${what}: ${show(x)} and ${show(y)}`);
  };
  const compareMeans = (what, x, y) => {
    if (x.some((value, channel) => Math.abs(value - y[channel]) > TOLERANCE.mean)) found.push(`${what}: ${rgb(x)} and ${rgb(y)}`);
  };
  compare('covered', a.covered, b.covered, TOLERANCE.covered, percent);
  compare('colours', a.colors, b.colors, TOLERANCE.colors * Math.max(a.colors, b.colors));
  a.layers.forEach((layer, index) => {
    compare(`share of layer ${index}`, layer.share, b.layers[index].share, TOLERANCE.layer, percent);
    compareMeans(`mean colour of layer ${index}`, layer.mean, b.layers[index].mean);
  });
  a.quarters.forEach((quarter, index) => compareMeans(`mean colour of quarter ${index}`, quarter, b.quarters[index]));
  return found;
}

function percent(share) {
  return `${(100 * share).toFixed(2)} %`;
}

function rgb(color) {
  return `rgb(${color.map((value) => value.toFixed(1)).join(', ')})`;
}
