/** Honest numbers of the colony that is shown. */

import { html, nothing } from 'lit';
import { woodEarText } from './strings.ts';
import { BACKENDS } from '../../controls/backends.ts';
import { percent } from '../../controls/numbers.ts';
import type { TemplateResult } from 'lit';
import type { WoodEarStage } from '../session.ts';
import type { WoodEarStringKey } from './strings.ts';
import type { WoodEarScene } from '../table.ts';
import type { WoodEarStore } from './store.ts';

const STAGES: readonly WoodEarStage[] = ['log', 'spawn', 'deform', 'collide', 'mesh'];

export function woodEarStatistics(store: WoodEarStore, { colony, ground }: WoodEarScene): TemplateResult {
  const { language } = store;
  const { individuals, triangles, crossingPairs, keptMedian, keptP10, ms } = colony.stats;
  const t = (key: WoodEarStringKey) => woodEarText(language, key);
  const number = (value: number) => value.toLocaleString(language);
  const time = (value: number) => (value === 0 ? '–' : value.toLocaleString(language, { maximumFractionDigits: value < 10 ? 1 : 0 }));
  return html`
    <dl class="figures">
      <div><dt>${t('individuals')}</dt><dd>${number(individuals)}</dd></div>
      <div><dt>${t('crossing')}</dt><dd>${crossingPairs === undefined ? '…' : number(crossingPairs)}</dd></div>
      <div title=${t('keptHelp')}><dt>${t('kept')}</dt><dd>${percent(keptMedian)} · ${percent(keptP10)}</dd></div>
    </dl>
    ${crossingPairs && store.params.collisions === 'thesis' ? html`<p class="quiet">${t('thesisLeaves')}</p>` : nothing}
    <dl class="figures figures-small">
      ${STAGES.map((stage) => html`<div><dt>${store.stageName(stage)}</dt><dd>${time(ms[stage])}</dd></div>`)}
      <div><dt>Σ</dt><dd>${time(ms.total)} ms</dd></div>
    </dl>
    <p class="quiet">
      ${number(triangles)} △ · ${t('rocks')}: ${number(ground.stats.rocks)} · <span data-backend>${store.backend ? BACKENDS[store.backend] : '–'}</span>
    </p>
  `;
}
