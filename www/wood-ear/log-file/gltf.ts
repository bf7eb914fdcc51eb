/**
 * The triangles of a glTF file's scene.
 *
 * Geometry alone is read, so nothing else decides: materials, textures and pictures, and extensions that only they need, are no reason
 * to refuse a file. Skins are ignored, and so is, as glTF wants it, the transform of a node whose mesh has one; morph targets rest.
 */

import { Accessors, isPacked } from './accessor.ts';
import type { Accessor } from './accessor.ts';
import type { Gltf, Item } from './gltf-json.ts';
import { GrowingFloats, GrowingIndices } from './growing.ts';
import { MOST_TRIANGLES } from './limits.ts';
import { determinant, fromParts, IDENTITY, product, transformed } from './matrix.ts';
import type { Matrix } from './matrix.ts';
import { checkCount } from './mesh.ts';
import type { Soup } from './mesh.ts';

/** glTF is in metres. */
const CENTIMETRES = 100;
/** The modes of primitives that are triangles; the others are points and lines. */
const [TRIANGLES, STRIP, FAN] = [4, 5, 6];
const [BYTE, UBYTE, SHORT, USHORT, UINT, FLOAT] = [5120, 5121, 5122, 5123, 5125, 5126];
/** With KHR_mesh_quantization; without it only the last. */
const POSITION_TYPES = [BYTE, UBYTE, SHORT, USHORT, FLOAT];
/** A strip may have triangles without area between its parts. */
const MOST_STEPS = 2 * MOST_TRIANGLES;

interface Primitive {
  mode: number;
  position: Accessor;
  indices: Accessor | null;
  what: string;
  /** Triangles, those of a strip without area counted too. */
  steps: number;
}

/** @throws {RockFieldError} `LogFileBroken`, `LogFileUnsupported`, `LogFileTooLarge` or `LogTooLarge`. */
export async function readGltf(gltf: Gltf, onProgress: (fraction: number) => void = () => {}): Promise<Soup> {
  const scene = new Scene(gltf, isPacked(gltf) ? await meshopt() : undefined);
  const placed = scene.placed();
  const soup = new Builder(gltf);
  placed.forEach(({ primitive, matrix }, k) => {
    onProgress(k / placed.length);
    soup.add(primitive, matrix);
  });
  return soup.finish();
}

async function meshopt() {
  const { MeshoptDecoder } = await import('meshoptimizer/decoder');
  await MeshoptDecoder.ready;
  return MeshoptDecoder;
}

/** Which primitives the scene shows, and where. */
class Scene {
  readonly #gltf: Gltf;
  readonly #accessors: Accessors;
  readonly #meshes = new Map<number, Primitive[]>();
  readonly #placed: { primitive: Primitive; matrix: Matrix }[] = [];
  #steps = 0;

  constructor(gltf: Gltf, decoder: ConstructorParameters<typeof Accessors>[1]) {
    this.#gltf = gltf;
    this.#accessors = new Accessors(gltf, decoder);
  }

  placed(): readonly { primitive: Primitive; matrix: Matrix }[] {
    const gltf = this.#gltf;
    const seen = new Set<number>();
    const open = this.#roots().map((index) => ({ index, parent: IDENTITY }));
    for (let next = open.pop(); next; next = open.pop()) {
      const { index, parent } = next;
      const node = gltf.item('nodes', index);
      const what = `nodes[${index as number}]`;
      if (seen.has(index as number))
        throw gltf.broken({
          en: `${what} is the child of two nodes, or of itself`,
          ja: `${what} が 2 つのノード、または自分自身の子になっています`,
        });
      seen.add(index as number);
      if (gltf.extension(node, 'KHR_node_visibility', what)?.['visible'] === false) continue;
      const matrix = product(parent, this.#local(node, what));
      if (node['mesh'] !== undefined) this.#place(node, what, matrix);
      for (const child of gltf.list(node['children'], `${what}.children`)) open.push({ index: child, parent: matrix });
    }
    return this.#placed;
  }

  /** Of the scene that is shown; of a file without scenes, the nodes that are nobody's children. */
  #roots(): readonly unknown[] {
    const gltf = this.#gltf;
    if (gltf.scene !== undefined || gltf.count('scenes') > 0) {
      const index = gltf.scene ?? 0;
      return gltf.list(gltf.item('scenes', index)['nodes'], `scenes[${String(index)}].nodes`);
    }
    const all = Array.from({ length: gltf.count('nodes') }, (_, index) => index);
    const children = new Set(all.flatMap((index) => gltf.list(gltf.item('nodes', index)['children'], `nodes[${index}].children`)));
    return all.filter((index) => !children.has(index));
  }

  #local(node: Item, what: string): Matrix {
    const gltf = this.#gltf;
    if (node['matrix'] !== undefined) return gltf.numbers(node, 'matrix', what, IDENTITY);
    const [x = 0, y = 0, z = 0] = gltf.numbers(node, 'translation', what, [0, 0, 0]);
    return fromParts([x, y, z], gltf.numbers(node, 'rotation', what, [0, 0, 0, 1]), gltf.numbers(node, 'scale', what, [1, 1, 1]));
  }

  #place(node: Item, what: string, matrix: Matrix): void {
    const gltf = this.#gltf;
    const primitives = this.#primitives(node['mesh']);
    if (primitives.length === 0) return;
    const instancing = gltf.extension(node, 'EXT_mesh_gpu_instancing', what);
    const matrices = node['skin'] !== undefined ? [IDENTITY] : instancing ? this.#instances(instancing, what, matrix) : [matrix];
    const steps = primitives.reduce((sum, primitive) => sum + primitive.steps, 0);
    this.#steps += steps * matrices.length;
    checkCount(gltf.name, { en: 'triangles', ja: '三角形' }, this.#steps, MOST_STEPS);
    for (const each of matrices) for (const primitive of primitives) this.#placed.push({ primitive, matrix: each });
  }

  #instances(instancing: Item, what: string, matrix: Matrix): Matrix[] {
    const gltf = this.#gltf;
    const attributes = gltf.object(instancing['attributes'], `${what}.attributes`);
    const read = (key: string, width: number, types: readonly number[]) =>
      attributes[key] === undefined ? undefined : this.#accessors.get(attributes[key], width, types);
    const translation = read('TRANSLATION', 3, [FLOAT]);
    const rotation = read('ROTATION', 4, [FLOAT, BYTE, SHORT]);
    const scale = read('SCALE', 3, [FLOAT]);
    const given = [translation, rotation, scale].filter((accessor) => accessor !== undefined);
    const count = Math.min(...given.map((accessor) => accessor.count), given.length === 0 ? 0 : MOST_STEPS + 1);
    checkCount(gltf.name, { en: 'triangles', ja: '三角形' }, count, MOST_STEPS);
    const parts = (accessor: Accessor | undefined, i: number, fallback: readonly number[]) =>
      fallback.map((value, k) => accessor?.get(i, k) ?? value);
    return Array.from({ length: count }, (_, i) =>
      product(matrix, fromParts(parts(translation, i, [0, 0, 0]), parts(rotation, i, [0, 0, 0, 1]), parts(scale, i, [1, 1, 1]))),
    );
  }

  #primitives(index: unknown): Primitive[] {
    const mesh = this.#gltf.item('meshes', index);
    const number = index as number;
    const known = this.#meshes.get(number);
    if (known) return known;
    const items = this.#gltf.list(mesh['primitives'], `meshes[${number}].primitives`);
    const primitives = items.flatMap((item, k) => this.#primitive(item, `meshes[${number}].primitives[${k}]`) ?? []);
    this.#meshes.set(number, primitives);
    return primitives;
  }

  /** Undefined for points and lines, and for triangles without positions, which glTF does not draw. */
  #primitive(value: unknown, what: string): Primitive | undefined {
    const gltf = this.#gltf;
    const item = gltf.object(value, what);
    const mode = gltf.whole(item, 'mode', what, TRIANGLES);
    if (mode !== TRIANGLES && mode !== STRIP && mode !== FAN) return undefined;
    const position = gltf.object(item['attributes'], `${what}.attributes`)['POSITION'];
    if (position === undefined) return undefined;
    const { bufferView, sparse } = gltf.item('accessors', position);
    if (bufferView === undefined && sparse === undefined && gltf.extension(item, 'KHR_draco_mesh_compression', what)) {
      throw gltf.unsupported({
        en: 'its geometry is compressed with Draco; save it without, or with meshopt',
        ja: '形状が Draco で圧縮されています。圧縮なし、または meshopt で保存してください',
      });
    }
    const positions = this.#accessors.get(position, 3, POSITION_TYPES);
    const indices = item['indices'] === undefined ? null : this.#accessors.get(item['indices'], 1, [UBYTE, USHORT, UINT]);
    const corners = (indices ?? positions).count;
    const steps = mode === TRIANGLES ? Math.floor(corners / 3) : Math.max(0, corners - 2);
    checkCount(gltf.name, { en: 'triangles', ja: '三角形' }, steps, mode === TRIANGLES ? MOST_TRIANGLES : MOST_STEPS);
    return { mode, position: positions, indices, what, steps };
  }
}

/** Gathers triangles, and of the vertices those that they use. */
class Builder {
  readonly #gltf: Gltf;
  readonly #positions = new GrowingFloats();
  readonly #indices = new GrowingIndices();

  constructor(gltf: Gltf) {
    this.#gltf = gltf;
  }

  add({ mode, position, indices, what, steps }: Primitive, matrix: Matrix): void {
    const numbers = new Map<number, number>();
    const isMirrored = determinant(matrix) < 0;
    const corner = (k: number): number => {
      const vertex = indices ? indices.get(k) : k;
      if (vertex >= position.count)
        throw this.#gltf.broken(
          {
            en: `an index of ${what} names vertex ${vertex} of ${position.count}`,
            ja: `${what} のインデックスが頂点 ${vertex} を指していますが、頂点は ${position.count} 個です`,
          },
          vertex,
        );
      return vertex;
    };
    const number = (vertex: number): number => {
      const known = numbers.get(vertex);
      if (known !== undefined) return known;
      const given = this.#positions.length / 3;
      for (const value of transformed(matrix, position.get(vertex, 0), position.get(vertex, 1), position.get(vertex, 2)))
        this.#positions.push(CENTIMETRES * value);
      numbers.set(vertex, given);
      return given;
    };
    for (let step = 0; step < steps; step += 1) {
      const isOdd = mode === STRIP && step % 2 === 1;
      const first = mode === TRIANGLES ? 3 * step : step;
      const [a, b, c] =
        mode === FAN ? [corner(step + 1), corner(step + 2), corner(0)] : [corner(first), corner(first + 1), corner(first + 2)];
      if (a === b || b === c || c === a) continue;
      const [i, j, k] = [number(a), number(b), number(c)];
      this.#indices.push(i);
      this.#indices.push(isOdd !== isMirrored ? k : j);
      this.#indices.push(isOdd !== isMirrored ? j : k);
    }
  }

  finish(): Soup {
    checkCount(this.#gltf.name, { en: 'triangles', ja: '三角形' }, this.#indices.length / 3, MOST_TRIANGLES);
    return { positions: this.#positions.values, indices: this.#indices.values };
  }
}
