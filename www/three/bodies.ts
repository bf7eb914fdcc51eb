/** Rocks that are placed one by one, as a `BatchedMesh` whose rocks change their level of detail by themselves. */

import * as three from 'three';
import type { BatchedMesh, Camera, Material, WebGLRenderer } from 'three';
import type { SceneBodies, SceneParts } from '../export/scene.ts';
import type { Pace } from '../export/pace.ts';
import { geometryOf } from './geometry.ts';
import { levelFor, limitOf } from './levels.ts';

/** @throws the reason of the signal when it was aborted; nothing is left then. */
export async function batchOf(parts: SceneParts, bodies: SceneBodies, material: Material, pace: Pace): Promise<BatchedMesh> {
  const { places, shapes, matrices, materialOf, levels } = bodies;
  let [vertices, indices] = [0, 0];
  for (const place of places) {
    vertices += place.vertices;
    indices += place.indices;
  }
  const batch = new three.BatchedMesh(shapes.length, vertices, indices, material);
  try {
    batch.name = 'rocks';
    // Rocks hardly hide each other, so that it does not pay to sort them.
    batch.sortObjects = false;
    for (const [at, place] of places.entries()) {
      batch.addGeometry(geometryOf(parts, [place]));
      if (pace.isDue()) await pace.rest(at / (places.length + shapes.length));
    }
    const [matrix, color] = [new three.Matrix4(), new three.Color()];
    for (const [k, shape] of shapes.entries()) {
      batch.addInstance(shape * levels);
      batch.setMatrixAt(k, matrix.fromArray(matrices, 16 * k));
      batch.setColorAt(k, color.setRGB(...parts.materials[materialOf[k]!]!.color));
      if (pace.isDue()) await pace.rest((places.length + k) / (places.length + shapes.length));
    }
    batch.computeBoundingBox();
    batch.computeBoundingSphere();
  } catch (thrown) {
    batch.dispose();
    throw thrown;
  }
  if (levels > 1) changeLevels(batch, bodies);
  return batch;
}

/** Chooses the levels before each frame. Shadows are those of the levels that are seen. */
function changeLevels(batch: BatchedMesh, { levels, shapes, places }: SceneBodies): void {
  const limits = Array.from({ length: places.length / levels }, (_, shape) =>
    places.slice(shape * levels, (shape + 1) * levels).map(({ indices }) => limitOf(indices / 3)),
  );
  const spheres = new Float32Array(4 * shapes.length);
  const [sphere, matrix, eye, size] = [new three.Sphere(), new three.Matrix4(), new three.Vector3(), new three.Vector2()];
  const measure = (k: number): void => {
    batch.getBoundingSphereAt(shapes[k]! * levels, sphere);
    sphere.applyMatrix4(batch.getMatrixAt(k, matrix));
    sphere.center.toArray(spheres, 4 * k);
    spheres[4 * k + 3] = sphere.radius;
  };
  for (let k = 0; k < shapes.length; k++) measure(k);
  const present = new Uint8Array(shapes.length);
  const choose = (renderer: WebGLRenderer, camera: Camera): void => {
    const height = renderer.getRenderTarget()?.height ?? renderer.getDrawingBufferSize(size).height;
    const projection = camera.projectionMatrix.elements;
    const scale = batch.matrixWorld.getMaxScaleOnAxis();
    // Measured in the axes of the rocks, where distances and sizes shrink alike.
    eye.setFromMatrixPosition(camera.matrixWorld).applyMatrix4(matrix.copy(batch.matrixWorld).invert());
    const isFlat = projection[15] === 1;
    for (let k = 0; k < shapes.length; k++) {
      const radius = spheres[4 * k + 3]!;
      const x = spheres[4 * k]! - eye.x;
      const y = spheres[4 * k + 1]! - eye.y;
      const z = spheres[4 * k + 2]! - eye.z;
      const distance = isFlat ? 1 / scale : Math.sqrt(x * x + y * y + z * z);
      const level = levelFor((radius * projection[5]! * height) / distance, present[k]!, limits[shapes[k]!]!);
      if (level === present[k]) continue;
      present[k] = level;
      batch.setGeometryIdAt(k, shapes[k]! * levels + level);
    }
  };
  /** With WebGPU shadows are drawn by the same call as everything else. */
  const lights = new WeakSet<Camera>();
  const { onBeforeRender, onBeforeShadow } = batch;
  batch.onBeforeShadow = (renderer, scene, camera, shadowCamera, ...rest) => {
    lights.add(shadowCamera);
    onBeforeShadow.call(batch, renderer, scene, camera, shadowCamera, ...rest);
  };
  batch.onBeforeRender = (renderer, scene, camera, ...rest) => {
    if (!lights.has(camera)) choose(renderer, camera);
    onBeforeRender.call(batch, renderer, scene, camera, ...rest);
  };
  const { setMatrixAt } = batch;
  batch.setMatrixAt = (k, to) => {
    setMatrixAt.call(batch, k, to);
    measure(k);
    return batch;
  };
}
