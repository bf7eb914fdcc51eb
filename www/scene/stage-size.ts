/** How large the picture is on the screen, in device pixels, and how large it may be drawn. */

import { MAX_PIXELS } from '../renderer/limits.ts';

export class StageSize {
  width = 0;
  height = 0;
  readonly #view: Window & typeof globalThis;
  #stage: HTMLElement;
  #changed: () => void;

  /** Calls `changed` after every change until `signal` is aborted. */
  constructor(stage: HTMLElement, changed: () => void, signal: AbortSignal) {
    this.#stage = stage;
    this.#changed = changed;
    this.#view = stage.ownerDocument.defaultView ?? window;
    const observer = new this.#view.ResizeObserver((entries) => entries.forEach((entry) => this.#onResize(entry)));
    try {
      observer.observe(stage, { box: 'device-pixel-content-box' });
    } catch {
      // Safari: CSS pixels times the ratio, which may change without a change of size.
      observer.observe(stage);
      this.#view.addEventListener('resize', () => this.measure(), { signal });
    }
    signal.addEventListener('abort', () => observer.disconnect());
  }

  get isEmpty(): boolean {
    return this.width === 0 || this.height === 0;
  }

  get aspect(): number {
    return this.isEmpty ? 2 : this.width / this.height;
  }

  /** What the canvas is to have. */
  get pixels(): [number, number] {
    const scale = Math.min(1, Math.sqrt(MAX_PIXELS / Math.max(1, this.width * this.height)));
    return [Math.max(1, Math.floor(this.width * scale)), Math.max(1, Math.floor(this.height * scale))];
  }

  /** Device pixels in a CSS pixel of the stage, which CSS may `zoom`. */
  get ratio(): number {
    return (this.#view.devicePixelRatio || 1) * ((this.#stage as { currentCSSZoom?: number }).currentCSSZoom ?? 1);
  }

  measure(): void {
    this.#set(Math.round(this.#stage.clientWidth * this.ratio), Math.round(this.#stage.clientHeight * this.ratio));
  }

  #onResize(entry: ResizeObserverEntry): void {
    // Out of the document everything is 0 × 0; it is told again on the way back in.
    if (!this.#stage.isConnected) return;
    const { ratio } = this;
    const { width, height } = entry.contentRect;
    const exact = entry.devicePixelContentBoxSize?.[0];
    // Developer tools that pretend another ratio leave this box in CSS pixels.
    if (exact && Math.abs(exact.inlineSize - width * ratio) < 2) this.#set(exact.inlineSize, exact.blockSize);
    else this.#set(Math.round(width * ratio), Math.round(height * ratio));
  }

  #set(width: number, height: number): void {
    this.width = width;
    this.height = height;
    this.#changed();
  }
}
