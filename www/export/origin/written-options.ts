/** What a file says of how it was written: so much that it can be made again, and nothing that would make two files of one. */

import { isMap, OPTIONS, resolveOptions } from '../options.ts';
import type { OptionKey, ResolvedOptions } from '../options.ts';

type Says = (options: ResolvedOptions) => boolean;

const isPoints: Says = (options) => !isMap(options) && options.mesh === 'points';
const isMesh: Says = (options) => !isMap(options) && !isPoints(options);
const isKit: Says = (options) => isMesh(options) && options.mesh === 'kit';
const isPlain: Says = (options) => isMesh(options) && options.format !== 'glb';
const isGlb: Says = (options) => isMesh(options) && options.format === 'glb';
/** A ZIP of all maps has points, too. */
const hasPoints: Says = (options) => isPoints(options) || (isMap(options) && options.map === 'all');
const shows =
  (...maps: readonly ResolvedOptions['map'][]): Says =>
  (options) =>
    isMap(options) && [...maps, 'all'].includes(options.map);

/** In which files an option changes anything. */
const CHANGES: Record<OptionKey, Says> = {
  format: () => true,
  mesh: (options) => !isMap(options),
  kinds: (options) => isKit(options) || hasPoints(options),
  instancing: isKit,
  solid: isMesh,
  belowGround: isMesh,
  groundMesh: isMesh,
  color: (options) => isMesh(options) || hasPoints(options),
  textures: isGlb,
  vertexColors: isMesh,
  compress: isGlb,
  lods: isMesh,
  hulls: isGlb,
  parts: isMesh,
  up: isPlain,
  scale: isPlain,
  // Every file says it by itself.
  metresPerPixel: () => false,
  axes: hasPoints,
  map: isMap,
  side: isMap,
  square: isMap,
  samples: isMap,
  green: shows('normal'),
  // Moss grows where it is near.
  contact: shows('contact', 'splat'),
};

/** The format, where it is not GLB, and the options that count for a file and are not as they are by themselves in one of its format. */
export function writtenOptions(options: ResolvedOptions): { options?: Partial<ResolvedOptions> } {
  const plain: ResolvedOptions = { ...resolveOptions({ format: options.format }), format: OPTIONS.format.default };
  const others = (Object.keys(OPTIONS) as OptionKey[]).filter((key) => options[key] !== plain[key] && CHANGES[key](options));
  return others.length > 0 ? { options: Object.fromEntries(others.map((key) => [key, options[key]])) } : {};
}

/**
 * Whether a file is in natural colours, and the options with their colour as the file says it: `preset` wherever that is the same, since a page asks
 * for what it shows by name.
 *
 * @param isNaturalByItself whether the scene's preset has natural colours.
 */
export function coloured(options: ResolvedOptions, isNaturalByItself: boolean): { isNatural: boolean; options: ResolvedOptions } {
  const { color } = options;
  const isNatural = color === 'preset' ? isNaturalByItself : color === 'natural';
  return { isNatural, options: { ...options, color: isNatural === isNaturalByItself ? 'preset' : color } };
}
