/** Whether a device has the memory for what it is given: browsers tell it apart from all other errors, and draw nothing where it has not. */

import type { GpuBackend } from '../base/view.ts';

/** The little of a WebGPU canvas that is used. */
interface GpuContext {
  getConfiguration?(): { device: { pushErrorScope(filter: 'out-of-memory'): void; popErrorScope(): Promise<object | null> } } | null;
}

/**
 * Calls `make`, which gives the canvas's device what may be too much for it. What is returned is to be asked when the device is done with that: whether it
 * had the memory. With WebGL2 the page waits for a device that is busy, here as with the question.
 */
export function watchMemory(canvas: HTMLCanvasElement, backend: GpuBackend, make: () => void): () => Promise<boolean> {
  if (backend === 'webgpu') {
    const device = (canvas.getContext('webgpu') as GpuContext | null)?.getConfiguration?.()?.device;
    device?.pushErrorScope('out-of-memory');
    let refused: Promise<object | null> | undefined;
    try {
      make();
    } finally {
      // On a device that is lost the question fails; whoever draws with it finds that out by themselves.
      refused = device?.popErrorScope().catch(() => null);
    }
    return async () => !(await refused);
  }
  const gl = canvas.getContext('webgl2');
  const errors = (): number[] => {
    const found: number[] = [];
    // A context that is lost may have errors without an end.
    for (let error = gl?.getError(); error && found.length < 8; error = gl?.getError()) found.push(error);
    return found;
  };
  errors();
  make();
  let answer: boolean | undefined;
  return async () => (answer ??= !errors().includes(gl?.OUT_OF_MEMORY ?? 0));
}
