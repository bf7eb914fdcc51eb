// Each scene is fetched when it is asked for, as each would be a page of its own.

const scenes = {
  three: async (kind: 'webgl' | 'webgpu') => (await import('./three')).look(kind),
  fiber: async () => (await import('./fiber')).look(),
  babylon: async () => (await import('./babylon')).look(),
};

export type Scenes = typeof scenes;

Object.assign(globalThis, { scenes });
