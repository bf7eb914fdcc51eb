/** The store of a field of rocks: with layers, and two notations. */

import { ROCKS } from '../rocks.ts';
import { loadLater } from './load-later.ts';
import { SceneStore } from './scene-store.ts';
import { summary } from './summary.ts';
import type { Field } from '../field.ts';
import type { StageName } from '../generator/protocol.ts';
import type { History } from '../history.ts';
import type { Notation } from '../params.ts';
import type { Rocks } from '../rocks.ts';
import type { Row } from '../table.ts';
import type { Edition, OpenedLink, Preferences } from './scene-store.ts';

export class Store extends SceneStore<Rocks> {
  constructor(link: OpenedLink<Rocks>, preferences: Preferences, history?: History<Edition<Rocks>>) {
    super(ROCKS, link, preferences, history);
  }

  get field(): Field | null {
    return this.result;
  }

  override summary(): string {
    return summary(this);
  }

  override stageName(stage: StageName): string {
    return this.text(`stage-${stage}`);
  }

  override get listKeys(): readonly string[] {
    return ['layers', 'id'];
  }

  /** What is too much for the memory is too many small rocks. */
  protected override itemAtFault(): number {
    const radii = this.params.layers.map(({ radius }) => radius);
    return radii.indexOf(Math.min(...radii));
  }

  override setParam(row: Row, item: number | null, value: number | string | null): void {
    if (row.key === 'notation') void this.setNotation(value as Notation);
    else super.setParam(row, item, value);
  }

  async setNotation(notation: Notation): Promise<void> {
    if (notation === this.params.notation) return;
    const { inNotation, later } = await loadLater();
    const { params, clamped } = inNotation(this.params, notation);
    this.edit(params);
    if (clamped) this.say((language) => later(language, 'notationClamped'));
  }

  async addLayer(): Promise<void> {
    const { nextLayer } = await loadLater();
    this.setItems([...this.params.layers, nextLayer(this.params, this.#freeId())]);
  }

  duplicateLayer(index: number): void {
    const { layers } = this.params;
    const original = layers[index];
    if (!original) return;
    const copy = { ...structuredClone(original), id: this.#freeId() };
    this.setItems([...layers.slice(0, index + 1), copy, ...layers.slice(index + 1)]);
  }

  /** Past all that were ever seen here, so that a removed layer's rocks do not come back under another layer's name. */
  #freeId(): number {
    return Math.max(-1, ...this.params.layers.map(({ id }) => id)) + 1;
  }
}
