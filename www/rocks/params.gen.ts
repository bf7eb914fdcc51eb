// Generated from src/params/rocks/table.rs by `UPDATE=1 cargo test --test params`; never edited.

import type { ParamSpec, Preset, Triple } from './spec.ts';

export const MAX_LAYERS = 8;

/** Every parameter, in the order of the flat form. */
export const PARAMS = [
  {
    key: "seed", component: null, url: "seed", scope: 'field', kind: 'integer', stage: 'sites',
    min: 0, max: 4294967295, step: 1, default: 0, slider: { min: 0, max: 4294967295, logarithmic: false },
    relative: null,
    unit: { px: "", relative: "" },
    label: "Seed",
    choices: [],
  },
  {
    key: "imageWidth", component: null, url: "w", scope: 'field', kind: 'integer', stage: 'sites',
    min: 1, max: 8192, step: 1, default: 1024, slider: { min: 16, max: 8192, logarithmic: true },
    relative: null,
    unit: { px: "px", relative: "px" },
    label: "Width",
    choices: [],
  },
  {
    key: "imageHeight", component: null, url: "h", scope: 'field', kind: 'integer', stage: 'sites',
    min: 1, max: 8192, step: 1, default: 1024, slider: { min: 16, max: 8192, logarithmic: true },
    relative: null,
    unit: { px: "px", relative: "px" },
    label: "Depth",
    choices: [],
  },
  {
    key: "packing", component: null, url: "cd", scope: 'field', kind: 'real', stage: 'sites',
    min: 0, max: 1, step: 0.01, default: 0.7, slider: { min: 0, max: 1, logarithmic: false },
    relative: null,
    unit: { px: "", relative: "" },
    label: "Packing c_d",
    choices: [],
  },
  {
    key: "notation", component: null, url: "u", scope: 'field', kind: 'choice', stage: 'sites',
    min: 0, max: 1, step: 1, default: 0, slider: { min: 0, max: 1, logarithmic: false },
    relative: null,
    unit: { px: "", relative: "" },
    label: "Notation",
    choices: [{ value: "px", label: "Pixels" }, { value: "relative", label: "Relative" }],
  },
  {
    key: "darts", component: null, url: "darts", scope: 'field', kind: 'choice', stage: 'sites',
    min: 0, max: 1, step: 1, default: 0, slider: { min: 0, max: 1, logarithmic: false },
    relative: null,
    unit: { px: "", relative: "" },
    label: "Darts",
    choices: [{ value: "saturate", label: "Until saturated" }, { value: "attempts", label: "N_p attempts" }],
  },
  {
    key: "border", component: null, url: "border", scope: 'field', kind: 'choice', stage: 'selection',
    min: 0, max: 1, step: 1, default: 0, slider: { min: 0, max: 1, logarithmic: false },
    relative: null,
    unit: { px: "", relative: "" },
    label: "Border cells",
    choices: [{ value: "clip", label: "Clip" }, { value: "drop", label: "Drop" }],
  },
  {
    key: "swing", component: null, url: "swing", scope: 'field', kind: 'choice', stage: 'mesh',
    min: 0, max: 1, step: 1, default: 0, slider: { min: 0, max: 1, logarithmic: false },
    relative: null,
    unit: { px: "", relative: "" },
    label: "Swing",
    choices: [{ value: "shared", label: "Shared" }, { value: "separate", label: "Separate" }],
  },
  {
    key: "crossing", component: null, url: "cross", scope: 'field', kind: 'choice', stage: 'mesh',
    min: 0, max: 1, step: 1, default: 0, slider: { min: 0, max: 1, logarithmic: false },
    relative: null,
    unit: { px: "", relative: "" },
    label: "Neighbours",
    choices: [{ value: "free", label: "May cross" }, { value: "apart", label: "Stay apart" }],
  },
  {
    key: "variation", component: null, url: "var", scope: 'field', kind: 'real', stage: 'look',
    min: 0, max: 1, step: 0.01, default: 0.5, slider: { min: 0, max: 1, logarithmic: false },
    relative: null,
    unit: { px: "", relative: "" },
    label: "Variation",
    choices: [],
  },
  {
    key: "wetness", component: null, url: "wet", scope: 'field', kind: 'real', stage: 'look',
    min: 0, max: 1, step: 0.01, default: 0, slider: { min: 0, max: 1, logarithmic: false },
    relative: null,
    unit: { px: "", relative: "" },
    label: "Wetness",
    choices: [],
  },
  {
    key: "moss", component: null, url: "moss", scope: 'field', kind: 'real', stage: 'look',
    min: 0, max: 1, step: 0.01, default: 0, slider: { min: 0, max: 1, logarithmic: false },
    relative: null,
    unit: { px: "", relative: "" },
    label: "Moss",
    choices: [],
  },
  {
    key: "dust", component: null, url: "dust", scope: 'field', kind: 'real', stage: 'look',
    min: 0, max: 1, step: 0.01, default: 0.2, slider: { min: 0, max: 1, logarithmic: false },
    relative: null,
    unit: { px: "", relative: "" },
    label: "Dust",
    choices: [],
  },
  {
    key: "snow", component: null, url: "snow", scope: 'field', kind: 'real', stage: 'look',
    min: 0, max: 1, step: 0.01, default: 0, slider: { min: 0, max: 1, logarithmic: false },
    relative: null,
    unit: { px: "", relative: "" },
    label: "Snow",
    choices: [],
  },
  {
    key: "water", component: null, url: "water", scope: 'field', kind: 'real', stage: 'look',
    min: 0, max: 1, step: 0.01, default: 0, slider: { min: 0, max: 1, logarithmic: false },
    relative: null,
    unit: { px: "", relative: "" },
    label: "Water",
    choices: [],
  },
  {
    key: "ground", component: null, url: "soil", scope: 'field', kind: 'choice', stage: 'look',
    min: 0, max: 2, step: 1, default: 0, slider: { min: 0, max: 2, logarithmic: false },
    relative: null,
    unit: { px: "", relative: "" },
    label: "Ground",
    choices: [{ value: "soil", label: "Soil" }, { value: "sand", label: "Sand" }, { value: "gravel", label: "Gravel" }],
  },
  {
    key: "sunAzimuth", component: null, url: "sa", scope: 'field', kind: 'real', stage: 'look',
    min: 0, max: 360, step: 1, default: 259, slider: { min: 0, max: 360, logarithmic: false },
    relative: null,
    unit: { px: "°", relative: "°" },
    label: "Sun azimuth",
    choices: [],
  },
  {
    key: "sunElevation", component: null, url: "se", scope: 'field', kind: 'real', stage: 'look',
    min: 5, max: 90, step: 1, default: 35, slider: { min: 5, max: 90, logarithmic: false },
    relative: null,
    unit: { px: "°", relative: "°" },
    label: "Sun elevation",
    choices: [],
  },
  {
    key: "radius", component: null, url: "r", scope: 'layer', kind: 'real', stage: 'sites',
    min: 1, max: 8192, step: 0.1, default: 30, slider: { min: 2, max: 512, logarithmic: true },
    relative: { min: 0.01, max: 8192, step: 0.01, default: 3, slider: { min: 0.2, max: 50, logarithmic: true } },
    unit: { px: "px", relative: "width/100" },
    label: "Radius r",
    choices: [],
  },
  {
    key: "areaFraction", component: null, url: "a", scope: 'layer', kind: 'real', stage: 'selection',
    min: 0, max: 1, step: 0.01, default: 0.25, slider: { min: 0, max: 1, logarithmic: false },
    relative: null,
    unit: { px: "", relative: "" },
    label: "Area A_s",
    choices: [],
  },
  {
    key: "cellCount", component: null, url: "n", scope: 'layer', kind: 'optional-integer', stage: 'selection',
    min: 0, max: 4294967295, step: 1, default: null, slider: { min: 0, max: 1000, logarithmic: false },
    relative: null,
    unit: { px: "", relative: "" },
    label: "Count",
    choices: [],
  },
  {
    key: "taper", component: 0, url: "w1", scope: 'layer', kind: 'real', stage: 'mesh',
    min: -500, max: 500, step: 0.1, default: 0, slider: { min: -40, max: 40, logarithmic: false },
    relative: { min: -500, max: 500, step: 0.01, default: 0, slider: { min: -4, max: 4, logarithmic: false } },
    unit: { px: "px", relative: "width/100" },
    label: "Taper base c_w1",
    choices: [],
  },
  {
    key: "taper", component: 1, url: "w2", scope: 'layer', kind: 'real', stage: 'mesh',
    min: -500, max: 500, step: 0.1, default: 6, slider: { min: -40, max: 40, logarithmic: false },
    relative: { min: -500, max: 500, step: 0.01, default: 0.3, slider: { min: -4, max: 4, logarithmic: false } },
    unit: { px: "px", relative: "width/100" },
    label: "Taper per rock c_w2",
    choices: [],
  },
  {
    key: "taper", component: 2, url: "w3", scope: 'layer', kind: 'real', stage: 'mesh',
    min: -500, max: 500, step: 0.1, default: 2, slider: { min: -40, max: 40, logarithmic: false },
    relative: { min: -500, max: 500, step: 0.01, default: 0.1, slider: { min: -4, max: 4, logarithmic: false } },
    unit: { px: "px", relative: "width/100" },
    label: "Taper per vertex c_w3",
    choices: [],
  },
  {
    key: "height", component: 0, url: "h1", scope: 'layer', kind: 'real', stage: 'mesh',
    min: 0, max: 500, step: 0.1, default: 5, slider: { min: 0, max: 80, logarithmic: false },
    relative: { min: 0, max: 500, step: 0.01, default: 0.3, slider: { min: 0, max: 2, logarithmic: false } },
    unit: { px: "px", relative: "r" },
    label: "Height base c_h1",
    choices: [],
  },
  {
    key: "height", component: 1, url: "h2", scope: 'layer', kind: 'real', stage: 'mesh',
    min: 0, max: 500, step: 0.1, default: 5, slider: { min: 0, max: 80, logarithmic: false },
    relative: { min: 0, max: 500, step: 0.01, default: 0.3, slider: { min: 0, max: 2, logarithmic: false } },
    unit: { px: "px", relative: "r" },
    label: "Height per rock c_h2",
    choices: [],
  },
  {
    key: "height", component: 2, url: "h3", scope: 'layer', kind: 'real', stage: 'mesh',
    min: 0, max: 500, step: 0.1, default: 3, slider: { min: 0, max: 80, logarithmic: false },
    relative: { min: 0, max: 500, step: 0.01, default: 0.1, slider: { min: 0, max: 2, logarithmic: false } },
    unit: { px: "px", relative: "r" },
    label: "Height per vertex c_h3",
    choices: [],
  },
  {
    key: "weathering", component: null, url: "we", scope: 'layer', kind: 'real', stage: 'mesh',
    min: 0, max: 1, step: 0.01, default: 0, slider: { min: 0, max: 1, logarithmic: false },
    relative: null,
    unit: { px: "", relative: "" },
    label: "Weathering",
    choices: [],
  },
  {
    key: "roughness", component: null, url: "ro", scope: 'layer', kind: 'real', stage: 'mesh',
    min: 0, max: 1, step: 0.01, default: 0, slider: { min: 0, max: 1, logarithmic: false },
    relative: null,
    unit: { px: "", relative: "" },
    label: "Roughness",
    choices: [],
  },
  {
    key: "detail", component: null, url: "dt", scope: 'layer', kind: 'real', stage: 'mesh',
    min: 0, max: 1000, step: 1, default: 0, slider: { min: 0, max: 200, logarithmic: false },
    relative: { min: 0, max: 81920, step: 1, default: 0, slider: { min: 0, max: 2000, logarithmic: false } },
    unit: { px: "/100 px", relative: "/width" },
    label: "Detail",
    choices: [],
  },
  {
    key: "embedding", component: null, url: "em", scope: 'layer', kind: 'real', stage: 'mesh',
    min: 0, max: 1, step: 0.01, default: 0, slider: { min: 0, max: 1, logarithmic: false },
    relative: null,
    unit: { px: "", relative: "" },
    label: "Embedding",
    choices: [],
  },
  {
    key: "material", component: null, url: "mat", scope: 'layer', kind: 'choice', stage: 'look',
    min: 0, max: 5, step: 1, default: 0, slider: { min: 0, max: 5, logarithmic: false },
    relative: null,
    unit: { px: "", relative: "" },
    label: "Material",
    choices: [{ value: "mixed", label: "Mixed" }, { value: "granite", label: "Granite" }, { value: "basalt", label: "Basalt" }, { value: "sandstone", label: "Sandstone" }, { value: "limestone", label: "Limestone" }, { value: "slate", label: "Slate" }],
  },
] as const satisfies readonly ParamSpec[];

/** Table 1 of both papers, then natural grounds. A row per layer, in the order of the layer's rows without the count; a
 * choice is the index of its word. The first is the default. */
export const PRESETS = [
  { name: 'journal-fig1', notation: 'px', layers: [[90, 0.2, 0, 6, 6, 14, 14, 9], [30, 0.24, 0, 6, 2, 5, 5, 3], [10, 0.56, 2, 2, 2, 2, 2, 1]] },
  { name: 'journal-fig11a', notation: 'px', layers: [[90, 0.5, 0, 0, 0, 45, 0, 0]] },
  { name: 'journal-fig11b', notation: 'px', layers: [[30, 0.5, 0, 0, 0, 15, 0, 0]] },
  { name: 'journal-fig11c', notation: 'px', layers: [[10, 0.5, 0, 0, 0, 5, 0, 0]] },
  { name: 'journal-fig12a', notation: 'px', layers: [[90, 0.5, 0, 0, 0, 45, 0, 0], [30, 0.25, 0, 0, 0, 15, 0, 0], [10, 0.25, 0, 0, 0, 5, 0, 0]] },
  { name: 'journal-fig12b', notation: 'px', layers: [[90, 0.25, 0, 0, 0, 45, 0, 0], [30, 0.5, 0, 0, 0, 15, 0, 0], [10, 0.25, 0, 0, 0, 5, 0, 0]] },
  { name: 'journal-fig12c', notation: 'px', layers: [[90, 0.25, 0, 0, 0, 45, 0, 0], [30, 0.25, 0, 0, 0, 15, 0, 0], [10, 0.5, 0, 0, 0, 5, 0, 0]] },
  { name: 'journal-fig13a', notation: 'px', layers: [[90, 0.5, 10, 0, 0, 45, 0, 0]] },
  { name: 'journal-fig13b', notation: 'px', layers: [[90, 0.5, 0, 10, 0, 45, 0, 0]] },
  { name: 'journal-fig13c', notation: 'px', layers: [[90, 0.5, 0, 0, 10, 45, 0, 0]] },
  { name: 'journal-fig14a', notation: 'px', layers: [[90, 0.5, 0, 0, 0, 67, 0, 0]] },
  { name: 'journal-fig14b', notation: 'px', layers: [[90, 0.5, 0, 0, 0, 0, 45, 0]] },
  { name: 'journal-fig14c', notation: 'px', layers: [[90, 0.5, 0, 0, 0, 0, 0, 45]] },
  { name: 'conference-fig1', notation: 'relative', layers: [[9, 0.2, 0, 0.3, 0.3, 0.3, 0.3, 0.1], [3, 0.24, 0, 0.3, 0.1, 0.3, 0.3, 0.1], [1, 0.56, 0.1, 0.1, 0.1, 0.3, 0, 0.1]] },
  { name: 'conference-fig9a', notation: 'relative', layers: [[9, 0.5, 0, 0, 0, 0.3, 0, 0.1]] },
  { name: 'conference-fig9b', notation: 'relative', layers: [[3, 0.5, 0, 0, 0, 0.3, 0, 0.1]] },
  { name: 'conference-fig9c', notation: 'relative', layers: [[1, 0.5, 0, 0, 0, 0.3, 0, 0.1]] },
  { name: 'conference-fig10a', notation: 'relative', layers: [[9, 0.5, 0, 0, 0, 0.3, 0, 0.1], [3, 0.25, 0, 0, 0, 0.3, 0, 0.1], [1, 0.25, 0, 0, 0, 0.3, 0, 0.1]] },
  { name: 'conference-fig10b', notation: 'relative', layers: [[9, 0.25, 0, 0, 0, 0.3, 0, 0.1], [3, 0.5, 0, 0, 0, 0.3, 0, 0.1], [1, 0.25, 0, 0, 0, 0.3, 0, 0.1]] },
  { name: 'conference-fig10c', notation: 'relative', layers: [[9, 0.25, 0, 0, 0, 0.3, 0, 0.1], [3, 0.25, 0, 0, 0, 0.3, 0, 0.1], [1, 0.5, 0, 0, 0, 0.3, 0, 0.1]] },
  { name: 'conference-fig11a', notation: 'relative', layers: [[9, 0.5, 0.4, 0, 0, 0.3, 0, 0]] },
  { name: 'conference-fig11b', notation: 'relative', layers: [[9, 0.5, -0.4, 0, 0, 0.3, 0, 0]] },
  { name: 'conference-fig11c', notation: 'relative', layers: [[9, 0.5, 0.2, 0.4, 0, 0.3, 0, 0]] },
  { name: 'conference-fig11d', notation: 'relative', layers: [[9, 0.5, 0, 0, 0, 1, 0, 0]] },
  { name: 'conference-fig11e', notation: 'relative', layers: [[9, 0.5, 0, 0, 0, 0.1, 0, 0]] },
  { name: 'conference-fig11f', notation: 'relative', layers: [[9, 0.5, 0, 0, 0, 0.3, 0.7, 0]] },
  { name: 'riverbed', natural: true, notation: 'px', fields: { imageWidth: 640, imageHeight: 640, border: "drop", swing: "separate", ground: "gravel", variation: 0.45, dust: 0.3, moss: 0.3, sunAzimuth: 245, sunElevation: 42 }, layers: [[22, 0.03, 0.44, 1.76, 1.1, 7.48, 5.28, 2.64, 0.95, 0.35, 133, 0.25, 0], [15, 0.1, 0.3, 1.2, 0.75, 5.1, 3.6, 1.8, 0.9, 0.35, 87, 0.25, 0], [10.5, 0.24, 0.21, 0.84, 0.53, 3.57, 2.52, 1.26, 0.85, 0.35, 55, 0.25, 0], [7.2, 0.36, 0.14, 0.58, 0.36, 2.45, 1.73, 0.86, 0.8, 0.35, 48, 0.25, 0], [5, 0.4, 0.1, 0.4, 0.25, 1.7, 1.2, 0.6, 0.75, 0.3, 45, 0.2, 0], [3.4, 0.4, 0.07, 0.27, 0.17, 1.16, 0.82, 0.41, 0.7, 0.2, 64, 0.2, 0], [2.4, 0.4, 0.05, 0.19, 0.12, 0.82, 0.58, 0.29, 0.6, 0, 0, 0.15, 0]] },
  { name: 'beach-cobbles', natural: true, notation: 'px', fields: { imageWidth: 640, imageHeight: 640, border: "drop", swing: "separate", ground: "sand", variation: 0.55, wetness: 0.3, dust: 0.05, sunAzimuth: 240, sunElevation: 34 }, layers: [[60, 0.1, 1.2, 3.6, 2.4, 21.6, 12, 4.8, 1, 0.15, 46, 0.3, 0], [38, 0.28, 0.76, 2.28, 1.52, 13.68, 7.6, 3.04, 1, 0.15, 34, 0.25, 0], [24, 0.4, 0.48, 1.44, 0.96, 8.64, 4.8, 1.92, 1, 0.15, 35, 0.2, 0], [15, 0.5, 0.3, 0.9, 0.6, 5.4, 3, 1.2, 1, 0.15, 40, 0.2, 0], [9, 0.5, 0.18, 0.54, 0.36, 3.24, 1.8, 0.72, 0.95, 0.1, 50, 0.2, 0], [5.5, 0.5, 0.11, 0.33, 0.22, 1.98, 1.1, 0.44, 0.9, 0.1, 70, 0.2, 0], [3.6, 0.5, 0.07, 0.22, 0.14, 1.3, 0.72, 0.29, 0.8, 0, 90, 0.2, 0], [2.4, 0.5, 0.05, 0.14, 0.1, 0.86, 0.48, 0.19, 0.8, 0, 60, 0.2, 0]] },
  { name: 'scree', natural: true, notation: 'px', fields: { imageWidth: 720, imageHeight: 720, border: "drop", swing: "separate", crossing: "apart", ground: "gravel", variation: 0.3, dust: 0.1, sunAzimuth: 235, sunElevation: 38 }, layers: [[80, 0.08, 3.2, 8, 4.8, 24, 33.6, 12.8, 0.24, 0.45, 36, 0.2, 4], [48, 0.22, 1.92, 4.8, 2.88, 14.4, 20.16, 7.68, 0.24, 0.4, 27, 0.2, 4], [28, 0.35, 1.12, 2.8, 1.68, 8.4, 11.76, 4.48, 0.25, 0.4, 25, 0.2, 4], [17, 0.4, 0.68, 1.7, 1.02, 5.1, 7.14, 2.72, 0.25, 0.3, 27, 0.2, 4], [10, 0.4, 0.4, 1, 0.6, 3, 4.2, 1.6, 0.25, 0.3, 23, 0.15, 4], [6, 0.4, 0.24, 0.6, 0.36, 1.8, 2.52, 0.96, 0.25, 0.2, 30, 0.15, 4], [3.6, 0.3, 0.14, 0.36, 0.22, 1.08, 1.51, 0.58, 0.22, 0, 0, 0.1, 4]] },
  { name: 'moraine', natural: true, notation: 'px', fields: { imageWidth: 800, imageHeight: 800, border: "drop", swing: "separate", ground: "soil", variation: 0.5, dust: 0.3, moss: 0.25, sunAzimuth: 250, sunElevation: 32 }, layers: [[120, 0.08, 0, 6, 4.8, 33.6, 38.4, 14.4, 0.5, 0.5, 34, 0.25, 1], [70, 0.1, 0, 3.5, 2.8, 19.6, 22.4, 8.4, 0.55, 0.5, 38, 0.3, 1], [40, 0.14, 0, 2, 1.6, 11.2, 12.8, 4.8, 0.6, 0.5, 36, 0.3, 1], [24, 0.18, 0, 1.2, 0.96, 6.72, 7.68, 2.88, 0.65, 0.4, 25, 0.3, 1], [13, 0.25, 0, 0.65, 0.52, 3.64, 4.16, 1.56, 0.7, 0.3, 19, 0.3, 1], [7, 0.3, 0, 0.35, 0.28, 1.96, 2.24, 0.84, 0.7, 0.2, 27, 0.3, 1], [4, 0.3, 0, 0.2, 0.16, 1.12, 1.28, 0.48, 0.7, 0.1, 38, 0.3, 1]] },
  { name: 'desert-pavement', natural: true, notation: 'px', fields: { imageWidth: 560, imageHeight: 560, border: "drop", swing: "separate", crossing: "apart", ground: "sand", variation: 0.6, dust: 0.3, sunAzimuth: 255, sunElevation: 27 }, layers: [[44, 0.03, 0, 2.2, 1.76, 9.68, 9.68, 4.4, 0.4, 0.4, 70, 0.35, 3], [24, 0.08, 0, 1.2, 0.96, 5.28, 5.28, 2.4, 0.45, 0.4, 65, 0.35, 3], [14, 0.24, 0, 0.7, 0.56, 3.08, 3.08, 1.4, 0.45, 0.35, 44, 0.35, 3], [8.5, 0.4, 0, 0.43, 0.34, 1.87, 1.87, 0.85, 0.5, 0.3, 34, 0.3, 3], [5, 0.4, 0, 0.25, 0.2, 1.1, 1.1, 0.5, 0.5, 0.2, 47, 0.3, 3], [3.2, 0.4, 0, 0.16, 0.13, 0.7, 0.7, 0.32, 0.5, 0.1, 52, 0.25, 3], [2.2, 0.4, 0, 0.11, 0.09, 0.48, 0.48, 0.22, 0.5, 0, 0, 0.2, 3]] },
  { name: 'lava-field', natural: true, notation: 'px', fields: { imageWidth: 800, imageHeight: 800, border: "drop", swing: "separate", crossing: "apart", ground: "gravel", variation: 0.35, dust: 0, sunAzimuth: 300, sunElevation: 36 }, layers: [[110, 0.2, 6.6, 15.4, 11, 26.4, 46.2, 24.2, 0.26, 1, 27, 0.2, 2], [66, 0.26, 3.96, 9.24, 6.6, 15.84, 27.72, 14.52, 0.26, 1, 21, 0.2, 2], [40, 0.34, 2.4, 5.6, 4, 9.6, 16.8, 8.8, 0.26, 1, 26, 0.2, 2], [24, 0.4, 1.44, 3.36, 2.4, 5.76, 10.08, 5.28, 0.26, 1, 28, 0.2, 2], [14, 0.45, 0.84, 1.96, 1.4, 3.36, 5.88, 3.08, 0.26, 0.9, 32, 0.15, 2], [8, 0.45, 0.48, 1.12, 0.8, 1.92, 3.36, 1.76, 0.26, 0.7, 29, 0.15, 2], [5, 0.45, 0.3, 0.7, 0.5, 1.2, 2.1, 1.1, 0.26, 0.5, 33, 0.15, 2], [3.2, 0.4, 0.19, 0.45, 0.32, 0.77, 1.34, 0.7, 0.26, 0.2, 46, 0.1, 2]] },
  { name: 'dry-garden', natural: true, notation: 'px', fields: { imageWidth: 640, imageHeight: 640, border: "drop", swing: "separate", ground: "gravel", variation: 0.3, moss: 0.4, dust: 0.05, sunAzimuth: 250, sunElevation: 36 }, layers: [[120, 0.09, 0, 6, 4.8, 36, 72, 24, 0.45, 0.6, 32, 0.25, 5], [60, 0.03, 0, 3, 2.4, 18, 24, 9, 0.5, 0.5, 45, 0.3, 5], [6, 0.3, 0, 0.3, 0.24, 1.68, 1.92, 0.72, 0.9, 0.1, 45, 0.2, 4], [4.4, 0.6, 0, 0.22, 0.18, 1.5, 0.88, 0.44, 0.9, 0.1, 45, 0.2, 4], [3.2, 0.6, 0, 0.16, 0.13, 1.09, 0.64, 0.32, 0.9, 0, 62, 0.2, 4]] },
  { name: 'forest-floor', natural: true, notation: 'px', fields: { imageWidth: 640, imageHeight: 640, border: "drop", swing: "separate", ground: "soil", variation: 0.4, wetness: 0.25, moss: 0.62, dust: 0.3, sunAzimuth: 250, sunElevation: 40 }, layers: [[110, 0.1, 0, 5.5, 4.4, 30.8, 35.2, 13.2, 0.6, 0.5, 34, 0.3, 1], [60, 0.1, 0, 3, 2.4, 16.8, 19.2, 7.2, 0.65, 0.5, 38, 0.35, 1], [34, 0.12, 0, 1.7, 1.36, 9.52, 10.88, 4.08, 0.7, 0.45, 36, 0.35, 1], [18, 0.12, 0, 0.9, 0.72, 5.04, 5.76, 2.16, 0.7, 0.4, 30, 0.35, 1], [9, 0.15, 0, 0.45, 0.36, 2.52, 2.88, 1.08, 0.75, 0.2, 27, 0.3, 1], [5, 0.15, 0, 0.25, 0.2, 1.4, 1.6, 0.6, 0.75, 0.2, 35, 0.3, 1]] },
  { name: 'quarry-rubble', natural: true, notation: 'px', fields: { imageWidth: 480, imageHeight: 480, border: "drop", swing: "separate", crossing: "apart", ground: "gravel", variation: 0.35, dust: 0.1, sunAzimuth: 240, sunElevation: 56 }, layers: [[14, 0.3, 2.24, 2.8, 1.12, 4.9, 8.4, 4.2, 0.22, 0.25, 78, 0.05, 1], [11.5, 0.7, 1.84, 2.3, 0.92, 4.02, 6.9, 3.45, 0.22, 0.25, 72, 0.05, 1], [8.5, 0.5, 1.36, 1.7, 0.68, 2.97, 5.1, 2.55, 0.22, 0.25, 59, 0.05, 1], [6, 0.4, 0.96, 1.2, 0.48, 2.1, 3.6, 1.8, 0.22, 0.2, 55, 0.05, 1], [4.4, 0.4, 0.7, 0.88, 0.35, 1.54, 2.64, 1.32, 0.22, 0.15, 44, 0.05, 1], [3, 0.4, 0.48, 0.6, 0.24, 1.05, 1.8, 0.9, 0.22, 0, 53, 0.05, 1]] },
  { name: 'first-snow', natural: true, notation: 'px', fields: { imageWidth: 720, imageHeight: 720, border: "drop", swing: "separate", ground: "soil", variation: 0.4, moss: 0.2, dust: 0.05, snow: 0.45, sunAzimuth: 285, sunElevation: 16 }, layers: [[110, 0.07, 0, 5.5, 4.4, 30.8, 35.2, 13.2, 0.5, 0.5, 36, 0.3, 1], [64, 0.1, 0, 3.2, 2.56, 17.9, 20.5, 7.7, 0.55, 0.5, 40, 0.3, 1], [36, 0.14, 0, 1.8, 1.44, 10.1, 11.5, 4.3, 0.6, 0.45, 38, 0.3, 1], [20, 0.16, 0, 1, 0.8, 5.6, 6.4, 2.4, 0.65, 0.4, 34, 0.3, 1], [11, 0.2, 0, 0.55, 0.44, 3.08, 3.52, 1.32, 0.7, 0.3, 38, 0.3, 1], [6, 0.2, 0, 0.3, 0.24, 1.68, 1.92, 0.72, 0.7, 0.2, 40, 0.25, 1]] },
  { name: 'mountain-stream', natural: true, notation: 'px', fields: { imageWidth: 640, imageHeight: 640, border: "drop", swing: "separate", ground: "gravel", variation: 0.5, wetness: 0.2, moss: 0.25, dust: 0.05, water: 0.42, sunAzimuth: 300, sunElevation: 44 }, layers: [[84, 0.07, 0.84, 4.2, 3.4, 23.5, 21.8, 8.4, 0.75, 0.4, 44, 0.25, 0], [50, 0.1, 0.5, 2.5, 2, 14, 13, 5, 0.8, 0.4, 44, 0.25, 0], [30, 0.16, 0.3, 1.5, 1.2, 8.4, 7.8, 3, 0.85, 0.35, 44, 0.25, 0], [18, 0.25, 0.18, 0.9, 0.72, 5.4, 4.3, 1.8, 0.85, 0.35, 46, 0.25, 0], [11, 0.32, 0.11, 0.55, 0.44, 3.3, 2.6, 1.1, 0.85, 0.35, 55, 0.25, 0], [7, 0.38, 0.07, 0.35, 0.28, 2.1, 1.6, 0.7, 0.85, 0.3, 48, 0.2, 0], [4.4, 0.4, 0.04, 0.22, 0.18, 1.3, 1, 0.44, 0.8, 0.2, 50, 0.2, 0]] },
  { name: 'shingle', natural: true, notation: 'px', fields: { imageWidth: 480, imageHeight: 480, border: "drop", swing: "separate", ground: "gravel", variation: 0.6, wetness: 0.15, dust: 0.05, sunAzimuth: 235, sunElevation: 36 }, layers: [[20, 0.08, 1, 2, 0.8, 6.4, 4.8, 1.6, 1, 0.1, 67, 0.15, 0], [14, 0.3, 0.7, 1.4, 0.56, 4.48, 3.36, 1.12, 1, 0.1, 46, 0.15, 0], [10, 0.45, 0.5, 1, 0.4, 3.2, 2.4, 0.8, 1, 0.1, 45, 0.15, 0], [7, 0.45, 0.35, 0.7, 0.28, 2.24, 1.68, 0.56, 0.95, 0.1, 39, 0.15, 0], [5, 0.4, 0.25, 0.5, 0.2, 1.6, 1.2, 0.4, 0.95, 0.05, 49, 0.15, 0], [3.4, 0.4, 0.17, 0.34, 0.14, 1.09, 0.82, 0.27, 0.9, 0, 56, 0.15, 0], [2.4, 0.4, 0.12, 0.24, 0.1, 0.77, 0.58, 0.19, 0.8, 0, 0, 0.15, 0]] },
] as const satisfies readonly Preset[];

/** The parameters of a layer. Its lengths are in the field's `notation`. */
export interface Layer {
  /** Stable identity: the layer's random numbers depend on it and not on its place in the list. */
  id: number;
  radius: number;
  areaFraction: number;
  cellCount: number | null;
  taper: Triple;
  height: Triple;
  weathering: number;
  roughness: number;
  detail: number;
  embedding: number;
  material: 'mixed' | 'granite' | 'basalt' | 'sandstone' | 'limestone' | 'slate';
}

/** All parameters of a field. */
export interface Params {
  seed: number;
  imageWidth: number;
  imageHeight: number;
  packing: number;
  notation: 'px' | 'relative';
  darts: 'saturate' | 'attempts';
  border: 'clip' | 'drop';
  swing: 'shared' | 'separate';
  crossing: 'free' | 'apart';
  variation: number;
  wetness: number;
  moss: number;
  dust: number;
  snow: number;
  water: number;
  ground: 'soil' | 'sand' | 'gravel';
  sunAzimuth: number;
  sunElevation: number;
  layers: Layer[];
}
