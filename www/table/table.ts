/** What the parts that all generators share know of one: its types, and its parameter table. */

import type { Words } from '../base/language.ts';
import type { Bounds, Notation } from '../rocks/params.ts';
import type { ColorMode, View } from '../renderer/renderer.ts';

/** One row of a parameter table. */
export interface Row extends Bounds {
  key: string;
  /** Part of a triple: 0 base, 1 per rock, 2 per vertex. */
  component: number | null;
  url: string;
  /** Of the whole, or of each item of the list that goes with it. */
  scope: 'field' | 'layer' | 'base';
  kind: 'real' | 'integer' | 'optional-real' | 'optional-integer' | 'choice';
  /** First stage an edit re-runs; `look` re-runs none and is drawn at once. */
  stage: string;
  /** Bounds in the conference's notation where they differ. */
  relative: Bounds | null;
  unit: Record<Notation, string>;
  /** In English, as those of the choices; `labelOf` has them in Japanese. */
  label: string;
  choices: readonly { value: string; label: string }[];
}

/** The types of a generator. */
export interface Kind {
  params: { seed: number };
  /** A layer, a base. */
  item: object;
  preset: string;
  result: object;
  stage: string;
}

/** Parameters by lot: of which seed, near which preset, and without touching what. */
export interface Draw {
  seed: number;
  preset: string;
  lock?: readonly string[];
}

/** Parameters are values: nothing here changes what it is given. */
export interface Table<K extends Kind> {
  rows: readonly Row[];
  itemRows: readonly Row[];
  /** How many items there may be. */
  itemCount: { min: number; max: number };
  presets: readonly { name: K['preset']; natural?: true }[];
  views: readonly View[];
  /** The first is that of presets that are no natural ones. */
  colors: readonly ColorMode[];
  /** With seed 0. */
  presetParams(name: string): K['params'];
  items(params: K['params']): readonly K['item'][];
  withItems(params: K['params'], items: readonly K['item'][]): K['params'];
  /** The item that comes to the others at place `index`. */
  newItem(index: number, params: K['params']): K['item'];
  boundsOf(row: Row, params: K['params']): Bounds;
  unitOf(row: Row, params: K['params']): string;
  read(owner: K['params'] | K['item'], row: Row): unknown;
  written<Owner extends K['params'] | K['item']>(owner: Owner, row: Row, value: unknown): Owner;
  /**
   * The full parameters that a request stands for, as a copy.
   *
   * @throws {RockFieldError} naming key, value and bounds.
   */
  resolve(request: object): K['params'];
  /** What every parameter does, by `url`; on demand. */
  docs(): Promise<Readonly<Record<string, Words>>>;
  /** The same for a picture as large as a thumb, where it can be had for less. */
  pictured(params: K['params']): K['params'];
  /** Whether both are the same in everything that no row tells. */
  sameBesides(one: K['params'], other: K['params']): boolean;
}

/** The colour of a preset where nobody chose one: what is found in nature in its own, a figure as its paper has it. */
export function presetColor<K extends Kind>({ presets, colors }: Table<K>, preset: string): ColorMode {
  return presets.find(({ name }) => name === preset)?.natural ? 'natural' : (colors[0] ?? 'plain');
}

export const isLook = ({ stage }: Row): boolean => stage === 'look';
export const isMade = (row: Row): boolean => !isLook(row);
const any = (): boolean => true;

/** Whether both say the same in the rows that count. */
export function same<K extends Kind>(table: Table<K>, one: K['params'], other: K['params'], counts: (row: Row) => boolean = any): boolean {
  if (one === other) return true;
  const like = (a: K['params'] | K['item'], b: K['params'] | K['item'] | undefined, rows: readonly Row[]): boolean =>
    b !== undefined && rows.every((row) => !counts(row) || table.read(a, row) === table.read(b, row));
  const [items, others] = [table.items(one), table.items(other)];
  return like(one, other, table.rows) && items.length === others.length && items.every((item, index) => like(item, others[index], table.itemRows)) && table.sameBesides(one, other);
}
