/**
 * What the attributes of `<rock-field>` say. One contract: absent → default; malformed → default and exactly one notice that
 * names the attribute; nothing throws.
 */

import { PRESETS } from './params.ts';
import type { Params } from './params.ts';
import { defaultParams, FIELD_ROWS, presetParams } from './params-flat.ts';
import type { CameraState, ColorMode, View } from './renderer/renderer.ts';
import { COLORS, decodeLink, VIEWS } from './url-codec.ts';

export { COLORS, VIEWS };

/** How much of a wrong value is repeated in a notice. */
const MAX_QUOTE_LENGTH = 32;

export interface AttributeState {
  params: Params;
  view: View;
  color: ColorMode;
  /** From a link in `src`; null: the whole field. */
  camera: CameraState | null;
  /** One sentence for each attribute, or part of a link, that could not be taken as it stood. */
  notices: AttributeNotice[];
}

export interface AttributeNotice {
  attribute: AttributeName;
  message: string;
}

export const ATTRIBUTES = ['src', 'preset', 'seed', 'view', 'color'] as const;

export type AttributeName = (typeof ATTRIBUTES)[number];

/** `src` fills everything and `preset` is then not looked at; the other attributes replace what `src` says. */
export function readAttributes(get: (name: AttributeName) => string | null): AttributeState {
  const notices: AttributeNotice[] = [];
  const src = get('src');
  const link = src === null ? null : decodeLink(src);
  for (const { text } of link?.notices ?? []) notices.push({ attribute: 'src', message: `src: ${text}` });
  const params = link?.params ?? readPreset(get('preset'), notices);
  params.seed = readSeed(get('seed'), params.seed, notices);
  return {
    params,
    view: readChoice('view', get('view'), VIEWS, link?.view ?? VIEWS[0], notices),
    color: readChoice('color', get('color'), COLORS, link?.color ?? COLORS[0], notices),
    camera: link?.camera ?? null,
    notices,
  };
}

function readPreset(given: string | null, notices: AttributeNotice[]): Params {
  if (given === null) return defaultParams();
  const found = PRESETS.find(({ name }) => name === given.trim());
  if (!found) notices.push({ attribute: 'preset', message: `preset: there is no preset called ${quote(given)}; ${PRESETS[0].name} is shown` });
  return found ? presetParams(found.name) : defaultParams();
}

function readSeed(given: string | null, fallback: number, notices: AttributeNotice[]): number {
  if (given === null) return fallback;
  const { min = 0, max = 0 } = FIELD_ROWS.find(({ key }) => key === 'seed') ?? {};
  const isWhole = /^\s*[+-]?\d+\s*$/.test(given);
  const seed = isWhole ? Math.min(max, Math.max(min, Number(given))) : fallback;
  if (!isWhole || seed !== Number(given)) {
    notices.push({ attribute: 'seed', message: `seed: ${quote(given)} is no whole number in ${min} to ${max}; ${seed} is used` });
  }
  return seed + 0;
}

function readChoice<T extends string>(attribute: AttributeName, given: string | null, choices: readonly T[], fallback: T, notices: AttributeNotice[]): T {
  if (given === null) return fallback;
  const found = choices.find((choice) => choice === given.trim());
  if (found === undefined) {
    notices.push({ attribute, message: `${attribute}: ${quote(given)} is none of ${choices.join(', ')}; ${fallback} is used` });
  }
  return found ?? fallback;
}

/** Short, and in one line. */
function quote(text: string): string {
  const line = text.replace(/[\p{Cc}\p{Cf}\s]+/gu, ' ');
  return JSON.stringify(line.length > MAX_QUOTE_LENGTH ? `${line.slice(0, MAX_QUOTE_LENGTH)}…` : line);
}
