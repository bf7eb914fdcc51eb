/** A scene's camera in the user's hands: what their gestures do, and a word on those that did nothing. Fetched after the first picture. */

import { lazily } from '../../base/lazy.ts';
import type { CameraState } from '../../base/view.ts';
import type { SceneTree } from '../tree.ts';
import { AutoRotation } from './auto-rotation.ts';
import { CameraFlight } from './flight.ts';
import { OrbitControls } from './orbit-controls.ts';
import type { Steered } from './steered.ts';
import type { Walk } from './walk.ts';

/** Scenes that have explained once what fingers do: these meet the picture whenever they scroll. */
const explained = new WeakSet<SceneTree>();

/** A flight that begins now. */
const fly = (from: CameraState, to: CameraState): CameraFlight => new CameraFlight(from, to, performance.now());

/** Gestures move the camera until `dispose` is called. */
export class Steering {
  readonly fly = fly;
  /** What turns the camera by itself, from before or new: the hands stop it for a while. */
  readonly rotation: AutoRotation;
  readonly #scene: Steered;
  readonly #orbit: OrbitControls;
  #walk: Walk | undefined;
  #isComing = false;
  #isDisposed = false;

  constructor(scene: Steered, rotation = new AutoRotation()) {
    this.rotation = rotation;
    this.#scene = scene;
    this.#orbit = new OrbitControls(
      scene.tree.stage,
      () => scene.camera(),
      (camera) => scene.move(camera),
      {
        onInteract: () => {
          this.rotation.pause(performance.now());
          scene.moved();
        },
        onFrameAll: () => scene.frameAll(),
        onRefused: (gesture) => void explain(gesture, scene),
        isPlan: () => scene.isPlan(),
        interaction: () => (this.#walk ? 'none' : scene.interaction()),
      },
    );
    this.#choose();
  }

  /** To be called after a change of `interaction` or `navigation`. */
  refresh(): void {
    this.#orbit.refresh();
    this.#choose();
  }

  dispose(): void {
    this.#isDisposed = true;
    this.#walk?.dispose();
    this.#orbit.dispose();
  }

  /** On to the frame at `now`. True while a walk has more to come; undefined while nobody walks. */
  advance(now: number): boolean | undefined {
    this.#choose();
    const moves = this.#walk?.advance(now);
    if (!this.#walk?.isOver) return moves;
    this.#walk = undefined;
    this.rotation.pause(now);
    this.refresh();
    return undefined;
  }

  /** Begins a walk, or ends it, as the scene has it. There is nowhere to walk in a plan. */
  #choose(): void {
    const scene = this.#scene;
    const field = scene.field();
    const walks = scene.navigation() === 'walk' && scene.interaction() !== 'none' && !scene.isPlan();
    if (!walks) this.#walk?.end();
    else if (field && !this.#walk && !this.#isComing) this.#begin().catch((thrown: unknown) => console.warn(thrown));
  }

  async #begin(): Promise<void> {
    this.#isComing = true;
    try {
      const { Walk } = await lazily(() => import('./walk.ts'));
      const field = this.#scene.field();
      if (this.#isDisposed || !field || this.#scene.navigation() !== 'walk') return;
      this.#walk = new Walk(this.#scene, field, fly);
      this.#orbit.refresh();
    } finally {
      this.#isComing = false;
    }
  }
}

/** Says why a gesture did nothing. */
async function explain(gesture: 'wheel' | 'touch', { tree, language }: Steered): Promise<void> {
  if (gesture === 'touch' && explained.has(tree)) return;
  if (gesture === 'touch') explained.add(tree);
  try {
    tree.hint((await lazily(() => import('../hints.ts'))).HINTS[gesture][language()]);
  } catch (thrown) {
    console.warn(thrown);
  }
}
