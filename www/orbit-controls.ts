/** Mouse, touch and keys to camera moves on one element. Holds no camera and draws nothing. */

import { orbit, pan, zoom } from './camera.ts';
import type { CameraState } from './renderer/renderer.ts';

export interface OrbitControlsOptions {
  /** After every move the user made. */
  onInteract?: () => void;
  /** Double-click, Home or F. */
  onFrameAll?: () => void;
  /** True while a plan is shown: dragging pans, nothing turns. */
  isPlan?: () => boolean;
}

/** Half a turn per picture height. */
const TURN_PER_HEIGHT = Math.PI;
const KEY_TURN = (5 * Math.PI) / 180;
/** Of the picture's height. */
const KEY_PAN = 0.08;
const KEY_ZOOM = 1.15;
/** A mouse wheel's notch is about 100 px: a fifth closer or farther. */
const WHEEL_RATE = 0.0022;
/** What a wheel's unit is worth in px: pixel, line, page. */
const WHEEL_UNIT_PX = [1, 16, 400];

export class OrbitControls {
  readonly #element: HTMLElement;
  readonly #getCamera: () => CameraState;
  readonly #setCamera: (camera: CameraState) => void;
  readonly #options: OrbitControlsOptions;
  readonly #listening = new AbortController();
  readonly #pointers = new Map<number, { x: number; y: number }>();
  readonly #touchAction: string;

  constructor(
    element: HTMLElement,
    getCamera: () => CameraState,
    setCamera: (camera: CameraState) => void,
    options: OrbitControlsOptions = {},
  ) {
    this.#element = element;
    this.#getCamera = getCamera;
    this.#setCamera = setCamera;
    this.#options = options;
    this.#touchAction = element.style.touchAction;
    element.style.touchAction = 'none';
    const { signal } = this.#listening;
    element.addEventListener('pointerdown', this.#onDown, { signal });
    element.addEventListener('pointermove', this.#onMove, { signal });
    element.addEventListener('pointerup', this.#onUp, { signal });
    element.addEventListener('pointercancel', this.#onUp, { signal });
    element.addEventListener('lostpointercapture', this.#onUp, { signal });
    element.addEventListener('wheel', this.#onWheel, { signal, passive: false });
    element.addEventListener('keydown', this.#onKey, { signal });
    element.addEventListener('dblclick', this.#onDouble, { signal });
    element.addEventListener('contextmenu', (event) => event.preventDefault(), { signal });
  }

  /** Removes every listener and gives the element its own touch behaviour back. */
  dispose(): void {
    this.#listening.abort();
    this.#pointers.clear();
    this.#element.style.touchAction = this.#touchAction;
  }

  #move(camera: CameraState): void {
    this.#setCamera(camera);
    this.#options.onInteract?.();
  }

  get #plan(): boolean {
    return this.#options.isPlan?.() ?? false;
  }

  get #height(): number {
    return Math.max(this.#element.clientHeight, 1);
  }

  get #aspect(): number {
    return Math.max(this.#element.clientWidth, 1) / this.#height;
  }

  /** Client coordinates to the picture's, -1…1. */
  #inPicture(x: number, y: number): [number, number] {
    const box = this.#element.getBoundingClientRect();
    return [
      (2 * (x - box.left)) / Math.max(box.width, 1) - 1,
      1 - (2 * (y - box.top)) / Math.max(box.height, 1),
    ];
  }

  #onDown = (event: PointerEvent): void => {
    this.#pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    this.#element.focus({ preventScroll: true });
    try {
      this.#element.setPointerCapture(event.pointerId);
    } catch {
      // The pointer is already gone, or was made by a script: the drag works without capture.
    }
  };

  #onUp = (event: PointerEvent): void => {
    this.#pointers.delete(event.pointerId);
  };

  #onMove = (event: PointerEvent): void => {
    const last = this.#pointers.get(event.pointerId);
    if (!last) return;
    const now = { x: event.clientX, y: event.clientY };
    const other = [...this.#pointers].find(([id]) => id !== event.pointerId)?.[1];
    this.#pointers.set(event.pointerId, now);
    if (other) {
      this.#pinch(last, now, other);
      return;
    }
    const [dx, dy] = [now.x - last.x, now.y - last.y];
    if (dx === 0 && dy === 0) return;
    const pans = this.#plan || event.shiftKey || (event.buttons & 6) !== 0;
    const camera = this.#getCamera();
    if (pans) {
      this.#move(pan(camera, dx, dy, this.#height, this.#plan));
    } else {
      const rate = TURN_PER_HEIGHT / this.#height;
      this.#move(orbit(camera, -dx * rate, dy * rate));
    }
  };

  /** One of two fingers moved: their middle drags the ground, their distance zooms about the middle. */
  #pinch(
    last: { x: number; y: number },
    now: { x: number; y: number },
    other: { x: number; y: number },
  ): void {
    const before = Math.hypot(last.x - other.x, last.y - other.y);
    const after = Math.hypot(now.x - other.x, now.y - other.y);
    const moved = pan(
      this.#getCamera(),
      (now.x - last.x) / 2,
      (now.y - last.y) / 2,
      this.#height,
      this.#plan,
    );
    const middle = this.#inPicture((now.x + other.x) / 2, (now.y + other.y) / 2);
    const factor = before / Math.max(after, 1);
    this.#move(zoom(moved, factor, middle, this.#aspect, this.#plan));
  }

  #onWheel = (event: WheelEvent): void => {
    event.preventDefault();
    const px = event.deltaY * (WHEEL_UNIT_PX[event.deltaMode] ?? 1);
    // A trackpad's pinch arrives as a wheel with ctrl held, in much smaller steps.
    const rate = event.ctrlKey ? 5 * WHEEL_RATE : WHEEL_RATE;
    const factor = Math.exp(Math.min(1, Math.max(-1, px * rate)));
    const about = this.#inPicture(event.clientX, event.clientY);
    this.#move(zoom(this.#getCamera(), factor, about, this.#aspect, this.#plan));
  };

  #onDouble = (event: MouseEvent): void => {
    event.preventDefault();
    this.#options.onFrameAll?.();
  };

  #onKey = (event: KeyboardEvent): void => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const moved = this.#byKey(event.key, event.shiftKey);
    if (!moved) return;
    event.preventDefault();
    if (moved === 'frame') this.#options.onFrameAll?.();
    else this.#move(moved);
  };

  #byKey(key: string, shift: boolean): CameraState | 'frame' | null {
    const camera = this.#getCamera();
    const plan = this.#plan;
    const arrow = ARROWS[key];
    if (arrow) {
      const [x, y] = arrow;
      if (!shift && !plan) return orbit(camera, x * KEY_TURN, y * KEY_TURN);
      const step = KEY_PAN * this.#height;
      return pan(camera, -x * step, y * step, this.#height, plan);
    }
    switch (key) {
      case '+':
      case '=':
        return zoom(camera, 1 / KEY_ZOOM, [0, 0], this.#aspect, plan);
      case '-':
      case '_':
        return zoom(camera, KEY_ZOOM, [0, 0], this.#aspect, plan);
      case 'Home':
      case 'f':
      case 'F':
        return 'frame';
      default:
        return null;
    }
  }
}

/** Right and up. */
const ARROWS: Record<string, readonly [number, number]> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};
