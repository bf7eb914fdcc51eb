/** What makes the ground between rocks, for Node. */

import { readFile } from 'node:fs/promises';
import { Realm } from '../generator/headless.ts';
import type { GroundModule } from '../rocks/ground.ts';

/** Fetched when a ground is first asked for. */
export const ground = /* @__PURE__ */ new Realm<GroundModule>(
  () => import('../../pkg/ground-mesh.js'),
  () => readFile(new URL('./ground-mesh_bg.wasm', import.meta.url)),
);
