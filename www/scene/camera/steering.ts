/** A scene's camera in the user's hands: what their gestures do, and a word on those that did nothing. Fetched after the first picture. */

import type { Language } from '../../base/language.ts';
import { lazily } from '../../base/lazy.ts';
import type { CameraState, Interaction } from '../../base/view.ts';
import type { SceneTree } from '../tree.ts';
import { CameraFlight } from './flight.ts';
import { OrbitControls } from './orbit-controls.ts';

/** The scene that is steered. */
export interface Steered {
  tree: SceneTree;
  language(): Language;
  camera(): CameraState;
  /** Moves the camera. */
  move(camera: CameraState): void;
  /** The user has moved it. */
  moved(): void;
  frameAll(): void;
  /** Whether it is seen from straight above. */
  isPlan(): boolean;
  interaction(): Interaction;
}

/** Scenes that have explained once what fingers do: these meet the picture whenever they scroll. */
const explained = new WeakSet<SceneTree>();

export interface Steering {
  /** A flight that begins now. */
  fly(from: CameraState, to: CameraState): CameraFlight;
  /** To be called after a change of `interaction`. */
  refresh(): void;
  dispose(): void;
}

/** Gestures move the camera until `dispose` is called. */
export function steer(scene: Steered): Steering {
  const controls = new OrbitControls(
    scene.tree.stage,
    () => scene.camera(),
    (camera) => scene.move(camera),
    {
      onInteract: () => scene.moved(),
      onFrameAll: () => scene.frameAll(),
      onRefused: (gesture) => void explain(gesture, scene),
      isPlan: () => scene.isPlan(),
      interaction: () => scene.interaction(),
    },
  );
  return {
    fly: (from, to) => new CameraFlight(from, to, performance.now()),
    refresh: () => controls.refresh(),
    dispose: () => controls.dispose(),
  };
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
