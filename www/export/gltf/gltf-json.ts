/** The JSON part of a glTF file. */

import { ByteWriter } from '../formats/byte-writer.ts';
import { BOUNDS, boundsOf, COLOR_BYTES } from './gltf-buffers.ts';
import type { Layout, View, ViewName } from './gltf-buffers.ts';
import { levelName } from './gltf-parts.ts';
import type { Meshes, Part, Shapes } from './gltf-parts.ts';
import { TEXTURED, texturesOf } from './gltf-textures.ts';
import type { Kit } from '../shapes/kit.ts';
import { isOneThing, thingsOf } from '../model.ts';
import type { Model } from '../model.ts';
import { COMPRESSION, packedViews } from './packed.ts';
import type { Packing } from './packed.ts';
import { instancesByKind, placementOf, translationOf } from '../shapes/placement.ts';
import type { Placement } from '../shapes/placement.ts';

/** What a file has in it, for its report. Vertices, triangles and objects are those of the finest level, without hulls. */
export interface Counts {
  vertices: number;
  triangles: number;
  /** Placed meshes. */
  objects: number;
  /** Triangles of each level of detail, the finest first, where a file may have them. */
  levels?: number[];
  /** Where there are any. */
  hulls?: { objects: number; vertices: number; triangles: number };
  /** Of the scene graph: objects, and the groups that they are in. */
  nodes: number;
  meshes: number;
}

/** What is said about the whole file, and about each body. */
export interface Told {
  title: string;
  /** JSON. */
  scene: Record<string, unknown>;
  /** Writes a JSON object about body k. */
  body: (out: ByteWriter, k: number) => void;
}

const [FLOAT, UNSIGNED_SHORT] = [5126, 5123];
/** Digits of numbers that people read, as many as a 32-bit float has; and of those that have to be a certain 32-bit float. */
const [DIGITS, BOUND_DIGITS] = [7, 9];

/** Extensions without which a file cannot be read. */
const REQUIRED = ['EXT_mesh_gpu_instancing', COMPRESSION];

/** What is written of vertices, in the order in which it stands in a primitive. */
const ATTRIBUTES = [
  { view: 'positions', semantic: 'POSITION', bytes: 12, component: FLOAT, type: 'VEC3' },
  { view: 'normals', semantic: 'NORMAL', bytes: 12, component: FLOAT, type: 'VEC3' },
  { view: 'tangents', semantic: 'TANGENT', bytes: 16, component: FLOAT, type: 'VEC4' },
  { view: 'coordinates', semantic: 'TEXCOORD_0', bytes: 8, component: FLOAT, type: 'VEC2' },
  { view: 'colors', semantic: 'COLOR_0', bytes: COLOR_BYTES, component: UNSIGNED_SHORT, type: 'VEC4' },
  { view: 'ids', semantic: '_FEATURE_ID_0', bytes: 4, component: FLOAT, type: 'SCALAR' },
] as const satisfies readonly { view: ViewName; semantic: string; bytes: number; component: number; type: string }[];

/**
 * The JSON part, whose lists are bytes from the start: as objects they would take ten times the time and the memory.
 *
 * What writes one object after the other yields after each, so that others can have their turn.
 */
export class GltfJson {
  readonly counts: Counts = { vertices: 0, triangles: 0, objects: 0, nodes: 0, meshes: 0 };
  #model: Model;
  #layout: Layout;
  #meshes: Meshes;
  #hullName: Shapes['hullName'];
  #told: Told;
  /** For each level. */
  #levels: number[];
  #accessors = new ByteWriter();
  #accessorCount = 0;
  #meshList = new ByteWriter();
  /** For each mesh. */
  #triangles: number[] = [];
  /** How many parts have been written. */
  #parts = 0;
  /** The first accessor of each of them; the others follow it. */
  #firstAccessors = new Map<Part, number>();
  /** Numbers in the file of the model's materials, in the order in which they were used. */
  #materials = new Map<number, number>();
  #nodes = new ByteWriter();
  #roots: number[] = [];
  #extensions = new Set<string>();
  #bounds = new Float32Array(BOUNDS);

  constructor(model: Model, layout: Layout, meshes: Meshes, hullName: Shapes['hullName'], told: Told) {
    this.#model = model;
    this.#layout = layout;
    this.#meshes = meshes;
    this.#hullName = hullName;
    this.#levels = Array.from({ length: meshes.levels }, () => 0);
    this.#told = told;
  }

  /** Meshes are added in the order of the layout. */
  *addMeshes(): Generator<void> {
    const out = this.#meshList;
    for (const { name, parts } of this.#meshes.all) {
      out.text(this.counts.meshes > 0 ? ',{"name":' : '{"name":');
      out.quoted(name);
      out.text(',"primitives":[');
      let triangles = 0;
      parts.forEach((part, p) => {
        if (p > 0) out.text(',');
        triangles += this.#addPart(part);
      });
      out.text(']}');
      this.#triangles.push(triangles);
      this.counts.meshes += 1;
      yield;
    }
  }

  /** Returns how many triangles it has. */
  #addPart(part: Part): number {
    const out = this.#meshList;
    const { places, views, indexType, indexBytes } = this.#layout;
    const { vertex, vertices, index, indices } = places[this.#parts++]!;
    const isNew = !part.sameAs;
    let accessor = part.sameAs ? this.#firstAccessors.get(part.sameAs)! : this.#accessorCount;
    if (isNew) this.#firstAccessors.set(part, accessor);
    out.text('{"attributes":');
    let before = '{"';
    for (const { view, semantic, bytes, component, type } of ATTRIBUTES) {
      if (!views[view] || (part.material === undefined && view !== 'positions')) continue;
      if (isNew) {
        const bounds = view === 'positions' ? boundsOf(part, this.#bounds) : undefined;
        this.#accessor(view, bytes * vertex, component, vertices, type, bounds);
      }
      out.text(before);
      out.text(semantic);
      out.text('":');
      out.whole(accessor++);
      before = ',"';
    }
    out.text('},"indices":');
    if (isNew) this.#accessor('indices', indexBytes * index, indexType, indices, 'SCALAR');
    out.whole(accessor);
    if (part.material !== undefined) {
      out.text(',"material":');
      out.whole(this.#material(part.material));
    }
    if (views.ids) {
      const features = { featureIds: [{ featureCount: part.bodies.length, attribute: 0 }] };
      out.text(`,"extensions":${JSON.stringify(this.#used('EXT_mesh_features', features))}`);
    }
    out.text('}');
    if (this.counts.meshes < this.#meshes.own.length) this.counts.vertices += vertices;
    return indices / 3;
  }

  *addWholes(): Generator<void> {
    for (const [mesh, { name, group }] of this.#meshes.own.entries()) {
      for (let level = 0; level < this.#meshes.levels; level++) {
        this.#roots.push(this.#beginNode(levelName(name, level, this.#meshes.levels)));
        this.#mesh(mesh, level);
        this.#endNode(this.#model.groups[group]!.extras);
      }
      yield;
    }
  }

  *addSingles(): Generator<void> {
    for (const group of this.#model.groups.keys()) {
      const first = this.counts.nodes;
      for (const [mesh, { name, group: of, parts }] of this.#meshes.own.entries()) {
        if (of !== group) continue;
        const body = parts[0]!.bodies[0]!;
        this.#object(name, mesh, translationOf(this.#model, body), undefined, body);
        yield;
      }
      this.#group(group, first);
    }
  }

  *addKit(kit: Kit, instancing: boolean): Generator<void> {
    if (instancing) {
      this.#addInstances(kit);
      return;
    }
    const things = thingsOf(this.#model);
    for (const group of this.#model.groups.keys()) {
      const first = this.counts.nodes;
      for (const { name, group: of, bodies } of things) {
        if (of !== group) continue;
        const body = bodies[0]!;
        const placement = isOneThing(this.#model, group) ? undefined : placementOf(this.#model, body, kit);
        this.#object(name, kit.kindOf[body]!, placement?.translation ?? translationOf(this.#model, body), placement, body);
        yield;
      }
      this.#group(group, first);
    }
  }

  #addInstances(kit: Kit): void {
    const instances = instancesByKind(this.#model, kit);
    let at = 0;
    for (const group of this.#model.groups.keys()) {
      const first = this.counts.nodes;
      for (const [mesh, { name, group: of, parts }] of this.#meshes.own.entries()) {
        if (of !== group) continue;
        if (isOneThing(this.#model, group)) {
          const body = parts[0]!.bodies[0]!;
          this.#object(name, mesh, translationOf(this.#model, body), undefined, body);
          continue;
        }
        const count = instances[mesh]!.length;
        if (count === 0) continue;
        const attributes = {
          TRANSLATION: this.#accessor('translations', 12 * at, FLOAT, count, 'VEC3'),
          ROTATION: this.#accessor('rotations', 16 * at, FLOAT, count, 'VEC4'),
          SCALE: this.#accessor('scales', 12 * at, FLOAT, count, 'VEC3'),
        };
        at += count;
        for (let level = 0; level < this.#meshes.levels; level++) {
          this.#beginNode(levelName(name, level, this.#meshes.levels));
          this.#mesh(mesh, level, count);
          this.#nodes.text(`,"extensions":${JSON.stringify(this.#used('EXT_mesh_gpu_instancing', { attributes }))}}`);
        }
      }
      this.#group(group, first);
    }
  }

  /** Returns its number. What it is and its end are still to be written. */
  #beginNode(name: string): number {
    const out = this.#nodes;
    out.text(this.counts.nodes > 0 ? ',{"name":' : '{"name":');
    out.quoted(name);
    this.counts.nodes += 1;
    return this.counts.nodes - 1;
  }

  #endNode(extras: Record<string, unknown>): void {
    this.#nodes.text(`,"extras":${JSON.stringify(extras)}}`);
  }

  /** Tells that the node is a mesh of the finest level, at another one, so many times. */
  #mesh(mesh: number, level: number, times = 1): void {
    const number = mesh + level * this.#meshes.own.length;
    this.#nodes.text(',"mesh":');
    this.#nodes.whole(number);
    this.#levels[level]! += times * this.#triangles[number]!;
    if (level > 0) return;
    this.counts.objects += times;
    this.counts.triangles += times * this.#triangles[number]!;
  }

  /** An object at all of its levels, and its hull. `mesh` is that of the finest. */
  #object(
    name: string,
    mesh: number,
    translation: Placement['translation'],
    placement: Partial<Placement> | undefined,
    body: number,
  ): void {
    const { levels, hulls } = this.#meshes;
    for (let level = 0; level < levels; level++) {
      this.#beginNode(levelName(name, level, levels));
      this.#mesh(mesh, level);
      this.#place(translation, placement);
      if (level === 0) {
        this.#nodes.text(',"extras":');
        this.#told.body(this.#nodes, body);
      }
      this.#nodes.text('}');
    }
    const hull = hulls[mesh];
    if (hull !== undefined) {
      this.#beginNode(this.#hullName(levelName(name, 0, levels)));
      this.#nodes.text(',"mesh":');
      this.#nodes.whole(hull);
      this.#place(translation, placement);
      this.#nodes.text('}');
      this.#countHull(hull);
    }
  }

  #countHull(hull: number): void {
    this.counts.hulls ??= { objects: 0, vertices: 0, triangles: 0 };
    const count = this.counts.hulls;
    count.objects += 1;
    count.vertices += this.#layout.places.at(hull - this.#meshes.all.length)!.vertices;
    count.triangles += this.#triangles[hull]!;
  }

  #place(translation: Placement['translation'], { rotation, scale }: Partial<Placement> = {}): void {
    const out = this.#nodes;
    this.#list(out, ',"translation":[', translation, 0, 3, DIGITS);
    if (rotation) this.#list(out, ',"rotation":[', rotation, 0, 4, DIGITS);
    if (scale) this.#list(out, ',"scale":[', scale, 0, 3, DIGITS);
  }

  /** The numbers from `begin` to `end`. */
  #list(out: ByteWriter, opening: string, numbers: ArrayLike<number>, begin: number, end: number, digits: number): void {
    out.text(opening);
    for (let k = begin; k < end; k++) {
      if (k > begin) out.text(',');
      out.significant(numbers[k]!, digits);
    }
    out.text(']');
  }

  /** A node above those of a group, which have been written from number `first` on; what is one thing needs none above it. */
  #group(group: number, first: number): void {
    const { name, extras } = this.#model.groups[group]!;
    const end = this.counts.nodes;
    if (isOneThing(this.#model, group)) {
      for (let node = first; node < end; node++) this.#roots.push(node);
    } else if (end > first) {
      this.#roots.push(this.#beginNode(name));
      let before = ',"children":[';
      for (let node = first; node < end; node++) {
        this.#nodes.text(before);
        this.#nodes.whole(node);
        before = ',';
      }
      this.#nodes.text(']');
      this.#endNode(extras);
    }
  }

  /** Returns its number. */
  #accessor(view: ViewName, byteOffset: number, componentType: number, count: number, type: string, bounds?: Float32Array): number {
    const out = this.#accessors;
    out.text(this.#accessorCount > 0 ? ',{"bufferView":' : '{"bufferView":');
    out.whole(this.#layout.views[view]!.index);
    out.text(',"byteOffset":');
    out.whole(byteOffset);
    out.text(',"componentType":');
    out.whole(componentType);
    if (view === 'colors') out.text(',"normalized":true');
    out.text(',"count":');
    out.whole(count);
    out.text(',"type":"');
    out.text(type);
    out.text('"');
    if (bounds) {
      this.#list(out, ',"min":[', bounds, 0, 3, BOUND_DIGITS);
      this.#list(out, ',"max":[', bounds, 3, 6, BOUND_DIGITS);
    }
    out.text('}');
    return this.#accessorCount++;
  }

  #material(ofModel: number): number {
    if (!this.#materials.has(ofModel)) this.#materials.set(ofModel, this.#materials.size);
    return this.#materials.get(ofModel)!;
  }

  #used(extension: string, value: unknown): Record<string, unknown> {
    this.#extensions.add(extension);
    return { [extension]: value };
  }

  /** All of it, in pieces that follow one another. `packing` where the binary part is compressed. */
  pieces(packing?: Packing): ByteWriter[] {
    this.counts.levels = this.#levels;
    if (packing) this.#extensions.add(COMPRESSION);
    const { title, scene } = this.#told;
    const { length, views } = this.#layout;
    const pieces: ByteWriter[] = [];
    const text = (words: string): void => {
      const piece = new ByteWriter();
      piece.text(words);
      pieces.push(piece);
    };
    const list = (name: string, items: ByteWriter): void => {
      if (items.length === 0) return;
      text(`,"${name}":[`);
      pieces.push(items);
      text(']');
    };
    text('{"asset":{"version":"2.0","generator":"rock-field"}');
    if (this.#extensions.size > 0) text(`,"extensionsUsed":${JSON.stringify([...this.#extensions])}`);
    const required = REQUIRED.filter((extension) => this.#extensions.has(extension));
    if (required.length > 0) text(`,"extensionsRequired":${JSON.stringify(required)}`);
    const roots = this.#roots.length > 0 && { nodes: this.#roots };
    text(`,"scene":0,"scenes":[${JSON.stringify({ name: title, ...roots, extras: scene })}]`);
    list('nodes', this.#nodes);
    list('meshes', this.#meshList);
    if (this.counts.meshes > 0) text(`,"materials":${JSON.stringify(this.#usedMaterials())}`);
    if (this.#model.textures) {
      for (const [name, items] of Object.entries(texturesOf(this.#layout))) text(`,"${name}":${JSON.stringify(items)}`);
    }
    list('accessors', this.#accessors);
    if (length > 0) {
      const bufferViews = packing ? packedViews(this.#layout, packing) : Object.values(views).map(bufferView);
      const fallback = { byteLength: length, extensions: { [COMPRESSION]: { fallback: true } } };
      const buffers = packing ? [{ byteLength: packing.length }, fallback] : [{ byteLength: length }];
      text(`,"bufferViews":${JSON.stringify(bufferViews)},"buffers":${JSON.stringify(buffers)}`);
    }
    text('}');
    return pieces;
  }

  #usedMaterials(): object[] {
    return [...this.#materials.keys()].map((used) => {
      const { name, color, roughness = 0.9, isTwoSided, isTextured } = this.#model.materials[used]!;
      if (isTextured) return { name, ...TEXTURED };
      return {
        name,
        pbrMetallicRoughness: {
          baseColorFactor: this.#layout.views.colors ? [1, 1, 1, 1] : [...color, 1],
          metallicFactor: 0,
          roughnessFactor: roughness,
        },
        ...(isTwoSided && { doubleSided: true }),
      };
    });
  }
}

function bufferView({ offset, length, stride, target }: View): object {
  return { buffer: 0, byteOffset: offset, byteLength: length, ...(stride && { byteStride: stride }), ...(target && { target }) };
}
