import * as THREE from 'three';
import { WebGPURenderer } from 'three/webgpu';
import type { RockField } from 'rock-field/three';
import { recipe } from './recipes/three.js';
import { SIZE, trianglesOf } from './report';
import type { Report } from './report';

type Renderer = THREE.WebGLRenderer | WebGPURenderer;

export async function look(kind: 'webgl' | 'webgpu'): Promise<Report> {
  const renderer = await opened(kind);
  const scene = new THREE.Scene();
  scene.background = new THREE.Color(0x8899aa);
  scene.add(new THREE.HemisphereLight(0xbbccff, 0x665544, 1.2), sun());
  const stand = (distance: number, height: number): THREE.PerspectiveCamera => {
    const camera = new THREE.PerspectiveCamera(40, SIZE.width / SIZE.height, 0.01, 1000);
    camera.position.set(0, height * distance, 0.75 * distance);
    camera.lookAt(0, 0, 0);
    return camera;
  };
  // Something else of the same kind has been drawn and freed before, so that what stays with the renderer is there already.
  const other = new THREE.Mesh(new THREE.BoxGeometry(0.1, 0.1, 0.1), new THREE.MeshStandardMaterial());
  other.castShadow = other.receiveShadow = true;
  scene.add(other);
  draw(renderer, scene, stand(1.5, 0.6));
  const before = held(renderer);

  const { rocks } = (await recipe({ scene })) as { rocks: RockField };
  scene.remove(other);
  const above = await draw(renderer, scene, stand(1.5, 0.6));
  await draw(renderer, scene, stand(0.3, 0.6));
  const near = trianglesOf(rocks.group);
  const box = new THREE.Box3().setFromObject(rocks.group);
  const ray = new THREE.Raycaster(new THREE.Vector3(0, 5, 0), new THREE.Vector3(0, -1, 0));
  const rock = ray.intersectObject(rocks.group).map((hit) => rocks.rockOf(hit))[0];
  await draw(renderer, scene, stand(30, 0.6));
  const far = trianglesOf(rocks.group);
  const below = await draw(renderer, scene, stand(1.5, -0.6));
  const during = held(renderer);

  const build = rocks.setSeed(8).build();
  rocks.dispose();
  const aborted = await build.then(
    () => 'built',
    (error: Error) => error.name,
  );
  scene.add(other);
  await draw(renderer, scene, stand(1.5, 0.6));
  const after = held(renderer);
  renderer.dispose();
  return {
    min: box.min.toArray(),
    max: box.max.toArray(),
    triangles: { near, far },
    held: { before, with: during, after },
    pictures: { above, below },
    aborted,
    rock,
  };
}

async function opened(kind: 'webgl' | 'webgpu'): Promise<Renderer> {
  const renderer = kind === 'webgl' ? new THREE.WebGLRenderer({ preserveDrawingBuffer: true }) : new WebGPURenderer();
  renderer.setSize(SIZE.width, SIZE.height, false);
  renderer.shadowMap.enabled = true;
  document.body.append(renderer.domElement);
  if (renderer instanceof WebGPURenderer) {
    await renderer.init();
    if ((renderer.backend as { isWebGPUBackend?: boolean }).isWebGPUBackend !== true) throw new Error('there is no WebGPU');
  }
  return renderer;
}

function sun(): THREE.DirectionalLight {
  const light = new THREE.DirectionalLight(0xfff0dd, 3);
  light.position.set(1, 1.4, 0.4);
  light.castShadow = true;
  light.shadow.mapSize.set(512, 512);
  light.shadow.normalBias = 0.005;
  Object.assign(light.shadow.camera, { left: -1, right: 1, top: 1, bottom: -1, near: 0.1, far: 4 });
  return light;
}

async function draw(renderer: Renderer, scene: THREE.Scene, camera: THREE.Camera): Promise<string> {
  renderer.info.reset();
  renderer.render(scene, camera);
  return renderer.domElement.toDataURL();
}

/** Geometries, textures and programs. Those that draw shadows belong to the renderer, which keeps them. */
function held({ info }: Renderer): number[] {
  const programs = (info as { programs?: { type: string }[] | null }).programs ?? [];
  return [info.memory.geometries, info.memory.textures, programs.filter(({ type }) => type !== 'MeshDepthMaterial').length];
}
