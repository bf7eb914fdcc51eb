/** The options of an export of wood ears: those of all exports, but for what only rocks can be. */

import { impossible, isMap, resolveOptions } from '../export/options.ts';
import type { ExportOptions, ResolvedOptions } from '../export/options.ts';

/**
 * All options, checked.
 *
 * @throws {RockFieldError} as `resolveOptions`; `ExportImpossible` for a kit, its points, maps, textures, and a mesh of the ground.
 */
export function colonyOptions(options?: ExportOptions): ResolvedOptions {
  const resolved = resolveOptions(options);
  if (isMap(resolved)) throw impossible('format', resolved.format, 'maps show rocks from above: use format "glb", "obj", "stl" or "ply"');
  const { mesh, textures, groundMesh } = resolved;
  if (textures !== 'none') throw impossible('textures', textures, 'only stone has them: leave textures out');
  if (groundMesh !== 'none') throw impossible('groundMesh', groundMesh, 'the ground of a field alone becomes a mesh: leave groundMesh out');
  if (mesh === 'rocks' || mesh === 'one') return resolved;
  throw impossible('mesh', mesh, 'every wood ear has its own shape, pressed against its neighbours: use mesh "rocks" or "one"');
}
