// Files of logs for tests, and what is asked of the meshes in them.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import type { RockFieldError } from '../../www/base/errors.ts';
import { readLogFile } from '../../www/wood-ear/log-file/read.ts';
import type { LogMesh } from '../../www/wood-ear/log-mesh.ts';

/** A file of tests/data/logs. */
export const stored = (name: string) => new File([readFileSync(new URL(`../data/logs/${name}`, import.meta.url))], name);
export const given = (name: string, ...parts: BlobPart[]) => new File(parts, name);
export const meshOf = async (file: File): Promise<LogMesh> => (await readLogFile(file)).mesh;

export const QUAD = 'v 0 0 0\nv 100 0 0\nv 100 30 10\nv 0 30 10\n';

export function sides({ positions }: LogMesh): number[] {
  return [0, 1, 2].map((k) => {
    const axis = [...positions].filter((_, i) => i % 3 === k);
    return Math.max(...axis) - Math.min(...axis);
  });
}

/** Triangles as places, however vertices are numbered and wherever a triangle begins. */
export function triangles({ positions, indices }: LogMesh): string[] {
  const place = (vertex: number) =>
    [...positions.subarray(3 * vertex, 3 * vertex + 3)].map((value) => value.toFixed(2).replace(/^-0\.00$/, '0.00')).join(' ');
  const all: string[] = [];
  for (let i = 0; i < indices.length; i += 3) {
    const corners = [0, 1, 2].map((k) => place(indices[i + k]!));
    const first = corners.indexOf([...corners].sort()[0]!);
    all.push([...corners.slice(first), ...corners.slice(0, first)].join(', '));
  }
  return all.sort();
}

export const refusal = async (file: File): Promise<RockFieldError> =>
  readLogFile(file).then(
    () => assert.fail(`${file.name} was read`),
    (thrown: unknown) => thrown as RockFieldError,
  );

// The stored files.
