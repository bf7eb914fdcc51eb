/** Pictures that are drawn in parts: larger than a device draws at once, or without the ground. */

import { RockFieldError } from '../base/errors.ts';
import { lazily } from '../base/lazy.ts';
import type { CameraState } from '../base/view.ts';
import { PngRows } from '../export/formats/png-rows.ts';
import type { Lens, SceneRenderer, Tile } from '../renderer/renderer.ts';

/** Width and height of a part, device pixels: even, since some of what is drawn is worked out for four pixels together. */
const TILE = [2048, 512] as const;

/** What is drawn, and on what. */
export interface TiledPicture {
  renderer: SceneRenderer;
  size: readonly [width: number, height: number];
  camera: CameraState;
  /** Of how many samples each part is the mean; undefined where light and shade are worked out at once. */
  samples?: number | undefined;
  lens?: Lens | undefined;
  /** Without ground and backdrop, which are then transparent. */
  isBare: boolean;
  /** Readies the renderer for a part. */
  prepare: () => void;
  /** Gives the screen its own picture back, in the task of each part. */
  restore: () => void;
  /** Whether what is drawn is still the same: a picture of two scenes is none. */
  isSame: () => boolean;
  signal?: AbortSignal | undefined;
  onProgress?: ((fraction: number) => void) | undefined;
  /** For tests: another size of the parts. */
  tile?: readonly [width: number, height: number];
}

/**
 * The picture as a PNG file, by a renderer that draws parts; undefined where the device was lost, or the scene changed, before all of it was
 * drawn.
 *
 * @throws the signal's reason.
 */
export async function tiledPicture(picture: TiledPicture): Promise<Blob | undefined> {
  const { renderer, size, isBare, signal, onProgress } = picture;
  const [width, height] = size;
  const rows = new PngRows(width, height, isBare);
  const [across, down] = [0, 1].map((axis) => Math.min(size[axis]!, (picture.tile ?? TILE)[axis]!)) as [number, number];
  const { context, canvas } = scratch(renderer, across, down);
  try {
    for (let y = 0; y < height; y += down) {
      const band = new ImageData(width, Math.min(down, height - y));
      for (let x = 0; x < width; x += across) {
        signal?.throwIfAborted();
        if (renderer.isLost || !picture.isSame()) return undefined;
        // All parts are of one size: the last ones begin where they fit.
        const corner = [Math.min(x, width - across), Math.min(y, height - down)] as const;
        const part = await drawnPart(picture, context, { whole: size, corner, size: [across, down] });
        if (!part) return undefined;
        put(band, part, [corner[0], corner[1] - y]);
        onProgress?.((y + (down * (x + across)) / width) / (height + down));
        await new Promise((resolve) => setTimeout(resolve));
      }
      await rows.add(band.data);
    }
  } finally {
    // What it holds is given back at once.
    canvas.width = canvas.height = 0;
  }
  signal?.throwIfAborted();
  return rows.finish();
}

/** A canvas that the parts are read from. */
function scratch(renderer: SceneRenderer, width: number, height: number): { canvas: HTMLCanvasElement; context: CanvasRenderingContext2D } {
  const canvas = renderer.canvas.ownerDocument.createElement('canvas');
  [canvas.width, canvas.height] = [width, height];
  const context = canvas.getContext('2d', { willReadFrequently: true });
  if (!context) throw new RockFieldError({ name: 'NoPicture', message: 'there is no 2D canvas to read the picture from' });
  return { canvas, context };
}

/** Undefined where the device was lost, or the scene changed. */
async function drawnPart(
  picture: TiledPicture,
  context: CanvasRenderingContext2D,
  tile: Omit<Tile, 'backing'>,
): Promise<ImageData | undefined> {
  const { renderer, camera, samples, lens, isBare, isSame, signal, prepare, restore } = picture;
  const [width, height] = tile.size;
  const read = (): ImageData => {
    // At once: in the next task the canvas may be blank.
    context.drawImage(renderer.canvas, 0, 0, width, height, 0, 0, width, height);
    return context.getImageData(0, 0, width, height);
  };
  const draw = (backing: Tile['backing']): ImageData => {
    renderer.renderTile?.({ ...tile, backing });
    return read();
  };
  if (samples) {
    const { stillPicture } = await lazily(() => import('./still.ts'));
    const part = { ...tile, backing: 'none' } as const;
    return stillPicture({ renderer, size: tile.size, tile: part, camera, samples, lens, isSame, signal, prepare, restore }, read);
  }
  prepare();
  renderer.setCamera(camera);
  try {
    return isBare ? bare(draw('black'), draw('white')) : draw('none');
  } finally {
    restore();
  }
}

/** What is the same on black and on white is opaque; the difference is how much of the ground is seen through, or shaded. */
function bare(black: ImageData, { data: onWhite }: ImageData): ImageData {
  const { data } = black;
  for (let at = 0; at < data.length; at += 4) {
    const through = onWhite[at]! + onWhite[at + 1]! + onWhite[at + 2]! - data[at]! - data[at + 1]! - data[at + 2]!;
    const opacity = Math.min(255, Math.max(0, 255 - Math.round(through / 3)));
    // On black it is dimmed by as much as it is transparent.
    for (let k = at; k < at + 3; k += 1) data[k] = opacity === 0 ? 0 : Math.round((255 * data[k]!) / opacity);
    data[at + 3] = opacity;
  }
  return black;
}

/** Copies a part to its place in a band, which may begin within it. */
function put(band: ImageData, part: ImageData, [x, y]: readonly [number, number]): void {
  for (let row = Math.max(0, -y); row < part.height && row + y < band.height; row += 1) {
    const own = part.data.subarray(4 * row * part.width, 4 * (row + 1) * part.width);
    band.data.set(own, 4 * ((row + y) * band.width + x));
  }
}
