import { Canvas, useThree } from '@react-three/fiber';
import type { RootState } from '@react-three/fiber';
import { StrictMode } from 'react';
import { createRoot } from 'react-dom/client';
import * as THREE from 'three';
import { Rocks } from './recipes/rocks.jsx';
import { SIZE, trianglesOf } from './report';
import type { Report } from './report';

const HIGH = [0, 0.9, 1.1] as const;

export async function look(): Promise<Report> {
  const element = document.createElement('div');
  Object.assign(element.style, { width: `${SIZE.width}px`, height: `${SIZE.height}px` });
  document.body.append(element);
  const root = createRoot(element);
  let state: RootState | undefined;
  const Peek = (): null => {
    state = useThree();
    return null;
  };
  const show = (hasRocks: boolean): void =>
    root.render(
      <StrictMode>
        <Canvas shadows frameloop="demand" dpr={1} camera={{ position: [...HIGH], fov: 40 }} gl={{ preserveDrawingBuffer: true }}>
          <color attach="background" args={[0x8899aa]} />
          <hemisphereLight args={[0xbbccff, 0x665544, 1.2]} />
          <directionalLight position={[1, 1.4, 0.4]} intensity={3} />
          {!hasRocks && (
            <mesh>
              <boxGeometry args={[0.1, 0.1, 0.1]} />
              <meshStandardMaterial />
            </mesh>
          )}
          {hasRocks && <Rocks preset="riverbed" mesh="rocks" groundMesh="whole" seed={7} imageWidth={160} imageHeight={120} />}
          <Peek />
        </Canvas>
      </StrictMode>,
    );
  show(false);
  await until(() => state !== undefined);
  const { gl, scene, camera } = state as unknown as RootState;
  const draw = (x: number, y: number, z: number): string => {
    camera.position.set(x, y, z);
    camera.lookAt(0, 0, 0);
    gl.render(scene, camera);
    return gl.domElement.toDataURL();
  };
  const held = (): number[] => [gl.info.memory.geometries, gl.info.memory.textures, gl.info.programs?.length ?? 0];
  const isBox = (child: THREE.Object3D): boolean => (child as THREE.Mesh).isMesh;
  // Where there are no rocks there is a box, so that what three.js fetches for the first material is there already.
  await until(() => scene.children.some(isBox));
  draw(0, 5, 5);
  const before = held();
  show(true);
  const group = (): THREE.Object3D | undefined => scene.getObjectByName('rock-field');
  await until(() => (group()?.children.length ?? 0) > 0);
  const above = draw(...HIGH);
  draw(0, 0.15, 0.2);
  const near = trianglesOf(group() as THREE.Object3D);
  const box = new THREE.Box3().setFromObject(group() as THREE.Object3D);
  draw(0, 18, 22);
  const far = trianglesOf(group() as THREE.Object3D);
  const below = draw(0, -0.9, 1.1);
  const during = held();
  show(false);
  await until(() => group() === undefined && scene.children.some(isBox));
  draw(0, 5, 5);
  const after = held();
  root.unmount();
  return {
    min: box.min.toArray(),
    max: box.max.toArray(),
    triangles: { near, far },
    held: { before, with: during, after },
    pictures: { above, below },
  };
}

async function until(condition: () => boolean): Promise<void> {
  while (!condition()) await new Promise((resolve) => setTimeout(resolve, 20));
}
