/** `wood-ear-panel.js`: what a `<wood-ear-log controls>` loads when its panel is opened for the first time. */

import { panelAddress } from '../controls/clipboard.ts';
import { EmbeddedPanel } from '../controls/embedded-panel.ts';
import { WoodEarPanel } from './controls/panel.ts';
import { WoodEarStore } from './controls/store.ts';
import { errorInfo, isAbort } from '../base/errors.ts';
import type { GeneratorElement } from '../element/generator-element.ts';
import type { OpenPanel, PanelOwner } from '../element/panel-owner.ts';
import type { WoodEars } from './table.ts';

/** The part of `<wood-ear-log>` that no other element has. */
interface LogReader {
  loadLog(file: File): Promise<unknown>;
}

export function openPanel(owner: PanelOwner<WoodEars, GeneratorElement<WoodEars>>, close: () => void): OpenPanel {
  const element = owner.element as unknown as HTMLElement & LogReader;
  return new EmbeddedPanel(owner, close, {
    newStore: (link, preferences, history) => new WoodEarStore(link, preferences, history),
    panel: new WoodEarPanel(),
    script: panelAddress(import.meta.url),
    actions: {
      loadLog: (file: File) => {
        element.loadLog(file).catch((thrown: unknown) => {
          if (!isAbort(thrown)) element.dispatchEvent(new CustomEvent('error', { detail: { error: errorInfo(thrown) }, composed: true }));
        });
      },
    },
  });
}
