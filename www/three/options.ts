/** What a `RockField` of three.js can be asked for: the parameters of a field, and some of the options of exports by their names. */

import type { Material } from 'three';
import { objectOf, wrongType } from '../table/param-checks.ts';
import { impossible, resolveOptions } from '../export/options.ts';
import type { ResolvedOptions } from '../export/options.ts';
import { FIELD_ROWS, resolveParams } from '../rocks/request.ts';
import type { FieldRequest } from '../rocks/request.ts';
import { strokesToText } from '../rocks/strokes.ts';
import type { FieldSource } from '../rocks/export.ts';
import type { PresetName } from '../rocks/params.ts';

/** Levels of detail of rocks that are drawn one by one, unless others are asked for. */
const LEVELS = 3;

/** What is said of an option where it means another thing than in a file. Markdown, in one sentence, as in `OPTIONS`. */
interface SceneRow {
  choices?: readonly string[];
  default?: string;
  doc?: string;
}

/** The options of exports that mean something in a scene. */
export const SCENE_OPTIONS = {
  mesh: {
    choices: ['one', 'rocks', 'kit'],
    default: 'one',
    doc: '`one` mesh for each layer; `rocks`: a `BatchedMesh` of all rocks, each with levels of detail; `kit`: the same with `kinds` shapes for each layer, of which every rock is an instance.',
  },
  kinds: {},
  lods: {
    default: String(LEVELS),
    doc: 'Levels of detail of `rocks` and of a `kit`: each of about a third of the triangles of the one before, with the same rim.',
  },
  groundMesh: {
    doc: 'The ground as a mesh, `ground`: `cut` out where rocks stand on it, or `whole`, which is better with levels of detail, since the holes are those of the finest. Rocks of natural presets are embedded: without a ground, or a terrain of yours at y = 0, their skirts show, which lie below, unless `belowGround` is `cut`.',
  },
  solid: { doc: 'Whether rocks are closed below.' },
  belowGround: {},
  color: {},
  metresPerPixel: { doc: 'How many metres a pixel of the field is.' },
} as const satisfies Partial<Record<keyof ResolvedOptions, SceneRow>>;

type SceneKey = keyof typeof SCENE_OPTIONS;

/** A preset fills every parameter, each parameter given then replaces its value; the options are those of exports. */
export type RockFieldOptions = FieldRequest & { [Key in Exclude<SceneKey, 'mesh'>]?: ResolvedOptions[Key] | undefined } & {
  /**
   * `one` mesh for each layer (the default); `rocks`: a `BatchedMesh` in which every rock has levels of detail and can be moved and coloured; `kit`: the
   * same with `kinds` shapes for each layer, of which every rock is an instance.
   */
  mesh?: (typeof SCENE_OPTIONS.mesh.choices)[number] | undefined;
  /** What rocks and ground are drawn with instead of a `MeshStandardMaterial`. It stays yours: `dispose()` leaves it alone. */
  material?: Material | undefined;
};

/** Every key that the options may have. */
export const OPTION_KEYS: readonly (keyof RockFieldOptions)[] = [
  'preset',
  'layers',
  'strokes',
  ...FIELD_ROWS.map(({ key }) => key as keyof FieldRequest),
  ...(Object.keys(SCENE_OPTIONS) as SceneKey[]),
  'material',
];

/** What is to be made, checked. */
export interface Wanted {
  source: FieldSource;
  options: ResolvedOptions;
  material: Material | undefined;
}

/**
 * @throws {RockFieldError} naming the parameter or the option, its value and its bounds; `ExportImpossible` where two options contradict each other.
 */
export function resolve(given: RockFieldOptions): Wanted {
  const { material, ...rest } = objectOf(given, 'options') as RockFieldOptions;
  const request: FieldRequest & Record<string, unknown> = {};
  const chosen: Record<string, unknown> = {};
  for (const [key, value] of Object.entries(rest)) (isSceneKey(key) ? chosen : request)[key] = value;
  const params = resolveParams({ ...request, strokes: strokesToText(request.strokes) });
  const asked = chosen as { [Key in SceneKey]?: ResolvedOptions[Key] };
  const { mesh = (asked.lods ?? 1) > 1 ? 'rocks' : 'one' } = asked;
  const options = resolveOptions({ target: 'three', ...asked, mesh, lods: asked.lods ?? (mesh === 'one' ? 1 : LEVELS) });
  if (mesh === 'points') throw impossible('mesh', mesh, 'a scene has no points: use mesh "one", "rocks" or "kit"');
  if (mesh === 'one' && options.lods > 1)
    throw impossible('lods', options.lods, 'levels of detail belong to single rocks: use mesh "rocks" or "kit"');
  if (material !== undefined && (material as Material | null)?.isMaterial !== true)
    throw wrongType('material', material, 'a Material of three.js');
  return { source: { params, preset: request.preset as PresetName | undefined }, options, material };
}

function isSceneKey(key: string): key is SceneKey {
  return Object.hasOwn(SCENE_OPTIONS, key);
}
