/** The page's side of the export worker. */

import { lazily } from '../base/lazy.ts';
import { asFile } from '../element/export-client.ts';
import type { ExportInWorker } from '../element/export-client.ts';
import type { ExportedFile } from '../export/file.ts';
import { resolveOptions } from '../export/options.ts';
import type { Laid } from '../export/textures/textured.ts';
import { inWorker } from '../generator/one-task.ts';
import type { TaskOptions } from '../generator/one-task.ts';
import { backendsOf, wantedBackend } from '../renderer/load.ts';
import type { Drawn } from './bake-textures.ts';
import { EXPORTER } from './export-task.ts';
import type { Rocks } from './table.ts';

/** The share of the work that is done when textures are drawn. */
const DRAWN = 0.6;

/** Where textures are asked for they are of natural stone, and drawn first: that may end in `DeviceLost`. */
export const exportInWorker: ExportInWorker<Rocks> = async (newest, options, { signal, onProgress }, { color, backend }) => {
  const isNatural = color === 'natural' || (options.textures ?? 'none') !== 'none';
  const resolved = resolveOptions({ color: isNatural ? 'natural' : 'layer', ...options });
  const { result: field, ...source } = await newest();
  const task = { field, source, options: resolved };
  const from = (begin: number, end: number): TaskOptions => ({
    signal,
    onProgress: onProgress && ((fraction) => onProgress(begin + (end - begin) * fraction)),
  });
  let drawn: Drawn | undefined;
  if (resolved.textures !== 'none') {
    const { bakedTextures } = await lazily(() => import('./bake-textures.ts'));
    const layOut = async (run: TaskOptions): Promise<Laid> => (await inWorker(EXPORTER, { ...task, step: 'lay-out' }, run)) as Laid;
    drawn = await bakedTextures(field, source, backendsOf(wantedBackend(backend)), layOut, from(0, DRAWN));
  }
  const handedOver = drawn ? [drawn.atlas.vertices.buffer, ...drawn.tiles.map(({ buffer }) => buffer)] : [];
  const answer = await inWorker(EXPORTER, { ...task, step: drawn }, from(drawn ? DRAWN : 0, 1), handedOver);
  return asFile(answer as ExportedFile);
};
