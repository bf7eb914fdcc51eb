/** Masks out of pictures, for the element; fetched when somebody gives it one. */

import { RockFieldError, isAbort } from '../base/errors.ts';
import { defaultMaxBytes } from '../generator/budget.ts';
import { shown, wrongType } from '../table/param-checks.ts';
import { checkedSize, maskRows } from './mask.ts';
import type { Mask, MaskRows } from './mask.ts';

/** Rows that are looked at together, so that the copy of a picture with four bytes per pixel is never whole. */
const STRIP = 256;
/** How much of a file may stand before what says how large its picture is. */
const HEADER = 2 ** 16;

/** An element that has a mask. */
interface Masked {
  generate(): Promise<unknown>;
  /** What is on screen last of all that has been asked for. */
  getField(): Promise<unknown>;
}

/** Gives an element a mask, or takes it away, and resolves when it is on screen; see `RockFieldElement.setMask`. */
export async function setMask(
  element: HTMLElement & Masked,
  masks: WeakMap<HTMLElement, MaskRows | undefined>,
  mask: Mask | Blob | URL | string | null,
): Promise<void> {
  const rows = mask === null ? undefined : await maskOf(mask, element.ownerDocument.baseURI);
  const before = masks.get(element);
  masks.set(element, rows);
  try {
    await element.generate();
  } catch (thrown) {
    // What is newer has this mask, too, or one that was set since.
    if (isAbort(thrown)) await element.getField();
    else {
      masks.set(element, before);
      throw thrown;
    }
  }
}

/**
 * What the generator takes for a mask: of pixels, of a picture file, or of the address of one.
 *
 * @throws {RockFieldError} `MaskUnreadable`; about the size, before the picture is decoded where its header tells it.
 */
async function maskOf(source: Mask | Blob | URL | string, base: string): Promise<MaskRows> {
  const isAddress = typeof source === 'string' || source instanceof URL;
  if (!isAddress && !(source instanceof Blob)) return maskRows(source, defaultMaxBytes());
  const blob = isAddress ? await fetched(source, base) : source;
  const size = sizeIn(new DataView(await blob.slice(0, HEADER).arrayBuffer()));
  if (size) checkedSize(size, defaultMaxBytes());
  let bitmap: ImageBitmap;
  try {
    bitmap = await createImageBitmap(blob, { premultiplyAlpha: 'none', colorSpaceConversion: 'none' });
  } catch (cause) {
    throw unreadable('the mask is no picture that this browser can read', source, cause);
  }
  try {
    return ofBitmap(bitmap);
  } finally {
    bitmap.close();
  }
}

async function fetched(address: string | URL, base: string): Promise<Blob> {
  let response: Response;
  try {
    response = await fetch(new URL(address, base));
  } catch (cause) {
    throw unreadable(`the mask at ${shown(String(address))} could not be fetched`, address, cause);
  }
  if (!response.ok) throw unreadable(`the mask at ${shown(String(address))} could not be fetched: status ${response.status}`, address);
  return response.blob();
}

function unreadable(message: string, value: unknown, cause?: unknown): RockFieldError {
  return new RockFieldError(
    { name: 'MaskUnreadable', key: 'mask', value: value instanceof Blob ? value.type : String(value), message },
    { cause },
  );
}

function ofBitmap(bitmap: ImageBitmap): MaskRows {
  const { width, height } = bitmap;
  const rows = new Uint8Array(checkedSize({ width, height }, defaultMaxBytes()));
  const canvas = document.createElement('canvas');
  [canvas.width, canvas.height] = [width, Math.min(STRIP, height)];
  const context = canvas.getContext('2d', { willReadFrequently: true });
  if (!context) throw wrongType('mask', bitmap, 'a picture that a canvas can hold');
  for (let top = 0; top < height; top += STRIP) {
    const count = Math.min(STRIP, height - top);
    context.clearRect(0, 0, width, STRIP);
    context.drawImage(bitmap, 0, -top);
    rows.set(maskRows(context.getImageData(0, 0, width, count), defaultMaxBytes()).rows, top * width);
  }
  return { width, rows };
}

/** Width and height as the header of a PNG, a GIF or a JPEG has them; undefined where it does not tell. */
export function sizeIn(bytes: DataView): { width: number; height: number } | undefined {
  const { byteLength } = bytes;
  if (byteLength >= 24 && bytes.getUint32(0) === 0x8950_4e47) return { width: bytes.getUint32(16), height: bytes.getUint32(20) };
  if (byteLength >= 10 && bytes.getUint32(0) === 0x4749_4638) return { width: bytes.getUint16(6, true), height: bytes.getUint16(8, true) };
  if (byteLength < 4 || bytes.getUint16(0) !== 0xffd8) return undefined;
  // Segments, each with its length; the frame's has the size, whatever its colours are.
  for (let at = 2; at + 9 <= byteLength && bytes.getUint8(at) === 0xff; at += 2 + bytes.getUint16(at + 2)) {
    const marker = bytes.getUint8(at + 1);
    if (marker >= 0xc0 && marker <= 0xcf && ![0xc4, 0xc8, 0xcc].includes(marker))
      return { width: bytes.getUint16(at + 7), height: bytes.getUint16(at + 5) };
  }
  return undefined;
}
