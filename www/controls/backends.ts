/** What draws, as it is called. */

import type { Backend } from '../renderer/renderer.ts';

export const BACKENDS: Record<Backend, string> = { webgpu: 'WebGPU', webgl: 'WebGL2', canvas2d: 'Canvas 2D', null: '–' };
