/** Maps of a model as files: height, normal, id, cover, contact and splat, seen from straight above. */

import { RockFieldError } from '../../base/errors.ts';
import type { Written } from '../gltf/glb.ts';
import type { Counts, Told } from '../gltf/gltf-json.ts';
import type { Model } from '../model.ts';
import { KEYWORD } from '../origin/origin.ts';
import { impossible } from '../options.ts';
import type { ResolvedOptions } from '../options.ts';
import { writtenOptions } from '../origin/written-options.ts';
import { Pace } from '../pace.ts';
import type { Turn } from '../pace.ts';
import { writeCsv } from '../formats/points.ts';
import { writeExr } from './exr.ts';
import { gridOf } from './grid.ts';
import type { Grid } from './grid.ts';
import { writePng } from './png.ts';
import { Rasters } from './rasters.ts';
import type { Mapped } from './rasters.ts';
import { writeZip } from './zip.ts';

type MapName = Exclude<ResolvedOptions['map'], 'all'>;
type ImageFormat = 'png' | 'r16' | 'exr';

/** What has to be known of a map to use it. */
export interface MapFacts {
  /** Pixels. */
  width: number;
  height: number;
  /** Along x and y. */
  metresPerPixel: [number, number];
  /** What the largest value of a height map is, in metres; 0 is the ground. */
  highest: number;
}

export interface WrittenMaps extends Written {
  /** What follows the title in the file's name: `-height.png`. */
  ending: string;
  map: MapFacts;
}

/** Another text of a PNG, beside that of its origin: what the map's numbers are. */
export const MAP_KEYWORD = 'rock-field-map';

/** The formats that each map has in a ZIP. In R16 and EXR there is one number for a pixel; in EXR the id, too, is exact below 2²⁴. */
export const MAP_FORMATS = {
  height: ['png', 'r16', 'exr'],
  normal: ['png'],
  id: ['png', 'exr'],
  cover: ['png'],
  contact: ['png'],
  splat: ['png'],
} as const satisfies Record<MapName, readonly ImageFormat[]>;

const NO_MESHES: Counts = { vertices: 0, triangles: 0, objects: 0, nodes: 0, meshes: 0 };

const NAMES = Object.keys(MAP_FORMATS) as MapName[];
/** Of a pixel in a PNG. */
const BYTES = { height: 2, normal: 3, id: 3, cover: 1, contact: 1, splat: 4 } as const satisfies Record<MapName, number>;

/** The share of the work that is done once it is known what is seen from above. */
const RELIEF = 0.2;

/** So much memory may maps take, bytes: as much as a field may by default. */
export const MOST_MEMORY = 1.5 * 2 ** 30;

/**
 * The map that is asked for, or a ZIP of maps with what they mean.
 *
 * @throws {RockFieldError} `ExportTooLarge`, or `ExportImpossible` of a model without ground, before anything is allocated.
 */
export async function writeMaps(model: Model, options: ResolvedOptions, told: Told, pace = new Pace()): Promise<WrittenMaps> {
  checkMaps(model, options);
  const grid = gridOf(model.ground.size, options);
  const { format, map } = options;
  const names = map === 'all' ? NAMES : [map];
  const rasters = await Rasters.of(model, grid, options, names.some(needsTriangles), pace.turns(0, RELIEF));
  const maps = new Maps(model, rasters, options, told);
  const report = { counts: NO_MESHES, map: maps.facts };
  if (format !== 'zip') {
    const bytes = await maps.file(map as MapName, format as ImageFormat, pace.turns(RELIEF, 1));
    return { ...report, ending: `-${map}.${format}`, bytes };
  }
  const files = names.flatMap((name) => MAP_FORMATS[name].map((kind) => ({ name, kind })));
  const entries: Record<string, Uint8Array> = {};
  const count = files.length + Number(map === 'all');
  const done = (k: number): number => RELIEF + ((1 - RELIEF) * k) / count;
  for (const [k, { name, kind }] of files.entries()) {
    entries[`${told.title}-${name}.${kind}`] = await maps.file(name, kind, pace.turns(done(k), done(k + 1)));
  }
  if (map === 'all') entries[`${told.title}-points.csv`] = (await writeCsv(model, options, pace.within(done(files.length), 1))).bytes;
  entries[`${KEYWORD}.json`] = new TextEncoder().encode(`${JSON.stringify({ ...told.scene, ...maps.meaning(names) }, null, 2)}\n`);
  return { ...report, ending: map === 'all' ? '-maps.zip' : `-${map}.zip`, bytes: writeZip(entries) };
}

/** Refuses what `writeMaps` would refuse. */
export function checkMaps(model: Model, options: ResolvedOptions): asserts model is Mapped {
  if (!model.ground) throw impossible('format', options.format, 'maps show ground from above, and here is none: use format "glb"');
  checkMemory(gridOf(model.ground.size, options), options);
}

class Maps {
  readonly facts: MapFacts;
  readonly #rasters: Rasters;
  readonly #model: Mapped;
  readonly #options: ResolvedOptions;
  readonly #told: Told;

  constructor(model: Mapped, rasters: Rasters, options: ResolvedOptions, told: Told) {
    const { grid, highest } = rasters;
    this.#rasters = rasters;
    this.#model = model;
    this.#options = options;
    this.#told = told;
    this.facts = {
      width: grid.width,
      height: grid.height,
      metresPerPixel: [rounded(model.unit / grid.perX), rounded(model.unit / grid.perY)],
      highest: rounded(model.unit * highest),
    };
  }

  async file(name: MapName, format: ImageFormat, turn: Turn): Promise<Uint8Array<ArrayBuffer>> {
    await turn(0);
    const { width, height } = this.#rasters.grid;
    // In a ZIP too it is the file that is written alone.
    const scene = { ...this.#told.scene, ...writtenOptions({ ...this.#options, format, map: name }) };
    const [origin, meaning] = [JSON.stringify(scene), JSON.stringify(this.meaning([name]))];
    if (format === 'png') return writePng(this.#rasters[name](), { [KEYWORD]: origin, [MAP_KEYWORD]: meaning }, turn);
    if (format === 'r16') return littleEndian(this.#rasters.height().samples);
    const valueAt = name === 'height' ? this.#rasters.metresAt : this.#rasters.idAt;
    return writeExr(width, height, valueAt, { comments: origin, rockFieldMap: meaning });
  }

  /** What the numbers of some maps are. JSON. */
  meaning(names: readonly MapName[]): Record<string, unknown> {
    const { width, height, metresPerPixel, highest } = this.facts;
    const { samples, green, contact } = this.#options;
    const meanings: Record<MapName, unknown> = {
      height: { min: 0, max: highest, unit: 'm' },
      normal: { green: green === 'up' ? '+y' : '-y' },
      id: { bodies: this.#model.groupOf.length, number: 'red + 256 · green + 65536 · blue', ground: 0 },
      cover: { ground: 0, rock: 255 },
      contact: { rock: 255, radius: contact, unit: 'm' },
      splat: {
        red: 'rock',
        green: 'gravel',
        blue: 'foot',
        alpha: 'ground',
        gravel: this.#model.groups.filter((_, group) => this.#model.ground.gravel[group]).map(({ name }) => name),
      },
    };
    return { pixels: { width, height, samples, metresPerPixel }, maps: Object.fromEntries(names.map((name) => [name, meanings[name]])) };
  }
}

function needsTriangles(name: MapName): boolean {
  return name === 'normal' || name === 'id' || name === 'splat';
}

function littleEndian(samples: Uint8Array | Uint16Array): Uint8Array<ArrayBuffer> {
  const bytes = new Uint8Array(2 * samples.length);
  const view = new DataView(bytes.buffer);
  for (let at = 0; at < samples.length; at++) view.setUint16(2 * at, samples[at]!, true);
  return bytes;
}

/** Seven digits: more than 16 bits have. */
function rounded(value: number): number {
  return Number(value.toPrecision(7));
}

function checkMemory({ width, height }: Grid, { format, map }: ResolvedOptions): void {
  const perPixel = bytesPerPixel(format, map);
  const expected = perPixel * width * height;
  if (expected <= MOST_MEMORY) return;
  const [needed, most] = [expected, MOST_MEMORY].map((bytes) => Math.round(bytes / 1e6));
  const fitting = Math.floor(Math.max(width, height) * Math.sqrt(MOST_MEMORY / expected));
  const lighter = map === 'all' ? ', or one map at a time' : '';
  throw new RockFieldError({
    name: 'ExportTooLarge',
    key: 'side',
    value: expected,
    max: MOST_MEMORY,
    message: `the map would need about ${needed} MB of memory; it may need at most ${most} MB: choose side ${fitting} or less${lighter}`,
    words: {
      en: `This would need about ${needed} MB of memory; it may need at most ${most} MB. Choose at most ${fitting} pixels${lighter}.`,
      ja: `約 ${needed} MB のメモリーが必要ですが、上限は ${most} MB です。${fitting} ピクセル以下に${map === 'all' ? 'するか、マップを 1 枚ずつ保存' : ''}してください。`,
    },
  });
}

/** Depth buffer, samples, and the file twice, in pieces and as a whole. PNG is taken to be as large as its samples. */
export function bytesPerPixel(format: ResolvedOptions['format'], map: ResolvedOptions['map']): number {
  const names = map === 'all' ? NAMES : [map];
  const depth = names.some(needsTriangles) ? 8 : 4;
  const nearness = names.some((name) => name === 'contact' || name === 'splat') ? 2 : 0;
  const fileOf = (name: MapName, kind: ImageFormat): number => ({ png: BYTES[name], r16: 2, exr: 4 })[kind];
  if (format !== 'zip') {
    const [name] = names as [MapName];
    return depth + nearness + (format === 'exr' ? 4 : BYTES[name] + (format === 'png' ? 2 : 1) * fileOf(name, format as ImageFormat));
  }
  const samples = Math.max(...names.map((name) => BYTES[name]));
  const files = names.reduce((sum, name) => sum + MAP_FORMATS[name].reduce((own, kind) => own + fileOf(name, kind), 0), 0);
  return depth + nearness + samples + 2 * files;
}
