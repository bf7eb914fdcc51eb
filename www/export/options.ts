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
    choices: ['glb', 'obj', 'stl', 'ply', 'csv', 'png', 'r16', 'exr', 'zip'],
    default: 'glb',
    doc: 'The kind of file. Meshes: binary glTF 2.0, Wavefront OBJ, binary STL or binary PLY. Points: CSV or PLY. Maps: PNG, raw 16 bits without a header, OpenEXR, or a ZIP of them.',
  },
  mesh: {
    kind: 'choice',
    choices: ['one', 'rocks', 'kit', 'points'],
    default: 'rocks',
    doc: '`one` mesh for each layer; `rocks`: an object for each rock or wood ear, whose origin is on the ground or on the log; `kit`: `kinds` meshes for each layer, and every rock an instance of the nearest; `points`: where the rocks of a kit lie, without their meshes.',
  },
  kinds: { kind: 'integer', min: 1, max: 256, default: 12, doc: 'How many meshes of a layer a `kit` has.' },
  instancing: {
    kind: 'switch',
    default: false,
    doc: 'A `kit` as `EXT_mesh_gpu_instancing`: far smaller, but few programs read it. Off: objects that share their meshes.',
  },
  solid: {
    kind: 'switch',
    default: false,
    doc: 'Whether rocks are closed below, and wood ears have a thickness, as printing and physics need them.',
  },
  belowGround: {
    kind: 'choice',
    choices: ['kept', 'cut'],
    default: 'kept',
    doc: 'What of rocks lies below the ground, as that of weathered and embedded ones does: `kept`, a skirt as wide as the cell of the rock, for uneven ground; or `cut` off, so that they end where the ground is. Maps and points show nothing of it.',
  },
  groundMesh: {
    kind: 'choice',
    choices: ['none', 'cut', 'whole'],
    default: 'none',
    doc: 'The ground as an object, `ground`, with its vertices at the rims of the rocks: `cut` out where rocks stand on it, or `whole`. Maps and points have none.',
  },
  color: {
    kind: 'choice',
    choices: ['preset', 'natural', 'layer'],
    default: 'preset',
    doc: '`natural`: the mean colours of stone, wood and flesh; `layer`: the colour of the layer, and those of the thesis for wood ears; `preset`: natural for natural presets.',
  },
  textures: {
    kind: 'choice',
    choices: ['none', '1k', '2k', '4k', '8k'],
    default: 'none',
    doc: 'Side of the textures of a GLB: albedo, normals, and occlusion, roughness and metalness of the stone as it is drawn, with moss, snow and dust. A graphics device draws them, so they need an element; where there is none the file has plain colours.',
  },
  vertexColors: {
    kind: 'switch',
    default: false,
    doc: 'The colours of materials as linear colours of vertices (`COLOR_0`), with materials that are white: for GLB. PLY has no materials, and always has them.',
  },
  compress: {
    kind: 'switch',
    default: false,
    doc: 'A GLB whose meshes are compressed without a loss (`EXT_meshopt_compression`): to about six tenths with mesh `one`, less where every rock is an object. three.js, Babylon.js, Godot and glTFast read it; Blender does from 5.2 on.',
  },
  lods: {
    kind: 'integer',
    min: 1,
    max: 4,
    default: 1,
    doc: 'Levels of detail of every object, called `…_LOD0`, `…_LOD1` and so on: each of about a third of the triangles of the one before, with the same rim. In GLB and OBJ.',
  },
  hulls: {
    kind: 'choice',
    choices: ['none', 'unreal', 'godot'],
    default: 'none',
    doc: 'Convex hulls of at most 32 vertices for physics, beside each rock or wood ear of a GLB, by the names that the program knows: `UCX_rock-1_00` or `rock-1-convcolonly`.',
  },
  parts: {
    kind: 'integer',
    min: 1,
    max: 64,
    default: 1,
    doc: 'In how many files the scene is, each with what stands in a cell of a grid: a ZIP of `…_x0_y0.glb`, `…_x1_y0.glb` and so on, x from west to east and y from south to north. All have one origin, so that they fit together. Best are numbers with many divisors: 4, 6, 9, 12, 16.',
  },
  up: { kind: 'choice', choices: ['y', 'z'], default: 'y', doc: 'The axis that points up in OBJ, STL and PLY. In glTF it is always y.' },
  scale: {
    kind: 'real',
    min: 1e-6,
    max: 1e6,
    default: 1,
    doc: 'Units of the file in a metre, in OBJ, STL and PLY: 1000 for millimetres. In glTF a unit is always a metre.',
  },
  metresPerPixel: {
    kind: 'real',
    min: 1e-6,
    max: 1e3,
    default: 0.01,
    doc: 'How many metres a pixel of the field is, and a centimetre of a log.',
  },
  axes: {
    kind: 'choice',
    choices: ['gltf', 'blender', 'unreal', 'unity'],
    default: 'gltf',
    doc: 'Axes and unit of points, those of a kit that the program has imported: `gltf`: metres, right-handed, y up; `blender`: z up; `unreal`: centimetres, left-handed, z up; `unity`: left-handed, y up.',
  },
  map: {
    kind: 'choice',
    choices: ['height', 'normal', 'id', 'cover', 'contact', 'splat', 'all'],
    default: 'height',
    doc: 'What PNG, R16 and EXR show, or a ZIP has in it: `all` is the default of a ZIP, and needs one.',
  },
  side: {
    kind: 'integer',
    min: 0,
    max: 16_384,
    default: 0,
    doc: 'Pixels of the longer side of a map; 0: one for each pixel of the field.',
  },
  square: { kind: 'switch', default: false, doc: 'Whether a map is stretched to a square: landscapes of Unity are square.' },
  samples: {
    kind: 'choice',
    choices: ['centres', 'corners'],
    default: 'centres',
    doc: 'Where a map is measured: in the `centres` of its pixels, as textures are, or so that the outermost pixels lie on the border of the field, as landscapes with 2ⁿ + 1 `corners` on a side are.',
  },
  green: {
    kind: 'choice',
    choices: ['up', 'down'],
    default: 'up',
    doc: 'Where green of a normal map points: `up` in the picture, as in OpenGL, Blender, Unity and Godot, or `down`, as in DirectX and Unreal.',
  },
  contact: {
    kind: 'real',
    min: 1e-6,
    max: 1e3,
    default: 0.1,
    doc: 'How far the foot of the rocks reaches, in metres: from them to there the contact map falls to 0.',
  },
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
  blender: { title: 'Blender', options: { axes: 'blender' } },
  unreal: { title: 'Unreal', options: { solid: true, hulls: 'unreal', axes: 'unreal', green: 'down' } },
  unity: { title: 'Unity', options: { axes: 'unity' } },
  godot: { title: 'Godot', options: { hulls: 'godot' } },
  three: { title: 'three.js', options: { mesh: 'one' } },
  print: { title: '3D printing', options: { format: 'stl', mesh: 'one', solid: true, belowGround: 'cut', up: 'z', scale: 1000 } },
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

/** What a format can hold of a mesh's forms; those of maps hold none, and take no notice of it. The first is what a target's own choice gives way to. */
export const FORMS: Partial<Record<ResolvedOptions['format'], readonly ResolvedOptions['mesh'][]>> = {
  glb: ['rocks', 'kit', 'one'],
  obj: ['rocks', 'one'],
  stl: ['one'],
  ply: ['one', 'points'],
  csv: ['points'],
};

/** The maps that a format can hold. */
export const MAPS: Partial<Record<ResolvedOptions['format'], readonly ResolvedOptions['map'][]>> = {
  png: ['height', 'normal', 'id', 'cover', 'contact', 'splat'],
  r16: ['height'],
  exr: ['height', 'id'],
  zip: ['all', 'height', 'normal', 'id', 'cover', 'contact', 'splat'],
};

/** Whether the file is one of maps. */
export function isMap({ format }: Pick<ResolvedOptions, 'format'>): boolean {
  return MAPS[format] !== undefined;
}

/** What else cannot be, and what the option becomes where nobody asked for it. */
interface Conflict<Key extends OptionKey = OptionKey> {
  key: Key;
  found: (options: ResolvedOptions) => boolean;
  instead: ResolvedOptions[Key];
  reason: (options: ResolvedOptions) => string;
}

const upper = ({ format }: ResolvedOptions): string => format.toUpperCase();

const CONFLICTS: readonly Conflict[] = [
  {
    key: 'parts',
    found: ({ format, mesh, parts }) => parts > 1 && (isMap({ format }) || mesh === 'points'),
    instead: 1,
    reason: ({ mesh }) => `${mesh === 'points' ? 'points' : 'maps'} are in one file: meshes alone can be in parts`,
  },
  {
    key: 'parts',
    found: ({ mesh, parts }) => parts > 1 && mesh === 'kit',
    instead: 1,
    reason: () => 'all rocks of a kit share its meshes, which are in one file: use mesh "rocks" or "one"',
  },
  {
    key: 'parts',
    found: ({ parts, textures }) => parts > 1 && textures !== 'none',
    instead: 1,
    reason: () => 'all rocks share the textures, which are in one file: leave one of the two out',
  },
  {
    key: 'groundMesh',
    found: ({ mesh, groundMesh }) => mesh === 'kit' && groundMesh === 'cut',
    instead: 'whole',
    reason: () => 'rocks of a kit do not fit the holes of others: use groundMesh "whole", or mesh "rocks" or "one"',
  },
  {
    key: 'vertexColors',
    found: ({ format, vertexColors }) => vertexColors && format !== 'glb' && format !== 'ply',
    instead: false,
    reason: (options) => `${upper(options)} files have no colours of vertices: use format "glb" or "ply"`,
  },
  {
    key: 'compress',
    found: ({ format, compress }) => compress && format !== 'glb',
    instead: false,
    reason: (options) => `${upper(options)} files are not compressed: use format "glb"`,
  },
  {
    key: 'vertexColors',
    found: ({ vertexColors, textures }) => vertexColors && textures !== 'none',
    instead: false,
    reason: () => 'textures have the colours: leave one of the two out',
  },
  {
    key: 'lods',
    found: ({ format, lods }) => lods > 1 && format !== 'glb' && format !== 'obj',
    instead: 1,
    reason: (options) => `${upper(options)} files have no objects, and so no levels of detail: use format "glb" or "obj"`,
  },
  {
    key: 'hulls',
    found: ({ format, hulls }) => hulls !== 'none' && format !== 'glb',
    instead: 'none',
    reason: (options) => `programs look for hulls in GLB files, not in ${upper(options)}: use format "glb"`,
  },
  {
    key: 'hulls',
    found: ({ mesh, hulls }) => hulls !== 'none' && mesh === 'one',
    instead: 'none',
    reason: () => 'a hull belongs to a rock: use mesh "rocks" or "kit"',
  },
  {
    key: 'hulls',
    found: ({ mesh, instancing, hulls }) => hulls !== 'none' && mesh === 'kit' && instancing,
    instead: 'none',
    reason: () => 'programs that know hulls read no instances: leave instancing out',
  },
];

/** The options, in which what cannot be beside what the file is gives way. */
export function agreeing(options: ResolvedOptions): ResolvedOptions {
  const agreed: ResolvedOptions = { ...options };
  for (const { key, found, instead } of CONFLICTS) if (found(agreed)) Object.assign(agreed, { [key]: instead });
  return agreed;
}

/** A target's or a default's choice gives way to what the caller asked for, and what was asked for has to fit. */
function consistent(options: ResolvedOptions, given: Record<string, unknown>): ResolvedOptions {
  const { format, textures } = options;
  const fitted: ResolvedOptions = {
    ...options,
    ...fitting('mesh', FORMS, options, given),
    ...fitting('map', MAPS, options, given),
    format,
  };
  for (const { key, found, reason } of CONFLICTS) {
    if (given[key] !== undefined && found(fitted)) throw impossible(key, fitted[key], reason(fitted));
  }
  Object.assign(fitted, agreeing(fitted));
  if (textures === 'none') return fitted;
  if (format !== 'glb') throw impossible('textures', textures, `${format.toUpperCase()} files have none: use format "glb"`);
  if (given.color === 'layer') throw impossible('textures', textures, 'they are of natural stone: leave color out, or use "natural"');
  return { ...fitted, color: 'natural' };
}

function fitting<Key extends 'mesh' | 'map'>(
  key: Key,
  holds: Partial<Record<ResolvedOptions['format'], readonly ResolvedOptions[Key][]>>,
  { format, [key]: value }: ResolvedOptions,
  given: Record<string, unknown>,
): Partial<ResolvedOptions> {
  const held = holds[format];
  // A ZIP of one map is only made on wish.
  if (!held || (held.includes(value) && (format !== 'zip' || given[key] !== undefined))) return {};
  if (given[key] === undefined) return { [key]: held[0] };
  const others = Object.entries(holds).filter(([, forms]) => forms.includes(value));
  const formats = others.map(([other]) => `"${other}"`).join(' or ');
  throw impossible(
    key,
    value,
    `${format.toUpperCase()} files cannot hold it: use format ${formats}, or ${key} ${held.map((one) => `"${one}"`).join(' or ')}`,
  );
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

/** Side of the textures that are asked for, texels; 0 of none. */
export function textureSide({ textures }: Pick<ResolvedOptions, 'textures'>): number {
  return textures === 'none' ? 0 : 1024 * Number.parseInt(textures, 10);
}
