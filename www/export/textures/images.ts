/** The textures of a file: what the renderer has drawn, taken apart into images. */

import type { Images } from '../model.ts';
import { filled, TEXEL } from './fill.ts';
import { writePng } from '../maps/png.ts';

/** Side of the tiles, texels. */
export const TILE = 1024;

/** Bytes of a texel, as `src/shading/shaders/bake.wgsl` writes them. */
const [OPEN, RIGHT, UP, ROUGH] = [3, 4, 5, 6];

/**
 * @param tiles of the atlas, row by row. They are taken out of the list, so that their memory is free again: of the largest textures it is 512 MB.
 * @param onProgress is told the share of the work that is done, 0 … 1.
 */
export async function imagesOf(tiles: Uint8Array[], side: number, onProgress?: (fraction: number) => void): Promise<Images> {
  const texels = joined(tiles, side);
  filled(texels, side);
  let done = 0;
  const image = async (fill: (from: number, samples: Uint8Array, to: number) => void): Promise<Uint8Array<ArrayBuffer>> => {
    const samples = new Uint8Array(3 * side * side);
    for (let from = 0, to = 0; from < texels.length; from += TEXEL, to += 3) fill(from, samples, to);
    const file = await writePng({ width: side, height: side, channels: 3, samples }, {}, (fraction) => {
      onProgress?.((done + fraction) / 3);
      return undefined;
    });
    done += 1;
    return file;
  };
  // One after the other: each takes as much memory as the tiles.
  const color = await image((from, samples, to) => {
    for (let byte = 0; byte < 3; byte++) samples[to + byte] = texels[from + byte]!;
  });
  const normal = await image((from, samples, to) => {
    const [x, y] = [texels[from + RIGHT]!, texels[from + UP]!];
    samples[to] = x;
    samples[to + 1] = y;
    samples[to + 2] = third(x, y);
  });
  const surface = await image((from, samples, to) => {
    samples[to] = texels[from + OPEN]!;
    samples[to + 1] = texels[from + ROUGH]!;
  });
  return { color, normal, surface };
}

/** z of a unit vector whose x and y are these bytes. */
function third(x: number, y: number): number {
  const [across, up] = [x / 127.5 - 1, y / 127.5 - 1];
  return Math.round(127.5 + 127.5 * Math.sqrt(Math.max(0, 1 - across * across - up * up)));
}

function joined(tiles: Uint8Array[], side: number): Uint8Array {
  const texels = new Uint8Array(TEXEL * side * side);
  const across = side / TILE;
  for (let number = across * across - 1; number >= 0; number--) {
    const tile = tiles.pop()!;
    const [left, top] = [TILE * (number % across), TILE * Math.floor(number / across)];
    for (let row = 0; row < TILE; row++) {
      texels.set(tile.subarray(TEXEL * TILE * row, TEXEL * TILE * (row + 1)), TEXEL * ((top + row) * side + left));
    }
  }
  return texels;
}
