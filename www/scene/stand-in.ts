/** Shows the plan, and how much of the renderer has arrived, for as long as a slow network brings it. */

import type { Field } from '../data/field.ts';
import { lazily } from '../base/lazy.ts';
import type { Language } from '../base/language.ts';
import { loadingText } from '../renderer/loading.ts';
import { rendererArrived } from '../renderer/artefact.ts';
import type { CameraState } from '../base/view.ts';
import type { SceneRenderer, SceneStyle, Wood } from '../renderer/renderer.ts';
import type { SceneTree } from './tree.ts';

/** A renderer that comes within this needs no plan before it. */
const PATIENCE_MS = 400;
const LOOK_EVERY_MS = 200;

/** What there is to show. */
interface Shown {
  field: Field | null;
  wood: Wood | null;
  style: SceneStyle;
  camera: CameraState;
  size: readonly [number, number] | undefined;
}

interface Host {
  /** The renderer has come, or nobody waits for it any more. */
  isOver(): boolean;
  tree: SceneTree;
  language(): Language;
  scene(): Shown;
}

/** Where something stands in at present. */
const standing = new WeakSet<SceneTree>();

/** Resolves when it is over, or at once where something stands in already. */
export async function standIn(host: Host): Promise<void> {
  if (standing.has(host.tree)) return;
  standing.add(host.tree);
  try {
    await standInUntilOver(host);
  } finally {
    standing.delete(host.tree);
  }
}

/** A poster of the author's stays where it is: then only the words are shown. */
async function standInUntilOver({ isOver, tree, language, scene }: Host): Promise<void> {
  let plan: SceneRenderer | undefined;
  let drawn = '';
  let last: Shown | undefined;
  await pause(PATIENCE_MS);
  try {
    for (; !isOver(); await pause(LOOK_EVERY_MS)) {
      const arrived = rendererArrived();
      tree.messages.setLoading(arrived === null ? '' : loadingText(language(), arrived));
      if (arrived === null || tree.hasPoster) continue;
      if (!plan) {
        const { Canvas2dRenderer } = await lazily(() => import('../renderer/canvas2d.ts'), true);
        if (isOver()) break;
        plan = new Canvas2dRenderer(tree.makeCanvas());
        tree.standIn(plan.canvas);
      }
      const now = scene();
      const rest = JSON.stringify([now.style, now.camera, now.size]);
      if (now.field === last?.field && now.wood === last?.wood && rest === drawn) continue;
      [last, drawn] = [now, rest];
      if (now.field) plan.setField(now.field);
      plan.setWood(now.wood);
      plan.setStyle(now.style);
      plan.resize(...(now.size ?? ([1, 1] as const)));
      plan.setCamera(now.camera);
      plan.render();
    }
  } finally {
    tree.messages.setLoading('');
    plan?.canvas.remove();
  }
}

function pause(ms: number): Promise<void> {
  return new Promise((resolve) => setTimeout(resolve, ms));
}
