/** Mouse, touch and keys of somebody who walks. Moves the walker, and draws nothing. */

import { fovOf } from '../../base/fov.ts';
import { groundPoint } from './camera.ts';
import { Fingers } from './gesture.ts';
import type { Walker } from './walker.ts';

export interface WalkOptions {
  /** The walker has moved, or is about to: a frame is wanted. */
  onMove: () => void;
  /** Escape. */
  onLeave: () => void;
  /** Whether a wheel is the picture's though it has not the focus. */
  takesWheel: () => boolean;
  /** Whether one goes to a place at once instead of walking there. */
  isStill: () => boolean;
}

/** Heights of the eye a second: a walk. */
const PACE = 0.9;
/** As many times as fast: with Shift, and on the way to a place. */
const RUN = 2.5;
/** Radians a second. */
const TURN = Math.PI / 2;
/** Heights of the eye for a drag of two fingers over the picture's height, and for a notch of the wheel. */
const DRAG = 4;
const NOTCH = 0.25;
const NOTCH_PX = 100;
/** What a wheel's unit is worth in px: pixel, line, page. */
const WHEEL_UNIT_PX = [1, 16, 400];
/** A device that draws slowly goes as fast as others; a tab that was hidden goes on where it was. */
const LONGEST_STEP_MS = 500;

/** What a key does each second: goes ahead and to the right, turns to the left and down. By its place on the keyboard, whatever it types. */
const KEYS: Record<string, readonly [ahead: number, right: number, left: number, down: number]> = {
  KeyW: [1, 0, 0, 0],
  KeyS: [-1, 0, 0, 0],
  KeyA: [0, -1, 0, 0],
  KeyD: [0, 1, 0, 0],
  ArrowUp: [1, 0, 0, 0],
  ArrowDown: [-1, 0, 0, 0],
  ArrowLeft: [0, 0, 1, 0],
  ArrowRight: [0, 0, -1, 0],
  PageUp: [0, 0, 0, -0.5],
  PageDown: [0, 0, 0, 0.5],
};

export class WalkControls {
  readonly #element: HTMLElement;
  readonly #walker: Walker;
  readonly #options: WalkOptions;
  readonly #touchAction: string;
  readonly #listening = new AbortController();
  readonly #held = new Set<string>();
  readonly #pointers = new Map<number, { x: number; y: number }>();
  readonly #fingers = new Fingers();
  #runs = false;
  #byMouse = true;
  /** Where it is going by itself. */
  #goal: readonly [number, number] | null = null;
  #last: number | undefined;

  constructor(element: HTMLElement, walker: Walker, options: WalkOptions) {
    this.#element = element;
    this.#walker = walker;
    this.#options = options;
    this.#touchAction = element.style.touchAction;
    element.style.touchAction = 'none';
    const { signal } = this.#listening;
    element.addEventListener('keydown', this.#onKey, { signal });
    element.addEventListener('keyup', ({ code }) => this.#held.delete(code), { signal });
    // What is let go while something else has the focus is not heard.
    element.addEventListener('blur', () => this.#held.clear(), { signal });
    element.addEventListener('pointerdown', this.#onDown, { signal });
    element.addEventListener('pointermove', this.#onMove, { signal });
    element.addEventListener('pointerup', this.#onUp, { signal });
    element.addEventListener('pointercancel', ({ pointerId }) => this.#lose(pointerId), { signal });
    element.addEventListener('wheel', this.#onWheel, { signal, passive: false });
    element.addEventListener('dblclick', this.#onDouble, { signal });
    element.addEventListener('contextmenu', (event) => event.preventDefault(), { signal });
  }

  /** Removes every listener and gives the element its own touch behaviour back. */
  dispose(): void {
    this.#listening.abort();
    for (const id of this.#pointers.keys()) if (this.#element.hasPointerCapture(id)) this.#element.releasePointerCapture(id);
    this.#element.style.touchAction = this.#touchAction;
  }

  /** On to the frame at `now`. True while there is more to come. */
  advance(now: number): boolean {
    if (this.#held.size === 0 && !this.#goal) {
      this.#last = undefined;
      return false;
    }
    const seconds = this.#last === undefined ? 0 : Math.min(LONGEST_STEP_MS, now - this.#last) / 1000;
    this.#last = now;
    const [ahead, right, left, down] = [0, 1, 2, 3].map((k) => [...this.#held].reduce((sum, code) => sum + KEYS[code]![k]!, 0)) as [
      number,
      number,
      number,
      number,
    ];
    const pace = PACE * this.#walker.eye * seconds;
    if (ahead !== 0 || right !== 0) {
      this.#goal = null;
      const share = (pace * (this.#runs ? RUN : 1)) / Math.hypot(ahead, right);
      this.#walker.go(ahead * share, right * share);
    }
    this.#walker.look(left * TURN * seconds, down * TURN * seconds);
    if (this.#goal) this.#approach(this.#goal, RUN * pace);
    return true;
  }

  #approach(goal: readonly [number, number], pace: number): void {
    const [ahead, right] = this.#walker.wayTo(...goal);
    const share = pace / Math.max(pace, Math.hypot(ahead, right), 1e-9);
    this.#walker.go(ahead * share, right * share);
    if (share === 1) this.#goal = null;
  }

  get #height(): number {
    return Math.max(this.#element.clientHeight, 1);
  }

  #onKey = (event: KeyboardEvent): void => {
    const { code, key } = event;
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (key !== 'Escape' && !KEYS[code]) return;
    event.preventDefault();
    if (key === 'Escape') {
      this.#options.onLeave();
      return;
    }
    this.#runs = event.shiftKey;
    this.#held.add(code);
    this.#options.onMove();
  };

  #onDown = (event: PointerEvent): void => {
    const { pointerId, clientX: x, clientY: y } = event;
    this.#byMouse = event.pointerType === 'mouse';
    this.#pointers.set(pointerId, { x, y });
    if (!this.#byMouse) this.#fingers.down(pointerId, x, y, event.timeStamp, true);
    this.#element.focus({ preventScroll: true });
    try {
      this.#element.setPointerCapture(pointerId);
    } catch {
      // The pointer is already gone, or was made by a script: the drag works without capture.
    }
  };

  #onMove = (event: PointerEvent): void => {
    const last = this.#pointers.get(event.pointerId);
    if (!last) return;
    const [dx, dy] = [event.clientX - last.x, event.clientY - last.y];
    this.#pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    if (!this.#byMouse) this.#fingers.move(event.pointerId, event.clientX, event.clientY);
    if (dx === 0 && dy === 0) return;
    this.#goal = null;
    if (this.#pointers.size > 1) {
      // The ground follows the middle of the fingers.
      const rate = (DRAG * this.#walker.eye) / this.#height / this.#pointers.size;
      this.#walker.go(dy * rate, -dx * rate);
    } else {
      const rate = fovOf(this.#walker.camera) / this.#height;
      this.#walker.look(dx * rate, -dy * rate);
    }
    this.#options.onMove();
  };

  #onUp = (event: PointerEvent): void => {
    this.#pointers.delete(event.pointerId);
    if (this.#fingers.up(event.pointerId, event.timeStamp)) this.#goThere(event);
  };

  #lose(id: number): void {
    this.#pointers.delete(id);
    this.#fingers.cancel(id);
  }

  #onWheel = (event: WheelEvent): void => {
    const { activeElement } = this.#element.getRootNode() as Document | ShadowRoot;
    if (!this.#options.takesWheel() && activeElement !== this.#element) return;
    event.preventDefault();
    const notches = (event.deltaY * (WHEEL_UNIT_PX[event.deltaMode] ?? 1)) / NOTCH_PX;
    this.#walker.go(-NOTCH * this.#walker.eye * Math.min(4, Math.max(-4, notches)), 0);
    this.#options.onMove();
  };

  /** The mouse's alone: two taps are counted by `Fingers`. */
  #onDouble = (event: MouseEvent): void => {
    event.preventDefault();
    if (this.#byMouse) this.#goThere(event);
  };

  /** To the ground under a point of the picture; nowhere for one of the sky. */
  #goThere({ clientX, clientY }: MouseEvent): void {
    const { left, top, width, height } = this.#element.getBoundingClientRect();
    const [x, y] = [(2 * (clientX - left)) / Math.max(width, 1) - 1, 1 - (2 * (clientY - top)) / Math.max(height, 1)];
    const place = groundPoint(this.#walker.camera, x, y, width / Math.max(height, 1));
    if (!place) return;
    if (this.#options.isStill()) this.#walker.goTo(...place);
    else this.#goal = place;
    this.#options.onMove();
  }
}
