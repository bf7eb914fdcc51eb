/** The module worker that writes one file of rocks, lays them out for its textures, or makes arrays of them for a scene graph. It is started when somebody exports, and ended when that is done. */

import { buffersOf } from '../export/scene.ts';
import { imagesOf } from '../export/textures/images.ts';
import { onTask } from '../generator/task-scope.ts';
import { exportField, fieldScene, layOutField } from '../rocks/export.ts';
import type { ExportAnswer, ExportTask } from '../rocks/export-task.ts';
import { groundRealm } from '../rocks/ground-realm.ts';

/** The share of the work that is done when the images are made. */
const IMAGES_SHARE = 0.9;

onTask<ExportTask, ExportAnswer>(async ({ field, source, options, step }, onProgress) => {
  if (step === 'lay-out') {
    const result = await layOutField(field, source.params, options, onProgress);
    const arrays = [...Object.values(result.mesh), result.atlas.vertices, result.atlas.holds];
    return { result, transfer: [...new Set(arrays.map(({ buffer }) => buffer))] };
  }
  if (step === 'scene') {
    const result = await fieldScene(field, source, options, groundRealm, { onProgress });
    return { result, transfer: buffersOf(result) };
  }
  const { atlas, tiles } = step ?? {};
  const baked = atlas && tiles && { atlas, images: await imagesOf(tiles, atlas.side, (fraction) => onProgress(IMAGES_SHARE * fraction)) };
  const begin = baked ? IMAGES_SHARE : 0;
  const result = await exportField(
    field,
    source,
    options,
    groundRealm,
    { onProgress: (fraction) => onProgress(begin + (1 - begin) * fraction) },
    baked,
  );
  return { result, transfer: [result.bytes.buffer] };
});
