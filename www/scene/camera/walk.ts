/** A walk at eye height: from the orbit down to the ground, about, and back. Fetched when somebody walks. */

import type { CameraState } from '../../base/view.ts';
import type { Field } from '../../data/field.ts';
import { HINTS } from '../hints.ts';
import { prefersStillness } from './stillness.ts';
import { Footing } from './footing.ts';
import type { CameraFlight } from './flight.ts';
import type { Steered } from './steered.ts';
import { WalkControls } from './walk-controls.ts';
import { eyeHeight, Walker } from './walker.ts';
import type { Grounds } from './walker.ts';

type Fly = (from: CameraState, to: CameraState) => CameraFlight;

/** Long enough to be read. */
const HINT_MS = 5000;

export class Walk {
  readonly #scene: Steered;
  readonly #fly: Fly;
  /** The camera before; null where the field was framed. */
  readonly #before: CameraState | null;
  readonly #walker: Walker;
  readonly #controls: WalkControls;
  #field: Field;
  /** There, and then back. */
  #flight: CameraFlight | undefined;
  #isEnding = false;
  #isOver = false;
  /** The camera as it was left: another one is somebody else's. */
  #left: string;

  constructor(scene: Steered, field: Field, fly: Fly) {
    this.#scene = scene;
    this.#fly = fly;
    this.#field = field;
    const from = scene.camera();
    this.#before = scene.isFramed() ? null : from;
    this.#left = JSON.stringify(from);
    this.#walker = new Walker(from, this.#grounds());
    this.#controls = new WalkControls(scene.tree.stage, this.#walker, {
      onMove: () => scene.invalidate(),
      onLeave: () => scene.leave(),
      takesWheel: () => scene.interaction() === 'always',
      isStill: () => this.#isStill,
    });
    if (!this.#isStill) this.#flight = fly(from, this.#walker.camera);
    const { stage } = scene.tree;
    stage.setAttribute('aria-keyshortcuts', 'W A S D Escape');
    // Where somebody has just asked for it, the keys are the picture's at once; a page that begins so keeps the focus where it is.
    if (scene.view().navigator.userActivation?.isActive ?? true) stage.focus({ preventScroll: true });
    scene.tree.hint(HINTS[scene.view().matchMedia('(pointer: coarse)').matches ? 'walkByTouch' : 'walk'][scene.language()], HINT_MS);
    scene.invalidate();
  }

  get isOver(): boolean {
    return this.#isOver;
  }

  /** Back to where the camera was before. */
  end(): void {
    if (this.#isEnding) return;
    this.#isEnding = true;
    this.dispose();
    const scene = this.#scene;
    const from = scene.camera();
    scene.move(this.#before);
    this.#flight = this.#isStill ? undefined : this.#fly(from, scene.camera());
    scene.move(from);
    this.#left = JSON.stringify(scene.camera());
    scene.invalidate();
  }

  /** Hears nothing any more. */
  dispose(): void {
    this.#controls.dispose();
    this.#scene.tree.stage.removeAttribute('aria-keyshortcuts');
  }

  /** On to the frame at `now`. True while there is more to come. */
  advance(now: number): boolean {
    const scene = this.#scene;
    if (JSON.stringify(scene.camera()) !== this.#left) {
      // A link was opened, all was framed, or a program has moved the camera: that is where it stays.
      if (!this.#isEnding) this.dispose();
      this.#isOver = true;
      scene.leave();
      return false;
    }
    const onTheWay = this.#flight?.at(now);
    if (onTheWay) {
      this.#show(onTheWay);
      return true;
    }
    this.#flight = undefined;
    if (this.#isEnding) {
      this.#isOver = true;
      this.#show(this.#before);
      return false;
    }
    const field = scene.field();
    if (field && field !== this.#field) {
      this.#field = field;
      this.#walker.grounds = this.#grounds();
    }
    const moves = this.#controls.advance(now);
    this.#show(this.#walker.camera);
    return moves;
  }

  get #isStill(): boolean {
    return prefersStillness(this.#scene.view());
  }

  #show(camera: CameraState | null): void {
    const scene = this.#scene;
    const before = this.#left;
    scene.move(camera);
    this.#left = JSON.stringify(scene.camera());
    if (this.#left !== before) scene.moved();
  }

  #grounds(): Grounds {
    const { imageWidth, imageHeight } = this.#field;
    const extent = [imageWidth, imageHeight] as const;
    const metresPerPixel = this.#scene.metresPerPixel();
    return { extent, metresPerPixel, footing: new Footing(this.#field, eyeHeight(extent, metresPerPixel)) };
  }
}
