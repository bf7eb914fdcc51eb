/** The store of a colony of wood ears: with bases, a log, and what that lies on. */

import { WOOD_EAR_LATER } from './deferred.ts';
import { woodEarText } from './strings.ts';
import { groundOf, WOOD_EARS } from '../table.ts';
import { Store } from '../../controls/store.ts';
import type { WoodEarStage } from '../session.ts';
import type { History } from '../../base/history.ts';
import type { PresetName } from '../../rocks/params.ts';
import type { WoodEarPresetName } from '../request.ts';
import type { WoodEars } from '../table.ts';
import { isSlowThesis, timeLeft } from '../patience.ts';
import { saySlow } from '../words.ts';
import type { Edition } from '../../table/table.ts';
import type { Offer, OpenedLink, Preferences } from '../../controls/store.ts';

export class WoodEarStore extends Store<WoodEars> {
  constructor(link: OpenedLink<WoodEars>, preferences: Preferences, history?: History<Edition<WoodEars>>) {
    super(WOOD_EARS, link, preferences, WOOD_EAR_LATER, history);
  }

  override summary(): string {
    const { result, language } = this;
    if (!result) return this.text('notYet');
    const { individuals, triangles, crossingPairs } = result.colony.stats;
    const number = (value: number) => value.toLocaleString(language);
    return woodEarText(language, 'summary', {
      ears: woodEarText(language, individuals === 1 ? 'oneEar' : 'ears', { n: number(individuals) }),
      triangles: number(triangles),
      // Not counted yet in what is shown of a drag.
      crossing: crossingPairs === undefined ? '…' : number(crossingPairs),
    });
  }

  override get offer(): Offer | null {
    const { progress, params, language } = this;
    if (!progress || !isSlowThesis(progress, params)) return null;
    return {
      text: saySlow(language, timeLeft(progress, language)),
      label: woodEarText(language, 'usePressed'),
      take: () => this.edit({ ...this.params, collisions: 'pressed' }),
    };
  }

  override stageName(stage: WoodEarStage): string {
    return woodEarText(this.language, `stage-${stage}`);
  }

  override get leftOut(): string {
    return this.params.mesh ? woodEarText(this.language, 'logLeftOut') : '';
  }

  override get listKeys(): readonly string[] {
    return ['bases', 'log'];
  }

  /** A log from a file stays, and what the log lies on where somebody chose it. */
  override choosePreset(preset: WoodEarPresetName): void {
    const { seed, ground, mesh } = this.params;
    const isChosen = ground !== this.table.presetParams(this.preset).ground;
    const params = this.table.presetParams(preset);
    this.edit({ ...params, seed, mesh, ground: isChosen ? ground : params.ground }, '', preset);
  }

  addBase(): void {
    const { bases } = this.params;
    this.setItems([...bases, this.table.newItem(bases.length, this.params)]);
  }

  setGround(ground: string): void {
    this.edit({ ...this.params, ground });
  }

  chooseGround(preset: PresetName | '', seed = 0): void {
    this.setGround(preset === '' ? '' : groundOf(preset, seed));
  }

  removeMesh(): void {
    this.edit({ ...this.params, mesh: null });
  }
}
