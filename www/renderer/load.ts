/** Finds the best backend that really works and makes a renderer of it. */

import { lazily } from '../lazy.ts';
import { GpuRenderer } from './gpu.ts';
import type { Backend, SceneRenderer } from './renderer.ts';

/** `auto` tries WebGPU, WebGL2, then canvas 2D; a name asks for that backend alone. */
export type WantedBackend = 'auto' | Backend;

const IN_ORDER = ['webgpu', 'webgl', 'canvas2d'] as const satisfies readonly Backend[];

/** What the attribute says; anything else is `auto`. */
export function wantedBackend(given: string | null): WantedBackend {
  return given === 'webgpu' || given === 'webgl' || given === 'canvas2d' || given === 'null' ? given : 'auto';
}

/**
 * A renderer on a canvas from `makeCanvas`. A canvas keeps the first kind of context it was asked for, so `makeCanvas` is called
 * once for every backend that gets as far as that.
 *
 * @throws an Error saying for each backend tried why it was refused.
 */
export async function loadRenderer(makeCanvas: () => HTMLCanvasElement, wanted: WantedBackend = 'auto'): Promise<SceneRenderer> {
  const refusals: string[] = [];
  for (const backend of wanted === 'auto' ? IN_ORDER : [wanted]) {
    try {
      return await open(backend, makeCanvas);
    } catch (error) {
      refusals.push(`${backend}: ${error instanceof Error ? error.message : String(error)}`);
    }
  }
  throw new Error(`The rocks cannot be drawn here. ${refusals.join('; ')}`);
}

async function open(backend: Backend, makeCanvas: () => HTMLCanvasElement): Promise<SceneRenderer> {
  switch (backend) {
    case 'null':
      return new (await lazily(() => import('./null.ts'))).NullRenderer(makeCanvas());
    case 'canvas2d':
      return new (await lazily(() => import('./canvas2d.ts'))).Canvas2dRenderer(makeCanvas());
    case 'webgpu':
    case 'webgl':
      return GpuRenderer.create(backend, makeCanvas);
  }
}
