/** What every scene on a page shares beside its picture: the camera, and the hands that move it. */

import type { Interaction, CameraState, Navigation } from '../base/view.ts';
import { lazily } from '../base/lazy.ts';
import type { Field } from '../data/field.ts';
import { prefersStillness } from './camera/stillness.ts';
import type { Subject } from './camera/camera.ts';
import type { Orbit } from './camera/orbit.ts';
import type { Steered } from './camera/steered.ts';
import type { Steering } from './camera/steering.ts';
import { SceneCamera } from './camera/scene-camera.ts';
import { DrawnElement } from './drawn-element.ts';

/**
 * @attr auto-rotate - Turns slowly while nobody moves it; not where the system asks for less motion.
 */
export abstract class SceneElement extends DrawnElement {
  #camera = new SceneCamera(() => ({
    extent: this.#extent(),
    aspect: this.aspect,
    plan: this.isPlan,
    closeUp: this.sceneColor === 'natural',
    subject: this.subject,
    height: () => this.#rocksHeight(),
  }));
  #measured: { field: Field | null; height: number } = { field: null, height: 0 };
  #controls: Steering | undefined;

  // What a kind of scene adds.

  /** Width and height of the ground before there is a field, px. */
  protected abstract groundSize(): [number, number];
  /** What moves the camera, as the attributes say. */
  protected abstract get interactionMode(): Interaction;
  /** How hands move the camera: see the attribute. */
  abstract get navigation(): Navigation;

  /** What is framed instead of all of the ground. */
  protected get subject(): Subject | null {
    return null;
  }

  /** Where the eye is. Assigning moves it at once; `null` frames the whole field again. */
  override get camera(): CameraState {
    return this.#camera.current;
  }

  override set camera(camera: CameraState | null) {
    this.#camera.current = camera;
    this.invalidate();
  }

  protected get sceneFov(): number {
    return this.#camera.fov;
  }

  protected set sceneFov(degrees: number) {
    this.#camera.fov = degrees;
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

  /**
   * Brings the whole field into view, with a margin; when it is in view already, goes back to the default camera, which is closer.
   * It flies there unless `animate` is false or the system asks for less motion.
   */
  frameAll(animate = true): void {
    const flies = animate && this.canDraw && !prefersStillness(this.ownWindow);
    const to = this.#camera.frameAll(flies ? this.#controls?.fly : undefined);
    this.invalidate();
    this.emit('camera-change', { camera: to, framed: true });
  }

  /** Whether the camera is the default one. */
  protected get hasDefaultCamera(): boolean {
    return this.#camera.isDefault;
  }

  protected setFraming(orbit: Orbit | null, metresPerPixel: number): void {
    this.#camera.setFraming(orbit, metresPerPixel);
    this.invalidate();
  }

  /** Changes the colour: a camera that nobody moved stays where it is. */
  protected recolor(change: () => void): void {
    const { isDefault } = this.#camera;
    if (this.isPainted) this.#camera.hold();
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
    if (this.isPainted && this.framed) this.emit('camera-change', { camera: this.camera, framed: true });
  }

  protected override cameraFor(aspect: number): CameraState {
    return this.#camera.forAspect(aspect);
  }

  protected override get planCamera(): CameraState {
    return this.framed ? this.#camera.framing(undefined, false, true) : this.camera;
  }

  #extent(): [number, number] {
    return this.field ? [this.field.imageWidth, this.field.imageHeight] : this.groundSize();
  }

  #rocksHeight(): number {
    const { field } = this;
    if (field && field !== this.#measured.field) this.#measured = { field, height: highest(field.positions) };
    return this.#measured.height;
  }

  // What moves it.

  protected override get rotates(): boolean {
    return (this.getAttribute('auto-rotate') ?? 'false') !== 'false' && !prefersStillness(this.ownWindow);
  }

  protected override advance(now: number): boolean {
    // Who walks is not turned.
    return this.#controls?.advance(now) ?? this.#camera.advance(now, this.rotates);
  }

  protected override entered(signal: AbortSignal): void {
    super.entered(signal);
    // Without hands the picture is still a picture.
    this.#steer(signal).catch((thrown: unknown) => console.warn(thrown));
  }

  /** The first picture needs no hands: they come after it. */
  async #steer(signal: AbortSignal): Promise<void> {
    const { Steering } = await lazily(() => import('./camera/steering.ts'));
    if (signal.aborted) return;
    const scene = {
      tree: this.tree,
      language: () => this.language,
      view: () => this.ownWindow,
      camera: () => this.camera,
      move: (camera: CameraState | null) => {
        this.#camera.current = camera;
        this.invalidate();
      },
      moved: () => this.emit('camera-change', { camera: this.camera, framed: this.framed }),
      frameAll: () => this.frameAll(),
      invalidate: () => this.invalidate(),
      isPlan: () => this.isPlan,
      isFramed: () => this.framed,
      navigation: () => this.navigation,
      leave: () => this.removeAttribute('navigation'),
      field: () => this.field,
      metresPerPixel: () => this.#camera.metresPerPixel,
      interaction: () => (this.hasAttribute('disabled') ? 'none' : this.interactionMode),
    } satisfies Steered;
    this.#controls = new Steering(scene, this.#camera.rotation);
    this.#camera.rotation = this.#controls.rotation;
    if (this.rotates) this.invalidate();
  }

  protected override left(): void {
    super.left();
    this.#controls?.dispose();
    this.#controls = undefined;
    this.#camera.stay();
  }

  protected override readManners(): void {
    super.readManners();
    this.#controls?.refresh();
  }
}

/** The largest z of a mesh. */
function highest(positions: Float32Array): number {
  let height = 0;
  for (let k = 2; k < positions.length; k += 3) height = Math.max(height, positions[k]!);
  return height;
}
