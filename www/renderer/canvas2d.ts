/**
 * The field from above on a plain 2D canvas, for devices without any GPU: every diagram with its sites in
 * the `diagrams` view, the selected cells with theirs in all others.
 */

import type { Field, FieldLayer } from '../data/field.ts';
import { tangentOf } from '../base/fov.ts';
import type { CameraState } from '../base/view.ts';
import type { Look } from '../data/look.ts';
import type { SceneRenderer, SceneStyle, Wood } from './renderer.ts';

/** As INK in `src/shading/palette.rs`: by layer id modulo 8. */
const INK = ['#cd5e3c', '#e8b24a', '#4a8fbc', '#7ca450', '#986c9e', '#d6c8ac', '#707880', '#409e8e'];
const GREY = '#9e9c98';
const THEMES = {
  light: { table: '#e0e4e6', paper: '#faf8f3', line: '#6e6860' },
  dark: { table: '#111214', paper: '#1b1d20', line: '#787670' },
} as const;
/** Under and round the selected cells, as in Fig. 8 (d). */
const GROUND = '#2e2925';
const OUTLINE = '#1e1a18';
const WOOD = { log: '#5b4636', ear: '#a5683f' };
/** Slices along a log, of which the outline is made. */
const SLICES = 160;
/** Larger canvases fail silently in some browsers. */
const MAX_SIDE = 8192;
/** Below this many device pixels per cell, lines and sites would only darken the sheet. */
const MIN_CELL_PX = 3;

export class Canvas2dRenderer implements SceneRenderer {
  readonly backend = 'canvas2d';
  readonly canvas: HTMLCanvasElement;
  /** A 2D canvas is restored by the browser itself: never resolves. */
  readonly lost: Promise<string> = new Promise(() => {});
  readonly #context: CanvasRenderingContext2D;
  /** The page's own, not a copy. */
  #field: Field | undefined;
  #wood: Wood | null = null;
  #style: SceneStyle = { view: '3d', color: 'layer', dark: false };
  #camera: CameraState = { azimuth: 0, elevation: 1, distance: 1000, target: [0, 0, 0] };

  constructor(canvas: HTMLCanvasElement) {
    const context = canvas.getContext('2d', { alpha: false });
    if (!context) throw new Error('no 2D canvas');
    this.canvas = canvas;
    this.#context = context;
    // After a crash of the GPU process the browser gives the canvas back blank.
    canvas.addEventListener('contextrestored', () => this.render());
  }

  get isLost(): boolean {
    return this.#context.isContextLost?.() ?? false;
  }

  setField(field: Field): void {
    this.#field = field;
  }

  setWood(wood: Wood | null): void {
    this.#wood = wood;
  }

  setStyle(style: SceneStyle): void {
    this.#style = { ...style };
  }

  /** Nothing of it is seen in a plan. */
  setLook(_look: Look): void {}

  setQuality(): void {}

  setCamera(camera: CameraState): void {
    this.#camera = { ...camera, target: [...camera.target] };
  }

  resize(width: number, height: number): void {
    const side = (value: number): number => Math.min(MAX_SIDE, Math.max(1, Math.round(value) || 1));
    this.canvas.width = side(width);
    this.canvas.height = side(height);
  }

  dispose(): void {
    this.#field = undefined;
    this.#wood = null;
  }

  render(): void {
    const context = this.#context;
    const { width, height } = this.canvas;
    const theme = this.#style.dark ? THEMES.dark : THEMES.light;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.fillStyle = theme.table;
    context.fillRect(0, 0, width, height);
    const field = this.#field;
    if (!field) return;
    // As the plans of the GPU renderers: half the height is distance · tan(fov / 2), y up.
    const scale = height / 2 / (this.#camera.distance * tangentOf(this.#camera));
    const [x, y] = this.#camera.target;
    context.setTransform(scale, 0, 0, -scale, width / 2 - x * scale, height / 2 + y * scale);
    const diagrams = this.#style.view === 'diagrams';
    context.fillStyle = diagrams ? theme.paper : GROUND;
    context.fillRect(0, 0, field.imageWidth, field.imageHeight);
    const pixel = 1 / scale;
    const layers = [...field.layers].sort((a, b) => a.radius - b.radius);
    for (const layer of layers) {
      if (diagrams) this.#drawDiagram(layer, pixel);
      else this.#fillSelected(layer, pixel);
    }
    if (this.#wood) this.#drawWood(this.#wood, pixel);
    context.strokeStyle = theme.line;
    context.lineWidth = 1.5 * pixel;
    context.strokeRect(0, 0, field.imageWidth, field.imageHeight);
  }

  #drawWood({ colony: { log, positions, vertexStarts, size }, place: [px, py, , scale] }: Wood, pixel: number): void {
    const context = this.#context;
    context.fillStyle = this.#style.color === 'plain' ? GREY : WOOD.log;
    context.strokeStyle = OUTLINE;
    context.lineWidth = 1.2 * pixel;
    context.beginPath();
    for (const [x, y] of outlineOf(log.positions)) context.lineTo(px + scale * x, py + scale * y);
    context.closePath();
    context.fill();
    context.stroke();
    context.fillStyle = this.#style.color === 'plain' ? GREY : WOOD.ear;
    for (let k = 0; k < size.length; k++) {
      const [x, y] = middleOf(positions, vertexStarts[k] ?? 0, vertexStarts[k + 1] ?? 0);
      context.beginPath();
      context.arc(px + scale * x, py + scale * y, (scale * (size[k] ?? 0)) / 2, 0, 2 * Math.PI);
      context.fill();
      context.stroke();
    }
  }

  #ink(layer: FieldLayer): string {
    return this.#style.color === 'plain' ? GREY : (INK[layer.id % INK.length] ?? GREY);
  }

  /** Adds cell `i` to the current path. */
  #trace(layer: FieldLayer, i: number): void {
    const from = layer.cellStarts[i] ?? 0;
    const to = layer.cellStarts[i + 1] ?? from;
    for (let j = from; j < to; j++) {
      const [x, y] = [layer.cellVertices[2 * j] ?? 0, layer.cellVertices[2 * j + 1] ?? 0];
      if (j === from) this.#context.moveTo(x, y);
      else this.#context.lineTo(x, y);
    }
    if (to > from) this.#context.closePath();
  }

  #fillSelected(layer: FieldLayer, pixel: number): void {
    const context = this.#context;
    context.beginPath();
    for (const site of layer.selected) this.#trace(layer, site);
    context.fillStyle = this.#ink(layer);
    context.fill();
    if (layer.radius < MIN_CELL_PX * pixel) return;
    context.strokeStyle = OUTLINE;
    context.lineWidth = 1.2 * pixel;
    context.stroke();
    context.fillStyle = OUTLINE;
    for (const site of layer.selected) this.#dot(layer, site, pixel);
  }

  #drawDiagram(layer: FieldLayer, pixel: number): void {
    if (layer.radius < MIN_CELL_PX * pixel) return;
    const context = this.#context;
    context.strokeStyle = this.#ink(layer);
    context.fillStyle = context.strokeStyle;
    context.globalAlpha = 0.7;
    context.lineWidth = Math.min(2 * pixel, layer.radius / 10);
    context.beginPath();
    for (let i = 0; i + 1 < layer.cellStarts.length; i++) this.#trace(layer, i);
    context.stroke();
    for (let i = 0; 2 * i + 1 < layer.sites.length; i++) this.#dot(layer, i, pixel);
    context.globalAlpha = 1;
  }

  #dot(layer: FieldLayer, site: number, pixel: number): void {
    const side = Math.min(2.5 * pixel, layer.radius / 4);
    const [x, y] = [layer.sites[2 * site] ?? 0, layer.sites[2 * site + 1] ?? 0];
    this.#context.fillRect(x - side / 2, y - side / 2, side, side);
  }
}

/** A log from above: along one side and back along the other. Its axis is x. */
function outlineOf(positions: Float32Array): [number, number][] {
  let [from, to] = [Infinity, -Infinity];
  for (let i = 0; i < positions.length; i += 3) {
    from = Math.min(from, positions[i]!);
    to = Math.max(to, positions[i]!);
  }
  const slices = Array.from({ length: SLICES }, (_, k) => ({
    x: from + ((k + 0.5) * (to - from)) / SLICES,
    low: Infinity,
    high: -Infinity,
  }));
  for (let i = 0; i < positions.length; i += 3) {
    const slice = slices[Math.min(SLICES - 1, Math.floor(((positions[i]! - from) / (to - from)) * SLICES))];
    if (!slice) continue;
    slice.low = Math.min(slice.low, positions[i + 1]!);
    slice.high = Math.max(slice.high, positions[i + 1]!);
  }
  const filled = slices.filter(({ low, high }) => low <= high);
  return [...filled.map(({ x, low }): [number, number] => [x, low]), ...filled.reverse().map(({ x, high }): [number, number] => [x, high])];
}

function middleOf(positions: Float32Array, from: number, to: number): [number, number] {
  let [x, y] = [0, 0];
  for (let i = from; i < to; i++) {
    x += positions[3 * i]!;
    y += positions[3 * i + 1]!;
  }
  return [x / (to - from), y / (to - from)];
}
