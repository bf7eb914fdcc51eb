/** The wasm renderer, on WebGPU or WebGL2, behind the page's `SceneRenderer`. */

import type { Field } from '../field.ts';
import type { CameraState, ColorMode, SceneRenderer, SceneStyle, View } from './renderer.ts';

/** What both artefacts export (`src/bindings/renderer.rs`). */
export interface RawRenderer {
  setField(
    imageWidth: number,
    imageHeight: number,
    positions: Float32Array,
    indices: Uint32Array,
    vertexStarts: Uint32Array,
    rockLayers: Uint32Array,
    rockSites: Uint32Array,
  ): void;
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
  Renderer: {
    create(canvas: HTMLCanvasElement, onLost: (reason: string) => void): Promise<RawRenderer>;
  };
}

// The order of these two lists is the meaning of the numbers in `RawRenderer.setStyle`.
const VIEWS: readonly View[] = ['3d', 'wireframe', 'diagrams', 'selection'];
const COLORS: readonly ColorMode[] = ['layer', 'rock', 'plain'];

/** Layer id and site index of every rock: what a rock's colour is drawn from, whatever happens to the others. */
function rockKeys(field: Field): { layers: Uint32Array; sites: Uint32Array } {
  const rocks = field.rockLayer.length;
  const layers = new Uint32Array(rocks);
  const sites = new Uint32Array(rocks);
  const seen = new Uint32Array(field.layers.length);
  for (let rock = 0; rock < rocks; rock++) {
    const index = field.rockLayer[rock] ?? 0;
    const layer = field.layers[index];
    const rank = seen[index] ?? 0;
    layers[rock] = layer?.id ?? index;
    sites[rock] = layer?.selected[rank] ?? rank;
    seen[index] = rank + 1;
  }
  return { layers, sites };
}

interface Deferred {
  promise: Promise<string>;
  resolve: (reason: string) => void;
}

function deferred(): Deferred {
  let resolve: (reason: string) => void = () => {};
  const promise = new Promise<string>((settle) => {
    resolve = settle;
  });
  return { promise, resolve };
}

export class GpuRenderer implements SceneRenderer {
  readonly backend: 'webgpu' | 'webgl';
  readonly canvas: HTMLCanvasElement;
  readonly lost: Promise<string>;
  readonly #raw: RawRenderer;
  readonly #onTrap: () => void;
  readonly #lose: (reason: string) => void;
  /** Null with WebGPU. */
  readonly #context: WebGL2RenderingContext | null;
  #dead = false;
  #disposed = false;
  /** The page's own, not a copy: edges and plans are made from it when they are first shown. */
  #field: Field | undefined;

  /** Makes the canvas' renderer; `onTrap` is called if the wasm instance can no longer be trusted. */
  static async create(
    backend: 'webgpu' | 'webgl',
    module: RendererModule,
    canvas: HTMLCanvasElement,
    onTrap: () => void,
  ): Promise<GpuRenderer> {
    const lost = deferred();
    try {
      const raw = await module.Renderer.create(canvas, lost.resolve);
      return new GpuRenderer(backend, raw, canvas, onTrap, lost);
    } catch (error) {
      if (error instanceof WebAssembly.RuntimeError) onTrap();
      throw error;
    }
  }

  private constructor(
    backend: 'webgpu' | 'webgl',
    raw: RawRenderer,
    canvas: HTMLCanvasElement,
    onTrap: () => void,
    lost: Deferred,
  ) {
    this.backend = backend;
    this.canvas = canvas;
    this.#raw = raw;
    this.#onTrap = onTrap;
    this.lost = lost.promise;
    this.#lose = lost.resolve;
    void lost.promise.then(() => {
      this.#dead = true;
    });
    this.#context = backend === 'webgl' ? canvas.getContext('webgl2') : null;
    canvas.addEventListener('webglcontextlost', this.#onContextLost);
  }

  setField(field: Field): void {
    const { layers, sites } = rockKeys(field);
    this.#guard(() => {
      this.#raw.setField(
        field.imageWidth,
        field.imageHeight,
        field.positions,
        field.indices,
        field.vertexStarts,
        layers,
        sites,
      );
      this.#field = field;
      this.#prepare();
    });
  }

  setStyle({ view, color, dark }: SceneStyle): void {
    this.#guard(() => {
      this.#raw.setStyle(VIEWS.indexOf(view), COLORS.indexOf(color), dark);
      this.#prepare();
    });
  }

  setCamera({ azimuth, elevation, distance, target }: CameraState): void {
    this.#guard(() => {
      this.#raw.setCamera(azimuth, elevation, distance, target[0], target[1], target[2]);
    });
  }

  resize(width: number, height: number): void {
    const whole = (side: number): number => Math.max(1, Math.round(side) || 1);
    this.#guard(() => {
      this.#raw.resize(whole(width), whole(height), globalThis.devicePixelRatio || 1);
    });
  }

  render(): void {
    this.#guard(() => this.#raw.render());
  }

  dispose(): void {
    if (this.#disposed) return;
    this.#disposed = true;
    this.#field = undefined;
    this.canvas.removeEventListener('webglcontextlost', this.#onContextLost);
    try {
      this.#raw.close();
      this.#raw.free();
    } catch (error) {
      // After a trap the instance cannot even free; its module is not used again.
      if (error instanceof WebAssembly.RuntimeError) this.#onTrap();
    }
  }

  /** Makes what the shown view lacks: edges for the wireframe, strokes and fills for a plan. */
  #prepare(): void {
    const field = this.#field;
    if (!field) return;
    if (this.#raw.needsEdges()) this.#raw.setEdges(field.indices);
    if (!this.#raw.needsPlan()) return;
    for (const layer of field.layers) {
      this.#raw.addLayer(
        layer.id,
        layer.radius,
        layer.sites,
        layer.cellStarts,
        layer.cellVertices,
        layer.selected,
      );
    }
    this.#raw.makePlan();
  }

  /** Calls into wasm unless that is over; a trap counts as a loss. */
  #guard(call: () => void): void {
    if (this.#disposed || this.#dead) return;
    // The event comes in a later task; until then every WebGL call fails.
    if (this.#context?.isContextLost()) {
      this.#onContextLost();
      return;
    }
    try {
      call();
    } catch (error) {
      if (!(error instanceof WebAssembly.RuntimeError)) throw error;
      this.#dead = true;
      this.#onTrap();
      this.#lose(`the renderer stopped: ${error.message}`);
    }
  }

  #onContextLost = (): void => {
    this.#dead = true;
    this.#lose('the WebGL context was lost');
  };
}
