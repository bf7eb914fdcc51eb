/**
 * An element that draws: its renderer, what the renderer is given, its frames, and the picture as a file or in print.
 *
 * Nothing is drawn unless something changed and it can be seen.
 */

import { CAN_SHOW } from '../base/document-styles.ts';
import type { ErrorInfo } from '../base/errors.ts';
import { isPassing, notConnected } from '../base/errors.ts';
import { lazily } from '../base/lazy.ts';
import type { Backend, CameraState, ColorMode, Quality, Theme, View, WantedQuality } from '../base/view.ts';
import type { Field } from '../data/field.ts';
import type { Look } from '../data/look.ts';
import { wantedBackend } from '../renderer/load.ts';
import type { SceneRenderer, SceneStyle, Wood } from '../renderer/renderer.ts';
import { isPlan } from './camera/camera.ts';
import { Failures } from './failures.ts';
import { FramePacer } from './frame-pacer.ts';
import type { PictureOptions, PictureSource } from './picture.ts';
import { errorText, RendererKeeper } from './renderer-keeper.ts';
import { StageElement } from './stage-element.ts';

/**
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
export abstract class DrawnElement extends StageElement {
  #kept = new RendererKeeper({
    wantedBackend: () => wantedBackend(this.getAttribute('backend')),
    makeCanvas: () => this.tree.makeCanvas(this.stageSize?.pixels),
    fill: (renderer) => this.#fill(renderer),
    opened: (renderer) => this.#onRenderer(renderer),
    said: () => this.#sayStanding(),
    report: (error) => this.report(error),
  });
  #failures = new Failures({
    hasPicture: () => this.#hasPicture(),
    language: () => this.language,
    messages: () => this.tree.messages,
    tell: (detail) => this.emit('error', detail),
  });
  #pacer = new FramePacer({
    view: () => this.ownWindow,
    canDraw: () => this.canDraw,
    isGraded: () => this.#isGraded,
    advance: (now) => this.advance(now),
    draw: (level) => this.#draw(level),
    pieces: () => {
      const pieces = this.#kept.renderer?.pieces;
      const size = this.stageSize?.pixels;
      return pieces && size && { pieces, size };
    },
    refiner: () => (this.#isGraded ? this.#kept.renderer : undefined),
    prepare: (level) => {
      const { camera } = this;
      const { renderer } = this.#kept;
      if (level) renderer?.setQuality(level);
      renderer?.setCamera(camera);
      return (show) => this.#show(camera, show);
    },
  });
  #readiness!: { promise: Promise<void>; resolve: () => void };
  #painted = false;

  #field: Field | null = null;
  #wood: Wood | null = null;
  #style: SceneStyle = { view: '3d', color: 'layer', dark: false };
  #look: Look | null = null;
  #theme: Theme = 'auto';

  constructor() {
    super();
    this.#renewReadiness();
  }

  // What the layers above add.

  /** Where the eye is. */
  abstract get camera(): CameraState;
  abstract set camera(camera: CameraState | null);
  /** The same for a picture of another aspect. */
  protected abstract cameraFor(aspect: number): CameraState;
  /** The same for the plan that stands in for a renderer that is still on its way. */
  protected abstract get planCamera(): CameraState;
  /** Moves what moves by itself on to the frame at `now`. True while there is more to come. */
  protected abstract advance(now: number): boolean;
  /** Whether the camera turns by itself. */
  protected abstract get rotates(): boolean;
  /** What brings back what is on screen. */
  protected abstract get pictureSource(): PictureSource;
  /** The last run failed: run again. */
  protected abstract regrow(): void;

  /** A frame has been drawn through `camera`. */
  protected drawn(_camera: CameraState): void {}

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
      failures: this.#failures,
      pacer: this.#pacer,
      start: () => this.start(),
      isOpen: () => this.isOpen,
      hasPicture: () => this.#hasPicture(),
      renderer: () => this.#kept.renderer,
      size: () => this.stageSize,
      camera: (aspect) => this.cameraFor(aspect),
      drawn: () => [this.#field, this.#wood, this.#style, this.#look],
      source: () => this.pictureSource,
    });
  }

  // What is drawn, and how.

  protected get sceneTheme(): Theme {
    return this.#theme;
  }

  protected set sceneTheme(theme: Theme) {
    this.#theme = theme;
    this.#restyle({ dark: this.#isDark() });
  }

  protected get sceneQuality(): WantedQuality {
    return this.#pacer.wanted;
  }

  protected set sceneQuality(quality: WantedQuality) {
    this.#pacer.wanted = quality;
  }

  protected get sceneSamples(): number {
    return this.#pacer.samples;
  }

  protected set sceneSamples(samples: number) {
    this.#pacer.samples = samples;
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
    if (!this.#kept.renderer) this.#standIn();
    this.#endFailure();
    this.invalidate();
    return true;
  }

  /** Whether it is seen from straight above, as everything is without a GPU. */
  protected get isPlan(): boolean {
    return isPlan(this.#style.view) || this.backend === 'canvas2d';
  }

  /** Whether a picture has been drawn in this cycle. */
  protected get isPainted(): boolean {
    return this.#painted;
  }

  protected get canDraw(): boolean {
    return this.isSeen && this.#hasPicture();
  }

  protected override invalidate(): void {
    this.#pacer.invalidate();
  }

  // What went wrong.

  /** An `error` event, at most one a second; also a message in the element while it has no picture to show instead. */
  protected report(error: ErrorInfo): void {
    this.#failures.report(error);
  }

  /** A new run may succeed, though it draws nothing where there is no renderer. */
  protected forgetFailure(): void {
    if (this.#kept.renderer) this.#failures.forget();
  }

  protected override retry(): void {
    this.#kept.retry();
    // Where there is nothing to draw with, only what failed for itself is asked for again.
    const failure = this.#failures.error;
    if (failure && (this.#kept.renderer || isPassing(failure))) this.regrow();
  }

  protected override relabel(): void {
    super.relabel();
    this.#sayStanding();
    this.#failures.say();
  }

  /** Says why the picture is not drawn as it was asked for. */
  #sayStanding(): void {
    this.tree.messages.setStanding(this.#kept.words(this.language), this.#kept.canRetry);
  }

  #endFailure(): void {
    if (this.#hasPicture()) this.#failures.end();
  }

  // The cycle.

  protected override entered(signal: AbortSignal): void {
    const view = this.ownWindow;
    view.addEventListener('beforeprint', () => this.#print(), { signal });
    view.addEventListener('afterprint', () => this.tree.print(null), { signal });
    const restyle = (): void => this.#restyle({ dark: this.#isDark() });
    darkness(view).addEventListener('change', restyle, { signal });
    restyle();
  }

  protected override opened(): void {
    this.#kept.open();
  }

  override disconnectedCallback(): void {
    this.#pacer.stop();
    super.disconnectedCallback();
  }

  protected override left(): void {
    this.tree.print(null);
    this.#failures.close(notConnected());
    this.#kept.close();
    if (this.#painted) this.#renewReadiness();
  }

  #renewReadiness(): void {
    this.#painted = false;
    let resolve = () => {};
    this.#readiness = { promise: new Promise<void>((settle) => (resolve = settle)), resolve: () => resolve() };
  }

  protected override resized(): void {
    if (this.stageSize) this.#kept.renderer?.resize(...this.stageSize.pixels);
    // A canvas is blank after a change of size: in this very frame there has to be a picture again.
    this.#pacer.drawNow();
  }

  protected override sighted(): void {
    this.#pacer.look(this.rotates);
  }

  // The renderer.

  #fill(renderer: SceneRenderer): void {
    renderer.setStyle(this.#style);
    if (this.#look) renderer.setLook(this.#look);
    if (this.#field) renderer.setField(this.#field);
    if (this.#wood) renderer.setWood(this.#wood);
  }

  #onRenderer(renderer: SceneRenderer): void {
    this.stage.replaceChildren(renderer.canvas);
    this.#pacer.renew(renderer.deviceName && `${renderer.backend} ${renderer.deviceName}`);
    this.stageSize?.measure();
    this.#endFailure();
    this.invalidate();
  }

  /** It is still on its way, and there is something to show: the plan until then. */
  #standIn(): void {
    const { cycle } = this;
    lazily(() => import('./stand-in.ts'), true)
      .then(({ standIn }) =>
        standIn({
          isOver: () => cycle?.aborted !== false || this.#painted || this.#kept.renderer !== undefined,
          tree: this.tree,
          language: () => this.language,
          scene: () => ({
            field: this.#field,
            wood: this.#wood,
            style: this.#style,
            camera: this.planCamera,
            size: this.stageSize?.pixels,
          }),
        }),
      )
      .catch((thrown: unknown) => console.warn(thrown));
  }

  #restyle(change: Partial<SceneStyle>): void {
    const style = { ...this.#style, ...change };
    if (this.#tell((renderer) => renderer.setStyle(style))) this.#style = style;
  }

  #isDark(): boolean {
    if (this.#theme !== 'auto') return this.#theme === 'dark';
    return CAN_SHOW && darkness(this.ownWindow).matches;
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

  /** Whether the quality makes a difference to what is shown. */
  get #isGraded(): boolean {
    return this.#style.color === 'natural' && this.#style.view === '3d' && this.backend !== 'canvas2d';
  }

  #hasPicture(): boolean {
    return this.#field !== null && this.#kept.renderer !== undefined;
  }

  #draw(level: Quality | null): void {
    const { camera } = this;
    this.#show(camera, (renderer) => {
      if (level) renderer.setQuality(level);
      renderer.setCamera(camera);
      renderer.render();
    });
  }

  #show(camera: CameraState, work: (renderer: SceneRenderer) => void): void {
    const outcome = this.#kept.draw(work);
    if (outcome === 'nothing') return;
    this.drawn(camera);
    if (outcome === 'restored') this.emit('restored');
    if (!this.#painted) {
      this.#painted = true;
      this.tree.hidePoster();
      this.#readiness.resolve();
      this.emit('load');
    }
  }

  /** Also of an element that has not been near the screen. */
  #print(): void {
    const { renderer } = this.#kept;
    const { stageSize } = this;
    if (!renderer || !this.#hasPicture() || !stageSize) return;
    if (stageSize.isEmpty) stageSize.measure();
    this.#draw(this.#pacer.best);
    this.tree.print(renderer.canvas);
  }
}

/** What the system is set to. */
function darkness(view: Window): MediaQueryList {
  return view.matchMedia('(prefers-color-scheme: dark)');
}
