/**
 * What every scene on a page shares: lifecycle, sizing, the canvas and its renderer, pointer and keys, frames, messages.
 *
 * Nothing is loaded before the element stands in a document, and nothing is drawn unless something changed and it can be seen.
 * Moving the element costs nothing: it is torn down only when it has been out of the document for `IDLE_TIMEOUT_MS`.
 * What is loaded lives for one *cycle*, from `open` to `close`; a cycle's number is compared after every await.
 */

import type { ErrorInfo } from './errors.ts';
import { CameraFlight } from './camera-flight.ts';
import { defaultCamera, isPlan } from './camera.ts';
import type { Field } from './field.ts';
import { MessageBox } from './message-box.ts';
import { OrbitControls } from './orbit-controls.ts';
import { loadRenderer } from './renderer/load.ts';
import type { Backend, CameraState, ColorMode, SceneRenderer, SceneStyle, View } from './renderer/renderer.ts';
import { sceneStyles } from './scene-styles.ts';

export type Theme = 'auto' | 'light' | 'dark';

/** How long an element may be out of the document before its worker, device and buffers go. */
export const IDLE_TIMEOUT_MS = 1000;

/** A 4K screen's worth. With 4 samples a pixel takes some 40 bytes, so this is 330 MB on the device. */
const MAX_PIXELS = 3840 * 2160;

/** So many losses within so short a time are no accident: the plan is drawn without the GPU then. */
const MAX_LOSSES = 3;
const LOSS_WINDOW_MS = 30_000;

const WORDS = {
  noGpu: {
    en: 'This browser offers neither WebGPU nor WebGL2 here, so the plan is drawn instead of the rocks.',
    ja: 'WebGPU も WebGL2 も使えないため、立体ではなく平面図を表示しています。',
  },
  role: { en: '3D picture', ja: '立体図' },
} as const;

/** On a server there is no HTMLElement; importing must be silent there, and nobody makes an element. */
const Base = (globalThis.HTMLElement ?? class {}) as typeof HTMLElement;

function errorText(thrown: unknown): string {
  return thrown instanceof Error ? thrown.message : String(thrown);
}

/**
 * @csspart canvas - The picture.
 * @csspart message - What went wrong, while there is something to say.
 * @slot message - Stands in for the text of the message.
 * @cssprop --rock-field-background - Behind the picture, before the first one.
 * @cssprop --rock-field-accent - Focus ring.
 */
export abstract class SceneElement extends Base {
  #stage!: HTMLElement;
  #messages!: MessageBox;

  #cycle = 0;
  #isOpen = false;
  #closing: ReturnType<typeof setTimeout> | undefined;
  /** Ends every listener and observer of the cycle. */
  #listening: AbortController | undefined;
  #controls: OrbitControls | undefined;
  #readiness!: { promise: Promise<void>; resolve: () => void };

  #renderer: SceneRenderer | undefined;
  #losses: number[] = [];
  #restoring = false;
  #painted = false;

  #field: Field | null = null;
  #style: SceneStyle = { view: '3d', color: 'layer', dark: false };
  #theme: Theme = 'auto';
  /** Null while the whole field is framed, whatever its size. */
  #camera: CameraState | null = null;
  #flight: CameraFlight | undefined;

  #width = 0;
  #height = 0;
  #seen = false;
  #dirty = false;
  #frame = 0;

  constructor() {
    super();
    this.#renewReadiness();
    // The fallback class of a server has no shadow root, and no document to build for.
    if (typeof this.attachShadow !== 'function') return;
    const root = this.attachShadow({ mode: 'open' });
    root.adoptedStyleSheets = [sceneStyles()];
    this.#stage = document.createElement('div');
    this.#stage.className = 'stage';
    this.#stage.tabIndex = 0;
    this.#stage.setAttribute('role', 'application');
    this.#messages = new MessageBox();
    root.append(this.#stage, this.#messages.element);
  }

  // What a kind of scene adds.

  /** A cycle begins: ask for what is to be shown. */
  protected abstract opened(): void;
  /** The cycle has ended: let go of everything. */
  protected abstract closed(): void;
  /** Width and height of the ground before there is a field, px. */
  protected abstract groundSize(): [number, number];

  // State that the outside sees.

  /** Resolves when the first picture has been painted; a new promise for every cycle. Stays open while there is none. */
  get ready(): Promise<void> {
    return this.#readiness.promise;
  }

  /** What is shown, the newest finished result. Not to be changed. */
  get field(): Field | null {
    return this.#field;
  }

  /** What draws the picture; null before it is known. */
  get backend(): Backend | null {
    return this.#renderer?.backend ?? null;
  }

  get theme(): Theme {
    return this.#theme;
  }

  set theme(theme: Theme) {
    this.#theme = theme;
    this.#restyle({ dark: this.#isDark() });
  }

  /** Where the eye is. Assigning moves it at once; `null` frames the whole field again. */
  get camera(): CameraState {
    return structuredClone(this.#camera ?? this.defaultCamera);
  }

  set camera(camera: CameraState | null) {
    this.#flight = undefined;
    this.#camera = camera && structuredClone(camera);
    this.invalidate();
  }

  /** The camera that frames the whole field, for the present size and view. */
  get defaultCamera(): CameraState {
    const [width, height] = this.#field ? [this.#field.imageWidth, this.#field.imageHeight] : this.groundSize();
    return defaultCamera(width, height, this.#aspect(), this.#style.view);
  }

  /** Whether the whole field is framed, that is, nobody has moved the camera since. */
  get framed(): boolean {
    return this.#camera === null || this.#flight !== undefined;
  }

  /** Brings the whole field into view, with a short flight unless `animate` is false or the system asks for less motion. */
  frameAll(animate = true): void {
    const to = this.defaultCamera;
    const still = !animate || !this.#canDraw() || matchMedia('(prefers-reduced-motion: reduce)').matches;
    if (still) {
      this.camera = null;
    } else {
      this.#flight = new CameraFlight(this.camera, to, performance.now());
      this.invalidate();
    }
    this.emit('camera-change', { camera: to, framed: true });
  }

  protected get sceneView(): View {
    return this.#style.view;
  }

  protected set sceneView(view: View) {
    this.#restyle({ view });
  }

  protected get sceneColor(): ColorMode {
    return this.#style.color;
  }

  protected set sceneColor(color: ColorMode) {
    this.#restyle({ color });
  }

  /** Shows a field. False when the renderer refused it: that is reported, and the old one stays on screen. */
  protected showField(field: Field): boolean {
    try {
      this.#renderer?.setField(field);
    } catch (thrown) {
      this.report({ name: 'RendererFailed', message: `the field could not be shown: ${errorText(thrown)}` });
      return false;
    }
    this.#field = field;
    this.#clearError();
    this.invalidate();
    return true;
  }

  protected describe(text: string): void {
    this.#stage.setAttribute('aria-label', text);
  }

  /** The page's language, from the nearest `lang`. */
  protected get language(): 'en' | 'ja' {
    const lang = this.closest('[lang]')?.getAttribute('lang') ?? '';
    return lang.toLowerCase().startsWith('ja') ? 'ja' : 'en';
  }

  protected emit(type: string, detail: unknown = null): void {
    this.dispatchEvent(new CustomEvent(type, { detail, bubbles: false, composed: true }));
  }

  /** An `error` event; also a message in the element while it has no picture to show instead. */
  protected report(error: ErrorInfo): void {
    if (!this.#hasPicture()) this.#messages.setError(error.message);
    this.emit('error', { error });
  }

  /** Something was put right, or left out, for an attribute: said once on the console, once by event, for a while on the picture. */
  protected notify(message: string): void {
    console.warn(`<${this.localName}>: ${message}`);
    this.#messages.notify(message);
    this.emit('notice', { message });
  }

  /** Asks for a frame; many calls, one frame. */
  protected invalidate(): void {
    this.#dirty = true;
    if (this.#frame === 0 && this.#canDraw()) this.#frame = requestAnimationFrame((now) => this.#onFrame(now));
  }

  // Lifecycle.

  connectedCallback(): void {
    clearTimeout(this.#closing);
    if (this.#isOpen) {
      this.invalidate();
      return;
    }
    this.#isOpen = true;
    this.#cycle += 1;
    this.#listen();
    this.#stage.setAttribute('aria-roledescription', WORDS.role[this.language]);
    void this.#openRenderer(this.#cycle);
    this.opened();
  }

  disconnectedCallback(): void {
    cancelAnimationFrame(this.#frame);
    this.#frame = 0;
    this.#closing = setTimeout(() => this.#close(), IDLE_TIMEOUT_MS);
  }

  #close(): void {
    this.#isOpen = false;
    this.#cycle += 1;
    this.#listening?.abort();
    this.#controls?.dispose();
    this.#controls = undefined;
    this.#renderer?.dispose();
    this.#renderer?.canvas.remove();
    this.#renderer = undefined;
    this.#losses = [];
    this.#restoring = false;
    this.#flight = undefined;
    this.#seen = false;
    this.#messages.forgetNotices();
    if (this.#painted) this.#renewReadiness();
    this.closed();
  }

  #renewReadiness(): void {
    this.#painted = false;
    let resolve = () => {};
    this.#readiness = { promise: new Promise<void>((settle) => (resolve = settle)), resolve: () => resolve() };
  }

  #listen(): void {
    this.#listening = new AbortController();
    const { signal } = this.#listening;
    const resize = new ResizeObserver((entries) => entries.forEach((entry) => this.#onResize(entry)));
    try {
      resize.observe(this.#stage, { box: 'device-pixel-content-box' });
    } catch {
      // Safari: CSS pixels times the ratio, which may change without a change of size.
      resize.observe(this.#stage);
      window.addEventListener('resize', () => this.#measure(), { signal });
    }
    // A little ahead of the edge, so that scrolling meets a picture.
    const intersection = new IntersectionObserver((entries) => this.#onSeen(entries.at(-1)?.isIntersecting ?? false), { rootMargin: '64px' });
    intersection.observe(this);
    signal.addEventListener('abort', () => {
      resize.disconnect();
      intersection.disconnect();
    });
    document.addEventListener('visibilitychange', () => this.#dirty && this.invalidate(), { signal });
    const dark = matchMedia('(prefers-color-scheme: dark)');
    dark.addEventListener('change', () => this.#restyle({ dark: this.#isDark() }), { signal });
    this.#restyle({ dark: this.#isDark() });
    this.#controls = new OrbitControls(
      this.#stage,
      () => this.camera,
      (camera) => (this.camera = camera),
      {
        onInteract: () => this.emit('camera-change', { camera: this.camera, framed: false }),
        onFrameAll: () => this.frameAll(),
        isPlan: () => isPlan(this.#style.view) || this.backend === 'canvas2d',
      },
    );
  }

  // The renderer.

  async #openRenderer(cycle: number, backend = this.#wantedBackend()): Promise<boolean> {
    let renderer: SceneRenderer;
    try {
      renderer = await loadRenderer(() => this.#makeCanvas(), { backend });
    } catch (thrown) {
      if (cycle === this.#cycle) this.report({ name: 'NoRenderer', message: errorText(thrown) });
      return false;
    }
    if (cycle !== this.#cycle) {
      renderer.dispose();
      return false;
    }
    try {
      renderer.setStyle(this.#style);
      if (this.#field) renderer.setField(this.#field);
    } catch (thrown) {
      renderer.dispose();
      this.report({ name: 'RendererFailed', message: `the picture could not be made: ${errorText(thrown)}` });
      return false;
    }
    this.#renderer = renderer;
    void renderer.lost.then((reason) => this.#onLost(renderer, reason));
    this.#stage.replaceChildren(renderer.canvas);
    const isMakeshift = renderer.backend === 'canvas2d' && this.#wantedBackend() === 'auto';
    this.#messages.setStanding(isMakeshift ? WORDS.noGpu[this.language] : '');
    this.#measure();
    this.#clearError();
    this.invalidate();
    return true;
  }

  #wantedBackend(): 'auto' | Backend {
    const wanted = this.getAttribute('backend');
    return wanted === 'webgpu' || wanted === 'webgl' || wanted === 'canvas2d' || wanted === 'null' ? wanted : 'auto';
  }

  #makeCanvas(): HTMLCanvasElement {
    const canvas = document.createElement('canvas');
    canvas.setAttribute('part', 'canvas');
    [canvas.width, canvas.height] = this.#pixels();
    return canvas;
  }

  /** The device or context is gone: a new canvas and renderer, the same field, the same camera. */
  async #onLost(renderer: SceneRenderer, reason: string): Promise<void> {
    if (this.#renderer !== renderer) return;
    const cycle = this.#cycle;
    this.#renderer = undefined;
    renderer.dispose();
    const now = performance.now();
    this.#losses = [...this.#losses.filter((time) => now - time < LOSS_WINDOW_MS), now];
    const givenUp = this.#losses.length > MAX_LOSSES;
    this.#restoring = true;
    // The old canvas keeps its last picture on the screen until the new one is put in its place.
    const opened = await this.#openRenderer(cycle, givenUp ? 'canvas2d' : this.#wantedBackend());
    if (!opened || cycle !== this.#cycle) return;
    if (givenUp) this.report({ name: 'DeviceLost', message: `the graphics device was lost ${this.#losses.length} times: ${reason}` });
  }

  // Size, visibility, frames.

  #onResize(entry: ResizeObserverEntry): void {
    // Out of the document everything is 0 × 0; it is told again on the way back in.
    if (!this.isConnected) return;
    const ratio = window.devicePixelRatio || 1;
    const { width, height } = entry.contentRect;
    const exact = entry.devicePixelContentBoxSize?.[0];
    // Developer tools that pretend another ratio leave this box in CSS pixels.
    if (exact && Math.abs(exact.inlineSize - width * ratio) < 2) this.#resize(exact.inlineSize, exact.blockSize);
    else this.#resize(Math.round(width * ratio), Math.round(height * ratio));
  }

  #measure(): void {
    const ratio = window.devicePixelRatio || 1;
    this.#resize(Math.round(this.#stage.clientWidth * ratio), Math.round(this.#stage.clientHeight * ratio));
  }

  #resize(width: number, height: number): void {
    this.#width = width;
    this.#height = height;
    this.#renderer?.resize(...this.#pixels());
    this.#dirty = true;
    // A canvas is blank after a change of size: in this very frame there has to be a picture again.
    if (this.#canDraw()) this.#draw();
  }

  #pixels(): [number, number] {
    const scale = Math.min(1, Math.sqrt(MAX_PIXELS / Math.max(1, this.#width * this.#height)));
    return [Math.max(1, Math.floor(this.#width * scale)), Math.max(1, Math.floor(this.#height * scale))];
  }

  #aspect(): number {
    return this.#width > 0 && this.#height > 0 ? this.#width / this.#height : 2;
  }

  #onSeen(seen: boolean): void {
    this.#seen = seen;
    if (seen && this.#dirty) this.invalidate();
  }

  #canDraw(): boolean {
    const canBeSeen = this.isConnected && this.#seen && this.#width > 0 && this.#height > 0 && document.visibilityState === 'visible';
    return canBeSeen && this.#hasPicture();
  }

  #onFrame(now: number): void {
    this.#frame = 0;
    if (!this.#dirty || !this.#canDraw()) return;
    if (this.#flight) {
      this.#camera = this.#flight.at(now);
      if (!this.#camera) this.#flight = undefined;
    }
    this.#draw();
    if (this.#flight) this.invalidate();
  }

  #draw(): void {
    const renderer = this.#renderer;
    if (!renderer) return;
    this.#dirty = false;
    try {
      renderer.setCamera(this.#camera ?? this.defaultCamera);
      renderer.render();
    } catch (thrown) {
      // A renderer that throws is as good as lost.
      void this.#onLost(renderer, errorText(thrown));
      return;
    }
    if (this.#restoring) {
      this.#restoring = false;
      this.emit('restored');
    }
    if (!this.#painted) {
      this.#painted = true;
      this.#readiness.resolve();
      this.emit('load');
    }
  }

  #isDark(): boolean {
    if (this.#theme !== 'auto') return this.#theme === 'dark';
    return globalThis.matchMedia?.('(prefers-color-scheme: dark)').matches ?? false;
  }

  #restyle(change: Partial<SceneStyle>): void {
    this.#style = { ...this.#style, ...change };
    try {
      this.#renderer?.setStyle(this.#style);
    } catch (thrown) {
      this.report({ name: 'RendererFailed', message: `the view could not be shown: ${errorText(thrown)}` });
    }
    this.invalidate();
  }

  #hasPicture(): boolean {
    return this.#field !== null && this.#renderer !== undefined;
  }

  #clearError(): void {
    if (this.#hasPicture()) this.#messages.setError('');
  }
}
