/** What the page's buttons do, once one of them is pressed. */

import { errorInfo } from '../base/errors.ts';
import { copyOrShow, showKeys } from './dialogs.ts';
import { embedCode } from './clipboard.ts';
import type { GeneratorElement } from '../element/generator-element.ts';
import type { Draw, Kind } from '../table/table.ts';
import type { Store } from './store.ts';

export interface PageParts<K extends Kind> {
  store: Store<K>;
  element: GeneratorElement<K>;
  stage: HTMLElement;
  random: (params: K['params'], draw: Draw) => Promise<K['params']>;
  /** The link to what is shown. */
  link: () => string;
}

async function withFreshSeed<K extends Kind>({ store, element }: PageParts<K>, use: (seed: number) => void | Promise<void>): Promise<void> {
  try {
    await use(await element.freshSeed());
  } catch (thrown) {
    void store.fail(errorInfo(thrown));
  }
}

export const pageActions = {
  freshSeed: <K extends Kind>(page: PageParts<K>) => withFreshSeed(page, (seed) => page.store.setSeed(seed)),
  randomise: <K extends Kind>(page: PageParts<K>) => withFreshSeed(page, (seed) => page.store.randomise(page.random, seed)),
  share: <K extends Kind>({ store, link }: PageParts<K>) =>
    copyOrShow(store, document.body, `${location.origin}${location.pathname}#${link()}`, 'copied', 'share'),
  embed: <K extends Kind>({ store, element, link }: PageParts<K>) =>
    copyOrShow(store, document.body, embedCode(element.localName, link(), location.href), 'embedCopied', 'embed'),
  help: <K extends Kind>({ store }: PageParts<K>) => showKeys(store, document.body),
  fullScreen: async <K extends Kind>({ stage }: PageParts<K>) => {
    try {
      if (document.fullscreenElement) await document.exitFullscreen();
      else await stage.requestFullscreen();
    } catch (thrown) {
      console.info('rock-field: no full screen:', thrown);
    }
  },
};
