/** What may be wrong with an attribute, in English; what may be wrong with a link in one is in `notices.ts`. */

import { filled } from './filled.ts';
import type { Slots } from './filled.ts';

/** `{given}` is quoted. The attribute's name stands before each of them. */
export const ATTRIBUTE_NOTICES = {
  'no-choice': '{given} is none of {choices}; {used} is used',
  'no-number': '{given} is no {kind} in {min} to {max}; {used} is used',
  'no-preset': 'there is no preset called {given}; {used} is shown',
  'not-json': 'this is not JSON; {used} is shown',
  'bad-request': '{reason}; {used} is shown',
  'no-orbit': '{given} is no orbit like 45deg 55deg 120%; the whole field is framed',
  'no-scale': '{given} is no number above 0 and up to 1000; {used} is used',
  'more-layers': '{given} layers; the first {used} are used',
  'other-length': '{given} values for {used} layers; they are left out',
  'no-bases': '{given} is no list of bases like 0 -20 30, 40 -20 30 25; the preset’s are used',
  'more-bases': '{given} bases; the first {used} are used',
} as const satisfies Record<string, string>;

export type AttributeNoticeCode = keyof typeof ATTRIBUTE_NOTICES;

export function attributeNoticeText(code: AttributeNoticeCode, slots: Slots): string {
  return filled(ATTRIBUTE_NOTICES[code], slots);
}
