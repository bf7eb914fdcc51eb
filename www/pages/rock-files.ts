/** Files on the page of rocks. */

import { PAGES } from '../controls/site.ts';
import { importedScene } from '../element/import-file.ts';
import type { RockFieldElement } from '../rocks/element.ts';
import { fieldHash } from '../rocks/hash.ts';
import { decodeLink } from '../rocks/link.ts';
import { ROCKS } from '../rocks/table.ts';
import type { Rocks } from '../rocks/table.ts';
import { bringBack } from './bring-back.ts';
import type { FileParts } from './bring-back.ts';

export function listenToFiles(parts: FileParts<Rocks>): void {
  const element = parts.element as RockFieldElement;
  bringBack(parts, {
    reading: { table: ROCKS, decode: decodeLink },
    hash: async () => fieldHash(await element.getField()),
    otherPage: async (file) => {
      const [{ decodeWoodEarLink, encodeWoodEarLink }, { WOOD_EARS }] = await Promise.all([
        import('../wood-ear/link.ts'),
        import('../wood-ear/table.ts'),
      ]);
      const scene = await importedScene({ table: WOOD_EARS, decode: decodeWoodEarLink }, file);
      const { name, href } = PAGES[1];
      return { name, address: `${href}#${encodeWoodEarLink(scene)}` };
    },
  });
}
