/** Whether a device has the memory for what it is given: browsers tell it apart from all other errors, and draw nothing where it has not. */

import type { GpuBackend } from '../base/view.ts';

/** The little of a WebGPU canvas that is used. */
interface GpuContext {
  getConfiguration?(): { device: { pushErrorScope(filter: 'out-of-memory'): void; popErrorScope(): Promise<object | null> } } | null;
}

/**
 * Watches the canvas's device. What is returned is to be called in the same task, when it has been given what may be too much: it tells whether there
 * was enough.
 */
export function watchMemory(canvas: HTMLCanvasElement, backend: GpuBackend): () => Promise<boolean> {
  if (backend === 'webgpu') {
    const device = (canvas.getContext('webgpu') as GpuContext | null)?.getConfiguration?.()?.device;
    device?.pushErrorScope('out-of-memory');
    // On a device that is lost the question fails; whoever draws with it finds that out by themselves.
    return async () => !(await device?.popErrorScope().catch(() => null));
  }
  const gl = canvas.getContext('webgl2');
  const errors = (): number[] => {
    const found: number[] = [];
    // A context that is lost may have errors without an end.
    for (let error = gl?.getError(); error && found.length < 8; error = gl?.getError()) found.push(error);
    return found;
  };
  errors();
  return async () => !errors().includes(gl?.OUT_OF_MEMORY ?? 0);
}
