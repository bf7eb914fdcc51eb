/** What was generated, for scripts: a description as JSON, and all of its arrays by name. The same scene is the same to the last byte. */

import { VERSION } from '../data/version.ts';
import type { WoodEarColony } from '../data/colony.ts';
import type { Field } from '../data/field.ts';
import type { NamedArray } from './npz.ts';

/** What is told beside what was made. */
export interface Origin {
  link: string;
  preset: string;
  params: object;
  /** SHA-256 of the scene's buffers, as in files. */
  hash: string;
}

/** What there is in a field. Times are left out: they differ from run to run. */
export function fieldDescription(
  { link, hash, preset, params }: Origin,
  { layers, positions, rockLayer, stats, imageWidth, imageHeight }: Field,
): object {
  return {
    ...{ generator: 'rocks', version: VERSION, link, hash, preset, imageWidth, imageHeight },
    ...{ rocks: stats.rocks, triangles: stats.triangles, vertices: positions.length / 3, coveredFraction: stats.coveredFraction },
    layers: layers.map(({ id, radius, sites, targetSites, sitesSaturated, areaFraction, areaReached, saturated }, index) => ({
      ...{ id, radius, rocks: rockLayer.filter((layer) => layer === index).length, sites: sites.length / 2, targetSites, sitesSaturated },
      ...{ areaFraction, areaReached, saturated },
    })),
    params,
  };
}

export function colonyDescription({ link, hash, preset, params }: Origin, { positions, bases, log, stats }: WoodEarColony): object {
  const { ms: _, ...counts } = stats;
  return {
    ...{ generator: 'wood-ears', version: VERSION, link, hash, preset },
    ...{ ...counts, vertices: positions.length / 3, logVertices: log.positions.length / 3, logTriangles: log.indices.length / 3 },
    bases: Array.from({ length: bases.length / 3 }, (_base, k) => [...bases.subarray(3 * k, 3 * k + 3)]),
    params,
  };
}

/** How many numbers a row of an array has; those of no name here are lists of single numbers. */
const ROW = { positions: 3, normals: 3, indices: 3, bases: 3, sites: 2, cellVertices: 2, coords: 2 } as const;

export function fieldArrays({ layers, ...field }: Field): NamedArray[] {
  return [...arraysOf(field), ...layers.flatMap((layer, index) => arraysOf(layer, `layer${index + 1}_`))];
}

export function colonyArrays({ log, ...colony }: WoodEarColony): NamedArray[] {
  return [...arraysOf(colony), ...arraysOf(log, 'log_')];
}

function arraysOf(owner: object, prefix = ''): NamedArray[] {
  return Object.entries(owner).flatMap(([key, values]) =>
    ArrayBuffer.isView(values)
      ? [{ name: prefix + key, values: values as NamedArray['values'], row: ROW[key as keyof typeof ROW] ?? 1 }]
      : [],
  );
}
