/** `panel.js`: what a `<rock-field controls>` loads when its panel is opened for the first time. */

import { panelAddress } from '../controls/clipboard.ts';
import { RockPanel } from './controls/panel.ts';
import { EmbeddedPanel } from '../controls/embedded-panel.ts';
import { ROCK_LATER } from './controls/deferred.ts';
import { RockStore } from './controls/store.ts';
import type { GeneratorElement } from '../element/generator-element.ts';
import type { OpenPanel, PanelOwner } from '../element/panel-owner.ts';
import type { Rocks } from './table.ts';

export function openPanel(owner: PanelOwner<Rocks, GeneratorElement<Rocks>>, close: () => void): OpenPanel {
  return new EmbeddedPanel(owner, close, {
    newStore: (link, preferences, history) => new RockStore(link, preferences, ROCK_LATER, history),
    panel: new RockPanel(),
    script: panelAddress(import.meta.url),
  });
}
