/**
 * The graphics device of a page: one per backend, shared by all pictures, made with the first and let go with the last.
 *
 * WebGPU gives every picture a canvas of its own. WebGL2 binds a device to one canvas, and browsers keep about 16 of those alive:
 * there all pictures are drawn on one canvas that nobody sees, and copied from it.
 */

import type { RawDevice, RendererModule } from './artefact.ts';
import { loadArtefact, markTrapped } from './artefact.ts';

export type GpuBackend = 'webgpu' | 'webgl';
export type LossListener = (reason: string) => void;

export class SharedDevice {
  readonly backend: GpuBackend;
  readonly module: RendererModule;
  readonly raw: RawDevice;
  /** Where all pictures are drawn; null with WebGPU. */
  readonly canvas: HTMLCanvasElement | null;
  readonly #context: WebGL2RenderingContext | null;
  readonly #forget: () => void;
  /** One for each of its users, told once when the device or context is lost. */
  readonly #listeners = new Set<LossListener>();
  #dead = false;
  #trapped = false;

  constructor(backend: GpuBackend, module: RendererModule, raw: RawDevice, canvas: HTMLCanvasElement | null, forget: () => void) {
    this.backend = backend;
    this.module = module;
    this.raw = raw;
    this.canvas = canvas;
    this.#context = canvas?.getContext('webgl2') ?? null;
    this.#forget = forget;
    canvas?.addEventListener('webglcontextlost', this.#onContextLost);
  }

  /** Nothing can be drawn with it any more. */
  get dead(): boolean {
    // The event comes in a later task; until then every WebGL call fails.
    if (!this.#dead && this.#context?.isContextLost()) this.#onContextLost();
    return this.#dead;
  }

  /** `onLost` is told of a loss until it leaves. */
  join(onLost: LossListener): void {
    this.#listeners.add(onLost);
  }

  /** The last one to leave ends the device. */
  leave(onLost: LossListener): void {
    if (!this.#listeners.delete(onLost) || this.#listeners.size > 0) return;
    this.#forget();
    this.canvas?.removeEventListener('webglcontextlost', this.#onContextLost);
    this.#dead = true;
    this.attempt(() => {
      this.raw.close();
      this.raw.free();
    });
    // Browsers keep few contexts alive; this one need not wait for the garbage collector.
    this.#context?.getExtension('WEBGL_lose_context')?.loseContext();
  }

  /** Calls into wasm. A trap is the loss of the device: the instance's memory cannot be trusted any more, and nothing is called. */
  attempt(call: () => void): void {
    if (this.#trapped) return;
    try {
      call();
    } catch (error) {
      if (!(error instanceof WebAssembly.RuntimeError)) throw error;
      markTrapped(this.backend, error);
      this.#trapped = true;
      this.lose(`the renderer stopped: ${error.message}`);
    }
  }

  /** It is lost: who comes from now on gets another. */
  lose(reason: string): void {
    if (this.#dead) return;
    this.#dead = true;
    this.#forget();
    for (const tell of this.#listeners) tell(reason);
  }

  #onContextLost = (): void => this.lose('the WebGL context was lost');
}

const devices = new Map<GpuBackend, Promise<SharedDevice>>();

/**
 * The page's device of a backend, joined for `onLost`, which has to leave it.
 *
 * @throws an Error saying why there is none.
 */
export async function joinDevice(backend: GpuBackend, onLost: LossListener): Promise<SharedDevice> {
  for (;;) {
    let opening = devices.get(backend);
    if (!opening) {
      const made = openDevice(backend, () => devices.get(backend) === made && devices.delete(backend));
      opening = made;
      devices.set(backend, made);
      // A failed attempt is not remembered.
      made.catch(() => devices.delete(backend));
    }
    const device = await opening;
    // Its last user may have left, or it may have been lost, while it was awaited.
    if (!device.dead) {
      device.join(onLost);
      return device;
    }
  }
}

async function openDevice(backend: GpuBackend, forget: () => void): Promise<SharedDevice> {
  const canvas = document.createElement('canvas');
  if (backend === 'webgpu') await probeWebGpu();
  else probeWebGl(canvas);
  const module = await loadArtefact(backend);
  let device: SharedDevice | undefined;
  let lostEarly: string | undefined;
  const lose = (reason: string): void => {
    lostEarly = reason;
    device?.lose(reason);
  };
  try {
    const raw = await module.Device.create(canvas, lose);
    device = new SharedDevice(backend, module, raw, backend === 'webgl' ? canvas : null, forget);
  } catch (error) {
    if (error instanceof WebAssembly.RuntimeError) markTrapped(backend, error);
    throw error;
  }
  if (lostEarly !== undefined) throw new Error(lostEarly);
  return device;
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
  requestAdapter(options: { powerPreference: 'high-performance' }): Promise<{ requestDevice(): Promise<{ destroy(): void }> } | null>;
}

/** On the canvas that is to be used, before 700 kB are fetched for it; with the options wgpu asks with later. */
function probeWebGl(canvas: HTMLCanvasElement): void {
  if (!canvas.getContext('webgl2', { antialias: false })) throw new Error('no WebGL2 context');
}
