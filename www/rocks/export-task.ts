/** What the page asks of the worker that exports rocks. */

import type { Field } from '../data/field.ts';
import type { ExportedFile } from '../export/file.ts';
import type { ResolvedOptions } from '../export/options.ts';
import type { SceneParts } from '../export/scene.ts';
import type { Laid } from '../export/textures/textured.ts';
import { taskWorker } from '../generator/one-task.ts';
import type { TaskKind } from '../generator/one-task.ts';
import type { Drawn } from './bake-textures.ts';
import type { FieldSource } from './export.ts';

/** What the page asks for: a file, for which textures may have been drawn, or that the rocks are laid out for textures; or arrays for a scene graph. */
export interface ExportTask {
  field: Field;
  source: FieldSource;
  options: ResolvedOptions;
  step?: Drawn | 'lay-out' | 'scene' | undefined;
}

/** A file, or what else was asked for. */
export type ExportAnswer = ExportedFile | Laid | SceneParts;

/** What answers a task. */
export const EXPORTER: TaskKind<ExportTask, ExportAnswer> = {
  what: 'that writes files',
  file: 'export-worker.js',
  // This literal form is the one that bundlers recognise.
  spawn: () => taskWorker(() => new Worker(new URL('./export-worker.js', import.meta.url), { type: 'module' })),
};
