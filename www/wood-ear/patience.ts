/** When the thesis's rule for collisions takes so long that the other one is offered. */

import type { Progress } from '../generator/protocol.ts';
import type { WoodEarStage } from './session.ts';
import type { Language } from '../base/language.ts';
import type { WoodEarParams } from './request.ts';

const SLOW_SECONDS = 10;

export function isSlowThesis({ stage, secondsLeft = 0 }: Progress<WoodEarStage>, { collisions }: WoodEarParams): boolean {
  return collisions === 'thesis' && stage === 'collide' && secondsLeft > SLOW_SECONDS;
}

/** "100 seconds", "2 minutes"; in two digits, since it is an estimate. */
export function timeLeft({ secondsLeft = 0 }: Progress<WoodEarStage>, language: Language): string {
  const isLong = secondsLeft > 100;
  const format = new Intl.NumberFormat(language, {
    style: 'unit',
    unit: isLong ? 'minute' : 'second',
    unitDisplay: 'long',
    maximumSignificantDigits: isLong ? 2 : 1,
  });
  return format.format(isLong ? secondsLeft / 60 : secondsLeft);
}
