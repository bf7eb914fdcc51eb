/** Logs of one's own from files: GLB, and OBJ. Fetched when somebody brings one. */

import { WebIO } from '@gltf-transform/core';
import { OBJLoader } from '@loaders.gl/obj';
import { RockFieldError } from './errors.ts';
import type { ErrorName } from './errors.ts';
import type { LogMesh } from './wood-ear-flat.ts';

/** What is larger is refused unread: a log of 100,000 triangles has a tenth of it as text. */
const MAX_MEGABYTES = 48;
/** A log that is shorter or longer than these has been made in other units, cm. */
const LENGTH = { min: 20, max: 1000, instead: 200 };
const TRIANGLES = 4;
const GLB = 'glTF';

export interface LogFile {
  /** cm, z up, the longest level side along x, the middle at the origin. */
  mesh: LogMesh;
  /** What was changed in it, a sentence each. */
  notices: string[];
}

/** Triangles as they stand in a file: three numbers for each vertex, y up. */
interface Soup {
  positions: Float32Array;
  indices: Uint32Array;
}

/**
 * The triangles of all meshes in a file.
 *
 * @throws {RockFieldError} `LogFileTooLarge`, `LogFileUnknown` (neither GLB nor OBJ), `LogFileUnsupported` (compressed, or of a kind that is
 *   not read), `LogFileBroken` or `LogFileNoMesh`, each with a message for people.
 */
export async function readLogFile(file: Blob & { name?: string }): Promise<LogFile> {
  const name = file.name || 'the file';
  const megabytes = file.size / 2 ** 20;
  if (megabytes > MAX_MEGABYTES) throw refused('LogFileTooLarge', `${name} has ${Math.ceil(megabytes)} MB; a log may have ${MAX_MEGABYTES}`);
  const bytes = new Uint8Array(await file.arrayBuffer());
  const soup = String.fromCharCode(...bytes.subarray(0, 4)) === GLB ? await readGlb(bytes, name) : readObj(bytes, name);
  if (soup.indices.length === 0) throw refused('LogFileNoMesh', `${name} has no triangles`);
  if (!soup.positions.every(Number.isFinite)) throw refused('LogFileBroken', `${name} has vertices that are nowhere`);
  return laidDown(merged(soup), name);
}

async function readGlb(bytes: Uint8Array<ArrayBuffer>, name: string): Promise<Soup> {
  try {
    const root = (await new WebIO().readBinary(bytes)).getRoot();
    const parts: Soup[] = [];
    const scene = root.getDefaultScene() ?? root.listScenes()[0];
    scene?.traverse((node) => {
      const matrix = node.getWorldMatrix();
      for (const primitive of node.getMesh()?.listPrimitives() ?? []) {
        const position = primitive.getAttribute('POSITION');
        if (!position || primitive.getMode() !== TRIANGLES) continue;
        const positions = new Float32Array(3 * position.getCount());
        const vertex: number[] = [];
        for (let i = 0; i < position.getCount(); i += 1) positions.set(transformed(matrix, position.getElement(i, vertex)), 3 * i);
        const given = primitive.getIndices()?.getArray();
        parts.push({ positions, indices: given ? Uint32Array.from(given) : Uint32Array.from({ length: position.getCount() }, (_, i) => i) });
      }
    });
    // glTF is in metres.
    return joined(parts, 100);
  } catch (thrown) {
    const reason = thrown instanceof Error ? thrown.message : String(thrown);
    if (/extension/i.test(reason)) throw refused('LogFileUnsupported', `${name} is compressed in a way that is not read (${reason}); save it without`, thrown);
    throw refused('LogFileBroken', `${name} is no whole GLB file (${reason})`, thrown);
  }
}

function readObj(bytes: Uint8Array, name: string): Soup {
  const text = new TextDecoder().decode(bytes);
  if (!/^[ \t]*v[ \t]/m.test(text)) throw refused('LogFileUnknown', `${name} is neither a GLB nor an OBJ file`);
  try {
    const positions = OBJLoader.parseTextSync?.(text)?.attributes['POSITION']?.value as Float32Array;
    return { positions, indices: Uint32Array.from({ length: positions.length / 3 }, (_, i) => i) };
  } catch (thrown) {
    throw refused('LogFileBroken', `${name} is no OBJ file that can be read (${thrown instanceof Error ? thrown.message : String(thrown)})`, thrown);
  }
}

/** By a matrix in columns. */
function transformed(m: readonly number[], [x = 0, y = 0, z = 0]: readonly number[]): [number, number, number] {
  const row = (k: number): number => m[k]! * x + m[k + 4]! * y + m[k + 8]! * z + m[k + 12]!;
  return [row(0), row(1), row(2)];
}

function joined(parts: readonly Soup[], scale: number): Soup {
  const vertices = parts.reduce((sum, { positions }) => sum + positions.length, 0);
  const corners = parts.reduce((sum, { indices }) => sum + indices.length, 0);
  const [positions, indices] = [new Float32Array(vertices), new Uint32Array(corners)];
  let [from, at] = [0, 0];
  for (const part of parts) {
    if (part.indices.some((index) => index >= part.positions.length / 3)) throw new Error('an index is of no vertex');
    positions.set(part.positions.map((value) => value * scale), from);
    indices.set(part.indices.map((index) => index + from / 3), at);
    from += part.positions.length;
    at += part.indices.length;
  }
  return { positions, indices };
}

/** Vertices at one place are one: on each grows a wood ear. Triangles that lose a corner so are left out. */
function merged({ positions, indices }: Soup): Soup {
  const places = new Map<string, number>();
  const kept: number[] = [];
  const numbers = Uint32Array.from({ length: positions.length / 3 }, (_, i) => {
    const place = positions.subarray(3 * i, 3 * i + 3);
    const key = place.join();
    let number = places.get(key);
    if (number === undefined) {
      number = places.size;
      places.set(key, number);
      kept.push(...place);
    }
    return number;
  });
  const corners: number[] = [];
  for (let i = 0; i + 2 < indices.length; i += 3) {
    const [a, b, c] = [numbers[indices[i]!]!, numbers[indices[i + 1]!]!, numbers[indices[i + 2]!]!];
    if (a !== b && b !== c && c !== a) corners.push(a, b, c);
  }
  return { positions: Float32Array.from(kept), indices: Uint32Array.from(corners) };
}

/** Up is z, and the log lies along x. */
function laidDown({ positions: given, indices }: Soup, name: string): LogFile {
  const notices: string[] = [];
  const [low, high] = box(given);
  const sides = high.map((value, k) => value - low[k]!);
  const isAlongX = sides[0]! >= sides[2]!;
  const length = Math.max(sides[0]!, sides[2]!);
  if (length === 0) throw refused('LogFileNoMesh', `${name} has no length`);
  const isOdd = length < LENGTH.min || length > LENGTH.max;
  const scale = isOdd ? LENGTH.instead / length : 1;
  if (isOdd) notices.push(`${name} is ${Number(length.toPrecision(3))} cm long; it is shown ${LENGTH.instead} cm long`);
  const positions = new Float32Array(given.length);
  for (let i = 0; i < given.length; i += 3) {
    const [x, y, z] = [0, 1, 2].map((k) => (given[i + k]! - (low[k]! + high[k]!) / 2) * scale) as [number, number, number];
    positions.set(isAlongX ? [x, -z, y] : [z, x, y], i);
  }
  return { mesh: { positions, indices }, notices };
}

function box(positions: Float32Array): [number[], number[]] {
  const [low, high] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
  positions.forEach((value, i) => {
    low[i % 3] = Math.min(low[i % 3]!, value);
    high[i % 3] = Math.max(high[i % 3]!, value);
  });
  return [low, high];
}

function refused(name: ErrorName, message: string, cause?: unknown): RockFieldError {
  return new RockFieldError({ name, key: 'log', message }, { cause });
}
