/** Finds the best backend that really works and makes a renderer of it. */

import { lazily } from '../base/lazy.ts';
import { GpuRenderer } from './gpu.ts';
import type { Backend } from '../base/view.ts';
import type { SceneRenderer } from './renderer.ts';

/** `auto` tries WebGPU, WebGL2, then canvas 2D; a name asks for that backend alone. */
export type WantedBackend = 'auto' | Backend;

/** A backend that was tried, and why it cannot draw. */
export interface Refusal {
  backend: Backend;
  error: unknown;
}

const IN_ORDER = ['webgpu', 'webgl', 'canvas2d'] as const satisfies readonly Backend[];

/** What the attribute says; anything else is `auto`. */
export function wantedBackend(given: string | null): WantedBackend {
  return given === 'webgpu' || given === 'webgl' || given === 'canvas2d' || given === 'null' ? given : 'auto';
}

/** The backends to try, in this order. */
export function backendsOf(wanted: WantedBackend): readonly Backend[] {
  return wanted === 'auto' ? IN_ORDER : [wanted];
}

/**
 * A renderer on a canvas from `makeCanvas`; undefined where no backend works. A canvas keeps the first kind of context it was asked for,
 * so `makeCanvas` is called once for every backend that gets as far as that.
 *
 * @param refusals filled with the backends that were tried in vain.
 */
export async function loadRenderer(
  makeCanvas: () => HTMLCanvasElement,
  backends: readonly Backend[],
  refusals: Refusal[],
): Promise<SceneRenderer | undefined> {
  // The plan stands in for a renderer that does not arrive, so it is asked for before the network may be gone.
  const plan = backends.includes('canvas2d') ? loadPlan() : undefined;
  plan?.catch(() => undefined);
  for (const backend of backends) {
    try {
      return await open(backend, makeCanvas, plan);
    } catch (error) {
      refusals.push({ backend, error });
    }
  }
  return undefined;
}

function loadPlan(): Promise<typeof import('./canvas2d.ts')> {
  return lazily(() => import('./canvas2d.ts'), true);
}

async function open(
  backend: Backend,
  makeCanvas: () => HTMLCanvasElement,
  plan: ReturnType<typeof loadPlan> | undefined,
): Promise<SceneRenderer> {
  switch (backend) {
    case 'null':
      return new (await lazily(() => import('./null.ts'))).NullRenderer(makeCanvas());
    case 'canvas2d':
      return new (await (plan ?? loadPlan())).Canvas2dRenderer(makeCanvas());
    case 'webgpu':
    case 'webgl':
      return GpuRenderer.create(backend, makeCanvas);
  }
}
