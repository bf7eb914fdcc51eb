/**
 * What every scene on a page shares: lifecycle, sizing, the canvas and its renderer, pointer and keys, frames, messages.
 *
 * Nothing is loaded before the element stands in a document, and nothing is drawn unless something changed and it can be seen.
 * Moving the element costs nothing: it is torn down only when it has been out of the document for `IDLE_TIMEOUT_MS`.
 * What is loaded lives for one *cycle*, from `open` to `close`.
 */

import { prefersStillness } from './camera/auto-rotation.ts';
import type { ErrorInfo } from '../base/errors.ts';
import type { Orbit } from './camera/orbit.ts';
import { isPlan } from './camera/camera.ts';
import type { Subject } from './camera/camera.ts';
import { isPassing, RockFieldError } from '../base/errors.ts';
import { ErrorPace } from '../base/error-pace.ts';
import type { Backend, CameraState, ColorMode, Interaction, Quality, Theme, View, WantedQuality } from '../base/view.ts';
import { CAN_SHOW } from '../base/document-styles.ts';
import type { Field } from '../data/field.ts';
import { FramePacer } from './frame-pacer.ts';
import { lazily } from '../base/lazy.ts';
import type { OrbitControls } from './camera/orbit-controls.ts';
import type { PictureOptions } from './picture.ts';
import { errorText, RendererKeeper } from './renderer-keeper.ts';
import { wantedBackend } from '../renderer/load.ts';
import type { Look } from '../data/look.ts';
import type { SceneRenderer, SceneStyle, Wood } from '../renderer/renderer.ts';
import { SceneCamera } from './camera/scene-camera.ts';
import { languageOf, watchLanguage } from './language.ts';
import { SceneTree } from './tree.ts';
import type { HINTS } from './hints.ts';
import { WORDS } from './words.ts';
import { StageSize } from './stage-size.ts';
import { Visibility } from './visibility.ts';

/** How long an element may be out of the document before its worker, device and buffers go. */
export const IDLE_TIMEOUT_MS = 1000;

/** How long `toBlob` waits for a picture. */
const PICTURE_TIMEOUT_MS = 120_000;

/** On a server there is no HTMLElement; importing must be silent there, and nobody makes an element. */
const Base = (globalThis.HTMLElement ?? class {}) as typeof HTMLElement;

/**
 * @attr poster - Address of a picture that stands in until the first one is painted.
 * @attr auto-rotate - Turns slowly while nobody moves it; not where the system asks for less motion.
 * @attr disabled - Nothing moves the camera, and the picture takes no focus.
 * @csspart canvas - The picture.
 * @csspart poster - What stands in for the picture.
 * @csspart progress - The bar of a run that takes longer.
 * @csspart message - What went wrong, while there is something to say.
 * @slot poster - Stands in for the picture until the first one is painted.
 * @slot progress - Stands in for the bar.
 * @slot error - Stands in for the text of an error.
 * @cssprop --rock-field-background - Behind the picture, before the first one.
 * @cssprop --rock-field-accent - Focus ring and progress bar.
 * @cssprop --rock-field-progress - Set while a run is under way: 0 … 1.
 */
export abstract class SceneElement extends Base {
  #tree!: SceneTree;

  #isOpen = false;
  #isStarted = false;
  #closing: ReturnType<typeof setTimeout> | undefined;
  /** Ends every listener and observer of the cycle. */
  #listening: AbortController | undefined;
  #speaking: AbortController | undefined;
  #spoken: 'en' | 'ja' | undefined;
  #controls: OrbitControls | undefined;
  #readiness!: { promise: Promise<void>; resolve: () => void };

  #kept = new RendererKeeper({
    wantedBackend: () => wantedBackend(this.getAttribute('backend')),
    makeCanvas: () => this.#tree.makeCanvas(this.#size?.pixels),
    fill: (renderer) => this.#fill(renderer),
    opened: (renderer) => this.#onRenderer(renderer),
    said: () => this.#sayStanding(),
    report: (error) => this.report(error),
  });
  #painted = false;
  #isStandingIn = false;
  #pacer = new FramePacer({
    view: () => this.#view,
    canDraw: () => this.#canDraw(),
    isGraded: () => this.#style.color === 'natural' && this.#style.view === '3d' && this.backend !== 'canvas2d',
    advance: (now) => this.#camera.advance(now, this.#rotates()),
    draw: (level) => this.#draw(level),
  });

  /** Why there is no picture, or not the one that was asked for. */
  #failure: ErrorInfo | null = null;
  #pace = new ErrorPace((detail) => this.emit('error', detail));
  /** Who waits for one. */
  #waiting: ((error?: RockFieldError) => void)[] = [];

  #field: Field | null = null;
  #measured: { field: Field | null; height: number } = { field: null, height: 0 };
  #wood: Wood | null = null;
  #style: SceneStyle = { view: '3d', color: 'layer', dark: false };
  #look: Look | null = null;
  #theme: Theme = 'auto';
  #camera = new SceneCamera(() => ({
    extent: this.#extent(),
    aspect: this.aspect,
    plan: this.#isPlan(),
    closeUp: this.#style.color === 'natural',
    subject: this.subject,
    height: () => this.#rocksHeight(),
  }));

  #size: StageSize | undefined;
  #visibility: Visibility | undefined;
  #touchExplained = false;

  constructor() {
    super();
    this.#renewReadiness();
    // The fallback class of a server has no shadow root, and no document to build for.
    if (typeof this.attachShadow !== 'function') return;
    this.#tree = new SceneTree(this.attachShadow({ mode: 'open' }), () => this.#retry());
  }

  // What a kind of scene adds.

  /** A cycle begins: ask for what is to be shown. */
  protected abstract opened(): void;
  /** The cycle has ended: let go of everything. */
  protected abstract closed(): void;
  /** The last run failed: run again. */
  protected abstract regrow(): void;
  /** Width and height of the ground before there is a field, px. */
  protected abstract groundSize(): [number, number];
  /** What moves the camera, as the attributes say. */
  protected abstract get interactionMode(): Interaction;

  /** What is framed instead of all of the ground. */
  protected get subject(): Subject | null {
    return null;
  }

  /** What the picture is of, in a word or two. */
  protected get label(): string {
    return WORDS.label[this.language];
  }

  /** A frame has been drawn through `camera`. */
  protected drawn(_camera: CameraState): void {}

  protected get aspect(): number {
    return this.#size?.aspect ?? 2;
  }

  /** Holds the canvas and the focus. */
  protected get stage(): HTMLElement {
    return this.#tree.stage;
  }

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
    return this.#kept.renderer?.backend ?? null;
  }

  protected get sceneTheme(): Theme {
    return this.#theme;
  }

  protected set sceneTheme(theme: Theme) {
    this.#theme = theme;
    this.#restyle({ dark: this.#isDark() });
  }

  /** Where the eye is. Assigning moves it at once; `null` frames the whole field again. */
  get camera(): CameraState {
    return this.#camera.current;
  }

  set camera(camera: CameraState | null) {
    this.#camera.current = camera;
    this.invalidate();
  }

  /** The camera that frames the whole field, or as `camera-orbit` has it, for the present size and view. */
  get defaultCamera(): CameraState {
    return this.#camera.framing();
  }

  /** Whether the whole field is framed, that is, nobody has moved the camera since. */
  get framed(): boolean {
    return this.#camera.framed;
  }

  #extent(): [number, number] {
    return this.#field ? [this.#field.imageWidth, this.#field.imageHeight] : this.groundSize();
  }

  protected setFraming(orbit: Orbit | null, metresPerPixel: number): void {
    this.#camera.setFraming(orbit, metresPerPixel);
    this.invalidate();
  }

  /**
   * Brings the whole field into view, with a margin; when it is in view already, goes back to the default camera, which is closer.
   * It flies there unless `animate` is false or the system asks for less motion.
   */
  frameAll(animate = true): void {
    const flies = animate && this.#canDraw() && !prefersStillness(this.#view);
    const to = this.#camera.frameAll(flies ? performance.now() : null);
    this.invalidate();
    this.emit('camera-change', { camera: to, framed: true });
  }

  /** Whether the camera is the default one. */
  protected get hasDefaultCamera(): boolean {
    return this.#camera.isDefault;
  }

  /** Changes the colour: a camera that nobody moved stays where it is. */
  protected recolor(change: () => void): void {
    const { isDefault } = this.#camera;
    if (this.#painted) this.#camera.hold();
    change();
    if (this.#camera.isDefault !== isDefault) this.#tellCamera();
  }

  /** After `recolor`: the default camera is the present colour's again. */
  protected releaseCamera(): void {
    const { isDefault } = this.#camera;
    this.#camera.release();
    if (!isDefault) this.#tellCamera();
  }

  #tellCamera(): void {
    if (this.#painted && this.framed) this.emit('camera-change', { camera: this.camera, framed: true });
  }

  #rocksHeight(): number {
    const field = this.#field;
    if (field && field !== this.#measured.field) this.#measured = { field, height: highest(field.positions) };
    return this.#measured.height;
  }

  /**
   * The picture as a file, as soon as there is one; also where the element cannot be seen.
   *
   * @throws {RockFieldError} `OutOfRange` for a size that cannot be drawn, `NotConnected` out of the document, `NoPicture` where the
   *   browser gives none; what the element reports where there will be no picture.
   */
  async toBlob(options: PictureOptions = {}): Promise<Blob> {
    this.start();
    const { picture } = await lazily(() => import('./picture.ts'));
    return picture(options, {
      drawable: () => this.#drawable(),
      renderer: () => this.#kept.renderer,
      size: () => this.#size,
      best: () => this.#pacer.best,
      camera: (aspect) => this.#camera.forAspect(aspect),
      redraw: () => this.#pacer.redraw(),
    });
  }

  /** Resolves when there is what to draw and what to draw it with; rejects when the cycle ends, or there will be none. */
  #drawable(): Promise<void> {
    this.start();
    if (this.#hasPicture()) return Promise.resolve();
    if (!this.#isOpen) return Promise.reject(notConnected());
    if (this.#failure) return Promise.reject(new RockFieldError(this.#failure));
    return new Promise((resolve, reject) => {
      const timer = setTimeout(
        () => reject(new RockFieldError({ name: 'NoPicture', message: 'there was no picture within two minutes' })),
        PICTURE_TIMEOUT_MS,
      );
      this.#waiting.push((error) => {
        clearTimeout(timer);
        if (error) reject(error);
        else resolve();
      });
    });
  }

  /** A new run may succeed, though it draws nothing where there is no renderer. */
  protected forgetFailure(): void {
    if (!this.#kept.renderer) return;
    this.#failure = null;
    this.#tree.messages.setError('');
  }

  #tellWaiting(error?: RockFieldError): void {
    for (const tell of this.#waiting.splice(0)) tell(error);
  }

  protected get sceneQuality(): WantedQuality {
    return this.#pacer.wanted;
  }

  protected set sceneQuality(quality: WantedQuality) {
    this.#pacer.wanted = quality;
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

  /** Drawn with the next frame: whoever changes it with the field calls this in the same task. */
  protected setSceneLook(look: Look): void {
    if (this.#tell((renderer) => renderer.setLook(look))) this.#look = look;
  }

  /** Shows a field, perhaps with a log on it. False when the renderer refused them: that is reported, and the old ones stay on screen. */
  protected showField(field: Field, wood: Wood | null = null): boolean {
    try {
      if (field !== this.#field) this.#kept.renderer?.setField(field);
      if (wood !== this.#wood) this.#kept.renderer?.setWood(wood);
    } catch (thrown) {
      this.report({ name: 'RendererFailed', message: `the result could not be shown: ${errorText(thrown)}` });
      return false;
    }
    this.#field = field;
    this.#wood = wood;
    if (!this.#kept.renderer) void this.#standIn();
    this.#clearError();
    this.invalidate();
    return true;
  }

  /** What the picture shows, for those who cannot see it. */
  protected describe(text: string): void {
    this.#tree.describe(text);
  }

  /** 0 … 1 while a run is under way that takes longer; null otherwise. */
  protected showProgress(fraction: number | null): void {
    this.#tree.showProgress(fraction);
    if (fraction === null) this.style.removeProperty('--rock-field-progress');
    else this.style.setProperty('--rock-field-progress', fraction.toFixed(3));
  }

  /** Attributes that are no parameters changed. */
  protected readManners(): void {
    if (!CAN_SHOW) return;
    this.#tree.setPoster(this.getAttribute('poster'));
    this.#tree.setDisabled(this.hasAttribute('disabled'));
    this.#controls?.refresh();
    this.invalidate();
  }

  /** The page's language, from the nearest `lang`. */
  protected get language(): 'en' | 'ja' {
    return languageOf(this);
  }

  /** The window that the element is in: one of a frame or a popup, perhaps. */
  get #view(): Window & typeof globalThis {
    return this.ownerDocument.defaultView ?? window;
  }

  /** False when it is an `error` that a listener tells the user itself. */
  protected emit(type: string, detail: unknown = null): boolean {
    return this.dispatchEvent(new CustomEvent(type, { detail, bubbles: false, composed: true, cancelable: /error|notice/.test(type) }));
  }

  /** An `error` event, at most one a second; also a message in the element while it has no picture to show instead. */
  protected report(error: ErrorInfo): void {
    if (!this.#hasPicture() || isPassing(error)) {
      this.#failure = error;
      this.#sayFailure(error);
      if (!this.#hasPicture()) this.#tellWaiting(new RockFieldError(error));
    }
    this.#pace.push({ error, shown: this.#shows(error) });
  }

  /** Whether the element's own message says it. */
  #shows(error: ErrorInfo): boolean {
    return error.name === 'DeviceLost' || (error === this.#failure && error.key === undefined);
  }

  #sayFailure(error: ErrorInfo): void {
    const canRetry = isPassing(error) || /Renderer/.test(error.name);
    const say = (text: string): void => this.#tree.messages.setError(text, canRetry);
    say(error.words?.[this.language] ?? error.message);
    if (error.words || this.language === 'en') return;
    lazily(() => import('../base/failures.ja.ts'), true).then(
      ({ japaneseFailure }) => this.#failure === error && say(japaneseFailure(error.message)),
      () => undefined,
    );
  }

  /** What failed is tried again: the renderer, the run. */
  #retry(): void {
    this.#kept.retry();
    // Where there is nothing to draw with, only what failed for itself is asked for again.
    if (this.#failure && (this.#kept.renderer || isPassing(this.#failure))) this.regrow();
  }

  /** Something was put right, or left out, for an attribute: said once on the console, once by event, for a while on the picture unless the event is prevented. */
  protected notify(message: string): void {
    console.warn(`<${this.localName}>: ${message}`);
    if (this.emit('notice', { message })) this.say(message);
  }

  /** Shown on the picture for a while. */
  protected say(text: string): void {
    this.#tree.messages.notify(text);
  }

  /** Takes back what is said on the picture and no longer holds. */
  protected unsay(text: string): void {
    this.#tree.messages.forget(text);
  }

  /** Asks for a frame; many calls, one frame. */
  protected invalidate(): void {
    this.#pacer.invalidate();
  }

  // Lifecycle.

  connectedCallback(): void {
    if (!CAN_SHOW) return;
    clearTimeout(this.#closing);
    if (this.#isOpen) {
      this.#speak();
      this.invalidate();
      return;
    }
    this.#isOpen = true;
    this.#listen();
    this.#speak();
    this.readManners();
    this.loadUnlessLazy();
  }

  /** In another document everything is another: styles, observers, frames. The field stays. */
  adoptedCallback(): void {
    clearTimeout(this.#closing);
    if (this.#isOpen) this.#close();
    this.#tree.dress();
  }

  protected loadUnlessLazy(): void {
    if (this.getAttribute('loading')?.trim() !== 'lazy') this.start();
  }

  /** In the language of where the element stands now, and whenever that changes. */
  #speak(): void {
    this.#speaking?.abort();
    this.#speaking = new AbortController();
    const say = () => {
      const { language } = this;
      if (language === this.#spoken) return;
      this.#spoken = language;
      this.relabel();
    };
    watchLanguage(this, say, this.#speaking.signal);
    say();
  }

  /** Says in the present language what is said all the time. */
  protected relabel(): void {
    this.#tree.setLanguage(this.language, WORDS.role[this.language], this.label);
    this.#sayStanding();
    if (this.#failure) this.#sayFailure(this.#failure);
    this.invalidate();
  }

  /** Says why the picture is not drawn as it was asked for. */
  #sayStanding(): void {
    this.#tree.messages.setStanding(this.#kept.words(this.language), this.#kept.canRetry);
  }

  /** Begins what costs something; where loading is lazy, as soon as the element comes near. */
  protected start(): void {
    if (this.#isStarted || !this.#isOpen) return;
    this.#isStarted = true;
    this.#kept.open();
    this.opened();
  }

  disconnectedCallback(): void {
    this.#pacer.stop();
    this.#closing = setTimeout(() => this.#close(), IDLE_TIMEOUT_MS);
  }

  #close(): void {
    this.#isOpen = false;
    this.#listening?.abort();
    this.#speaking?.abort();
    this.#tree.print(null);
    this.#failure = null;
    this.#tellWaiting(notConnected());
    this.#controls?.dispose();
    this.#controls = undefined;
    this.#kept.close();
    this.#camera.stay();
    this.#visibility = undefined;
    this.#size = undefined;
    this.#tree.messages.forget();
    if (this.#painted) this.#renewReadiness();
    if (this.#isStarted) this.closed();
    this.#isStarted = false;
  }

  #renewReadiness(): void {
    this.#painted = false;
    let resolve = () => {};
    this.#readiness = { promise: new Promise<void>((settle) => (resolve = settle)), resolve: () => resolve() };
  }

  #listen(): void {
    this.#listening = new AbortController();
    const { signal } = this.#listening;
    this.#tree.box(this.#view);
    const size = new StageSize(this.#tree.stage, () => this.#resized(), signal);
    this.#size = size;
    this.#visibility = new Visibility(this, () => this.#onVisibility(), signal);
    const dark = this.#view.matchMedia('(prefers-color-scheme: dark)');
    this.#view.addEventListener('beforeprint', () => this.#print(), { signal });
    this.#view.addEventListener('afterprint', () => this.#tree.print(null), { signal });
    dark.addEventListener('change', () => this.#restyle({ dark: this.#isDark() }), { signal });
    this.#restyle({ dark: this.#isDark() });
    // Without hands the picture is still a picture.
    this.#steer(signal).catch((thrown: unknown) => console.warn(thrown));
  }

  /** The first picture needs no hands: they come after it. */
  async #steer(signal: AbortSignal): Promise<void> {
    const { OrbitControls } = await lazily(() => import('./camera/orbit-controls.ts'));
    if (signal.aborted) return;
    this.#controls = new OrbitControls(
      this.#tree.stage,
      () => this.camera,
      (camera) => {
        this.#camera.current = camera;
        this.invalidate();
      },
      {
        onInteract: () => {
          this.#camera.pauseRotation(performance.now());
          this.emit('camera-change', { camera: this.camera, framed: false });
        },
        onFrameAll: () => this.frameAll(),
        onRefused: (gesture) => this.#explain(gesture),
        isPlan: () => this.#isPlan(),
        interaction: () => (this.hasAttribute('disabled') ? 'none' : this.interactionMode),
      },
    );
  }

  /** Why a gesture did nothing: for fingers, which meet the picture whenever they scroll, once. */
  #explain(gesture: 'wheel' | 'touch'): void {
    if (gesture === 'touch' && this.#touchExplained) return;
    this.#touchExplained ||= gesture === 'touch';
    void this.#saying(gesture, (text) => this.#tree.hint(text));
  }

  async #saying(hint: keyof typeof HINTS, say: (text: string) => void): Promise<void> {
    try {
      say((await lazily(() => import('./hints.ts'))).HINTS[hint][this.language]);
    } catch (thrown) {
      console.warn(thrown);
    }
  }

  // The renderer.

  /** It is still on its way, and there is something to show: the plan until then. */
  async #standIn(): Promise<void> {
    if (this.#isStandingIn) return;
    this.#isStandingIn = true;
    const { signal } = this.#listening ?? {};
    try {
      const { standIn } = await lazily(() => import('./stand-in.ts'), true);
      await standIn({
        isOver: () => signal?.aborted !== false || this.#painted || this.#kept.renderer !== undefined,
        tree: this.#tree,
        language: () => this.language,
        scene: () => ({
          field: this.#field,
          wood: this.#wood,
          style: this.#style,
          camera: this.framed ? this.#camera.framing(undefined, false, true) : this.camera,
          size: this.#size?.pixels,
        }),
      });
    } catch (thrown) {
      console.warn(thrown);
    }
    this.#isStandingIn = false;
  }

  /** Whether it is seen from straight above, as everything is without a GPU. */
  #isPlan(): boolean {
    return isPlan(this.#style.view) || this.backend === 'canvas2d';
  }

  #fill(renderer: SceneRenderer): void {
    renderer.setStyle(this.#style);
    if (this.#look) renderer.setLook(this.#look);
    if (this.#field) renderer.setField(this.#field);
    if (this.#wood) renderer.setWood(this.#wood);
  }

  #onRenderer(renderer: SceneRenderer): void {
    this.#tree.stage.replaceChildren(renderer.canvas);
    this.#pacer.renew();
    this.#size?.measure();
    this.#clearError();
    this.invalidate();
  }

  // Size, visibility, frames.

  #resized(): void {
    if (this.#size) this.#kept.renderer?.resize(...this.#size.pixels);
    // A canvas is blank after a change of size: in this very frame there has to be a picture again.
    this.#pacer.drawNow();
  }

  #onVisibility(): void {
    if (this.#visibility?.near) this.start();
    this.#pacer.look(this.#rotates());
  }

  #canDraw(): boolean {
    return this.isConnected && this.#visibility?.visible === true && this.#size?.isEmpty === false && this.#hasPicture();
  }

  #rotates(): boolean {
    return (this.getAttribute('auto-rotate') ?? 'false') !== 'false' && !prefersStillness(this.#view);
  }

  #draw(level: Quality | null): void {
    const { camera } = this;
    const outcome = this.#kept.draw((renderer) => {
      if (level) renderer.setQuality(level);
      renderer.setCamera(camera);
      renderer.render();
    });
    if (outcome === 'nothing') return;
    this.drawn(camera);
    if (outcome === 'restored') this.emit('restored');
    if (!this.#painted) {
      this.#painted = true;
      this.#tree.hidePoster();
      this.#readiness.resolve();
      this.emit('load');
    }
  }

  /** Also of an element that has not been near the screen. */
  #print(): void {
    const { renderer } = this.#kept;
    if (!renderer || !this.#hasPicture() || !this.#size) return;
    if (this.#size.isEmpty) this.#size.measure();
    this.#draw(this.#pacer.best);
    this.#tree.print(renderer.canvas);
  }

  #isDark(): boolean {
    if (this.#theme !== 'auto') return this.#theme === 'dark';
    return CAN_SHOW && this.#view.matchMedia('(prefers-color-scheme: dark)').matches;
  }

  #restyle(change: Partial<SceneStyle>): void {
    const style = { ...this.#style, ...change };
    if (this.#tell((renderer) => renderer.setStyle(style))) this.#style = style;
  }

  /** False when the renderer refused it: that is reported. */
  #tell(work: (renderer: SceneRenderer) => void): boolean {
    this.invalidate();
    try {
      if (this.#kept.renderer) work(this.#kept.renderer);
      return true;
    } catch (thrown) {
      this.report({ name: 'RendererFailed', message: `the view could not be shown: ${errorText(thrown)}` });
      return false;
    }
  }

  #hasPicture(): boolean {
    return this.#field !== null && this.#kept.renderer !== undefined;
  }

  #clearError(): void {
    if (!this.#hasPicture()) return;
    this.#tree.messages.setError('');
    this.#failure = null;
    this.#tellWaiting();
  }
}

function notConnected(): RockFieldError {
  return new RockFieldError({ name: 'NotConnected', message: 'put the element into the document first' });
}

/** The largest z of a mesh. */
function highest(positions: Float32Array): number {
  let height = 0;
  for (let k = 2; k < positions.length; k += 3) height = Math.max(height, positions[k]!);
  return height;
}
