/** The presets of rocks as they are chosen from: natural grounds, then the figures of the two papers. */

import type { Language } from '../../base/language.ts';
import type { PresetGroup } from '../../controls/preset-picker.ts';
import { later } from '../../controls/strings-later.ts';
import { translate } from '../../controls/strings.ts';
import { figureOf, PAPERS, paperOf } from '../figures.ts';
import { PRESETS } from '../params.ts';
import { LAYER_ROWS } from '../request.ts';
import type { Preset } from '../spec.ts';
import { presetName } from '../words.ts';

/** Table 1's columns, by the last word of a parameter's label: r, A_s, c_w1 … */
const COLUMNS = LAYER_ROWS.filter(({ kind }) => kind !== 'optional-integer').map(({ label }) => label.split(' ').at(-1) ?? '');

/** The natural grounds, then the figures of the papers. */
export function presetGroups(language: Language): PresetGroup[] {
  const presets: readonly Preset[] = PRESETS;
  const group = (
    label: string,
    isPictured: boolean,
    belongs: (preset: Preset) => boolean,
    words: (preset: Preset) => string,
  ): PresetGroup => ({
    label,
    isPictured,
    presets: presets
      .filter((preset) => Boolean(preset.natural) === isPictured && belongs(preset))
      .map((preset) => ({ name: preset.name, words: words(preset) })),
  });
  return [
    group(
      later(language, 'natural'),
      true,
      () => true,
      (preset) => presetName(language, preset),
    ),
    ...PAPERS.map((paper) =>
      group(
        translate(language, paper),
        false,
        ({ name }) => paperOf(name) === paper,
        (preset) => presetLabel(language, preset, COLUMNS),
      ),
    ),
  ];
}

/** `journal-fig11a` → `Fig. 11 (a)`, with what sets it apart: `r 90 · c_h1 45`, or the layers' areas. */
export function presetLabel(language: Language, preset: Preset, columns: readonly string[]): string {
  const { layers } = preset;
  const figure = unbroken(figureOf(preset.name));
  const areas = layers.map(([, area = 0]) => Math.round(100 * area)).join(' / ');
  if (layers.length > 1) return `${figure} – ${unbroken(later(language, 'layerCount', { n: layers.length }))} · ${unbroken(`${areas} %`)}`;
  const [only = []] = layers;
  // The area is 0.5 in all of them.
  const numbers = only.flatMap((value, index) => (index !== 1 && value !== 0 ? [unbroken(`${columns[index]} ${value}`)] : []));
  return `${figure} – ${numbers.join(' · ')}`;
}

/** A number stays in one line with what belongs to it. */
function unbroken(text: string): string {
  return text.replaceAll(' ', '\u00a0');
}
