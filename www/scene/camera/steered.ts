/** What hands that move a camera see of its scene. */

import type { Language } from '../../base/language.ts';
import type { CameraState, Interaction, Navigation } from '../../base/view.ts';
import type { Field } from '../../data/field.ts';
import type { SceneTree } from '../tree.ts';

export interface Steered {
  tree: SceneTree;
  language(): Language;
  view(): Window;
  camera(): CameraState;
  /** Moves the camera; null frames the field. */
  move(camera: CameraState | null): void;
  /** The user has moved it. */
  moved(): void;
  frameAll(): void;
  /** A frame is wanted. */
  invalidate(): void;
  /** Whether it is seen from straight above. */
  isPlan(): boolean;
  isFramed(): boolean;
  interaction(): Interaction;
  navigation(): Navigation;
  /** The walk is over. */
  leave(): void;
  field(): Field | null;
  metresPerPixel(): number;
}
