/** Files on the page of rocks. */

import { shown } from '../base/file-name.ts';
import { toast } from '../controls/dialogs.ts';
import { PAGES } from '../controls/site.ts';
import { importedScene } from '../element/import-file.ts';
import { setMask } from '../rocks/controls/painting/paint-section.ts';
import { paintWords } from '../rocks/controls/painting/paint-words.ts';
import type { RockStore } from '../rocks/controls/store.ts';
import type { RockFieldElement } from '../rocks/element.ts';
import { fieldHash } from '../rocks/hash.ts';
import { decodeLink } from '../rocks/link.ts';
import { ROCKS } from '../rocks/table.ts';
import type { Rocks } from '../rocks/table.ts';
import { bringBack } from './bring-back.ts';
import type { FileParts } from './bring-back.ts';

const TOAST_MS = 4000;

export function listenToFiles(parts: FileParts<Rocks>): void {
  const element = parts.element as RockFieldElement;
  bringBack(parts, {
    reading: { table: ROCKS, decode: decodeLink },
    hash: async () => fieldHash(await element.getField()),
    pictures: {
      take: async (file) => {
        const store = parts.store as RockStore;
        if (await setMask(store, element, file))
          toast(document.body, paintWords(store.language, 'maskSet', { file: shown(file.name) }), TOAST_MS);
      },
      invitation: (language) => paintWords(language, 'drop'),
    },
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
