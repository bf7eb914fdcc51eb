import { FreeCamera } from '@babylonjs/core/Cameras/freeCamera';
import { Engine } from '@babylonjs/core/Engines/engine';
import { DirectionalLight } from '@babylonjs/core/Lights/directionalLight';
import { HemisphericLight } from '@babylonjs/core/Lights/hemisphericLight';
import { Color4 } from '@babylonjs/core/Maths/math.color';
import { PBRMaterial } from '@babylonjs/core/Materials/PBR/pbrMaterial';
import { CreateBox } from '@babylonjs/core/Meshes/Builders/boxBuilder';
import { Vector3 } from '@babylonjs/core/Maths/math.vector';
import { Scene } from '@babylonjs/core/scene';
import type { AssetContainer } from '@babylonjs/core/assetContainer';
import type { AbstractMesh } from '@babylonjs/core/Meshes/abstractMesh';
import { recipe } from './recipes/babylon.js';
import { recipe as levels } from './recipes/babylon-levels.js';
import { SIZE } from './report';
import type { Report } from './report';

export async function look(): Promise<Report> {
  const canvas = Object.assign(document.createElement('canvas'), SIZE);
  document.body.append(canvas);
  const engine = new Engine(canvas, true, { preserveDrawingBuffer: true });
  const scene = new Scene(engine);
  scene.clearColor = new Color4(0.53, 0.6, 0.67, 1);
  const camera = new FreeCamera('eye', new Vector3(0, 0.9, -1.1), scene);
  camera.minZ = 0.01;
  camera.fov = 0.7;
  new HemisphericLight('sky', new Vector3(0, 1, 0), scene).intensity = 0.7;
  new DirectionalLight('sun', new Vector3(-1, -1.4, 0.4), scene).intensity = 2.5;
  const draw = async (distance: number, height: number): Promise<string> => {
    camera.position.set(0, height * distance, -1.1 * distance);
    camera.setTarget(Vector3.Zero());
    await scene.whenReadyAsync();
    scene.render();
    return canvas.toDataURL();
  };
  const held = (): number[] => [
    scene.meshes.length,
    scene.geometries.length,
    scene.materials.length,
    engine.getLoadedTexturesCache().length,
  ];
  // What engine and materials of this kind fetch once is there before the rocks are.
  const other = CreateBox('other', { size: 0.1 }, scene);
  other.material = new PBRMaterial('other', scene);
  await draw(1, 0.9);
  other.dispose(false, true);
  const before = held();
  const { rocks } = (await recipe({ scene })) as { rocks: AssetContainer };
  levels({ rocks });
  const above = await draw(1, 0.9);
  const near = scene.getActiveIndices() / 3;
  const { min, max } = boundsOf(rocks.meshes);
  await draw(25, 0.9);
  const far = scene.getActiveIndices() / 3;
  const below = await draw(1, -0.9);
  const during = held();
  rocks.dispose();
  await draw(1, 0.9);
  const after = held();
  engine.dispose();
  return { min, max, triangles: { near, far }, held: { before, with: during, after }, pictures: { above, below } };
}

function boundsOf(meshes: readonly AbstractMesh[]): { min: number[]; max: number[] } {
  const boxes = meshes.filter((mesh) => mesh.getTotalVertices() > 0).map((mesh) => mesh.getBoundingInfo().boundingBox);
  const corner = (of: (one: Vector3, other: Vector3) => Vector3, side: 'minimumWorld' | 'maximumWorld'): number[] =>
    boxes
      .map((box) => box[side])
      .reduce(of)
      .asArray();
  return { min: corner(Vector3.Minimize, 'minimumWorld'), max: corner(Vector3.Maximize, 'maximumWorld') };
}
