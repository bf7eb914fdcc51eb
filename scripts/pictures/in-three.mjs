// In a page: a GLB with textures as three.js draws it, under the light of src/shading/shaders/daylight.wgsl as far as three has it.
import * as THREE from 'three';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';

/** As in daylight.wgsl. */
const SKY = [0.36, 0.4, 0.45];
const [LOW_SUN, HIGH_SUN] = [
  [2.8, 1.95, 1.2],
  [2.66, 2.46, 2.16],
];
/** Between the stones, as in cover.wgsl: what light the ground gives back. */
const SOILS = { soil: [0.115, 0.092, 0.069], sand: [0.4, 0.335, 0.245], gravel: [0.19, 0.174, 0.148] };
/** Vertical field of view, degrees, as in www/renderer/limits.ts. */
const FOV = 36;

/**
 * The picture, and where in it there are rocks, as addresses of PNG files.
 *
 * @param {Uint8Array} bytes of the GLB
 * @param {{ width: number, height: number, camera: any, image: [number, number], unit: number, sun: [number, number], ground: keyof typeof SOILS }} scene
 *   `sun`: azimuth and elevation, degrees; `unit`: metres in a pixel of the field; `image`: its sides
 */
export async function inThree(bytes, { width, height, camera, image, unit, sun, ground }) {
  const renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
  renderer.setSize(width, height, false);
  const scene = new THREE.Scene();
  const { scene: rocks } = await new GLTFLoader().parseAsync(bytes.slice().buffer, '');
  scene.add(rocks);
  const towards = towardsSun(sun);
  const daylight = mixed(LOW_SUN, HIGH_SUN, THREE.MathUtils.smoothstep(towards.y, 0.05, 0.75));
  const size = Math.hypot(...image) * unit;
  scene.add(sunlight(daylight, towards, size));
  const bounce = SOILS[ground].map((value, c) => value * (daylight[c] * towards.y * 0.45 + SKY[c] * 0.6));
  scene.environment = sky(renderer, bounce);
  developAsOurs(towards.y);
  renderer.toneMapping = THREE.CustomToneMapping;
  renderer.shadowMap.enabled = true;

  // Hides what is below the ground, and is no rock.
  const black = new THREE.MeshBasicMaterial({ color: 0, toneMapped: false });
  scene.add(new THREE.Mesh(new THREE.PlaneGeometry(100 * size, 100 * size).rotateX(-Math.PI / 2), black));
  const stones = [];
  rocks.traverse((/** @type {any} */ object) => {
    if (object.isMesh) stones.push(object);
  });
  for (const stone of stones) {
    stone.castShadow = stone.receiveShadow = true;
    for (const map of ['map', 'normalMap', 'aoMap', 'roughnessMap']) stone.material[map].anisotropy = 8;
  }
  const eye = eyeOf(camera, width / height, image, unit);
  renderer.render(scene, eye);
  const picture = renderer.domElement.toDataURL();
  for (const stone of stones) stone.material = new THREE.MeshBasicMaterial({ color: 0xffffff, toneMapped: false });
  renderer.render(scene, eye);
  return { picture, mask: renderer.domElement.toDataURL() };
}

const mixed = (a, b, share) => a.map((value, c) => value + (b[c] - value) * share);

/** As `sun` of look.rs; our (x, y, z) is glTF's (x, z, −y). */
function towardsSun([azimuth, elevation]) {
  const [a, e] = [THREE.MathUtils.degToRad(azimuth), THREE.MathUtils.degToRad(elevation)];
  return new THREE.Vector3(Math.sin(a) * Math.cos(e), Math.sin(e), Math.cos(a) * Math.cos(e));
}

/** Diffuse light is what we have without dividing by π; highlights are π times as bright as ours. */
function sunlight(color, towards, size) {
  const light = new THREE.DirectionalLight(new THREE.Color(...color), Math.PI);
  light.position.copy(towards).multiplyScalar(size);
  light.castShadow = true;
  light.shadow.mapSize.set(4096, 4096);
  Object.assign(light.shadow.camera, { left: -size / 2, right: size / 2, top: size / 2, bottom: -size / 2, near: 0.01, far: 2 * size });
  light.shadow.bias = -0.0005;
  light.shadow.normalBias = 0.004;
  return light;
}

/** A sky whose light on a matte surface is that of ours: from the ground's below to the sky's above, evenly with the normal's height. */
function sky(renderer, bounce) {
  const [width, height] = [64, 32];
  const texels = new Float32Array(4 * width * height);
  for (let at = 0; at < texels.length; at += 4) {
    const up = Math.sin(((Math.floor(at / 4 / width) + 0.5) / height - 0.5) * Math.PI);
    for (let c = 0; c < 3; c++) texels[at + c] = (bounce[c] + SKY[c]) / 2 + 0.75 * (SKY[c] - bounce[c]) * up;
    texels[at + 3] = 1;
  }
  const around = new THREE.DataTexture(texels, width, height, THREE.RGBAFormat, THREE.FloatType);
  around.mapping = THREE.EquirectangularReflectionMapping;
  around.magFilter = around.minFilter = THREE.LinearFilter;
  around.needsUpdate = true;
  return new THREE.PMREMGenerator(renderer).fromEquirectangular(around).texture;
}

/** The exposure and the curve of `developed` in daylight.wgsl, without the air. */
function developAsOurs(sunHeight) {
  const exposure = 0.42 / (0.42 + 0.8 * sunHeight);
  const chunks = /** @type {Record<string, string>} */ (THREE.ShaderChunk);
  chunks.tonemapping_pars_fragment = chunks.tonemapping_pars_fragment.replace(
    'vec3 CustomToneMapping( vec3 color ) { return color; }',
    `vec3 CustomToneMapping( vec3 color ) {
      vec3 x = color * ${exposure.toFixed(6)};
      return (x * (2.2 * x + 0.25)) / (x * (2.2 * x + 0.75) + 0.2);
    }`,
  );
}

function eyeOf({ azimuth, elevation, distance, target }, aspect, [width, height], unit) {
  const eye = new THREE.PerspectiveCamera(FOV, aspect, 0.01, 1000);
  const placed = (x, y, z) => new THREE.Vector3((x - width / 2) * unit, z * unit, -(y - height / 2) * unit);
  const level = distance * Math.cos(elevation);
  eye.position.copy(
    placed(target[0] + level * Math.sin(azimuth), target[1] - level * Math.cos(azimuth), target[2] + distance * Math.sin(elevation)),
  );
  eye.lookAt(placed(target[0], target[1], target[2]));
  return eye;
}
