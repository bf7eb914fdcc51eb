/** Patches side by side in a square. */

/** What is laid out: in units of the model, upright. */
export interface Box {
  width: number;
  height: number;
}

export interface Packing {
  /** Texels in a unit of the model. */
  density: number;
  /** For each box, x and y of its upper left corner within its margin, texels. */
  corners: Uint32Array;
}

/** Halvings of the interval in which the density is searched: to a millionth of it. */
const HALVINGS = 20;

/**
 * The largest packing that fits, in shelves of falling height; null where nothing does.
 *
 * potpack and its like take the boxes as they are, and find the square: here the square is given, and the boxes are scaled.
 *
 * @param margin around every box, texels.
 */
export function packed(boxes: readonly Box[], side: number, margin: number): Packing | null {
  const order = [...boxes.keys()].sort((a, b) => boxes[b]!.height - boxes[a]!.height || a - b);
  let [low, high] = [0, side / Math.sqrt(boxes.reduce((sum, { width, height }) => sum + width * height, 0))];
  let best = shelves(boxes, order, side, margin, low);
  if (!best) return null;
  for (let halving = 0; halving < HALVINGS; halving++) {
    const middle = (low + high) / 2;
    const found = shelves(boxes, order, side, margin, middle);
    if (found) [low, best] = [middle, found];
    else high = middle;
  }
  return low > 0 ? { density: low, corners: best } : null;
}

function shelves(boxes: readonly Box[], order: readonly number[], side: number, margin: number, density: number): Uint32Array | null {
  const corners = new Uint32Array(2 * boxes.length);
  const texels = (length: number): number => Math.ceil(density * length) + 1 + 2 * margin;
  let [x, y, shelf] = [0, 0, 0];
  for (const k of order) {
    const [width, height] = [texels(boxes[k]!.width), texels(boxes[k]!.height)];
    if (x + width > side) [x, y, shelf] = [0, y + shelf, 0];
    if (width > side || y + height > side) return null;
    corners[2 * k] = x + margin;
    corners[2 * k + 1] = y + margin;
    x += width;
    shelf = Math.max(shelf, height);
  }
  return corners;
}
