/** What may be wrong with an attribute, in English; what may be wrong with a link in one is in `notices.ts`. */

import { filled } from '../base/filled.ts';
import type { Slots } from '../base/filled.ts';

/** `{given}` is quoted. The attribute's name stands before each of them. */
export const ATTRIBUTE_NOTICES = {
  'no-choice': '{given} must be one of {choices}; using {used}',
  'no-number': '{given} must be a {kind} between {min} and {max}; using {used}',
  'no-preset': 'there is no preset called {given}; showing {used}',
  'not-json': 'this is not JSON; showing {used}',
  'bad-request': '{reason}; showing {used}',
  'no-orbit': '{given} must be an orbit such as 45deg 55deg 120%; showing the whole field',
  'no-scale': '{given} must be a number above 0 and at most 1000; using {used}',
  'more-layers': 'there are {given} layers; using the first {used}',
  'other-length': 'there are {given} values for {used} layers; ignoring them',
  'no-bases': '{given} must be a list of bases such as 0 -20 30, 40 -20 30 25; using the preset’s',
  'more-bases': 'there are {given} bases; using the first {used}',
  'no-strokes': '{given} cannot be read; showing none',
} as const satisfies Record<string, string>;

export type AttributeNoticeCode = keyof typeof ATTRIBUTE_NOTICES;

export function attributeNoticeText(code: AttributeNoticeCode, slots: Slots): string {
  return filled(ATTRIBUTE_NOTICES[code], slots);
}
