/** `panel.js`: what a `<rock-field controls>` loads when its panel is opened for the first time. */

import { panelAddress } from '../controls/clipboard.ts';
import { ControlPanel } from './controls/panel.ts';
import { EmbeddedPanel } from '../controls/embedded-panel.ts';
import { Store } from './controls/store.ts';
import type { OpenPanel, PanelOwner } from '../element/controls-button.ts';
import type { Rocks } from './table.ts';

export function openPanel(owner: PanelOwner<Rocks>, close: () => void): OpenPanel {
  return new EmbeddedPanel(owner, close, {
    newStore: (link, preferences, history) => new Store(link, preferences, history),
    panel: new ControlPanel(),
    script: panelAddress(import.meta.url),
  });
}
