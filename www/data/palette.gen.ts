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
  { name: 'basalt', albedo: [0.126, 0.12, 0.113] },
  { name: 'sandstone', albedo: [0.27, 0.227, 0.174] },
  { name: 'limestone', albedo: [0.35, 0.335, 0.3] },
  { name: 'slate', albedo: [0.152, 0.16, 0.158] },
  { name: 'quartz', albedo: [0.41, 0.395, 0.36] },
  { name: 'red-sandstone', albedo: [0.215, 0.166, 0.142] },
] as const;

/** What a log is made of, in the order of its `kinds`, with mean colours in linear light. */
export const WOOD = [
  { name: 'bark', plain: [0.2, 0.16, 0.125], natural: [0.1282, 0.1017, 0.0789] },
  { name: 'end-grain', plain: [0.42, 0.33, 0.23], natural: [0.1645, 0.126, 0.0885] },
  { name: 'splinter', plain: [0.42, 0.33, 0.23], natural: [0.24, 0.1825, 0.13] },
] as const;

/** What the colours of wood ears are mixed from, in linear light: those of wet flesh by age, of the other
 * states and sides, and of plain ones. */
export const FLESH = {
  young: [0.2, 0.098, 0.042],
  grown: [0.115, 0.046, 0.019],
  old: [0.04, 0.013, 0.0085],
  dryInside: [0.026, 0.019, 0.016],
  wetOutside: [0.086, 0.058, 0.041],
  dryOutside: [0.185, 0.162, 0.142],
  velvet: [0.36, 0.32, 0.285],
  plainInside: [0.2, 0.085, 0.06],
  plainOutside: [0.27, 0.21, 0.18],
} as const;

/** What lies between rocks, by the names of the parameter `ground`, with its colour in linear light. */
export const GROUND_KINDS = [
  { name: 'soil', albedo: [0.115, 0.092, 0.069] },
  { name: 'sand', albedo: [0.4, 0.335, 0.245] },
  { name: 'gravel', albedo: [0.19, 0.174, 0.148] },
] as const;

/** What lies between rocks in all other colours: bytes of sRGB. */
export const SOIL = [92, 74, 61] as const;
