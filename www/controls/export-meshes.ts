/** What the export dialog offers for meshes. */

import { html, nothing } from 'lit';
import type { TemplateResult } from 'lit';
import { FORMS, OPTIONS } from '../export/options.ts';
import type { ResolvedOptions } from '../export/options.ts';
import { PART_NUMBERS } from '../export/parts.ts';
import { dropDown } from './drop-down.ts';
import type { Choosing } from './export-choosing.ts';
import { segments } from './parts.ts';
import type { LaterKey } from './strings-later.ts';

type Form = ResolvedOptions['mesh'];

/** The forms that a generator's meshes have, and what they are called. */
export interface MeshWords {
  label: LaterKey;
  /** In the order in which they are shown. */
  forms: { [F in Form]?: LaterKey };
  solid: LaterKey;
  open: LaterKey;
  closed: LaterKey;
  /** Which have textures, and reach below the ground. */
  areRocks: boolean;
}

export function meshControls(
  { words, options, choose }: Choosing,
  { label, forms, solid, open, closed, areRocks }: MeshWords,
): TemplateResult {
  return html`
    ${segments({
      name: 'export-mesh',
      label: words(label),
      options: (Object.entries(forms) as [Form, LaterKey][]).map(([value, form]) => ({ value, label: words(form) })),
      value: options.mesh,
      action: (mesh) => choose({ mesh }),
    })}
    ${segments({
      name: 'export-format',
      label: words('exportFormat'),
      options: (['glb', 'obj', 'stl', 'ply'] as const).map((value) => ({ value, label: value.toUpperCase() })),
      value: options.format,
      action: (format) => choose({ format }),
    })}
    ${
      areRocks
        ? segments({
            name: 'export-textures',
            label: words('exportTextures'),
            options: OPTIONS.textures.choices.map((value) => ({ value, label: value === 'none' ? words('textures-none') : value })),
            value: options.textures,
            action: (textures) => choose({ textures }),
          })
        : nothing
    }
    ${segments({
      name: 'export-lods',
      label: words('exportLods'),
      options: ['1', '2', '3', '4'].map((value) => ({ value, label: value })),
      value: String(options.lods),
      action: (lods) => choose({ lods: Number(lods) }),
    })}
    ${segments({
      name: 'export-bottom',
      label: words(solid),
      options: [
        { value: 'open', label: words(open) },
        { value: 'closed', label: words(closed) },
      ],
      value: options.solid ? 'closed' : 'open',
      action: (bottom) => choose({ solid: bottom === 'closed' }),
    })}
    ${
      areRocks
        ? segments({
            name: 'export-below',
            label: words('exportBelow'),
            options: OPTIONS.belowGround.choices.map((value) => ({ value, label: words(`below-${value}`) })),
            value: options.belowGround,
            action: (belowGround) => choose({ belowGround }),
          })
        : nothing
    }
    ${segments({
      name: 'export-ground',
      label: words('exportGround'),
      options: OPTIONS.groundMesh.choices.map((value) => ({ value, label: words(`ground-${value}`) })),
      value: options.groundMesh,
      action: (groundMesh) => choose({ groundMesh }),
    })}
    ${dropDown({
      name: 'export-parts',
      label: words('exportParts'),
      options: PART_NUMBERS.map((n) => ({ value: String(n), label: n === 1 ? words('parts-one') : words('parts-many', { n }) })),
      value: String(options.parts),
      action: (parts) => choose({ parts: Number(parts) }),
    })}
  `;
}

/** What has just been chosen counts; what it cannot go with gives way. */
export function fittingMesh(options: ResolvedOptions, change: Partial<ResolvedOptions>, { forms }: MeshWords): ResolvedOptions {
  const { format, mesh, textures, lods } = options;
  // Copies of a few do not fit the holes of others.
  if (change.groundMesh === 'cut' && mesh === 'kit') return { ...options, mesh: 'rocks' };
  // All rocks share the meshes of a kit, and textures.
  if (change.parts !== undefined && change.parts > 1) return { ...options, mesh: mesh === 'kit' ? 'rocks' : mesh, textures: 'none' };
  const isHeld = mesh in forms && FORMS[format]?.includes(mesh);
  const hasLevels = lods === 1 || format === 'glb' || format === 'obj';
  if (isHeld && hasLevels && (textures === 'none' || format === 'glb')) return options;
  return change.format ? { ...options, mesh: isHeld ? mesh : 'one', textures: 'none' } : { ...options, format: 'glb' };
}
