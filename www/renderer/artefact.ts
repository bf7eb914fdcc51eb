/** The two renderer artefacts: what they export (`src/bindings/renderer.rs`, `renderer_wood.rs`, `renderer_bake.rs`), and how one is fetched and started. */

import { lazily, tellMissingFile } from '../base/lazy.ts';
import type { GpuBackend } from '../base/view.ts';

export interface RawDevice {
  maxSide(): number;
  close(): void;
  free(): void;
}

export interface RawRenderer {
  setField(
    imageWidth: number,
    imageHeight: number,
    positions: Float32Array,
    normals: Float32Array,
    indices: Uint32Array,
    vertexStarts: Uint32Array,
    indexStarts: Uint32Array,
    rockLayers: Uint32Array,
    rockSites: Uint32Array,
  ): void;
  setLog(positions: Float32Array, normals: Float32Array, indices: Uint32Array, kinds: Uint8Array, place: Float32Array): void;
  setColony(
    positions: Float32Array,
    normals: Float32Array,
    indices: Uint32Array,
    keys: Uint32Array,
    rings: number,
    meridians: number,
    place: Float32Array,
  ): void;
  clearWood(): void;
  needsWoodEdges(): boolean;
  setWoodEdges(log: Uint32Array, colony: Uint32Array): void;
  needsEdges(): boolean;
  setEdges(indices: Uint32Array): void;
  setAtlas(atlas: Float32Array): void;
  bakeTile(x: number, y: number): void;
  takeTile(): Uint8Array<ArrayBuffer> | undefined;
  needsPlan(): boolean;
  addLayer(
    id: number,
    radius: number,
    sites: Float32Array,
    cellStarts: Uint32Array,
    cellVertices: Float32Array,
    selected: Uint32Array,
  ): void;
  makePlan(): void;
  setStyle(view: number, color: number, dark: boolean): void;
  setLook(values: Float32Array, layerIds: Uint32Array, materials: Uint8Array): void;
  setQuality(level: number): void;
  setCamera(azimuth: number, elevation: number, distance: number, targetX: number, targetY: number, targetZ: number, fov: number): void;
  resize(width: number, height: number, ratio: number): void;
  setTile(width: number, height: number, x: number, y: number, backing: number): void;
  render(): void;
  beginStill(lens: number, focus: number): void;
  drawSample(pixels: number): boolean;
  showStill(): void;
  refinePicture(opacity: number): boolean;
  endStill(): void;
  makeNext(sort: number, mayDraw: boolean): boolean;
  beginPicture(width: number, height: number, isRough: boolean): void;
  lightPicture(): boolean;
  drawPiece(pixels: number): boolean;
  piecesUnderWay(): number;
  showPicture(): boolean;
  endPictures(): void;
  close(): void;
  free(): void;
}

export interface RendererModule {
  default(options: { module_or_path: Response | BufferSource }): Promise<unknown>;
  /** Behind a flag of the wasm-bindgen CLI: a new instance of the same module. */
  __wbg_reset_state(): void;
  Device: { create(canvas: HTMLCanvasElement, onLost: (reason: string) => void): Promise<RawDevice> };
  Renderer: new (device: RawDevice, canvas?: HTMLCanvasElement) => RawRenderer;
}

/** The module's name and its wasm; both stand beside each other in `pkg/` and in the built page. */
const ARTEFACTS = {
  webgpu: {
    load: () => lazily(() => import('../../pkg/renderer-webgpu.js') as Promise<unknown>, true),
    wasm: () => new URL('./renderer-webgpu_bg.wasm', import.meta.url),
  },
  webgl: {
    load: () => lazily(() => import('../../pkg/renderer-webgl.js') as Promise<unknown>, true),
    wasm: () => new URL('./renderer-webgl_bg.wasm', import.meta.url),
  },
} as const satisfies Record<GpuBackend, { load: () => Promise<unknown>; wasm: () => URL }>;

/** Filled in by the build: bytes of each wasm as they are before the server compresses them. */
declare const __WEBGPU_BYTES__: number;
declare const __WEBGL_BYTES__: number;

/** Of the wasm that is on its way, 0 … 1. */
let arrived: number | null = null;

/** How much of the renderer has arrived; null when nothing of it is on its way. */
export function rendererArrived(): number | null {
  return arrived;
}

const modules = new Map<GpuBackend, Promise<RendererModule>>();
/** Which instance of a module is the present one: the memory of one that trapped cannot be trusted, and what was made by it is stale. */
const instances = new Map<GpuBackend, number>();
const trapped = new Set<GpuBackend>();

export function markTrapped(backend: GpuBackend): void {
  trapped.add(backend);
  instances.set(backend, instanceOf(backend) + 1);
}

/** Changes when the backend's wasm traps. */
export function instanceOf(backend: GpuBackend): number {
  return instances.get(backend) ?? 0;
}

/** The module with its wasm instantiated, once per page and after every trap; a failed attempt is not remembered. */
export async function loadArtefact(backend: GpuBackend): Promise<RendererModule> {
  let loading = modules.get(backend);
  if (!loading) {
    loading = instantiate(backend);
    modules.set(backend, loading);
    loading.catch(() => modules.delete(backend));
  }
  const module = await loading;
  if (trapped.delete(backend)) {
    module.__wbg_reset_state();
    import('./stale-errors.ts').then(
      ({ ignoreStale }) => ignoreStale(),
      () => undefined,
    );
  }
  return module;
}

async function instantiate(backend: GpuBackend): Promise<RendererModule> {
  const { load, wasm } = ARTEFACTS[backend];
  const url = wasm();
  // Asked for before the code that reads it is there: it is by far the largest file.
  const stop = new AbortController();
  const response = fetch(url, { signal: stop.signal });
  response.catch(() => undefined);
  const scripts = Promise.all([load() as Promise<RendererModule>, lazily(() => import('../base/wasm-file.ts'), true)]);
  // A request that nobody reads would keep the next one for the same file waiting.
  scripts.catch(() => stop.abort());
  const [module, { startWasmFile }] = await scripts;
  arrived = 0;
  const heard = (bytes: number): void => {
    arrived = Math.min(1, bytes / (backend === 'webgpu' ? __WEBGPU_BYTES__ : __WEBGL_BYTES__));
  };
  const started = startWasmFile(url, (source) => module.default({ module_or_path: source }), { response, stop, heard });
  await started.catch(missing).finally(() => {
    arrived = null;
  });
  return module;
}

function missing(error: unknown): never {
  tellMissingFile(true);
  throw error;
}
