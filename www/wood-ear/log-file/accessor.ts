/**
 * Numbers of a glTF file, read where they stand: an accessor is a list of scalars or vectors in a view of a buffer, perhaps with some of them replaced.
 *
 * What an accessor promises is compared with what the file holds before anything is read; nothing is allocated by a number of the file.
 */

import type { MeshoptDecoder } from 'meshoptimizer/decoder';
import type { Gltf, Item } from './gltf-json.ts';
import { MOST_BYTES, MOST_LISTED } from './limits.ts';
import { checkCount } from './mesh.ts';

type Decoder = typeof MeshoptDecoder;

/** The same coding under two names. */
const MESHOPT = ['KHR_meshopt_compression', 'EXT_meshopt_compression'];

interface Component {
  bytes: number;
  /** What a normalized value is divided by. */
  full: number;
  get: (view: DataView, at: number) => number;
}

const COMPONENTS: Readonly<Record<number, Component>> = {
  5120: { bytes: 1, full: 127, get: (view, at) => view.getInt8(at) },
  5121: { bytes: 1, full: 255, get: (view, at) => view.getUint8(at) },
  5122: { bytes: 2, full: 32_767, get: (view, at) => view.getInt16(at, true) },
  5123: { bytes: 2, full: 65_535, get: (view, at) => view.getUint16(at, true) },
  5125: { bytes: 4, full: 0xffff_ffff, get: (view, at) => view.getUint32(at, true) },
  5126: { bytes: 4, full: 1, get: (view, at) => view.getFloat32(at, true) },
};
const WIDTHS: Readonly<Record<string, number>> = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4 };

interface View {
  bytes: Uint8Array;
  /** Bytes from one vector to the next; 0: they are packed. */
  stride: number;
}

export interface Accessor {
  count: number;
  /** A component of a vector; 0 where there are no bytes. */
  get(index: number, component?: number): number;
}

export class Accessors {
  readonly #gltf: Gltf;
  readonly #decoder: Decoder | undefined;
  readonly #views = new Map<number, View>();
  readonly #accessors = new Map<number, Accessor>();

  /** `decoder`: needed where `isPacked` says so. */
  constructor(gltf: Gltf, decoder: Decoder | undefined) {
    this.#gltf = gltf;
    this.#decoder = decoder;
  }

  /** The accessor of this number, of `width` components in one of `types`. */
  get(index: unknown, width: number, types: readonly number[]): Accessor {
    const gltf = this.#gltf;
    const item = gltf.item('accessors', index);
    const number = index as number;
    const what = `accessors[${number}]`;
    const type = gltf.whole(item, 'componentType', what);
    if (WIDTHS[String(item['type'])] !== width || !types.includes(type))
      throw gltf.broken({ en: `${what} is of a type that does not fit its use`, ja: `${what} の型が用途に合いません` }, item['type']);
    const accessor = this.#accessors.get(number) ?? this.#made(item, what, width, type);
    this.#accessors.set(number, accessor);
    return accessor;
  }

  #made(item: Item, what: string, width: number, type: number): Accessor {
    const gltf = this.#gltf;
    const component = COMPONENTS[type] as Component;
    const count = gltf.whole(item, 'count', what);
    const read =
      item['bufferView'] === undefined ? undefined : this.#reader(item, what, count, width, component, this.#view(item['bufferView']));
    // These take no room in the file, so nothing else bounds them.
    if (!read) checkCount(gltf.name, { en: 'vertices', ja: '頂点' }, count, MOST_LISTED);
    const replaced = this.#sparse(item, what, count, width, component);
    const plain = (index: number, k: number): number => {
      const other = replaced?.(index, k);
      return other ?? read?.(index, k) ?? 0;
    };
    if (item['normalized'] !== true || type === 5126) return { count, get: (index, k = 0) => plain(index, k) };
    return { count, get: (index, k = 0) => Math.max(-1, plain(index, k) / component.full) };
  }

  #reader(
    place: Item,
    what: string,
    count: number,
    width: number,
    component: Component,
    { bytes, stride: given }: View,
  ): (index: number, k: number) => number {
    const start = this.#gltf.whole(place, 'byteOffset', what, 0);
    const size = width * component.bytes;
    const stride = given || size;
    const end = count === 0 ? 0 : start + stride * (count - 1) + size;
    if (stride < size || end > bytes.length)
      throw this.#gltf.broken(
        {
          en: `${what} has ${count} elements, for which its buffer view is too short`,
          ja: `${what} の要素は ${count} 個ですが、バッファービューが足りません`,
        },
        count,
      );
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
    return (index, k) => component.get(view, start + stride * index + component.bytes * k);
  }

  /** The elements that are replaced; each reading gives nothing for the others. */
  #sparse(
    item: Item,
    what: string,
    count: number,
    width: number,
    component: Component,
  ): ((index: number, k: number) => number | undefined) | undefined {
    const gltf = this.#gltf;
    if (item['sparse'] === undefined) return undefined;
    const sparse = gltf.object(item['sparse'], `${what}.sparse`);
    const number = gltf.whole(sparse, 'count', `${what}.sparse`);
    const [indices, values] = ['indices', 'values'].map((key) => gltf.object(sparse[key], `sparse ${key} of ${what}`)) as [Item, Item];
    const type = gltf.whole(indices, 'componentType', `${what}.sparse.indices`);
    const ofIndex = [5121, 5123, 5125].includes(type) ? COMPONENTS[type] : undefined;
    if (!ofIndex)
      throw gltf.broken(
        {
          en: `sparse indices of ${what} are of a type that does not fit their use`,
          ja: `${what} の疎なインデックスの型が用途に合いません`,
        },
        type,
      );
    const at = this.#reader(indices, `${what}.sparse.indices`, number, 1, ofIndex, this.#view(indices['bufferView']));
    const value = this.#reader(values, `${what}.sparse.values`, number, width, component, this.#view(values['bufferView']));
    const places = new Map<number, number>();
    for (let k = 0; k < number; k += 1) {
      const index = at(k, 0);
      if (index >= count)
        throw gltf.broken(
          {
            en: `sparse indices of ${what} name element ${index} of ${count}`,
            ja: `${what} の疎なインデックスが要素 ${index} を指していますが、要素は ${count} 個です`,
          },
          index,
        );
      places.set(index, k);
    }
    return (index, k) => {
      const place = places.get(index);
      return place === undefined ? undefined : value(place, k);
    };
  }

  #view(index: unknown): View {
    const item = this.#gltf.item('bufferViews', index);
    const number = index as number;
    const view = this.#views.get(number) ?? this.#opened(item, `bufferViews[${number}]`);
    this.#views.set(number, view);
    return view;
  }

  #opened(item: Item, what: string): View {
    const gltf = this.#gltf;
    const packed = packing(gltf, item, what);
    if (packed) return this.#unpacked(packed, what);
    const stranger = Object.keys((item['extensions'] ?? {}) as object).find((name) => gltf.isRequired(name));
    if (stranger !== undefined)
      throw gltf.unsupported({
        en: `its geometry needs the extension ${stranger}; save it without`,
        ja: `形状に拡張機能 ${stranger} が必要です。使わずに保存してください`,
      });
    return { bytes: this.#piece(item, what), stride: gltf.whole(item, 'byteStride', what, 0) };
  }

  #unpacked(packed: Item, view: string): View {
    const gltf = this.#gltf;
    const what = `the packed ${view}`;
    const [count, stride] = [gltf.whole(packed, 'count', what), gltf.whole(packed, 'byteStride', what)];
    if (count * stride > MOST_BYTES) throw gltf.tooLarge(view, count * stride);
    const bytes = new Uint8Array(count * stride);
    const source = this.#piece(packed, what);
    try {
      this.#decoder?.decodeGltfBuffer(
        bytes,
        count,
        stride,
        source,
        String(packed['mode']),
        packed['filter'] === undefined ? undefined : String(packed['filter']),
      );
    } catch {
      throw gltf.broken({ en: `${what} cannot be unpacked`, ja: `${what} を展開できません` });
    }
    return { bytes, stride };
  }

  #piece(item: Item, what: string): Uint8Array {
    const gltf = this.#gltf;
    const buffer = gltf.buffer(item['buffer']);
    const [start, length] = [gltf.whole(item, 'byteOffset', what, 0), gltf.whole(item, 'byteLength', what)];
    if (start + length > buffer.length)
      throw gltf.broken(
        {
          en: `${what} ends at byte ${start + length} of the ${buffer.length} of its buffer`,
          ja: `${what} はバッファー（${buffer.length} バイト）の ${start + length} バイト目まで必要です`,
        },
        start + length,
      );
    return buffer.subarray(start, start + length);
  }
}

/** Whether a decoder is needed. */
export function isPacked(gltf: Gltf): boolean {
  for (let index = 0; index < gltf.count('bufferViews'); index += 1) {
    if (packing(gltf, gltf.item('bufferViews', index), `bufferViews[${index}]`)) return true;
  }
  return false;
}

function packing(gltf: Gltf, item: Item, what: string): Item | undefined {
  for (const name of MESHOPT) {
    const packed = gltf.extension(item, name, what);
    if (packed) return packed;
  }
  return undefined;
}
