/** Painting on the ground of an element: its picture is seen from above, and what a pointer or the keys go along becomes a stroke. */

import { addStyles } from '../../../base/document-styles.ts';
import { errorInfo } from '../../../base/errors.ts';
import { defaultCamera, groundPoint, isPlan } from '../../../scene/camera/camera.ts';
import type { CameraState } from '../../../base/view.ts';
import { hasModifier } from '../../../controls/keys.ts';
import { PANEL_STYLES } from '../../../controls/panel-styles.ts';
import { errorText } from '../../../controls/strings-later.ts';
import { strokesOfText, strokesToText } from '../../strokes.ts';
import type { Stroke } from '../../strokes.ts';
import type { RockStore } from '../store.ts';
import { BRUSH_STEP, BRUSH_WIDTH, shapeOf, strokeAlong } from './brush.ts';
import type { Brush, Seen } from './brush.ts';
import { PAINT_STYLES, showBar } from './paint-bar.ts';
import type { PaintKey } from './paint-words.ts';
import type { Paintable } from './paintable.ts';

/** What each mode is painted in, over any ground. */
const COLORS = { add: '46 160 90', erase: '214 69 59', path: '224 165 38', restore: '64 140 220' } as const;
/** How far a key moves the brush, in its widths; with Shift, four times as far. */
const KEY_STEP = 0.25;

const ARROWS: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

/** The painters at work, by their elements. */
const painters = new WeakMap<HTMLElement, Painter>();

/** Whether somebody paints on an element. */
export function isPainting(element: HTMLElement): boolean {
  return painters.has(element);
}

/** Begins to paint on an element, or ends it. */
export function togglePainting(element: Paintable, store: RockStore): void {
  const painter = painters.get(element);
  if (painter) painter.end();
  else painters.set(element, new Painter(element, store));
  store.notify('messages');
}

class Painter {
  readonly brush: Brush = { mode: 'add', layer: null, width: BRUSH_WIDTH.start };
  /** What those are told who cannot see the brush. */
  said: PaintKey | null = null;
  readonly #element: Paintable;
  readonly #store: RockStore;
  readonly #stage: HTMLElement;
  readonly #canvas = document.createElement('canvas');
  readonly #host = document.createElement('div');
  readonly #listening = new AbortController();
  /** What is seen, and how the fingers move the page, before and after. */
  readonly #before: { camera: CameraState | null; touchAction: string };
  /** Where the brush is, in widths of the image; `null`: nowhere on the ground. */
  #at: [number, number] | null = null;
  /** The way of the stroke that is being painted. */
  #way: number[] | null = null;
  /** The pointer that paints, by what it came down with; `null` for the keys. */
  #pointer: PointerEvent | null = null;
  /** Two fingers move the picture until both have left. */
  #isMoved = false;
  #strokes: { text: string; list: readonly Stroke[] } = { text: '', list: [] };
  /** What the canvas shows. */
  #drawn = '';

  constructor(element: Paintable, store: RockStore) {
    this.#element = element;
    this.#store = store;
    const stage = element.shadowRoot?.querySelector<HTMLElement>('.stage');
    if (!stage) throw new Error('there is no picture to paint on');
    this.#stage = stage;
    const { camera } = element;
    const isFramed = JSON.stringify(camera) === JSON.stringify(element.defaultCamera);
    this.#before = { camera: isFramed ? null : camera, touchAction: stage.style.touchAction };
    element.navigation = 'orbit';
    this.#lookDown(camera);
    this.#canvas.className = 'painting';
    this.#canvas.style.cssText = 'pointer-events: none; z-index: 1';
    stage.append(this.#canvas);
    stage.style.touchAction = 'none';
    stage.style.cursor = 'crosshair';
    this.#host.className = 'paint-bar';
    const inner = this.#host.attachShadow({ mode: 'open' });
    stage.after(this.#host);
    addStyles(inner, PANEL_STYLES);
    addStyles(inner, PAINT_STYLES);
    const { signal } = this.#listening;
    signal.addEventListener(
      'abort',
      store.subscribe(() => this.show()),
    );
    this.#listen(signal);
    this.show();
    stage.focus({ preventScroll: true });
    this.#frame();
  }

  get store(): RockStore {
    return this.#store;
  }

  end(): void {
    if (!painters.delete(this.#element)) return;
    this.#listening.abort();
    this.#canvas.remove();
    this.#host.remove();
    this.#stage.style.touchAction = this.#before.touchAction;
    this.#stage.style.cursor = '';
    this.#element.camera = this.#before.camera;
    this.#store.notify('messages');
  }

  setBrush(change: Partial<Brush>): void {
    Object.assign(this.brush, change);
    this.brush.width = Math.min(BRUSH_WIDTH.max, Math.max(BRUSH_WIDTH.min, this.brush.width));
    this.show();
  }

  /** Shows the bar as things are. */
  show(): void {
    const { language, theme, params } = this.#store;
    this.#host.lang = language;
    this.#host.dataset.theme = theme;
    // A layer that is gone is not painted.
    if (!params.layers.some(({ id }) => id === this.brush.layer)) this.brush.layer = null;
    if (this.#host.shadowRoot) showBar(this, this.#host.shadowRoot);
  }

  /** From straight above, with all of the field in view. */
  #lookDown({ fov }: CameraState): void {
    const { imageWidth, imageHeight } = this.#store.params;
    this.#element.camera = {
      ...defaultCamera(imageWidth, imageHeight, this.#aspect, true, false, fov),
      azimuth: 0,
      elevation: Math.PI / 2,
    };
  }

  get #aspect(): number {
    return this.#stage.clientWidth / Math.max(1, this.#stage.clientHeight);
  }

  get #seen(): Seen {
    return { camera: this.#element.camera, aspect: this.#aspect, isPlan: isPlan(this.#store.view) };
  }

  #listen(signal: AbortSignal): void {
    const stage = this.#stage;
    // Before what moves the camera hears of it.
    const options = { signal, capture: true };
    stage.addEventListener('pointerdown', (event) => this.#onDown(event), options);
    stage.addEventListener('pointermove', (event) => this.#onMove(event), options);
    stage.addEventListener('pointerup', (event) => this.#onUp(event), options);
    stage.addEventListener('pointercancel', (event) => this.#onCancel(event), options);
    stage.addEventListener('pointerleave', () => this.#leave(), options);
    stage.addEventListener('dblclick', (event) => event.stopImmediatePropagation(), options);
    stage.addEventListener('keydown', (event) => this.#onKey(event, ARROWS), options);
    // In the bar, arrows and Space are those of its controls; none of its keys is the page's.
    this.#host.addEventListener('keydown', (event) => this.#onKey(event, {}), options);
    this.#host.addEventListener('keydown', (event) => hasModifier(event) || event.stopPropagation(), { signal });
  }

  #onDown(event: PointerEvent): void {
    if (this.#isMoved) return;
    if (!event.isPrimary) {
      // A second finger: both move the picture, and what the first one painted was not meant.
      const first = this.#pointer;
      this.#lift(false);
      this.#isMoved = true;
      if (first) this.#stage.dispatchEvent(new PointerEvent('pointerdown', first));
      return;
    }
    if (event.button !== 0) return;
    this.#take(event);
    this.#stage.focus({ preventScroll: true });
    this.#stage.setPointerCapture(event.pointerId);
    this.#pointer = event;
    this.#moveTo(this.#groundAt(event));
    this.#put();
  }

  #onMove(event: PointerEvent): void {
    if (this.#isMoved) return;
    if (!this.#way || event.pointerId !== this.#pointer?.pointerId) {
      if (event.buttons === 0) this.#moveTo(this.#groundAt(event));
      return;
    }
    this.#take(event);
    const all = event.getCoalescedEvents();
    for (const one of all.length > 0 ? all : [event]) this.#moveTo(this.#groundAt(one));
  }

  #onUp(event: PointerEvent): void {
    if (this.#isMoved) {
      this.#isMoved = !event.isPrimary;
      return;
    }
    if (event.pointerId !== this.#pointer?.pointerId) return;
    this.#take(event);
    this.#lift(true);
  }

  /** The browser took a pointer: nothing of it is kept, and without the first finger the picture is not moved any more. */
  #onCancel(event: PointerEvent): void {
    if (event.isPrimary) this.#isMoved = false;
    if (event.pointerId === this.#pointer?.pointerId) this.#lift(false);
  }

  /** A brush that is down stays where it left the picture. */
  #leave(): void {
    if (!this.#way) this.#at = null;
  }

  /** `arrows`: the keys that move the brush. */
  #onKey(event: KeyboardEvent, arrows: Partial<typeof ARROWS>): void {
    const { key } = event;
    if (hasModifier(event)) return;
    const arrow = arrows[key];
    const { imageWidth, imageHeight } = this.#store.params;
    const middle: [number, number] = [0.5, (0.5 * imageHeight) / imageWidth];
    if (arrow) {
      const step = KEY_STEP * this.brush.width * (event.shiftKey ? 4 : 1);
      const [x, y] = this.#at ?? middle;
      this.#moveTo([x + step * arrow[0], y + step * arrow[1]]);
    } else if (key === ' ' && arrows === ARROWS) {
      this.#at ??= middle;
      const isDown = this.#way !== null;
      if (isDown) this.#lift(true);
      else this.#put();
      this.said = isDown ? 'up' : 'down';
      this.show();
    } else if (key === '[' || key === ']') this.setBrush({ width: this.brush.width * (key === ']' ? BRUSH_STEP : 1 / BRUSH_STEP) });
    else if (key !== 'Escape') return;
    else if (this.#way) this.#lift(false);
    else this.end();
    this.#take(event);
  }

  /** Neither the camera's nor the page's. */
  #take(event: Event): void {
    event.preventDefault();
    event.stopImmediatePropagation();
  }

  #groundAt({ clientX, clientY }: PointerEvent): [number, number] | null {
    const { left, top, width, height } = this.#stage.getBoundingClientRect();
    const { camera, aspect, isPlan } = this.#seen;
    const point = groundPoint(camera, (2 * (clientX - left)) / width - 1, 1 - (2 * (clientY - top)) / height, aspect, isPlan);
    const { imageWidth } = this.#store.params;
    return point && [point[0] / imageWidth, point[1] / imageWidth];
  }

  #moveTo(at: [number, number] | null): void {
    this.#at = at;
    if (at) this.#way?.push(...at);
  }

  #put(): void {
    if (this.#at) this.#way = [...this.#at];
  }

  /** The brush is lifted: what it painted is kept, or not. */
  #lift(isKept: boolean): void {
    const way = this.#way;
    this.#way = null;
    this.#pointer = null;
    if (!way || !isKept) return;
    const { params } = this.#store;
    try {
      const strokes = strokesToText([...this.#painted(), strokeAlong(this.brush, way)]);
      this.#store.edit({ ...params, strokes });
    } catch (thrown) {
      this.#store.say((language) => errorText(language, errorInfo(thrown)), true);
    }
  }

  /** The strokes that there are. */
  #painted(): readonly Stroke[] {
    const { strokes: text = '' } = this.#store.params;
    if (text !== this.#strokes.text) this.#strokes = { text, list: strokesOfText(text) };
    return this.#strokes.list;
  }

  /** Once a frame, since the camera may move by itself: draws anew what has changed. */
  #frame = (): void => {
    if (this.#listening.signal.aborted) return;
    if (!this.#element.isConnected) {
      this.end();
      return;
    }
    const { clientWidth, clientHeight } = this.#stage;
    const { imageWidth, strokes } = this.#store.params;
    const state = JSON.stringify([this.#seen, clientWidth, clientHeight, imageWidth, strokes, this.brush, this.#at, this.#way?.length]);
    if (state !== this.#drawn) this.#draw(clientWidth, clientHeight);
    this.#drawn = state;
    (this.#element.ownerDocument.defaultView ?? window).requestAnimationFrame(this.#frame);
  };

  #draw(width: number, height: number): void {
    const canvas = this.#canvas;
    const ratio = this.#element.ownerDocument.defaultView?.devicePixelRatio ?? 1;
    [canvas.width, canvas.height] = [Math.round(width * ratio), Math.round(height * ratio)];
    const context = canvas.getContext('2d');
    if (!context) return;
    const seen = this.#seen;
    const { imageWidth } = this.#store.params;
    const path = (stroke: Pick<Stroke, 'width' | 'points'>): Path2D => {
      const shape = new Path2D();
      for (const corners of shapeOf(stroke, imageWidth, seen)) {
        const polygon = new Path2D();
        for (const [x, y] of corners) polygon.lineTo(((x + 1) / 2) * canvas.width, ((1 - y) / 2) * canvas.height);
        polygon.closePath();
        shape.addPath(polygon);
      }
      return shape;
    };
    for (const stroke of this.#painted()) {
      context.fillStyle = `rgb(${COLORS[stroke.mode]} / 26%)`;
      context.fill(path(stroke));
    }
    const { mode, width: across } = this.brush;
    if (this.#way) {
      context.fillStyle = `rgb(${COLORS[mode]} / 55%)`;
      context.fill(path({ width: across, points: this.#way }));
    }
    if (!this.#at) return;
    const ring = path({ width: across, points: this.#at });
    context.lineWidth = 3.5 * ratio;
    context.strokeStyle = 'rgb(0 0 0 / 55%)';
    context.stroke(ring);
    context.lineWidth = 1.5 * ratio;
    context.strokeStyle = '#fff';
    context.stroke(ring);
  }
}
