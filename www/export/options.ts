/**
 * What can be asked of an export: its options, and the targets, which are sets of defaults for them.
 *
 * Both are tables. Types, checks, documentation and the dialog are derived from them; an option more is a row in `OPTIONS`, a tool more a row
 * in `TARGETS`.
 */

import { RockFieldError } from '../base/errors.ts';
import { checkNumber, checkValue, objectOf, rejectUnknown, shown, wrongType } from '../table/param-checks.ts';

interface ChoiceRow {
  kind: 'choice';
  choices: readonly string[];
  default: string;
  /** What the option means, in one sentence of Markdown. */
  doc: string;
}

interface NumberRow {
  kind: 'real' | 'integer';
  min: number;
  max: number;
  default: number;
  doc: string;
}

interface SwitchRow {
  kind: 'switch';
  default: boolean;
  doc: string;
}

type OptionRow = ChoiceRow | NumberRow | SwitchRow;

/** Keeps the words of a row apart from one another in its type. */
function rows<const Rows extends Record<string, OptionRow>>(table: Rows): Rows {
  return table;
}

export const OPTIONS = /* @__PURE__ */ rows({
  format: {
    kind: 'choice',
    choices: ['glb', 'obj', 'stl', 'ply'],
    default: 'glb',
    doc: 'The kind of file: binary glTF 2.0, Wavefront OBJ, binary STL or binary PLY.',
  },
  mesh: {
    kind: 'choice',
    choices: ['one', 'rocks', 'kit'],
    default: 'rocks',
    doc: '`one` mesh for each layer; `rocks`: an object for each rock, whose origin is on the ground; `kit`: `kinds` meshes for each layer, and every rock an instance of the nearest.',
  },
  kinds: { kind: 'integer', min: 1, max: 256, default: 12, doc: 'How many meshes of a layer a `kit` has.' },
  instancing: {
    kind: 'switch',
    default: false,
    doc: 'A `kit` as `EXT_mesh_gpu_instancing`: far smaller, but few programs read it. Off: objects that share their meshes.',
  },
  solid: { kind: 'switch', default: false, doc: 'Whether rocks are closed below, as printing and physics need them.' },
  color: {
    kind: 'choice',
    choices: ['preset', 'natural', 'layer'],
    default: 'preset',
    doc: '`natural`: the mean colour of the kind of stone; `layer`: the colour of the layer; `preset`: natural for natural grounds.',
  },
  up: { kind: 'choice', choices: ['y', 'z'], default: 'y', doc: 'The axis that points up in OBJ, STL and PLY. In glTF it is always y.' },
  scale: {
    kind: 'real',
    min: 1e-6,
    max: 1e6,
    default: 1,
    doc: 'Units of the file in a metre, in OBJ, STL and PLY: 1000 for millimetres. In glTF a unit is always a metre.',
  },
  metresPerPixel: { kind: 'real', min: 1e-6, max: 1e3, default: 0.01, doc: 'How many metres a pixel of the field is.' },
});

export type OptionKey = keyof typeof OPTIONS;

type ValueOf<Row extends OptionRow> = Row extends ChoiceRow ? Row['choices'][number] : Row extends SwitchRow ? boolean : number;

/** Every option with its value. */
export type ResolvedOptions = { -readonly [Key in OptionKey]: ValueOf<(typeof OPTIONS)[Key]> };

interface TargetRow {
  /** As the tool calls itself. */
  title: string;
  /** What differs from the defaults of `OPTIONS`. */
  options: Partial<ResolvedOptions>;
}

function targets<const Rows extends Record<string, TargetRow>>(table: Rows): Rows {
  return table;
}

export const TARGETS = /* @__PURE__ */ targets({
  gltf: { title: 'glTF', options: {} },
  blender: { title: 'Blender', options: {} },
  unreal: { title: 'Unreal', options: { solid: true } },
  unity: { title: 'Unity', options: {} },
  godot: { title: 'Godot', options: {} },
  three: { title: 'three.js', options: { mesh: 'one' } },
  print: { title: '3D printing', options: { format: 'stl', mesh: 'one', solid: true, up: 'z', scale: 1000 } },
});

export type ExportTarget = keyof typeof TARGETS;

/** What to write. A `target` sets what suits a tool; every option given beside it counts. */
export type ExportOptions = { target?: ExportTarget | undefined } & { [Key in OptionKey]?: ResolvedOptions[Key] | undefined };

/**
 * All options, checked.
 *
 * @throws {RockFieldError} `WrongType`, `OutOfRange`, `NotAnInteger`, `UnknownKey`, or `ExportImpossible` where two options contradict each other.
 */
export function resolveOptions(options: ExportOptions = {}): ResolvedOptions {
  const given = objectOf(options, 'options');
  rejectUnknown(given, (key) => key === 'target' || Object.hasOwn(OPTIONS, key));
  const target = given.target === undefined ? 'gltf' : (checked('target', choiceOf(Object.keys(TARGETS)), given.target) as ExportTarget);
  const resolved: Record<string, unknown> = {};
  const preferred: Partial<ResolvedOptions> = TARGETS[target].options;
  for (const key of Object.keys(OPTIONS) as OptionKey[]) {
    const row: OptionRow = OPTIONS[key];
    resolved[key] = given[key] === undefined ? (preferred[key] ?? row.default) : checked(key, row, given[key]);
  }
  return consistent(resolved as ResolvedOptions, given);
}

function choiceOf(choices: readonly string[]): Pick<ChoiceRow, 'kind' | 'choices'> {
  return { kind: 'choice', choices };
}

function checked(key: string, row: OptionRow | Pick<ChoiceRow, 'kind' | 'choices'>, value: unknown): unknown {
  if (row.kind === 'switch') {
    if (typeof value !== 'boolean') throw wrongType(key, value, 'true or false');
    return value;
  }
  if (row.kind !== 'choice') return checkNumber(key, value, row, row.kind === 'integer');
  const choices = row.choices.map((choice) => ({ value: choice }));
  const bounds = { min: 0, max: choices.length - 1 };
  return checkValue({ key, component: null, kind: 'choice', choices, ...bounds }, bounds, value);
}

/** A kit is made of objects that share meshes, and only glTF has those. */
function consistent(options: ResolvedOptions, given: Record<string, unknown>): ResolvedOptions {
  const { format, mesh } = options;
  if (format !== 'glb' && mesh === 'kit') {
    throw impossible(
      'mesh',
      mesh,
      `${format.toUpperCase()} files cannot share meshes between rocks: use format "glb", or mesh "rocks" or "one"`,
    );
  }
  // A target's own choice gives way to what the caller asked for.
  if (format !== 'glb' && format !== 'obj' && mesh === 'rocks') {
    if (given.mesh === 'rocks') {
      throw impossible('mesh', mesh, `${format.toUpperCase()} files have no objects: use format "glb" or "obj", or mesh "one"`);
    }
    return { ...options, mesh: 'one' };
  }
  return options;
}

/** The error about an option that cannot be had. */
export function impossible(key: OptionKey, value: unknown, reason: string): RockFieldError {
  return new RockFieldError({
    name: 'ExportImpossible',
    key,
    value,
    message: `${key} is ${shown(value)}, which cannot be exported: ${reason}`,
  });
}
