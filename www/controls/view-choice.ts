/** How the scene is drawn: a choice of views, and of colours. */

import { isPlan } from '../scene/camera/camera.ts';
import { segments } from './parts.ts';
import type { TemplateResult } from 'lit';
import type { Kind } from '../table/table.ts';
import type { Store } from './store.ts';

export function viewChoice<K extends Kind>(store: Store<K>, hideLabel: boolean): TemplateResult {
  return segments({
    name: 'view',
    label: store.text('view'),
    hideLabel,
    options: store.table.views.map((value) => ({ value, label: store.text(`view-${value}`) })),
    value: store.view,
    action: (view) => store.setView(view),
  });
}

export function colorChoice<K extends Kind>(store: Store<K>, hideLabel: boolean): TemplateResult {
  return segments({
    name: 'color',
    label: store.text('color'),
    hideLabel,
    options: store.table.colors.map((value) => ({ value, label: store.text(`color-${value}`) })),
    value: store.color,
    action: (color) => store.setColor(color),
    // Plans are drawn in the layers' colours.
    disabled: isPlan(store.view),
  });
}
