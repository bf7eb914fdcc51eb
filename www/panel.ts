/** `panel.js`: what an element with `controls` loads when its panel is opened for the first time. */

import { cdnBeside } from './controls/clipboard.ts';
import { EmbeddedPanel } from './controls/embedded-panel.ts';
import type { PanelOwner } from './controls-button.ts';

export function openPanel(owner: PanelOwner, close: () => void): EmbeddedPanel {
  // The address of this very file: what the panel is made of may lie in others.
  return new EmbeddedPanel(owner, close, cdnBeside(import.meta.url));
}
