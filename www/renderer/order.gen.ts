// Generated from src/shading/order.rs by `UPDATE=1 cargo test --lib order`; never edited.

/** The index of its word is what `RawRenderer.setStyle` takes as a view. */
export const VIEWS = ['3d', 'wireframe', 'diagrams', 'selection'] as const;

/** Likewise, as a colour mode. */
export const COLORS = ['layer', 'rock', 'plain', 'natural'] as const;

/** Likewise, what `RawRenderer.setQuality` takes. */
export const QUALITIES = ['low', 'medium', 'high'] as const;

/** The values that `RawRenderer.setLook` takes, in this order. */
export const LOOK = ['variation', 'wetness', 'moss', 'dust', 'snow', 'water', 'ground', 'sunAzimuth', 'sunElevation'] as const;

/** The values of wood ears, which follow those of `LOOK`. */
export const FLESH = ['moisture', 'variation', 'translucency', 'velvet'] as const;
