/** A model as a file, in whatever format is asked for. */

import { filled } from '../base/filled.ts';
import type { ByteWriter } from './formats/byte-writer.ts';
import { writeGlb } from './gltf/glb.ts';
import type { Written } from './gltf/glb.ts';
import type { Counts, Told } from './gltf/gltf-json.ts';
import type { Shapes } from './gltf/gltf-parts.ts';
import { HULL_NAMES, hullsOf } from './shapes/hulls.ts';
import { kitOf } from './shapes/kit.ts';
import type { Kit } from './shapes/kit.ts';
import { levelsOf } from './shapes/lods.ts';
import { checkMaps, writeMaps } from './maps/maps.ts';
import type { MapFacts, WrittenMaps } from './maps/maps.ts';
import { measuresOf } from './shapes/measures.ts';
import type { Measures } from './shapes/measures.ts';
import { isOneThing } from './model.ts';
import type { Model } from './model.ts';
import { isMap } from './options.ts';
import type { ResolvedOptions } from './options.ts';
import { originOf } from './origin/origin.ts';
import { writtenOptions } from './origin/written-options.ts';
import { Pace } from './pace.ts';
import type { Waiting } from './pace.ts';
import { cellsOf, MANY_OBJECTS, together } from './parts.ts';
import { writeZip } from './maps/zip.ts';
import { someOf } from './shapes/some.ts';
import { checkFits } from './too-large.ts';
import { writeObj, writePly, writeStl } from './formats/plain-formats.ts';
import { writeCsv, writePlyPoints } from './formats/points.ts';
import { closed } from './shapes/solid.ts';
import { textured } from './textures/textured.ts';
import type { Baked } from './textures/textured.ts';

/** What there is in a file, and what of the scene is not. */
export interface ExportReport extends Counts {
  /** Length of the file. */
  bytes: number;
  /** Of maps. */
  map?: MapFacts | undefined;
  /** How fine the textures are, if there are any. */
  texelsPerMetre?: number;
  notes: ExportNote[];
}

type NoteCode = keyof typeof NOTES;

/** What is noted, and of how many things where it is not of all. */
export interface Note {
  code: NoteCode;
  count?: number | undefined;
}

export interface ExportNote extends Note {
  /** In English. */
  message: string;
}

/** A file. */
export interface ExportedFile {
  bytes: Uint8Array<ArrayBuffer>;
  /** With its ending: `riverbed-7.glb`. */
  name: string;
  /** Its media type. */
  type: string;
  report: ExportReport;
}

/** What is said in the file about where it comes from. */
export interface Source {
  /** The file's name without its ending. */
  title: string;
  /** Brings the scene back. */
  link: string;
  /** Of the scene's buffers, as `hash.ts` computes it. */
  hash: () => Promise<string>;
  /** Whether materials have patterns that no file has. */
  hasPatterns: boolean;
  /** What is said of a thing beside its measures; k is its first body. */
  extrasOf: (k: number) => Record<string, unknown>;
  /** What else the report says. */
  notes?: readonly Note[] | undefined;
}

const NOTES = {
  'plain-colours':
    'Each material has one colour: the patterns of stone, wood and flesh, moss, snow and dust are drawn by rock-field alone.',
  'no-colours': 'This format has no colours.',
  'no-objects': 'This format has no objects: everything is one mesh.',
  'no-units': 'This format has no units: tell the program that opens it what a unit is.',
  'few-readers': 'Few programs read EXT_mesh_gpu_instancing; without `instancing` all do.',
  'no-device': 'Textures are drawn by a graphics device, and there is none here: each rock has one colour.',
  'many-objects':
    '{count} objects in a file: many programs take long to open so many. A kit shares its meshes, `mesh: "one"` has one for each layer, and `parts` are several files.',
  compressed: 'Programs that do not know EXT_meshopt_compression cannot open it.',
  'kit-differs': 'Rocks of a kit are like the rocks of the scene, not the same.',
  'below-ground': 'Worn rocks have skirts below the ground, which show where there is none: `belowGround: "cut"` leaves them out.',
  'ground-is-open': 'The ground is a sheet without a thickness: `solid` closes the rocks alone.',
  thickened: 'Wood ears without a thickness are sheets: to be solid they have been made 1.5 mm thick.',
  'crosses-itself':
    '{count} of the objects pass through themselves; their `extras` have `solid: false`. Slicers join what overlaps; Boolean operations may not.',
  'open-log': 'The log is not closed, so that it is not solid; its `extras` have `solid: false`.',
  'log-not-in-link': 'The log is a mesh of your own, which is in no link: that of the file shows a grown one.',
  'in-parts': 'The parts have one origin: import all of them at the same place.',
  'kinds-of-kit': 'The kinds are the meshes of a kit that is exported with the same `kinds`, as GLB.',
  'no-header': 'This format has no header: tell the program that opens it the width and height in pixels, 16 bits, little-endian.',
  'height-range': 'In 16 bits 0 is the ground, and 65535 the `highest` of `report.map`, in metres.',
  'in-metres': 'The numbers are metres.',
  'green-up': 'Green of the normal map points up, as in OpenGL.',
  'green-down': 'Green of the normal map points down, as in DirectX.',
  data: 'The numbers are no colours: import the pictures as linear data, without sRGB.',
} as const;

const FORMATS = {
  glb: { type: 'model/gltf-binary', lost: ['plain-colours'] },
  obj: { type: 'model/obj', lost: ['no-colours', 'no-units'] },
  stl: { type: 'model/stl', lost: ['no-colours', 'no-objects', 'no-units'] },
  ply: { type: 'application/octet-stream', lost: ['plain-colours', 'no-objects', 'no-units'] },
  csv: { type: 'text/csv', lost: [] },
  png: { type: 'image/png', lost: [] },
  r16: { type: 'application/octet-stream', lost: [] },
  exr: { type: 'image/x-exr', lost: [] },
  zip: { type: 'application/zip', lost: [] },
} as const satisfies Record<ResolvedOptions['format'], { type: string; lost: readonly (keyof typeof NOTES)[] }>;

/** As long as a hash, before there is one. */
const NO_HASH = '0'.repeat(64);

/** Digits of what is measured of a body: nobody measures a stone more closely. */
const MEASURED = 4;

/** The share of the work that is done when a kit is chosen. */
const KIT_SHARE = 0.1;
/** That of the rest when levels and hulls are there. */
const SHAPES_SHARE = 0.4;

/**
 * The file.
 *
 * @param model open below; `options.solid` closes it.
 * @throws {RockFieldError} `ExportTooLarge`, before anything is allocated.
 * @throws the reason of the signal when it was aborted.
 */
export async function exportModel(
  model: Model,
  source: Source,
  options: ResolvedOptions,
  waiting?: Waiting,
  baked?: Baked,
): Promise<ExportedFile> {
  const { format } = options;
  const { title, hash, hasPatterns, notes: own = [] } = source;
  const fineness = baked && { texelsPerMetre: Math.round(baked.atlas.density / model.unit) };
  const more = { ...fineness, ...writtenOptions(options) };
  const pace = new Pace(waiting);
  const kit = !isMap(options) && options.mesh === 'kit' ? await kitOf(model, options.kinds, pace.within(0, KIT_SHARE)) : undefined;
  if (isMap(options)) checkMaps(model, options);
  else checkFits({ model, options, told: toldOf(model, source, NO_HASH, more), kit, images: baked?.images });
  const told = toldOf(model, source, await hash(), more);
  const writing = kit ? pace.within(KIT_SHARE, 1) : pace;
  const isCut = options.parts > 1;
  const {
    bytes,
    counts,
    largest = counts.objects,
    ending = `.${format}`,
    map,
  } = isCut ? await writeParts(model, options, told, writing) : await writeModel(model, options, told, writing, kit, baked);
  const notes = [
    ...codesOf(options, hasPatterns, baked !== undefined).map((code): Note => ({ code })),
    ...(options.mesh === 'rocks' && largest > MANY_OBJECTS ? [{ code: 'many-objects', count: largest } as const] : []),
    ...own,
  ];
  return {
    bytes,
    name: `${title}${ending}`,
    type: FORMATS[isCut ? 'zip' : format].type,
    report: {
      ...counts,
      bytes: bytes.length,
      ...(map && { map }),
      ...fineness,
      notes: notes.map((note) => ({ ...note, message: filled(NOTES[note.code], { count: note.count }) })),
    },
  };
}

/** @param more about the scene. */
export function toldOf(model: Model, { title, link, extrasOf }: Omit<Source, 'hash' | 'hasPatterns'>, hash: string, more?: object): Told {
  return {
    title,
    scene: { ...originOf({ link, hash, metresPerPixel: model.unit }), ...more },
    body: (out, k) => {
      const { noun, extras, isOpenBelow } = model.groups[model.groupOf[k]!]!;
      if (isOpenBelow) writeMeasured(out, extrasOf(k), measuresOf(model, k));
      else out.text(JSON.stringify({ ...(noun === undefined && extras), ...extrasOf(k) }));
    },
  };
}

/** A file as a format's writer has made it. */
interface Outcome extends Written, Partial<Pick<WrittenMaps, 'ending' | 'map'>> {
  /** Objects of the part that has the most, where there are several. */
  largest?: number;
}

function codesOf(options: ResolvedOptions, hasPatterns: boolean, isTextured: boolean): NoteCode[] {
  const { format, mesh, instancing, textures, compress, solid, groundMesh, parts } = options;
  if (isMap(options)) return mapCodesOf(options);
  if (mesh === 'points') return ['kinds-of-kit'];
  return [
    ...FORMATS[format].lost.filter((code) => code !== 'plain-colours' || (hasPatterns && textures === 'none')),
    ...(textures !== 'none' && !isTextured ? (['no-device'] as const) : []),
    ...(mesh === 'kit' ? (['kit-differs'] as const) : []),
    ...(solid && groundMesh !== 'none' ? (['ground-is-open'] as const) : []),
    ...(mesh === 'kit' && instancing ? (['few-readers'] as const) : []),
    ...(compress ? (['compressed'] as const) : []),
    ...(parts > 1 ? (['in-parts'] as const) : []),
  ];
}

function mapCodesOf({ format, map, green }: ResolvedOptions): NoteCode[] {
  const has = (name: typeof map): boolean => map === name || map === 'all';
  const codes: Partial<Record<NoteCode, boolean>> = {
    'no-header': format === 'r16',
    'height-range': has('height') && format !== 'exr',
    'in-metres': map === 'height' && format === 'exr',
    'green-up': has('normal') && green === 'up',
    'green-down': has('normal') && green === 'down',
    data: format === 'png' || format === 'zip',
  };
  return (Object.keys(codes) as NoteCode[]).filter((code) => codes[code]);
}

/** One JSON object. */
function writeMeasured(out: ByteWriter, extras: Record<string, unknown>, { area, volume, size }: Measures): void {
  const own = JSON.stringify(extras).slice(0, -1);
  out.text(own);
  out.text(own === '{' ? '"area":' : ',"area":');
  out.significant(area, MEASURED);
  out.text(',"volume":');
  out.significant(volume, MEASURED);
  out.text(',"size":[');
  out.significant(size[0], MEASURED);
  out.text(',');
  out.significant(size[1], MEASURED);
  out.text(',');
  out.significant(size[2], MEASURED);
  out.text(']}');
}

/** A file for each cell of a grid, one after the other, in a ZIP. */
async function writeParts(model: Model, options: ResolvedOptions, told: Told, pace: Pace): Promise<Outcome> {
  const files: Record<string, Uint8Array> = {};
  const counts: Counts[] = [];
  const cells = cellsOf(model, options.parts);
  for (const [c, { name, bodies }] of cells.entries()) {
    const own: Told = { ...told, body: (out, k) => told.body(out, bodies[k]!) };
    const part = await writeModel(someOf(model, bodies), options, own, pace.within(c / cells.length, (c + 1) / cells.length));
    files[`${told.title}_${name}.${options.format}`] = part.bytes;
    counts.push(part.counts);
  }
  return { bytes: writeZip(files), counts: together(counts), largest: Math.max(...counts.map(({ objects }) => objects)), ending: '.zip' };
}

async function writeModel(model: Model, options: ResolvedOptions, told: Told, pace: Pace, kit?: Kit, baked?: Baked): Promise<Outcome> {
  const shapes = await shapesOf(model, options, kit, pace.within(0, SHAPES_SHARE), baked);
  return write(shapes, options, told, pace.within(SHAPES_SHARE, 1), kit);
}

/** What is written of the model. */
async function shapesOf(
  open: Model,
  options: ResolvedOptions,
  kit: Kit | undefined,
  pace: Pace,
  baked: Baked | undefined,
): Promise<Shapes> {
  const { mesh, solid, lods, hulls } = options;
  const whole = solid && !isMap(options) && mesh !== 'points' ? closed(open) : open;
  const chosen = kit && new Set(kit.kinds);
  const isOne = (k: number): boolean => isOneThing(open, open.groupOf[k]!);
  const isWritten = (k: number): boolean => !chosen || chosen.has(k) || isOne(k);
  const levels = await levelsOf(baked ? textured(whole, baked) : whole, open, lods, isWritten, pace.within(0, 0.7));
  if (hulls === 'none') return { levels, hullName: (object) => object };
  const ofHulls = await hullsOf(open, (k) => isWritten(k) && !isOne(k), pace.within(0.7, 1));
  return { levels, hulls: ofHulls, hullName: HULL_NAMES[hulls] };
}

async function write(shapes: Shapes, options: ResolvedOptions, told: Told, pace: Pace, kit: Kit | undefined): Promise<Outcome> {
  const model = shapes.levels[0]!;
  if (isMap(options)) return writeMaps(model, options, told, pace);
  if (options.mesh === 'points')
    return options.format === 'csv' ? writeCsv(model, options, pace) : writePlyPoints(model, options, told, pace);
  if (options.format === 'obj') return writeObj(shapes.levels, options, told, pace);
  if (options.format === 'stl') return writeStl(model, options, told, pace);
  if (options.format === 'ply') return writePly(model, options, told, pace);
  return writeGlb(shapes, options, told, pace, kit);
}
