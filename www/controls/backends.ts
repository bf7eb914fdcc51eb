/** What draws, as it is called. */

import type { Backend } from '../base/view.ts';

export const BACKENDS: Record<Backend, string> = { webgpu: 'WebGPU', webgl: 'WebGL2', canvas2d: 'Canvas 2D', null: '–' };
