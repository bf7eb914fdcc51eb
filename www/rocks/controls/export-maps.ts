/** What the export dialog offers for maps and points, and how choices there give way to one another. */

import { html } from 'lit';
import type { TemplateResult } from 'lit';
import { dropDown } from '../../controls/drop-down.ts';
import type { Choosing } from '../../controls/export-choosing.ts';
import { segments } from '../../controls/parts.ts';
import { isMap, MAPS, OPTIONS, resolveOptions } from '../../export/options.ts';
import type { ExportTarget, ResolvedOptions } from '../../export/options.ts';

export const CONTENTS = ['meshes', 'points', 'maps'] as const;
/** What a file is about. */
export type Content = (typeof CONTENTS)[number];

export function contentOf(options: ResolvedOptions): Content {
  if (isMap(options)) return 'maps';
  return options.mesh === 'points' ? 'points' : 'meshes';
}

/** The change of options that makes a file one about `content`. */
export function turnTo(content: Content, { map }: ResolvedOptions, target: ExportTarget): Partial<ResolvedOptions> {
  if (content === 'maps') return { format: map === 'all' ? 'zip' : 'png', textures: 'none' };
  if (content === 'points') return { format: 'csv', mesh: 'points', textures: 'none' };
  const { format, mesh } = resolveOptions({ target });
  return { format, mesh };
}

/** The change of options for another target, which leaves open maps and points. */
export function retarget(options: ResolvedOptions, target: ExportTarget): Partial<ResolvedOptions> {
  const preferred = resolveOptions({ target });
  if (contentOf(options) === 'meshes' || target === 'print') return preferred;
  const { axes, green } = preferred;
  const side = options.samples === 'corners' ? enough(landscapesFor(target), options.side) : options.side;
  return { axes, green, side };
}

/** What has just been chosen of maps counts; what it cannot go with gives way. */
export function fittingMap(options: ResolvedOptions, { format: isFormatNew }: Partial<ResolvedOptions>): ResolvedOptions {
  const { format, map } = options;
  if (MAPS[format]?.includes(map)) return options;
  return isFormatNew ? { ...options, map: MAPS[format]![0]! } : { ...options, format: formatsOf(map)[0]! };
}

/** The formats that hold a map. */
function formatsOf(map: ResolvedOptions['map']): ResolvedOptions['format'][] {
  return OPTIONS.format.choices.filter((format) => MAPS[format]?.includes(map));
}

const TEXTURES = [512, 1024, 2048, 4096, 8192];

/** Corners on a side of the landscapes that a program has. */
function landscapesFor(target: ExportTarget): readonly number[] {
  return target === 'unreal' ? [505, 1009, 2017, 4033, 8129] : [513, 1025, 2049, 4097];
}

/** The first that hardly loses anything of `side` pixels. */
function enough(sides: readonly number[], side: number): number {
  return sides.find((one) => one >= 0.9 * side) ?? sides.at(-1)!;
}

export function pointControls({ words, options, choose }: Choosing): TemplateResult {
  return segments({
    name: 'export-format',
    label: words('exportFormat'),
    options: (['csv', 'ply'] as const).map((value) => ({ value, label: value.toUpperCase() })),
    value: options.format,
    action: (format) => choose({ format }),
  });
}

/** @param fieldSide pixels of the longer side of the field. */
export function mapControls({ words, options, target, choose }: Choosing, fieldSide: number): TemplateResult {
  const isLandscape = options.samples === 'corners';
  const sides = isLandscape ? landscapesFor(target) : [0, ...TEXTURES];
  const label = (side: number): string => (side === 0 ? `${words('sideOfField')} (${fieldSide})` : String(side));
  return html`
    ${dropDown({
      name: 'export-map',
      label: words('exportMap'),
      options: OPTIONS.map.choices.map((value) => ({ value, label: words(`map-${value}`) })),
      value: options.map,
      action: (map) => choose({ map }),
    })}
    ${segments({
      name: 'export-format',
      label: words('exportFormat'),
      options: formatsOf(options.map).map((value) => ({ value, label: value.toUpperCase() })),
      value: options.format,
      action: (format) => choose({ format }),
    })}
    ${segments({
      name: 'export-samples',
      label: words('exportUse'),
      options: OPTIONS.samples.choices.map((value) => ({ value, label: words(`samples-${value}`) })),
      value: options.samples,
      action: (samples) =>
        choose(
          samples === 'corners'
            ? { samples, square: true, side: enough(landscapesFor(target), options.side || fieldSide) }
            : { samples, square: false, side: 0 },
        ),
    })}
    ${dropDown({
      name: 'export-side',
      label: words('exportSide'),
      options: sides.map((side) => ({ value: String(side), label: label(side) })),
      value: String(options.side),
      action: (side) => choose({ side: Number(side) }),
    })}
  `;
}
