/** When a device is done with what it was given. */

import type { GpuBackend } from '../base/view.ts';

/** The little of a WebGPU canvas that is used; TypeScript's DOM library has none of it. */
interface GpuContext {
  getConfiguration?(): { device: { lost: Promise<unknown>; queue: { onSubmittedWorkDone(): Promise<unknown> } } } | null;
}

/** How often a WebGL2 context is asked, ms. */
const POLL_MS = 4;

/** Resolves when all that was drawn on the canvas's device until now is drawn, or the device is lost. */
export async function deviceDone(canvas: HTMLCanvasElement, backend: GpuBackend): Promise<void> {
  if (backend === 'webgpu') {
    const device = (canvas.getContext('webgpu') as GpuContext | null)?.getConfiguration?.()?.device;
    if (device) await Promise.race([device.lost, device.queue.onSubmittedWorkDone().catch(() => undefined)]);
    return;
  }
  const gl = canvas.getContext('webgl2');
  const sync = gl?.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
  if (!gl || !sync) return;
  gl.flush();
  // A context that is lost says that it is signaled.
  do await new Promise((resolve) => setTimeout(resolve, POLL_MS));
  while (!gl.isContextLost() && gl.getSyncParameter(sync, gl.SYNC_STATUS) !== gl.SIGNALED);
  gl.deleteSync(sync);
}
