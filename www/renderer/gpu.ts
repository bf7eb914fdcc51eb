/** The wasm renderer, on WebGPU or WebGL2, behind the page's `SceneRenderer`. */

import { lazily } from '../base/lazy.ts';
import type { Field } from '../data/field.ts';
import type { RawRenderer } from './artefact.ts';
import { joinDevice } from './device.ts';
import type { CameraState, GpuBackend, Quality } from '../base/view.ts';
import type { LossListener, SharedDevice } from './device.ts';
import { fovOf } from '../base/fov.ts';
import { COLORS, FLESH, LOOK, QUALITIES, VIEWS } from './order.gen.ts';
import type { Look } from '../data/look.ts';
import type { Pieces, SceneRenderer, SceneStyle, Stills, Tile, Wood } from './renderer.ts';

/** Layer id and site index of every rock: what a rock's colour is drawn from, whatever happens to the others. */
export function rockKeys(field: Field): { layers: Uint32Array; sites: Uint32Array } {
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

export function giveLook(raw: RawRenderer, look: Look): void {
  const { layers, flesh } = look;
  const values = [...LOOK.map((key) => look[key]), ...FLESH.map((key) => flesh?.[key] ?? 0)];
  const ids = layers.map(({ id }) => id);
  const materials = layers.map(({ material }) => material);
  raw.setLook(Float32Array.from(values), Uint32Array.from(ids), Uint8Array.from(materials));
}

export class GpuRenderer implements SceneRenderer {
  readonly canvas: HTMLCanvasElement;
  /** A promise of its own: on one of the device the pictures of the past would hang for as long as it lives. */
  readonly lost: Promise<string>;
  #lose: (reason: string) => void = () => {};
  readonly #device: SharedDevice;
  readonly #raw: RawRenderer;
  /** Where the picture is copied to from the device's canvas; null with WebGPU, which draws on `canvas` itself. */
  readonly #context: CanvasRenderingContext2D | null;
  /** Its place at the device. */
  readonly #onLost: LossListener;
  #disposed = false;
  /** Sizes of the pictures in pieces: of the one that is begun, and of the one that is whole. */
  #begun: readonly [number, number] = [1, 1];
  #whole = this.#begun;
  /** The page's own, not a copy: edges and plans are made from it when they are first shown. */
  #field: Field | undefined;
  /** What is drawn; its log is not uploaded again. */
  #wood: Wood | null = null;

  /** @throws an Error saying why the backend cannot be had, or not on a canvas from `makeCanvas`. */
  static async create(backend: GpuBackend, makeCanvas: () => HTMLCanvasElement): Promise<GpuRenderer> {
    let tell: (reason: string) => void = () => {};
    const onLost = (reason: string): void => tell(reason);
    const device = await joinDevice(backend, onLost);
    try {
      const renderer = new GpuRenderer(device, makeCanvas(), onLost);
      tell = (reason) => renderer.#lose(reason);
      return renderer;
    } catch (error) {
      device.leave(onLost);
      throw error;
    }
  }

  private constructor(device: SharedDevice, canvas: HTMLCanvasElement, onLost: LossListener) {
    this.canvas = canvas;
    this.lost = new Promise((resolve) => (this.#lose = resolve));
    this.#device = device;
    this.#onLost = onLost;
    this.#context = device.canvas ? canvas.getContext('2d', { alpha: false }) : null;
    if (device.canvas && !this.#context) throw new Error('no 2D canvas');
    const { Renderer } = device.module;
    this.#raw = device.canvas ? new Renderer(device.raw) : new Renderer(device.raw, canvas);
  }

  get backend(): GpuBackend {
    return this.#device.backend;
  }

  get deviceName(): string {
    return this.#device.name;
  }

  get maxSide(): number {
    return this.isLost ? 0 : this.#device.raw.maxSide();
  }

  get isLost(): boolean {
    return this.#device.dead;
  }

  setField(field: Field): void {
    const { layers, sites } = rockKeys(field);
    this.#guard(() => {
      this.#raw.setField(
        field.imageWidth,
        field.imageHeight,
        field.positions,
        field.normals,
        field.indices,
        field.vertexStarts,
        field.rockStarts,
        layers,
        sites,
      );
      this.#field = field;
      this.#prepare();
    });
  }

  setWood(wood: Wood | null): void {
    this.#guard(() => {
      if (wood) this.#upload(wood);
      else if (this.#wood) this.#raw.clearWood();
      this.#wood = wood;
      this.#prepare();
    });
  }

  #upload({ colony, rings, meridians, place }: Wood): void {
    const { log } = colony;
    const at = Float32Array.from(place);
    const old = this.#wood;
    const isOld = old !== null && old.colony.log === log && old.place.every((value, k) => value === place[k]);
    // Shown with the colony, or, where that fails, not.
    if (!isOld) this.#raw.setLog(log.positions, log.normals, log.indices, log.kinds, at);
    this.#raw.setColony(colony.positions, colony.normals, colony.indices, colony.foot, rings, meridians, at);
  }

  setStyle({ view, color, dark }: SceneStyle): void {
    this.#guard(() => {
      this.#raw.setStyle(VIEWS.indexOf(view), COLORS.indexOf(color), dark);
      this.#prepare();
    });
  }

  setLook(look: Look): void {
    this.#guard(() => giveLook(this.#raw, look));
  }

  setQuality(level: Quality): void {
    this.#guard(() => this.#raw.setQuality(QUALITIES.indexOf(level)));
  }

  setCamera(camera: CameraState): void {
    const { azimuth, elevation, distance, target } = camera;
    this.#guard(() => this.#raw.setCamera(azimuth, elevation, distance, ...target, fovOf(camera)));
  }

  resize(width: number, height: number): void {
    this.#guard(() => {
      const max = this.#device.raw.maxSide();
      const side = (pixels: number): number => Math.min(max, Math.max(1, Math.round(pixels) || 1));
      const [across, down] = [side(width), side(height)];
      this.#raw.resize(across, down, (this.canvas.ownerDocument.defaultView ?? globalThis).devicePixelRatio || 1);
      // With WebGPU the surface has done it. Assigning clears a canvas, also with what it has.
      if (this.#context && (this.canvas.width !== across || this.canvas.height !== down)) {
        [this.canvas.width, this.canvas.height] = [across, down];
      }
    });
  }

  render(): void {
    this.#guard(() => {
      this.#raw.render();
      this.#copy([this.canvas.width, this.canvas.height]);
    });
  }

  renderTile(tile: Tile): void {
    this.#setTile(tile);
    this.render();
  }

  async stills(): Promise<Stills> {
    const { makeStills } = await lazily(() => import('./stills.ts'));
    return makeStills({
      raw: this.#raw,
      device: this.#device,
      canvas: this.canvas,
      guard: (call) => this.#guard(call),
      setTile: (tile) => this.#setTile(tile),
      copy: (size) => this.#copy(size),
    });
  }

  /** Copies what was just drawn in the corner of the device's canvas. At once: in the next task that may be blank, or another's. */
  #copy([across, down]: readonly [number, number]): void {
    const { width, height } = this.canvas;
    if (this.#device.canvas) this.#context?.drawImage(this.#device.canvas, 0, 0, across, down, 0, 0, width, height);
  }

  readonly pieces: Pieces = {
    make: (isRough) => {
      // Whoever looks at a picture, such as a test, can tell that another is on its way.
      this.canvas.dataset['drawing'] = '';
      return this.#guard(() => this.#device.makeNext(this.#raw, isRough ? 1 : 0)) === true;
    },
    isMaking: () => this.#device.isMaking,
    begin: (width, height, isRough) => {
      this.#begun = [width, height];
      this.#guard(() => this.#raw.beginPicture(width, height, isRough));
    },
    light: () => this.#guard(() => this.#raw.lightPicture()) === true,
    draw: (pixels) => {
      const goesOn = this.#guard(() => this.#raw.drawPiece(pixels));
      if (!goesOn) this.#whole = this.#begun;
      return goesOn === true;
    },
    underWay: () => this.#guard(() => this.#raw.piecesUnderWay()) ?? 0,
    show: () => {
      this.#guard(() => this.#raw.showPicture() && this.#copy(this.#whole));
      delete this.canvas.dataset['drawing'];
    },
    end: () => this.#guard(() => this.#raw.endPictures()),
  };

  #setTile({ whole, corner, size, backing }: Tile): void {
    this.resize(...size);
    this.#guard(() => this.#raw.setTile(...whole, ...corner, ['none', 'black', 'white'].indexOf(backing)));
  }

  dispose(): void {
    if (this.#disposed) return;
    this.#disposed = true;
    this.#device.attempt(() => {
      this.#raw.close();
      this.#raw.free();
    });
    this.#field = undefined;
    this.#wood = null;
    this.#device.leave(this.#onLost);
  }

  /** Makes what the shown view lacks: edges for the wireframe, strokes and fills for a plan. */
  #prepare(): void {
    const colony = this.#wood?.colony;
    if (colony && this.#raw.needsWoodEdges()) this.#raw.setWoodEdges(colony.log.indices, colony.indices);
    const field = this.#field;
    if (!field) return;
    if (this.#raw.needsEdges()) this.#raw.setEdges(field.indices);
    if (!this.#raw.needsPlan()) return;
    for (const layer of field.layers) {
      this.#raw.addLayer(layer.id, layer.radius, layer.sites, layer.cellStarts, layer.cellVertices, layer.selected);
    }
    this.#raw.makePlan();
  }

  /** Calls into wasm unless that is over. */
  #guard<T>(call: () => T): T | undefined {
    return this.#disposed || this.#device.dead ? undefined : this.#device.attempt(call);
  }
}
