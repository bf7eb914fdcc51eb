/**
 * Finds the best backend that really works and loads exactly one renderer for it.
 *
 * A canvas keeps the first kind of context it was asked for, so every attempt gets its own, and WebGPU
 * is believed only once a device was obtained.
 */

import { Canvas2dRenderer } from './canvas2d.ts';
import { GpuRenderer, type RendererModule } from './gpu.ts';
import { NullRenderer } from './null.ts';
import type { Backend, SceneRenderer } from './renderer.ts';

export interface LoadOptions {
  /** `auto` (default) tries WebGPU, WebGL2, then canvas 2D; a name asks for that backend alone. */
  backend?: 'auto' | Backend;
}

type GpuBackend = 'webgpu' | 'webgl';

/** The module's name and its wasm; both stand beside each other in `pkg/` and in the built page. */
const ARTEFACTS = {
  webgpu: {
    load: () => import('../../pkg/renderer-webgpu.js') as Promise<unknown>,
    wasm: () => new URL('./renderer-webgpu_bg.wasm', import.meta.url),
  },
  webgl: {
    load: () => import('../../pkg/renderer-webgl.js') as Promise<unknown>,
    wasm: () => new URL('./renderer-webgl_bg.wasm', import.meta.url),
  },
} as const satisfies Record<GpuBackend, { load: () => Promise<unknown>; wasm: () => URL }>;

const modules = new Map<GpuBackend, Promise<RendererModule>>();
/** Instances that trapped: their memory cannot be trusted and a module has only one. */
const trapped = new Set<GpuBackend>();

/**
 * A renderer on a canvas from `makeCanvas`, which is called once for every backend tried.
 *
 * @throws an Error saying for each backend tried why it was refused.
 */
export async function loadRenderer(
  makeCanvas: () => HTMLCanvasElement,
  options: LoadOptions = {},
): Promise<SceneRenderer> {
  const wanted = options.backend ?? 'auto';
  const order: readonly Backend[] = wanted === 'auto' ? ['webgpu', 'webgl', 'canvas2d'] : [wanted];
  const refusals: string[] = [];
  for (const backend of order) {
    try {
      return await open(backend, makeCanvas);
    } catch (error) {
      refusals.push(`${backend}: ${error instanceof Error ? error.message : String(error)}`);
    }
  }
  throw new Error(`The rocks cannot be drawn here. ${refusals.join('; ')}`);
}

async function open(backend: Backend, makeCanvas: () => HTMLCanvasElement): Promise<SceneRenderer> {
  switch (backend) {
    case 'null':
      return new NullRenderer(makeCanvas());
    case 'canvas2d':
      return new Canvas2dRenderer(makeCanvas());
    case 'webgpu':
      await probeWebGpu();
      return openGpu(backend, makeCanvas);
    case 'webgl':
      probeWebGl();
      return openGpu(backend, makeCanvas);
  }
}

async function openGpu(
  backend: GpuBackend,
  makeCanvas: () => HTMLCanvasElement,
): Promise<GpuRenderer> {
  const module = await loadModule(backend);
  return GpuRenderer.create(backend, module, makeCanvas(), () => trapped.add(backend));
}

/** `navigator.gpu` may exist without an adapter, and an adapter without a device: only a device counts. */
async function probeWebGpu(): Promise<void> {
  const gpu = (globalThis.navigator as { gpu?: ProbedGpu } | undefined)?.gpu;
  if (!gpu) throw new Error('this browser has no WebGPU');
  const adapter = await gpu.requestAdapter({ powerPreference: 'high-performance' });
  if (!adapter) throw new Error('no graphics adapter');
  const device = await adapter.requestDevice();
  device.destroy();
}

/** The little of WebGPU that the probe uses; TypeScript's DOM library has none of it. */
interface ProbedGpu {
  requestAdapter(options: {
    powerPreference: 'high-performance';
  }): Promise<{ requestDevice(): Promise<{ destroy(): void }> } | null>;
}

/** On a canvas of its own: a canvas refused here stays usable for canvas 2D. */
function probeWebGl(): void {
  const context = document.createElement('canvas').getContext('webgl2');
  if (!context) throw new Error('no WebGL2 context');
  // Browsers keep few contexts alive; this one need not wait for the garbage collector.
  context.getExtension('WEBGL_lose_context')?.loseContext();
}

/** The module with its wasm instantiated, once per page; a failed attempt is not remembered. */
function loadModule(backend: GpuBackend): Promise<RendererModule> {
  if (trapped.has(backend)) {
    return Promise.reject(new Error('its wasm stopped earlier on this page; reload to try again'));
  }
  let module = modules.get(backend);
  if (!module) {
    module = instantiate(backend);
    modules.set(backend, module);
    module.catch(() => modules.delete(backend));
  }
  return module;
}

async function instantiate(backend: GpuBackend): Promise<RendererModule> {
  const { load, wasm } = ARTEFACTS[backend];
  const url = wasm();
  const [module, source] = await Promise.all([load() as Promise<RendererModule>, fetchWasm(url)]);
  try {
    await module.default({ module_or_path: source });
  } catch (error) {
    throw new Error(`${fileName(url)} could not be started: ${String(error)}`);
  }
  return module;
}

function fileName(url: URL): string {
  return url.pathname.slice(url.pathname.lastIndexOf('/') + 1);
}

/** The bytes of a wasm file, or an Error that names it: servers answer missing files with pages. */
async function fetchWasm(url: URL): Promise<Response | ArrayBuffer> {
  const name = fileName(url);
  let response: Response;
  try {
    response = await fetch(url);
  } catch (error) {
    throw new Error(`${name} could not be fetched: ${String(error)}`);
  }
  if (!response.ok) throw new Error(`${name} could not be fetched: HTTP ${response.status}`);
  const type = response.headers.get('content-type')?.split(';')[0] ?? 'no type';
  // Only this type may be compiled while it arrives.
  if (type === 'application/wasm') return response;
  const bytes = await response.arrayBuffer();
  const magic = new Uint8Array(bytes, 0, Math.min(4, bytes.byteLength));
  if (String.fromCharCode(...magic) !== '\0asm') {
    throw new Error(`${name} is not WebAssembly (${type}, ${bytes.byteLength} bytes)`);
  }
  return bytes;
}
