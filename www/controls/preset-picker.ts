/** The presets to choose from, in groups; those that are found in nature with a small picture each. */

import { html, nothing } from 'lit';
import { showDialog } from './dialogs.ts';
import { mathText } from './parts.ts';
import { drawPictures, PICTURE_SIZE } from './preset-pictures.ts';
import type { TemplateResult } from 'lit';
import type { GeneratorElement } from '../element/generator-element.ts';
import type { Kind } from '../table/table.ts';
import type { Place } from './parts.ts';
import type { Store } from './store.ts';

/** Letters that follow each other closely are the beginning of one name. */
const TYPING_MS = 700;

type Direction = readonly [across: number, down: number];
const DIRECTIONS: Readonly<Record<string, Direction>> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

/** Presets that stand together, with their words. */
export interface PresetGroup {
  label: string;
  /** Each with a small picture. */
  isPictured: boolean;
  presets: readonly { name: string; words: string }[];
}

/** Opens the list; what is chosen becomes the store's. `newElement` makes an element for the pictures; null: there are none. */
export function choosePreset<K extends Kind>(
  store: Store<K>,
  place: Place,
  groups: readonly PresetGroup[],
  newElement: (() => GeneratorElement<K>) | null,
): void {
  const option = (name: string, words: string, isPictured: boolean): TemplateResult => {
    const isChosen = name === store.preset;
    return html`
      <div class="preset" role="option" data-preset=${name} aria-selected=${isChosen} tabindex=${isChosen ? 0 : -1}>
        ${isPictured ? html`<canvas width=${PICTURE_SIZE.width} height=${PICTURE_SIZE.height} aria-hidden="true"></canvas>` : nothing}<span>${mathText(words)}</span>
      </div>
    `;
  };
  const lists = groups.map(
    ({ label, isPictured, presets }) => html`
      <h3 aria-hidden="true">${label}</h3>
      <div class=${isPictured ? 'preset-grid' : 'preset-lines'} role="group" aria-label=${label}>${presets.map(({ name, words }) => option(name, words, isPictured))}</div>
    `,
  );

  const choose = (chosen: Element | null): void => {
    const name = chosen?.closest<HTMLElement>('.preset')?.dataset.preset;
    if (name === undefined) return;
    dialog.close();
    store.choosePreset(name);
  };
  const press = keysOf(choose);
  const list = html`
    <div class="presets" role="listbox" aria-labelledby="dialog-heading" @click=${({ target }: Event) => choose(target as Element)} @keydown=${press}>${lists}</div>
  `;
  const dialog = showDialog(store, place, store.text('preset'), list);
  dialog.querySelector<HTMLElement>('.preset[aria-selected="true"]')?.focus();

  const closed = new AbortController();
  dialog.addEventListener('close', () => closed.abort(), { once: true });
  if (newElement) {
    const show = (name: string, picture: ImageBitmap) =>
      dialog.querySelector<HTMLCanvasElement>(`[data-preset="${name}"] canvas`)?.getContext('2d')?.drawImage(picture, 0, 0);
    void drawPictures(store.table, newElement, dialog, show, closed.signal);
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
