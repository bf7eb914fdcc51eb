/** The store of a field of rocks: with layers, and two notations. */

import { ROCKS } from '../table.ts';
import { Store } from '../../controls/store.ts';
import { summary } from './summary.ts';
import type { Layer } from '../params.ts';
import type { Deferred } from '../../base/deferred.ts';
import type { Words } from '../../base/language.ts';
import type * as strings from '../../controls/strings-later.ts';
import type * as layers from './next-layer.ts';
import type * as notation from './notation.ts';
import type * as scale from './scaled-layer.ts';
import type { Field } from '../../data/field.ts';
import type { StageName } from '../../generator/protocol.ts';
import type { History } from '../../base/history.ts';
import type { Notation, Row } from '../../table/row.ts';
import type { Rocks } from '../table.ts';
import type { Edition } from '../../table/table.ts';
import type { OpenedLink, Preferences, StoreLater } from '../../controls/store.ts';

/** Colours of the renderer's palette, which layers have by their ids. */
const COLORS = 8;

/** What the store needs of what comes later. */
type RockStoreLater = StoreLater & typeof layers & typeof notation & typeof scale & Pick<typeof strings, 'later'>;

export class RockStore extends Store<Rocks> {
  /** Whether height and taper stay when the radius changes; else they keep their proportions. */
  keepsShape = false;
  declare protected readonly later: Deferred<RockStoreLater>;
  /** What the element shows beside what links hold, in words. */
  unlinked: () => Words | null = () => null;
  /** The layer whose radius was changed last, as it was before, and as it is. All that follows is measured from there: a drag rounds nothing away. */
  #resized: { from: Layer; to: Layer } | undefined;

  constructor(link: OpenedLink<Rocks>, preferences: Preferences, later: Deferred<RockStoreLater>, history?: History<Edition<Rocks>>) {
    super(ROCKS, link, preferences, later, history);
  }

  get field(): Field | null {
    return this.result;
  }

  override summary(): string {
    return summary(this);
  }

  override get leftOut(): string {
    return this.unlinked()?.[this.language] ?? '';
  }

  override stageName(stage: StageName): string {
    return this.text(`stage-${stage}`);
  }

  override get listKeys(): readonly string[] {
    return ['layers', 'id'];
  }

  /** What is too much for the memory is too many small rocks. */
  override itemAtFault(): number {
    const radii = this.params.layers.map(({ radius }) => radius);
    return radii.indexOf(Math.min(...radii));
  }

  override setParam(row: Row, item: number | null, value: number | string | null): void {
    if (row.key === 'notation') void this.setNotation(value as Notation);
    else if (row.key === 'radius' && item !== null && !this.keepsShape)
      void this.later.use((later) => this.#resize(later, row, item, Number(value)));
    else super.setParam(row, item, value);
  }

  protected override get lock(): readonly string[] {
    return this.keepsShape ? ['taper', 'height'] : [];
  }

  setKeepsShape(keeps: boolean): void {
    this.keepsShape = keeps;
    this.notify('messages');
  }

  #resize({ scaledLayer, later }: RockStoreLater, row: Row, item: number, radius: number): void {
    const { layers, notation } = this.params;
    const layer = layers[item];
    if (!layer) return;
    const from = layer === this.#resized?.to ? this.#resized.from : layer;
    const { scaled, isClamped } = scaledLayer(from, radius, notation);
    this.#resized = { from, to: scaled };
    this.edit({ ...this.params, layers: layers.map((old, index) => (index === item ? scaled : old)) }, `${row.url} ${item}`, this.preset, {
      row,
      item,
      value: radius,
    });
    if (isClamped) this.setProblem({ key: row.key, item, component: null, text: (language) => later(language, 'shapeClamped') });
  }

  setNotation(notation: Notation): Promise<void> {
    return this.later.use(({ inNotation, later }) => {
      const { params, clamped } = inNotation(this.params, notation);
      this.edit(params);
      if (clamped) this.say((language) => later(language, 'notationClamped'));
    });
  }

  addLayer(): Promise<void> {
    return this.later.use(({ nextLayer }) => this.setItems([...this.params.layers, nextLayer(this.params, this.#freeId())]));
  }

  duplicateLayer(index: number): void {
    const { layers } = this.params;
    const original = layers[index];
    if (!original) return;
    const copy = { ...structuredClone(original), id: this.#freeId() };
    this.setItems([...layers.slice(0, index + 1), copy, ...layers.slice(index + 1)]);
  }

  /** Past all that were ever seen here, so that a removed layer's rocks do not come back under another layer's name; of a colour that no layer has. */
  #freeId(): number {
    const ids = this.params.layers.map(({ id }) => id);
    const colors = new Set(ids.map((id) => id % COLORS));
    let id = Math.max(-1, ...ids) + 1;
    while (colors.size < COLORS && colors.has(id % COLORS)) id += 1;
    return id;
  }
}
