/** Where the browser gets the artefact from that makes the ground of files. */

import { Realm } from '../generator/headless.ts';
import type { GroundModule } from './ground.ts';

/** Fetched when a ground is first asked for. */
export const groundRealm = /* @__PURE__ */ new Realm<GroundModule>(
  () => import('../../pkg/ground-mesh.js'),
  // Bundlers copy the file when they see it in this literal form.
  () => new URL('./ground-mesh_bg.wasm', import.meta.url),
);
