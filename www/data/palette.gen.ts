// Generated from src/shading/palette.rs by `UPDATE=1 cargo test --lib palette`; never edited.

/** Colours of rocks by layer id modulo 8: bytes of sRGB. */
export const STONE = [
  [176, 108, 90],
  [198, 165, 106],
  [112, 138, 155],
  [143, 157, 112],
  [150, 118, 143],
  [208, 198, 180],
  [104, 109, 116],
  [100, 152, 146],
] as const;

/** How many of 100 stones of a mixture are of each kind. */
export const MIXED = [24, 18, 20, 5, 19, 6, 8] as const;

/** The kinds of stone, with their mean colour in linear light. */
export const STONE_KINDS = [
  { name: 'granite', albedo: [0.235, 0.228, 0.214] },
  { name: 'basalt', albedo: [0.122, 0.122, 0.12] },
  { name: 'sandstone', albedo: [0.27, 0.227, 0.174] },
  { name: 'limestone', albedo: [0.35, 0.335, 0.3] },
  { name: 'slate', albedo: [0.152, 0.16, 0.158] },
  { name: 'quartz', albedo: [0.41, 0.395, 0.36] },
  { name: 'red-sandstone', albedo: [0.215, 0.166, 0.142] },
] as const;
