/** The two renderer artefacts: what they export (`src/bindings/renderer.rs`, `renderer_wood.rs`), and how one is fetched and started. */

import { lazily, tellMissingFile } from '../lazy.ts';
import type { GpuBackend } from './device.ts';

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
    rockLayers: Uint32Array,
    rockSites: Uint32Array,
  ): void;
  setLog(
    positions: Float32Array,
    normals: Float32Array,
    indices: Uint32Array,
    kinds: Uint8Array,
    place: Float32Array,
  ): void;
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
  setCamera(
    azimuth: number,
    elevation: number,
    distance: number,
    targetX: number,
    targetY: number,
    targetZ: number,
  ): void;
  resize(width: number, height: number, ratio: number): void;
  render(): void;
  close(): void;
  free(): void;
}

export interface RendererModule {
  default(options: { module_or_path: Response | BufferSource }): Promise<unknown>;
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

const modules = new Map<GpuBackend, Promise<RendererModule>>();
/** Instances that trapped, and how: their memory cannot be trusted and a module has only one. */
const trapped = new Map<GpuBackend, string>();

export function markTrapped(backend: GpuBackend, { message }: Error): void {
  trapped.set(backend, message);
}

/** The module with its wasm instantiated, once per page; a failed attempt is not remembered. */
export function loadArtefact(backend: GpuBackend): Promise<RendererModule> {
  if (trapped.has(backend)) {
    return Promise.reject(new Error(`its wasm stopped earlier on this page (${trapped.get(backend)}); reload to try again`));
  }
  let module = modules.get(backend);
  if (!module) {
    module = instantiate(backend);
    modules.set(backend, module);
    module.catch(() => modules.delete(backend));
  }
  return module;
}

/** Scripts of some kB that have not come after so long do not come. */
const SCRIPT_MS = 30_000;

async function instantiate(backend: GpuBackend): Promise<RendererModule> {
  const { load, wasm } = ARTEFACTS[backend];
  const url = wasm();
  // Asked for before the code that reads it is there: it is by far the largest file.
  const stop = new AbortController();
  const response = fetch(url, { signal: stop.signal });
  response.catch(() => undefined);
  const [module, { startWasmFile }] = await Promise.race([Promise.all([load() as Promise<RendererModule>, lazily(() => import('../wasm-file.ts'), true)]), late()]);
  await startWasmFile(url, (source) => module.default({ module_or_path: source }), { response, stop }).catch(missing);
  return module;
}

function missing(error: unknown): never {
  tellMissingFile(true);
  throw error;
}

function late(): Promise<never> {
  return new Promise((_, reject) => setTimeout(() => reject(new Error('its script does not arrive; check the connection')), SCRIPT_MS));
}
