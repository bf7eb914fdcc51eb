/** What the parts that all generators share know of one: its types, and its parameter table. */

import type { Words } from '../base/language.ts';
import type { Bounds, Row } from './row.ts';
import type { ColorMode, View } from '../base/view.ts';

/** The types of a generator. */
export interface Kind {
  params: { seed: number };
  /** A layer, a base. */
  item: object;
  preset: string;
  result: object;
  stage: string;
}

/** What undo goes back to: what is made, not the look. */
export interface Edition<K extends Kind> {
  params: K['params'];
  preset: K['preset'];
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

const any = (): boolean => true;

/** Whether both say the same in the rows that count. */
export function same<K extends Kind>(table: Table<K>, one: K['params'], other: K['params'], counts: (row: Row) => boolean = any): boolean {
  if (one === other) return true;
  const like = (a: K['params'] | K['item'], b: K['params'] | K['item'] | undefined, rows: readonly Row[]): boolean =>
    b !== undefined && rows.every((row) => !counts(row) || table.read(a, row) === table.read(b, row));
  const [items, others] = [table.items(one), table.items(other)];
  return (
    like(one, other, table.rows) &&
    items.length === others.length &&
    items.every((item, index) => like(item, others[index], table.itemRows)) &&
    table.sameBesides(one, other)
  );
}
