/**
 * The graphics device of a page: one per backend, shared by all pictures, made with the first and let go with the last.
 *
 * WebGPU gives every picture a canvas of its own. WebGL2 binds a device to one canvas, and browsers keep about 16 of those alive:
 * there all pictures are drawn on one canvas that nobody sees, and copied from it.
 */

import type { RawDevice, RawRenderer, RendererModule } from './artefact.ts';
import { lazily } from '../base/lazy.ts';
import type { GpuBackend } from '../base/view.ts';
import { instanceOf, loadArtefact, markTrapped } from './artefact.ts';
import type { Programs } from './programs.ts';

export type LossListener = (reason: string) => void;

const CONTEXT_LOST = 'the WebGL context was lost';

export class SharedDevice {
  readonly backend: GpuBackend;
  readonly module: RendererModule;
  readonly raw: RawDevice;
  /** What the browser calls it. */
  readonly name: string;
  /** Where all pictures are drawn; null with WebGPU. */
  readonly canvas: HTMLCanvasElement | null;
  /** With WebGL2, what makes programs beside the page, as WebGPU does by itself. */
  readonly #programs: Programs | null;
  readonly #context: WebGL2RenderingContext | null;
  readonly #forget: () => void;
  /** One for each of its users, told once when the device or context is lost. */
  readonly #listeners = new Set<LossListener>();
  /** Of the wasm that it was made by. */
  readonly #instance: number;
  #dead = false;

  constructor(
    backend: GpuBackend,
    module: RendererModule,
    raw: RawDevice,
    name: string,
    canvas: HTMLCanvasElement | null,
    programs: Programs | null,
    forget: () => void,
  ) {
    this.backend = backend;
    this.#instance = instanceOf(backend);
    this.module = module;
    this.raw = raw;
    this.name = name;
    this.canvas = canvas;
    this.#programs = programs;
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

  /** Whether it still makes what it was given: what draws with that has the page wait. */
  get isMaking(): boolean {
    return this.#programs?.isLinking === true;
  }

  /** As `makeNext` of the wasm; true also while the device is making something. To be called within `attempt`. */
  makeNext(raw: RawRenderer, sort: number): boolean {
    const make = (mayDraw: boolean): boolean => raw.makeNext(sort, mayDraw);
    return this.#programs ? this.#programs.beside(make) : make(true);
  }

  /** Calls into wasm. A trap is the loss of the device: another instance takes the place of the one that trapped, and nothing more is called in that. */
  attempt<T>(call: () => T): T | undefined {
    if (this.#instance !== instanceOf(this.backend)) return undefined;
    try {
      return call();
    } catch (error) {
      if (!(error instanceof WebAssembly.RuntimeError)) throw error;
      markTrapped(this.backend);
      this.lose(`the renderer stopped: ${error.message}`);
      return undefined;
    }
  }

  /** It is lost: who comes from now on gets another. */
  lose(reason: string): void {
    if (this.#dead) return;
    this.#dead = true;
    this.#forget();
    for (const tell of this.#listeners) tell(reason);
  }

  #onContextLost = (): void => this.lose(CONTEXT_LOST);
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

/** A device is given within a second or two, or never: a GPU process that crashes meanwhile leaves the question without an answer. */
const DEVICE_MS = 15_000;

async function openDevice(backend: GpuBackend, forget: () => void): Promise<SharedDevice> {
  const canvas = document.createElement('canvas');
  const contextLost = new Promise<never>((_, reject) =>
    canvas.addEventListener('webglcontextlost', () => reject(new Error(CONTEXT_LOST)), { once: true }),
  );
  contextLost.catch(() => undefined);
  const name = backend === 'webgpu' ? await inTime(probeWebGpu()) : probeWebGl(canvas);
  const linker = backend === 'webgl' ? lazily(() => import('./programs.ts'), true) : null;
  const [module, made] = await Promise.race([Promise.all([loadArtefact(backend), linker]), contextLost]);
  const context = made && canvas.getContext('webgl2');
  if (context?.isContextLost()) throw new Error(CONTEXT_LOST);
  const programs = context && new made.Programs(context);
  let device: SharedDevice | undefined;
  let lostEarly: string | undefined;
  const lose = (reason: string): void => {
    lostEarly = reason;
    device?.lose(reason);
  };
  let isAnswered = false;
  try {
    const creating = module.Device.create(canvas, lose).finally(() => (isAnswered = true));
    const raw = await inTime(Promise.race([creating, contextLost]));
    device = new SharedDevice(backend, module, raw, name, context && canvas, programs, forget);
  } catch (error) {
    // What traps in the middle of its waiting gives no answer.
    if (!isAnswered || error instanceof WebAssembly.RuntimeError) markTrapped(backend);
    throw error;
  }
  if (lostEarly !== undefined) throw new Error(lostEarly);
  return device;
}

function inTime<T>(answer: Promise<T>): Promise<T> {
  let timer: ReturnType<typeof setTimeout>;
  const late = new Promise<never>(
    (_, reject) => (timer = setTimeout(() => reject(new Error('the graphics device does not answer')), DEVICE_MS)),
  );
  return Promise.race([answer, late]).finally(() => clearTimeout(timer));
}

/**
 * `navigator.gpu` may exist without an adapter, and an adapter without a device: only a device counts.
 *
 * @returns what the adapter is called.
 */
async function probeWebGpu(): Promise<string> {
  const gpu = (globalThis.navigator as { gpu?: ProbedGpu } | undefined)?.gpu;
  if (!gpu) throw new Error('this browser has no WebGPU');
  const adapter = await gpu.requestAdapter({ powerPreference: 'high-performance' });
  if (!adapter) throw new Error('no graphics adapter');
  const device = await adapter.requestDevice();
  device.destroy();
  const { vendor, architecture, description, isFallbackAdapter } = adapter.info ?? {};
  return [vendor, architecture, description, isFallbackAdapter && 'fallback'].filter(Boolean).join(' ');
}

/** The little of WebGPU that the probe uses; TypeScript's DOM library has none of it. */
interface ProbedGpu {
  requestAdapter(options: { powerPreference: 'high-performance' }): Promise<{
    info?: { vendor?: string; architecture?: string; description?: string; isFallbackAdapter?: boolean };
    requestDevice(): Promise<{ destroy(): void }>;
  } | null>;
}

/**
 * On the canvas that is to be used, before 700 kB are fetched for it; with the options wgpu asks with later.
 *
 * @returns what the device is called.
 */
function probeWebGl(canvas: HTMLCanvasElement): string {
  const context = canvas.getContext('webgl2', { antialias: false });
  if (!context) throw new Error('no WebGL2 context');
  const names = context.getExtension('WEBGL_debug_renderer_info');
  return String(context.getParameter(names?.UNMASKED_RENDERER_WEBGL ?? context.RENDERER));
}
