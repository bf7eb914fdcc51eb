/**
 * What marks the bases of colonies on the picture: a handle each, which is dragged along the log, moved by arrow keys, and removed.
 *
 * A click on the log, or Enter while the picture has the focus, places another base.
 */

import { addStyles } from '../base/document-styles.ts';
import { project, rayThrough } from '../scene/camera/pick.ts';
import type { Language } from '../base/language.ts';
import type { CameraState } from '../base/view.ts';
import { sayBase } from './words.ts';

type Vector = [number, number, number];

export interface HandlesOwner {
  /** Holds the picture and the focus. */
  stage: HTMLElement;
  camera: () => CameraState;
  aspect: () => number;
  language: () => Language;
  /** Whether bases may be changed. */
  isEditable: () => boolean;
  /** Where the bases are, in the world. */
  bases: () => readonly Vector[];
  /** The log's surface on a ray; null beside it. */
  surface: (ray: ReturnType<typeof rayThrough>) => Vector | null;
  place: (point: Vector) => void;
  move: (index: number, point: Vector) => void;
  remove: (index: number) => void;
  /** A drag begins or ends: what lies between is one step of undo. */
  hold: (isHeld: boolean) => void;
}

/** A press that goes farther, or lasts longer, is a drag. */
const CLICK_PX = 5;
const CLICK_MS = 500;
/** The second of two clicks belongs to the first. */
const DOUBLE_MS = 400;
/** CSS px for each press of an arrow key. */
const KEY_STEP = 10;
const ARROWS: Readonly<Record<string, readonly [number, number]>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
};

const STYLES = `
.handles { position: absolute; inset: 0; overflow: hidden; pointer-events: none; opacity: 0; transition: opacity .15s }
:host(:hover) .handles, .handles:focus-within, .handles.is-held { opacity: 1 }
@media (hover: none) { .handles { opacity: 1 } }
@media (prefers-reduced-motion: reduce) { .handles { transition: none } }
.handle {
  position: absolute; left: 0; top: 0; width: 28px; height: 28px; margin: -14px; padding: 0; border: 0; background: none; cursor: grab;
  pointer-events: auto; touch-action: none; color-scheme: light;
}
.handle::before {
  content: ''; position: absolute; inset: 7px; border-radius: 50%; border: 2px solid #fff; background: rgb(20 20 24 / .35);
  box-shadow: 0 0 0 1.5px rgb(20 20 24 / .75), inset 0 0 0 1px rgb(20 20 24 / .5);
}
.handle:hover::before, .handle:active::before { inset: 5px }
.handle:active { cursor: grabbing }
.handle:focus-visible { outline: none }
.handle:focus-visible::before { inset: 5px; border-color: var(--rock-field-accent, Highlight) }
.handle:disabled { display: none }
@media (pointer: coarse) { .handle { width: 44px; height: 44px; margin: -22px } .handle::before { inset: 14px } .handle:active::before { inset: 11px } }
:host([editable]) .stage.is-over-log { cursor: crosshair }
`;

export class BaseHandles {
  readonly #owner: HandlesOwner;
  readonly #box = document.createElement('div');
  #pressed: { x: number; y: number; at: number } | null = null;
  #placedAt = -Infinity;

  constructor(root: ShadowRoot, owner: HandlesOwner, signal: AbortSignal) {
    this.#owner = owner;
    this.#box.className = 'handles';
    this.#box.setAttribute('part', 'handles');
    addStyles(root, STYLES);
    owner.stage.after(this.#box);
    const { stage } = owner;
    stage.addEventListener('pointerdown', (event) => this.#press(event), { signal });
    stage.addEventListener('pointerup', (event) => this.#release(event), { signal });
    stage.addEventListener('pointermove', (event) => this.#hover(event), { signal });
    stage.addEventListener('keydown', (event) => this.#key(event), { signal });
    // Two clicks on the log are no wish to see everything.
    stage.addEventListener('dblclick', (event) => this.#isEditable && this.#pick(event) && event.stopImmediatePropagation(), {
      signal,
      capture: true,
    });
    signal.addEventListener('abort', () => this.#box.remove());
  }

  get #isEditable(): boolean {
    return this.#owner.isEditable();
  }

  /** Puts the handles where the bases are in the picture. */
  update(): void {
    const { bases, camera, aspect, language } = this.#owner;
    const places = this.#isEditable ? bases() : [];
    while (this.#box.childElementCount > places.length) this.#box.lastElementChild?.remove();
    while (this.#box.childElementCount < places.length) this.#box.append(this.#made(this.#box.childElementCount));
    const { clientWidth, clientHeight } = this.#owner.stage;
    const eye = camera();
    places.forEach((place, index) => {
      const handle = this.#box.children[index] as HTMLButtonElement;
      const at = project(eye, place, aspect());
      handle.disabled = at === null;
      if (at)
        handle.style.transform = `translate(${(((at[0] + 1) * clientWidth) / 2).toFixed(1)}px, ${(((1 - at[1]) * clientHeight) / 2).toFixed(1)}px)`;
      handle.ariaLabel = sayBase(language(), index + 1, places.length);
      handle.title = handle.ariaLabel;
    });
  }

  focus(index: number): void {
    (this.#box.children[index] as HTMLElement | undefined)?.focus();
  }

  #made(index: number): HTMLButtonElement {
    const handle = document.createElement('button');
    handle.type = 'button';
    handle.className = 'handle';
    handle.addEventListener('pointerdown', (event) => this.#drag(handle, index, event));
    handle.addEventListener('keydown', (event) => this.#keyOf(handle, index, event));
    return handle;
  }

  #drag(handle: HTMLButtonElement, index: number, down: PointerEvent): void {
    if (down.button !== 0) return;
    down.stopPropagation();
    handle.setPointerCapture(down.pointerId);
    const listening = new AbortController();
    const { signal } = listening;
    const end = (): void => {
      listening.abort();
      this.#box.classList.remove('is-held');
      this.#owner.hold(false);
    };
    this.#box.classList.add('is-held');
    this.#owner.hold(true);
    handle.addEventListener(
      'pointermove',
      (event) => {
        const point = this.#pick(event);
        if (point) this.#owner.move(index, point);
      },
      { signal },
    );
    for (const type of ['pointerup', 'pointercancel', 'lostpointercapture'] as const) handle.addEventListener(type, end, { signal });
  }

  #keyOf(handle: HTMLButtonElement, index: number, event: KeyboardEvent): void {
    const step = ARROWS[event.key];
    if (event.altKey || event.ctrlKey || event.metaKey) return;
    if (event.key === 'Delete' || event.key === 'Backspace') {
      this.#owner.remove(index);
      this.focus(Math.max(0, index - 1));
    } else if (step) {
      const { left, top, width, height } = handle.getBoundingClientRect();
      const far = event.shiftKey ? 4 : 1;
      const point = this.#pick({
        clientX: left + width / 2 + far * KEY_STEP * step[0],
        clientY: top + height / 2 + far * KEY_STEP * step[1],
      });
      if (point) this.#owner.move(index, point);
    } else return;
    event.preventDefault();
    event.stopPropagation();
  }

  #press({ button, isPrimary, clientX: x, clientY: y, timeStamp: at }: PointerEvent): void {
    this.#pressed = button === 0 && isPrimary ? { x, y, at } : null;
  }

  #release(event: PointerEvent): void {
    const pressed = this.#pressed;
    this.#pressed = null;
    if (!pressed || !this.#isEditable || event.timeStamp - pressed.at > CLICK_MS) return;
    if (Math.hypot(event.clientX - pressed.x, event.clientY - pressed.y) > CLICK_PX || event.timeStamp - this.#placedAt < DOUBLE_MS) return;
    const point = this.#pick(event);
    if (!point) return;
    this.#placedAt = event.timeStamp;
    this.#owner.place(point);
  }

  #hover(event: PointerEvent): void {
    if (event.buttons !== 0 || event.pointerType === 'touch') return;
    this.#owner.stage.classList.toggle('is-over-log', this.#isEditable && this.#pick(event) !== null);
  }

  /** In the middle of the picture, for those who point at nothing. */
  #key(event: KeyboardEvent): void {
    if (event.key !== 'Enter' || event.target !== this.#owner.stage || !this.#isEditable) return;
    const point = this.#owner.surface(rayThrough(this.#owner.camera(), 0, 0, this.#owner.aspect()));
    if (point) this.#owner.place(point);
    event.preventDefault();
  }

  #pick({ clientX, clientY }: { clientX: number; clientY: number }): Vector | null {
    const { left, top, width, height } = this.#owner.stage.getBoundingClientRect();
    const [x, y] = [(2 * (clientX - left)) / width - 1, 1 - (2 * (clientY - top)) / height];
    return this.#owner.surface(rayThrough(this.#owner.camera(), x, y, this.#owner.aspect()));
  }
}
