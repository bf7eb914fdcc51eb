/** How the field is drawn: a choice of views, and of colours. */

import { COLORS, VIEWS } from '../url-codec.ts';
import { segments } from './parts.ts';
import type { TemplateResult } from 'lit';
import type { Store } from './store.ts';

export function viewChoice(store: Store, hideLabel: boolean): TemplateResult {
  return segments({
    name: 'view',
    label: store.text('view'),
    hideLabel,
    options: VIEWS.map((value) => ({ value, label: store.text(`view-${value}`) })),
    value: store.view,
    action: (view) => store.setView(view),
  });
}

export function colorChoice(store: Store, hideLabel: boolean): TemplateResult {
  return segments({
    name: 'color',
    label: store.text('color'),
    hideLabel,
    options: COLORS.map((value) => ({ value, label: store.text(`color-${value}`) })),
    value: store.color,
    action: (color) => store.setColor(color),
  });
}
