/** What a file says of the scene that it shows. PNG has it as text, glTF in the extras of its scene, ZIP and JSON as a file of their own. */

import { VERSION } from '../../data/version.ts';

/** Under this name it is found in a file. */
export const KEYWORD = 'rock-field';

export interface Origin {
  /** Brings the scene back: a link without the address of a page. */
  link: string;
  /** Of the package that wrote the file. */
  version: string;
  /** SHA-256 of the scene's buffers, hexadecimal: `hash.ts`. */
  hash: string;
  /** Size of a pixel of the ground. */
  metresPerPixel: number;
}

export function originOf({ link, hash, metresPerPixel }: Omit<Origin, 'version'>): Origin {
  return { link, version: VERSION, hash, metresPerPixel };
}
