/** Files on the page of wood ears: scenes, and logs. */

import { errorInfo, isAbort } from '../base/errors.ts';
import { PAGES } from '../controls/site.ts';
import { importedScene } from '../element/import-file.ts';
import { decodeLink, encodeLink } from '../rocks/link.ts';
import { ROCKS } from '../rocks/table.ts';
import type { WoodEarLogElement } from '../wood-ear/element.ts';
import { colonyHash } from '../wood-ear/hash.ts';
import { decodeWoodEarLink } from '../wood-ear/link.ts';
import { besideNotice, logAmong, nothingDropped } from '../wood-ear/log-drop.ts';
import { WOOD_EARS } from '../wood-ear/table.ts';
import type { WoodEars } from '../wood-ear/table.ts';
import { bringBack } from './bring-back.ts';
import type { FileParts } from './bring-back.ts';

export function listenToFiles(parts: FileParts<WoodEars>): void {
  const { store } = parts;
  const element = parts.element as WoodEarLogElement;
  bringBack(parts, {
    reading: { table: WOOD_EARS, decode: decodeWoodEarLink },
    hash: async () => colonyHash(await element.getColony()),
    otherPage: async (file) => {
      const scene = await importedScene({ table: ROCKS, decode: decodeLink }, file);
      const { name, href } = PAGES[0];
      return { name, address: `${href}#${encodeLink(scene)}` };
    },
    takeOthers: (files) => {
      const file = logAmong(files);
      const said = file ? besideNotice(files, store.language) : nothingDropped(store.language);
      if (said) store.say(() => said, !file);
      if (file) element.loadLog(file).catch((thrown: unknown) => void (isAbort(thrown) || store.fail(errorInfo(thrown))));
    },
  });
}
