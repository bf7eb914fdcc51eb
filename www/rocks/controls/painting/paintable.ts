/** What of an element is painted on. */

import type { CameraState } from '../../../base/view.ts';

export interface Paintable extends HTMLElement {
  get camera(): CameraState;
  set camera(camera: CameraState | null);
  readonly defaultCamera: CameraState;
  navigation: string | null;
  readonly hasMask: boolean;
  setMask(mask: Blob | null): Promise<void>;
}
