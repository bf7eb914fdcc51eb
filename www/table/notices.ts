/** What may be wrong with a link, in English: an element reads links too. `notices.ja.ts` has the same in Japanese, for the page. */

import { filled } from '../base/filled.ts';

export type NoticeCode =
  | 'too-long'
  | 'unknown-key'
  | 'unknown-version'
  | 'unknown-preset'
  | 'unknown-choice'
  | 'not-a-number'
  | 'clamped'
  | 'not-whole'
  | 'repeated'
  | 'unequal-lists'
  | 'too-many-layers'
  | 'too-many-bases'
  | 'bad-ids'
  | 'bad-camera'
  | 'bad-strokes';

/** One thing in a link that could not be taken as it stood. Its strings come from the link: show them as text only. */
export interface Notice {
  code: NoticeCode;
  /** The key at fault, or several. */
  key: string;
  /** What stood there, shortened. */
  given: string;
  /** What is used instead. */
  used: string;
  min?: number;
  max?: number;
  /** In English, for the console and for embedders. */
  text: string;
}

/** `{key}` names what is wrong. */
export const NOTICES: Record<Notice['code'], string> = {
  'too-long': 'The link has {given} characters; reading only the first {used}.',
  'unknown-key': 'The link has something unknown in it, which was ignored: {key}.',
  'unknown-version': 'The link is of version {given}, which this page does not know; reading it as version {used}.',
  'unknown-preset': 'There is no preset “{given}”; showing {used}.',
  'unknown-choice': '{key}: “{given}” is not a choice; using {used}.',
  'not-a-number': '{key}: “{given}” is not a number; using the preset’s {used}.',
  clamped: '{key}: {given} must be between {min} and {max}; using {used}.',
  'not-whole': '{key}: {given} must be a whole number; using {used}.',
  repeated: '{key} is in the link more than once; using the first.',
  'unequal-lists': 'The lists in the link do not fit together ({given}); using the preset’s.',
  'too-many-layers': 'The link has {given} layers ({key}); showing the first {used}.',
  'too-many-bases': 'The link has {given} bases ({key}); using the first {used}.',
  'bad-ids': 'The layers’ ids ({given}) must be different whole numbers; using {used}.',
  'bad-camera': 'camera: “{given}” is not a camera position; showing the whole field.',
  'bad-strokes': 'strokes: “{given}” cannot be read; showing none.',
};

export function noticeText({ code, key, given, used, min, max }: Omit<Notice, 'text'>): string {
  return filled(NOTICES[code], { key, given, used, min, max });
}
