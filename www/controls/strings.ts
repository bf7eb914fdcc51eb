/**
 * The sentences of the page and the panel in English; `strings.ja.ts` has them in Japanese. What a parameter is called and does stands in its table
 * (`params.gen.ts`), what may be wrong with a link in `table/notices.ts`.
 */

import { filled } from '../base/filled.ts';
import { lazily } from '../base/lazy.ts';
import type { Slots } from '../base/filled.ts';
import type { Language, Words } from '../base/language.ts';
import type { Preset, PRESETS } from '../rocks/params.ts';
import type * as Japanese from './strings.ja.ts';

export const LANGUAGES = ['en', 'ja'] as const satisfies readonly Language[];

/** Each language in itself. */
export const LANGUAGE_NAMES: Words = { en: 'English', ja: '日本語' };

/** The papers whose figures are presets, as the presets' names begin. */
export const PAPERS = ['journal', 'conference'] as const;
export type Paper = (typeof PAPERS)[number];

export type NaturalName = Extract<(typeof PRESETS)[number], { natural: true }>['name'];

const NATURAL_NAMES: Record<NaturalName, string> = {
  riverbed: 'Riverbed',
  'beach-cobbles': 'Beach cobbles',
  scree: 'Scree',
  moraine: 'Moraine',
  'desert-pavement': 'Desert pavement',
  'lava-field': 'Lava field',
  'dry-garden': 'Dry garden',
  'forest-floor': 'Forest floor',
  'quarry-rubble': 'Quarry rubble',
  shingle: 'Shingle',
};

/** What is on the page from the start, or may be at any moment; the rest is in `strings-later.ts`. `{…}` is filled in by `translate`. */
export const STRINGS = {
  title: 'rock-field',
  skip: 'Skip to the controls',
  picture: 'Picture',
  controls: 'Controls',
  scenes: 'Scene',
  'scene-rocks': 'Rocks',
  'scene-wood-ears': 'Wood ears',

  undo: 'Undo',
  redo: 'Redo',
  reset: 'Reset to the preset',
  randomise: 'Randomise',
  share: 'Share',
  shareHelp: 'Copies a link that shows exactly these rocks.',
  shareSettingsHelp: 'Copies a link that holds these settings.',
  embed: 'Copy embed code',
  embedHelp: 'Two lines of HTML that show these rocks on any page.',
  docs: 'Docs',
  help: 'Keys and gestures',
  close: 'Close',
  dismiss: 'Dismiss',
  cancel: 'Cancel',

  preset: 'Preset',
  presetHelp: 'Natural grounds, and the figures of the two papers as in their Table 1. The seed stays.',
  edited: 'edited',
  journal: 'Journal (2011)',
  conference: 'Conference (2010)',
  previousSeed: 'Previous seed',
  nextSeed: 'Next seed',
  freshSeed: 'Fresh random seed',

  look: 'Look',
  layers: 'Layers',
  ground: 'Ground and method',
  statistics: 'Statistics',
  page: 'Page',
  layer: 'Layer {n}',
  addLayer: 'Add layer',
  removeLayer: 'Remove layer {n}',
  duplicateLayer: 'Duplicate layer {n}',
  noLayers: 'No layers: bare ground. Add one to grow rocks.',
  shape: 'Taper and height',
  wear: 'Wear',
  oneRock: '1 rock',
  someRocks: '{n} rocks',

  view: 'View',
  'view-3d': '3D',
  'view-wireframe': 'Wireframe',
  'view-diagrams': 'Diagrams',
  'view-selection': 'Selection',
  color: 'Colour',
  'color-layer': 'Layer',
  'color-rock': 'Rock',
  'color-plain': 'Plain',
  'color-natural': 'Natural',
  frameAll: 'Frame all',
  fullScreen: 'Full screen',
  leaveFullScreen: 'Leave full screen',
  language: 'Language',
  theme: 'Theme',
  'theme-auto': 'Auto',
  'theme-light': 'Light',
  'theme-dark': 'Dark',

  summary: '{rocks} · {triangles} triangles · {covered} covered',
  notYet: 'Waiting for the first field …',
  'stage-sites': 'Sites',
  'stage-cells': 'Cells',
  'stage-selection': 'Selection',
  'stage-shape': 'Shape',
  'stage-mesh': 'Mesh',
  working: 'Generating: {stage}, {percent}',
  cancelled: 'Cancelled: back to the settings of this picture.',
  helpHint: 'Point at a control to read what it does. Press ? for the keys.',
  helpHintShort: 'Point at a control to read what it does.',

  clampedInField: 'Allowed: {min} to {max}.',
  notANumber: 'A number from {min} to {max}, please.',
  lostPicture: 'The graphics device was lost; the picture is back.',
} as const satisfies Record<string, string>;

export type StringKey = keyof typeof STRINGS;

export function translate(language: Language, key: StringKey, slots: Slots = {}): string {
  return filled((language === 'ja' && japanese?.STRINGS_JA[key]) || STRINGS[key], slots);
}

/** The label of a parameter or of a choice, which the tables have in English. */
export function labelOf(language: Language, label: string): string {
  return (language === 'ja' && japanese?.LABELS_JA[label]) || label;
}

let japanese: typeof Japanese | undefined;

/** Few read Japanese, so its sentences are fetched; until they are there, and where they cannot be had, they are English. */
export async function loadJapanese(): Promise<void> {
  try {
    japanese ??= await lazily(() => import('./strings.ja.ts'));
  } catch (thrown) {
    console.warn(thrown);
  }
}

/** The page's title in Japanese; undefined where it is the document's own. */
export function pageTitle(language: Language, element: string): string | undefined {
  return language === 'ja' ? japanese?.TITLES_JA[element] : undefined;
}

/** `Riverbed`; of a figure `Journal (2011), Fig. 11 (a)`. */
export function presetName(language: Language, { name }: Pick<Preset, 'name'>): string {
  const natural = (language === 'ja' && japanese?.NATURAL_NAMES_JA[name as NaturalName]) || (NATURAL_NAMES[name as NaturalName] as string | undefined);
  return natural ?? `${translate(language, paperOf(name))}${language === 'ja' ? '、' : ', '}${figureOf(name)}`;
}

/** The paper of a preset that is a figure. */
export function paperOf(name: string): Paper {
  return PAPERS.find((paper) => name.startsWith(paper)) ?? PAPERS[0];
}

/** `journal-fig11a` → `Fig. 11 (a)`. */
export function figureOf(name: string): string {
  const [, number = '', part = ''] = /fig(\d+)([a-z]?)$/.exec(name) ?? [];
  return `Fig. ${number}${part && ` (${part})`}`;
}

/** English or Japanese, whichever the list of preferred languages names first; English for all others. */
export function pickLanguage(preferred: readonly string[]): Language {
  const found = preferred.map((tag) => LANGUAGES.find((language) => tag.toLowerCase().split('-')[0] === language)).find(Boolean);
  return found ?? 'en';
}
