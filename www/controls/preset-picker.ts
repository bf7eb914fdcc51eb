/** The presets to choose from: natural grounds with a small picture each, then the figures of the two papers. */

import { html, nothing } from 'lit';
import { PRESETS } from '../params.ts';
import { LAYER_ROWS } from '../params-flat.ts';
import { later, presetLabel } from '../strings-later.ts';
import { PAPERS, paperOf, presetName } from '../strings.ts';
import { showDialog } from './dialogs.ts';
import { mathText } from './parts.ts';
import { drawPictures, PICTURED, PICTURE_SIZE } from './preset-pictures.ts';
import type { TemplateResult } from 'lit';
import type { Preset, PresetName } from '../params.ts';
import type { RockFieldElement } from '../rock-field-element.ts';
import type { Place } from './parts.ts';
import type { Store } from './store.ts';

/** Table 1's columns, by the last word of a parameter's label: r, A_s, c_w1 … */
const COLUMNS = LAYER_ROWS.filter(({ kind }) => kind !== 'optional-integer').map(({ label }) => label.en.split(' ').at(-1) ?? '');
/** Letters that follow each other closely are the beginning of one name. */
const TYPING_MS = 700;

type Direction = readonly [across: number, down: number];
const DIRECTIONS: Readonly<Record<string, Direction>> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

/** Opens the list; what is chosen becomes the store's. `newField` makes an element for the pictures; null: there are none. */
export function choosePreset(store: Store, place: Place, newField: (() => RockFieldElement) | null): void {
  const { language } = store;
  const papers = PAPERS.map((paper) => group(store.text(paper), 'preset-lines', PRESETS.filter(({ name }) => !PICTURED.includes(name) && paperOf(name) === paper), (preset) => presetLabel(language, preset, COLUMNS)));
  const natural = group(later(language, 'natural'), 'preset-grid', PRESETS.filter(({ name }) => PICTURED.includes(name)), (preset) => presetName(language, preset));

  function group(label: string, className: string, presets: readonly Preset[], words: (preset: Preset) => string): TemplateResult {
    return html`
      <h3 aria-hidden="true">${label}</h3>
      <div class=${className} role="group" aria-label=${label}>${presets.map((preset) => option(preset, words(preset)))}</div>
    `;
  }

  function option({ name, natural: isPictured }: Preset, words: string): TemplateResult {
    const isChosen = name === store.preset;
    return html`
      <div class="preset" role="option" data-preset=${name} aria-selected=${isChosen} tabindex=${isChosen ? 0 : -1}>
        ${isPictured ? html`<canvas width=${PICTURE_SIZE.width} height=${PICTURE_SIZE.height} aria-hidden="true"></canvas>` : nothing}<span>${mathText(words)}</span>
      </div>
    `;
  }

  const choose = (chosen: Element | null): void => {
    const name = chosen?.closest<HTMLElement>('.preset')?.dataset.preset;
    if (name === undefined) return;
    dialog.close();
    store.choosePreset(name as PresetName);
  };
  const press = keysOf(choose);
  const list = html`
    <div class="presets" role="listbox" aria-labelledby="dialog-heading" @click=${({ target }: Event) => choose(target as Element)} @keydown=${press}>${natural}${papers}</div>
  `;
  const dialog = showDialog(store, place, store.text('preset'), list);
  dialog.querySelector<HTMLElement>('.preset[aria-selected="true"]')?.focus();

  const closed = new AbortController();
  dialog.addEventListener('close', () => closed.abort(), { once: true });
  if (newField) {
    const show = (name: PresetName, picture: ImageBitmap) => dialog.querySelector<HTMLCanvasElement>(`[data-preset="${name}"] canvas`)?.getContext('2d')?.drawImage(picture, 0, 0);
    void drawPictures(newField, dialog, show, closed.signal);
  }
}

/** Arrows by where things are, Home and End, Enter and Space, and the beginning of a name. */
function keysOf(choose: (chosen: Element) => void): (event: KeyboardEvent) => void {
  let typed = '';
  let typedAt = -Infinity;
  return (event) => {
    const at = event.target as HTMLElement;
    const options = [...(event.currentTarget as HTMLElement).querySelectorAll<HTMLElement>('.preset')];
    const { key } = event;
    if (event.altKey || event.ctrlKey || event.metaKey) return;
    const direction = DIRECTIONS[key];
    let next: HTMLElement | undefined;
    if (key === 'Enter' || (key === ' ' && performance.now() - typedAt > TYPING_MS)) choose(at);
    else if (direction) next = neighbour(at, options, direction);
    else if (key === 'Home' || key === 'End') next = options.at(key === 'Home' ? 0 : -1);
    else if (key.length === 1) {
      typed = event.timeStamp - typedAt > TYPING_MS ? key : typed + key;
      typedAt = event.timeStamp;
      const from = options.indexOf(at) + (typed.length === 1 ? 1 : 0);
      const startsSo = (option: HTMLElement) => option.innerText.trim().toLowerCase().startsWith(typed.toLowerCase());
      next = [...options.slice(from), ...options.slice(0, from)].find(startsSo);
    } else return;
    event.preventDefault();
    next?.focus();
  };
}

/** The nearest in a direction; sideways also from line to line, in the order of reading. */
function neighbour(at: HTMLElement, options: readonly HTMLElement[], [across, down]: Direction): HTMLElement | undefined {
  if (across !== 0) return options[options.indexOf(at) + across];
  const from = at.getBoundingClientRect();
  const distance = (option: HTMLElement): number => {
    const { left, top } = option.getBoundingClientRect();
    const ahead = (top - from.top) * down;
    return ahead > 1 ? ahead + Math.abs(left - from.left) / 1000 : Infinity;
  };
  const [nearest] = options.filter((option) => distance(option) < Infinity).sort((a, b) => distance(a) - distance(b));
  return nearest;
}
