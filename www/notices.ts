/** What may be wrong with a link, in English: an element reads links too. `notices.ja.ts` has the same in Japanese, for the page. */

import { filled } from './filled.ts';
import type { Notice } from './link.ts';

/** `{key}` names what is wrong. */
export const NOTICES: Record<Notice['code'], string> = {
  'too-long': 'The link has {given} characters; only the first {used} were read.',
  'unknown-key': 'The link has something unknown in it, which was ignored: {key}.',
  'unknown-version': 'The link is of version {given}, which this page does not know; it was read as version {used}.',
  'unknown-preset': 'There is no preset “{given}”; {used} is shown.',
  'unknown-choice': '{key}: “{given}” is not a choice; {used} is used.',
  'not-a-number': '{key}: “{given}” is not a number; the preset’s value {used} is used.',
  clamped: '{key}: {given} is not allowed ({min} to {max}); {used} is used.',
  repeated: '{key} stands more than once in the link; the first one counts.',
  'unequal-lists': 'The lists in the link do not fit together ({given}); the preset’s are used.',
  'too-many-layers': 'The link has {given} layers ({key}); the first {used} are shown.',
  'too-many-bases': 'The link has {given} bases ({key}); the first {used} are used.',
  'bad-ids': 'The layers’ ids ({given}) have to be different whole numbers; {used} is used.',
  'bad-camera': 'camera: “{given}” is not a camera position; the whole field is shown.',
};

export function noticeText({ code, key, given, used, min, max }: Omit<Notice, 'text'>): string {
  return filled(NOTICES[code], { key, given, used, min, max });
}
