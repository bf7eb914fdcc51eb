/** `wood-ear-panel.js`: what a `<wood-ear-log controls>` loads when its panel is opened for the first time. */

import { panelAddress } from './controls/clipboard.ts';
import { EmbeddedPanel } from './controls/embedded-panel.ts';
import { WoodEarPanel } from './controls/wood-ear-controls.ts';
import { WoodEarStore } from './controls/wood-ear-store.ts';
import { errorInfo, isAbort } from './errors.ts';
import type { OpenPanel, PanelOwner } from './controls-button.ts';
import type { WoodEarLogElement } from './wood-ear-log-element.ts';
import type { WoodEars } from './wood-ears.ts';

export function openPanel(owner: PanelOwner<WoodEars>, close: () => void): OpenPanel {
  const element = owner.element as unknown as WoodEarLogElement;
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
