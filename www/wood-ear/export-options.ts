/** The options of an export of wood ears: those of all exports, but for what only rocks can be. */

import { impossible, isMap, resolveOptions } from '../export/options.ts';
import type { ExportOptions, ResolvedOptions } from '../export/options.ts';

/**
 * All options, checked.
 *
 * @throws {RockFieldError} as `resolveOptions`; `ExportImpossible` for a kit, its points, maps and textures.
 */
export function colonyOptions(options?: ExportOptions): ResolvedOptions {
  const resolved = resolveOptions(options);
  const { format, mesh, textures } = resolved;
  const others = 'use format "glb", "obj", "stl" or "ply"';
  if (isMap(resolved)) throw impossible('format', format, `maps show rocks from above: ${others}`);
  // Nobody asked for points but by the format, which holds nothing else.
  if (mesh === 'points' && options?.mesh === undefined)
    throw impossible('format', format, `it holds points alone, which stand for meshes of a kit, and wood ears have none: ${others}`);
  if (textures !== 'none') throw impossible('textures', textures, 'only stone has them: leave textures out');
  if (mesh === 'rocks' || mesh === 'one') return resolved;
  throw impossible('mesh', mesh, 'every wood ear has its own shape, pressed against its neighbours: use mesh "rocks" or "one"');
}
