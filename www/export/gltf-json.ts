/** The JSON part of a glTF file. */

import type { Buffers, Mesh, Place } from './gltf-parts.ts';
import type { Kit } from './kit.ts';
import { isOneThing, thingsOf } from './model.ts';
import type { Model } from './model.ts';

/** What a file has in it, for its report. */
export interface Counts {
  vertices: number;
  triangles: number;
  /** Placed meshes. */
  objects: number;
  /** Of the scene graph: objects, and the groups that they are in. */
  nodes: number;
  meshes: number;
}

/** What is said about the whole file, and about each body. JSON. */
export interface Told {
  title: string;
  scene: Record<string, unknown>;
  body: (k: number) => Record<string, unknown>;
}

const FLOAT = 5126;

/** The JSON part, written as text from the start: as objects it would take ten times the memory. */
export class GltfJson {
  readonly counts: Counts = { vertices: 0, triangles: 0, objects: 0, nodes: 0, meshes: 0 };
  #model: Model;
  #buffers: Buffers;
  #indices: number;
  #accessors: string[] = [];
  #meshes: string[] = [];
  /** For each mesh. */
  #triangles: number[] = [];
  /** How many parts have been written. */
  #parts = 0;
  /** Numbers in the file of the model's materials, in the order in which they were used. */
  #materials = new Map<number, number>();
  #nodes: string[] = [];
  #roots: number[] = [];
  #extensions = new Set<string>();

  constructor(model: Model, buffers: Buffers) {
    this.#model = model;
    this.#buffers = buffers;
    this.#indices = buffers.places.reduce((sum, { indices }) => sum + indices, 0);
  }

  /** Meshes are added in the order of the buffers. */
  addMesh({ name, parts }: Mesh): void {
    const { places, views, indexType } = this.#buffers;
    const bytes = views.indices!.length / this.#indices;
    let triangles = 0;
    const primitives = parts.map(({ material, bodies }) => {
      const { vertex, vertices, index, indices, min, max } = places[this.#parts++]!;
      const attributes: Record<string, number> = {
        POSITION: this.#accessor('positions', 12 * vertex, FLOAT, vertices, 'VEC3', { min, max }),
        NORMAL: this.#accessor('normals', 12 * vertex, FLOAT, vertices, 'VEC3'),
      };
      if (views.ids) attributes._FEATURE_ID_0 = this.#accessor('ids', 4 * vertex, FLOAT, vertices, 'SCALAR');
      this.counts.vertices += vertices;
      triangles += indices / 3;
      return {
        attributes,
        indices: this.#accessor('indices', bytes * index, indexType, indices, 'SCALAR'),
        material: this.#material(material),
        ...(views.ids && { extensions: this.#used('EXT_mesh_features', { featureIds: [{ featureCount: bodies.length, attribute: 0 }] }) }),
      };
    });
    this.#meshes.push(JSON.stringify({ name, primitives }));
    this.#triangles.push(triangles);
    this.counts.meshes += 1;
  }

  addWholes(meshes: readonly Mesh[]): void {
    meshes.forEach(({ name, group }, mesh) => {
      this.#roots.push(this.#node({ name, mesh, extras: this.#model.groups[group]!.extras }, mesh));
    });
  }

  addSingles(meshes: readonly Mesh[], told: Told): void {
    this.#grouped((group) => {
      const children: number[] = [];
      meshes.forEach(({ name, group: of, parts }, mesh) => {
        if (of !== group) return;
        const [k] = parts[0]!.bodies as [number];
        children.push(this.#node({ name, mesh, translation: this.#placeOf(k), extras: told.body(k) }, mesh));
      });
      return children;
    });
  }

  addKit(kit: Kit, meshes: readonly Mesh[], told: Told, instancing: boolean): void {
    if (instancing) this.#addInstances(kit, meshes, told);
    else {
      const things = thingsOf(this.#model);
      this.#grouped((group) =>
        things
          .filter((thing) => thing.group === group)
          .map(({ name, bodies: [k] }) => {
            const mesh = kit.kindOf[k!]!;
            const place = isOneThing(this.#model, group) ? { translation: this.#placeOf(k!) } : this.#instance(kit, k!);
            return this.#node({ name, mesh, ...place, extras: told.body(k!) }, mesh);
          }),
      );
    }
  }

  /** The instances of a kind lie one after the other in their views. */
  #addInstances(kit: Kit, meshes: readonly Mesh[], told: Told): void {
    const { bytes, views } = this.#buffers;
    const arrays = {
      translation: new Float32Array(bytes.buffer, views.translations?.offset, (views.translations?.length ?? 0) / 4),
      rotation: new Float32Array(bytes.buffer, views.rotations?.offset, (views.rotations?.length ?? 0) / 4),
      scale: new Float32Array(bytes.buffer, views.scales?.offset, (views.scales?.length ?? 0) / 4),
    };
    let at = 0;
    this.#grouped((group) =>
      meshes.flatMap(({ name, group: of }, mesh) => {
        const own = of === group ? [...kit.kindOf.keys()].filter((k) => kit.kindOf[k] === mesh) : [];
        if (own.length === 0) return [];
        if (isOneThing(this.#model, group)) {
          return [this.#node({ name, mesh, translation: this.#placeOf(own[0]!), extras: told.body(own[0]!) }, mesh)];
        }
        const attributes = {
          TRANSLATION: this.#accessor('translations', 12 * at, FLOAT, own.length, 'VEC3'),
          ROTATION: this.#accessor('rotations', 16 * at, FLOAT, own.length, 'VEC4'),
          SCALE: this.#accessor('scales', 12 * at, FLOAT, own.length, 'VEC3'),
        };
        for (const k of own) {
          const { translation, rotation, scale } = this.#instance(kit, k);
          arrays.translation.set(translation, 3 * at);
          arrays.rotation.set(rotation, 4 * at);
          arrays.scale.set(scale, 3 * at);
          at += 1;
        }
        this.counts.objects += own.length - 1;
        this.counts.triangles += (own.length - 1) * this.#trianglesOf(mesh);
        return [this.#node({ name, mesh, extensions: this.#used('EXT_mesh_gpu_instancing', { attributes }) }, mesh)];
      }),
    );
  }

  /** What makes the body's kind lie as the body does. */
  #instance({ kinds, kindOf, frames }: Kit, k: number) {
    const [own, kind] = [frames[k]!, frames[kinds[kindOf[k]!]!]!];
    const [along, across, height] = own.extents.map((extent, axis) => rounded(extent / kind.extents[axis]!));
    // Half of the angle, which is between −90° and 90°.
    const [cos, sin] = [Math.sqrt((1 + own.cos) / 2), Math.sqrt(Math.max(0, (1 - own.cos) / 2)) * (own.sin < 0 ? -1 : 1)];
    return { translation: this.#placeOf(k), rotation: [0, rounded(sin), 0, rounded(cos)], scale: [along!, height!, across!] };
  }

  /** Metres from the middle of the whole, y up. */
  #placeOf(k: number): number[] {
    const { origins, centre, unit } = this.#model;
    const [x, y, z] = [0, 1, 2].map((axis) => unit * (origins[3 * k + axis]! - centre[axis]!)) as [number, number, number];
    return [rounded(x), rounded(z), rounded(-y)];
  }

  /** A node for each group that has children; what is one thing needs none above it. */
  #grouped(childrenOf: (group: number) => number[]): void {
    this.#model.groups.forEach(({ name, extras }, group) => {
      const children = childrenOf(group);
      if (isOneThing(this.#model, group)) this.#roots.push(...children);
      else if (children.length > 0) this.#roots.push(this.#node({ name, children, extras }));
    });
  }

  #node(node: Record<string, unknown>, mesh?: number): number {
    this.#nodes.push(JSON.stringify(node));
    this.counts.nodes += 1;
    if (mesh !== undefined) {
      this.counts.objects += 1;
      this.counts.triangles += this.#trianglesOf(mesh);
    }
    return this.#nodes.length - 1;
  }

  #trianglesOf(mesh: number): number {
    return this.#triangles[mesh]!;
  }

  #accessor(
    view: keyof Buffers['views'],
    byteOffset: number,
    componentType: number,
    count: number,
    type: string,
    bounds?: Pick<Place, 'min' | 'max'>,
  ): number {
    const bufferView = this.#buffers.views[view]!.index;
    this.#accessors.push(JSON.stringify({ bufferView, byteOffset, componentType, count, type, ...bounds }));
    return this.#accessors.length - 1;
  }

  #material(ofModel: number): number {
    if (!this.#materials.has(ofModel)) this.#materials.set(ofModel, this.#materials.size);
    return this.#materials.get(ofModel)!;
  }

  #used(extension: string, value: unknown): Record<string, unknown> {
    this.#extensions.add(extension);
    return { [extension]: value };
  }

  text({ title, scene }: Told): string {
    const materials = [...this.#materials.keys()].map((used) => {
      const { name, color } = this.#model.materials[used]!;
      return { name, pbrMetallicRoughness: { baseColorFactor: [...color, 1], metallicFactor: 0, roughnessFactor: 0.9 } };
    });
    const { bytes, views } = this.#buffers;
    const bufferViews = Object.values(views).map(({ offset, length, stride, target }) => ({
      buffer: 0,
      byteOffset: offset,
      byteLength: length,
      ...(stride && { byteStride: stride }),
      ...(target && { target }),
    }));
    const list = (name: string, items: readonly string[]): string[] => (items.length > 0 ? [`"${name}":[${items.join()}]`] : []);
    const used = this.#extensions.size > 0 ? [`"extensionsUsed":${JSON.stringify([...this.#extensions])}`] : [];
    const required = this.#extensions.has('EXT_mesh_gpu_instancing') ? ['"extensionsRequired":["EXT_mesh_gpu_instancing"]'] : [];
    return `{${[
      '"asset":{"version":"2.0","generator":"rock-field"}',
      ...used,
      ...required,
      '"scene":0',
      `"scenes":[${JSON.stringify({ name: title, ...(this.#roots.length > 0 && { nodes: this.#roots }), extras: scene })}]`,
      ...list('nodes', this.#nodes),
      ...list('meshes', this.#meshes),
      ...(this.#meshes.length > 0 ? [`"materials":${JSON.stringify(materials)}`] : []),
      ...list('accessors', this.#accessors),
      ...(bytes.length > 0
        ? [`"bufferViews":${JSON.stringify(bufferViews)}`, `"buffers":${JSON.stringify([{ byteLength: bytes.length }])}`]
        : []),
    ].join()}}`;
  }
}

/** Seven digits, as many as a 32-bit float has. */
export function rounded(value: number): number {
  return Number(value.toPrecision(7));
}
