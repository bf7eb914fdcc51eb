/** The ground around rocks as a mesh, for files: the wasm artefact `ground-mesh` triangulates it. */

import { errorInfo, RockFieldError } from '../base/errors.ts';
import type { Field } from '../data/field.ts';
import { GROUND_KINDS, SOIL } from '../data/palette.gen.ts';
import { joined } from '../export/shapes/join.ts';
import type { Material, Model } from '../export/model.ts';
import { isMap } from '../export/options.ts';
import type { ResolvedOptions } from '../export/options.ts';
import type { Realm } from '../generator/headless.ts';
import { linearColor } from './linear.ts';
import type { Params } from './params.ts';

/** src/bindings/ground_mesh.rs. */
interface GroundMesh {
  add(positions: Float32Array, indices: Uint32Array, vertexStarts: Uint32Array, rockStarts: Uint32Array): void;
  make(cut: boolean): void;
  positions(): Float32Array;
  indices(): Uint32Array;
  free(): void;
}

export interface GroundModule {
  GroundMesh: new (width: number, height: number) => GroundMesh;
}

/** Where the artefact comes from. It is fetched when a ground is first asked for. */
export type GroundRealm = Realm<GroundModule>;

/** Rocks that are copied to wasm at once: what is needed of them is far less. */
const ROCKS_AT_ONCE = 4096;

/**
 * The rocks with the ground around them, if the options ask for it: one thing more, called `ground`.
 *
 * @param model of `rocksModel`.
 * @throws {RockFieldError} `WasmUnavailable`, `ScriptUnavailable`; `Internal`.
 */
export async function withGround(
  model: Model,
  field: Field,
  { ground }: Params,
  options: ResolvedOptions,
  isNatural: boolean,
  realm: GroundRealm,
): Promise<Model> {
  if (options.groundMesh === 'none' || options.mesh === 'points' || isMap(options)) return model;
  const module = await realm.load();
  const instance = realm.soundInstance();
  let sheet: Sheet;
  try {
    sheet = sheetOf(module, field, options.groundMesh === 'cut');
  } catch (thrown) {
    realm.trap(instance);
    throw new RockFieldError({ ...errorInfo(thrown), message: 'the ground could not be triangulated' }, { cause: thrown });
  }
  const material: Material = isNatural
    ? { name: ground, color: GROUND_KINDS.find(({ name }) => name === ground)!.albedo }
    : { name: 'ground', color: linearColor(SOIL) };
  return joined(model, groundModel(sheet, model, material, field), [0, 0, 0]);
}

interface Sheet {
  /** x and y of each vertex. */
  plane: Float32Array;
  indices: Uint32Array;
}

function sheetOf({ GroundMesh }: GroundModule, field: Field, cut: boolean): Sheet {
  const { positions, indices, vertexStarts, rockStarts, rockLayer, imageWidth, imageHeight } = field;
  const mesh = new GroundMesh(imageWidth, imageHeight);
  for (let from = 0; from < rockLayer.length; from += ROCKS_AT_ONCE) {
    const to = Math.min(from + ROCKS_AT_ONCE, rockLayer.length);
    mesh.add(
      positions.subarray(3 * vertexStarts[from]!, 3 * vertexStarts[to]!),
      indices.subarray(rockStarts[from], rockStarts[to]),
      vertexStarts.subarray(from, to + 1),
      rockStarts.subarray(from, to + 1),
    );
  }
  mesh.make(cut);
  const sheet = { plane: mesh.positions(), indices: mesh.indices() };
  mesh.free();
  return sheet;
}

/** One body, which is one thing; all of its normals point up. */
function groundModel({ plane, indices }: Sheet, { unit, centre }: Model, material: Material, { imageWidth, imageHeight }: Field): Model {
  const vertices = plane.length / 2;
  const positions = new Float32Array(3 * vertices);
  const normals = new Float32Array(3 * vertices);
  for (let v = 0; v < vertices; v++) {
    positions[3 * v] = plane[2 * v]!;
    positions[3 * v + 1] = plane[2 * v + 1]!;
    normals[3 * v + 2] = 1;
  }
  let twiceArea = 0;
  for (let i = 0; i < indices.length; i += 3) {
    const [a, b, c] = [2 * indices[i]!, 2 * indices[i + 1]!, 2 * indices[i + 2]!];
    const [x, y] = [plane[a]!, plane[a + 1]!];
    twiceArea += (plane[b]! - x) * (plane[c + 1]! - y) - (plane[b + 1]! - y) * (plane[c]! - x);
  }
  const extras = {
    material: material.name,
    area: rounded((unit * unit * twiceArea) / 2),
    size: [rounded(unit * imageWidth), 0, rounded(unit * imageHeight)],
  };
  // Rocks may lie all over it.
  const bodies = indices.length > 0 ? 1 : 0;
  return {
    unit,
    positions,
    normals,
    indices,
    indexStarts: Uint32Array.of(0, indices.length).subarray(0, bodies + 1),
    vertexStarts: Uint32Array.of(0, vertices).subarray(0, bodies + 1),
    groupOf: new Uint8Array(bodies),
    groups: [{ name: 'ground', extras }],
    materialOf: new Uint8Array(bodies),
    materials: [material],
    origins: Float64Array.from(centre).subarray(0, 3 * bodies),
    centre,
  };
}

/** Four digits, as what is measured of rocks. */
function rounded(value: number): number {
  return Number(value.toPrecision(4));
}
