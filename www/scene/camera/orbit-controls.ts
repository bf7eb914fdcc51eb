/**
 * Mouse, touch and keys to camera moves on one element. Holds no camera and draws nothing.
 *
 * A picture stands on a page that scrolls: unless told otherwise it takes only what is surely meant for it, see `Interaction`.
 */

import { orbit, pan, zoom } from './moves.ts';
import type { CameraState, Interaction } from '../../base/view.ts';
import { Fingers } from './gesture.ts';

export interface OrbitControlsOptions {
  /** After every move the user made. */
  onInteract?: () => void;
  /** Double-click, double tap, Home or F. */
  onFrameAll?: () => void;
  /** True while a plan is shown: dragging pans, nothing turns. */
  isPlan?: () => boolean;
  /** Whose gestures are, `cooperative` by default. After a change, call `refresh`. */
  interaction?: () => Interaction;
  /** A gesture was left to the page: the time to say how to move the picture. At most once a second. */
  onRefused?: (gesture: 'wheel' | 'touch') => void;
}

/** What the browser may do itself with fingers on the picture. */
const TOUCH_ACTION: Record<Interaction, string> = { cooperative: 'pan-y', always: 'none', none: 'auto' };

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
/** With ctrl held no step is larger than a mouse wheel's notch: it may be a pinch, or a wheel. */
const PINCH_STEP = 100 * WHEEL_RATE;
const REFUSAL_PAUSE_MS = 1000;

export class OrbitControls {
  readonly #element: HTMLElement;
  readonly #getCamera: () => CameraState;
  readonly #setCamera: (camera: CameraState) => void;
  readonly #options: OrbitControlsOptions;
  readonly #touchAction: string;
  #interaction: Interaction | undefined;
  #listening: AbortController | undefined;
  readonly #pointers = new Map<number, { x: number; y: number }>();
  readonly #fingers = new Fingers();
  #byMouse = true;
  #refusedAt = -Infinity;

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
    this.refresh();
  }

  /** Asks `interaction` again. A change ends what the fingers are doing. */
  refresh(): void {
    const interaction = this.#options.interaction?.() ?? 'cooperative';
    if (interaction === this.#interaction) return;
    this.#stop();
    this.#interaction = interaction;
    this.#element.style.touchAction = TOUCH_ACTION[interaction];
    if (interaction !== 'none') this.#listen();
  }

  /** Removes every listener and gives the element its own touch behaviour back. */
  dispose(): void {
    this.#stop();
    this.#element.style.touchAction = this.#touchAction;
  }

  #listen(): void {
    this.#listening = new AbortController();
    const { signal } = this.#listening;
    const element = this.#element;
    element.addEventListener('pointerdown', this.#onDown, { signal });
    element.addEventListener('pointermove', this.#onMove, { signal });
    element.addEventListener('pointerup', this.#onUp, { signal });
    element.addEventListener('pointercancel', this.#onCancel, { signal });
    element.addEventListener('lostpointercapture', this.#onLost, { signal });
    element.addEventListener('touchmove', this.#onTouchMove, { signal, passive: false });
    element.addEventListener('wheel', this.#onWheel, { signal, passive: false });
    element.addEventListener('keydown', this.#onKey, { signal });
    element.addEventListener('dblclick', this.#onDouble, { signal });
    element.addEventListener('mousedown', this.#onMouseDown, { signal });
    element.addEventListener('contextmenu', (event) => event.preventDefault(), { signal });
  }

  #stop(): void {
    this.#listening?.abort();
    for (const id of this.#pointers.keys()) {
      if (this.#element.hasPointerCapture(id)) this.#element.releasePointerCapture(id);
    }
    this.#pointers.clear();
    this.#fingers.clear();
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
    return [(2 * (x - box.left)) / Math.max(box.width, 1) - 1, 1 - (2 * (y - box.top)) / Math.max(box.height, 1)];
  }

  /** Whether the keyboard's focus is on the picture, in a window that has it. */
  get #isFocused(): boolean {
    const { activeElement } = this.#element.getRootNode() as Document | ShadowRoot;
    return activeElement !== null && this.#element.contains(activeElement) && this.#element.ownerDocument.hasFocus();
  }

  #refuse(gesture: 'wheel' | 'touch', time: number): void {
    if (time - this.#refusedAt < REFUSAL_PAUSE_MS) return;
    this.#refusedAt = time;
    this.#options.onRefused?.(gesture);
  }

  #onDown = (event: PointerEvent): void => {
    const { pointerId, clientX: x, clientY: y } = event;
    this.#byMouse = event.pointerType === 'mouse';
    this.#pointers.set(pointerId, { x, y });
    const atOnce = this.#interaction === 'always';
    if (this.#byMouse || this.#fingers.down(pointerId, x, y, event.timeStamp, atOnce) !== 'wait') this.#focus();
    try {
      this.#element.setPointerCapture(pointerId);
    } catch {
      // The pointer is already gone, or was made by a script: the drag works without capture.
    }
  };

  #focus(): void {
    this.#element.focus({ preventScroll: true });
  }

  #onUp = (event: PointerEvent): void => {
    this.#pointers.delete(event.pointerId);
    if (this.#fingers.up(event.pointerId, event.timeStamp)) this.#options.onFrameAll?.();
  };

  #onCancel = (event: PointerEvent): void => {
    this.#pointers.delete(event.pointerId);
    if (this.#fingers.cancel(event.pointerId)) this.#refuse('touch', event.timeStamp);
  };

  /** Only of this element's capture: a finger's is the canvas's at first, and that is lost to this one. */
  #onLost = (event: PointerEvent): void => {
    if (event.target !== this.#element) return;
    this.#pointers.delete(event.pointerId);
    this.#fingers.cancel(event.pointerId);
  };

  /** Fingers as the browser's scrolling sees them; the pointer events of the same move have been heard before. */
  #onTouchMove = (event: TouchEvent): void => {
    if (event.cancelable && this.#fingers.holdsPage) event.preventDefault();
  };

  #onMove = (event: PointerEvent): void => {
    const last = this.#pointers.get(event.pointerId);
    if (!last) return;
    const now = { x: event.clientX, y: event.clientY };
    const other = [...this.#pointers].find(([id]) => id !== event.pointerId)?.[1];
    this.#pointers.set(event.pointerId, now);
    if (event.pointerType !== 'mouse' && !this.#isMoving(event)) return;
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

  /** Whether this move of a finger is the camera's. The one that decides it is not: the picture would jump by it. */
  #isMoving(event: PointerEvent): boolean {
    const before = this.#fingers.meaning;
    const after = this.#fingers.move(event.pointerId, event.clientX, event.clientY);
    if (before !== 'wait') return after === 'drag' || after === 'pinch';
    if (after === 'drag') this.#focus();
    if (after === 'page') this.#refuse('touch', event.timeStamp);
    return false;
  }

  /** One of two fingers moved: their middle drags the ground, their distance zooms about the middle. */
  #pinch(last: { x: number; y: number }, now: { x: number; y: number }, other: { x: number; y: number }): void {
    const before = Math.hypot(last.x - other.x, last.y - other.y);
    const after = Math.hypot(now.x - other.x, now.y - other.y);
    const moved = pan(this.#getCamera(), (now.x - last.x) / 2, (now.y - last.y) / 2, this.#height, this.#plan);
    const middle = this.#inPicture((now.x + other.x) / 2, (now.y + other.y) / 2);
    const factor = before / Math.max(after, 1);
    this.#move(zoom(moved, factor, middle, this.#aspect, this.#plan));
  }

  #onWheel = (event: WheelEvent): void => {
    const isMeant = this.#interaction === 'always' || event.ctrlKey || event.metaKey || this.#isFocused;
    if (!isMeant) {
      this.#refuse('wheel', event.timeStamp);
      return;
    }
    event.preventDefault();
    const px = event.deltaY * (WHEEL_UNIT_PX[event.deltaMode] ?? 1);
    // A trackpad's pinch arrives as a wheel with ctrl held, in much smaller steps.
    const [rate, limit] = event.ctrlKey ? [5 * WHEEL_RATE, PINCH_STEP] : [WHEEL_RATE, 1];
    const factor = Math.exp(Math.min(limit, Math.max(-limit, px * rate)));
    const about = this.#inPicture(event.clientX, event.clientY);
    this.#move(zoom(this.#getCamera(), factor, about, this.#aspect, this.#plan));
  };

  /** The middle button pans; on a page that scrolls it would begin the browser's own scrolling. */
  #onMouseDown = (event: MouseEvent): void => {
    if (event.button === 1) event.preventDefault();
  };

  /** The mouse's alone: some browsers send it for two taps as well, which are counted by `Fingers`. */
  #onDouble = (event: MouseEvent): void => {
    event.preventDefault();
    if (this.#byMouse) this.#options.onFrameAll?.();
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
