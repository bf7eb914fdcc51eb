/** What the documentation says about each notice of a link: where it comes from, and what helps. Markdown within a line. */

import type { NoticeCode } from '../link.ts';

export const NOTICE_HELP: Record<NoticeCode, { cause: string; remedy: string }> = {
  'too-long': {
    cause: 'Text that is far longer than any link of this package.',
    remedy: 'Copy the link again with **Share** or `shareURL()`.',
  },
  'unknown-key': {
    cause: 'A key that this release does not know: misspelt, or of a later release.',
    remedy: 'Compare it with the keys in [Attributes](attributes.html) (“In links”).',
  },
  'unknown-version': {
    cause: 'A link made by a later release, whose rocks may be different.',
    remedy: 'Open it with the release that made it, or update this one.',
  },
  'unknown-preset': {
    cause: 'A preset that this release does not have.',
    remedy: 'Take a name from the [gallery](gallery.html).',
  },
  'unknown-choice': {
    cause: 'A word that is not among the choices of this key.',
    remedy: 'Take one of the words in [Attributes](attributes.html).',
  },
  'not-a-number': {
    cause: 'Text where a number is expected. Decimal points are points: `0.5`.',
    remedy: 'Correct the number.',
  },
  clamped: {
    cause: 'A number outside its bounds, or a fraction where a whole number is expected.',
    remedy: 'Choose a value within the bounds.',
  },
  repeated: {
    cause: 'Two links pasted together, or a link edited by hand.',
    remedy: 'Leave one of the two out.',
  },
  'unequal-lists': {
    cause: 'The keys of layers (of bases) list different numbers of them.',
    remedy: 'Give every list a value for each layer: `r=90,30&a=0.2,0.5`.',
  },
  'too-many-layers': {
    cause: 'More layers than a field may have.',
    remedy: 'Leave the last ones out.',
  },
  'too-many-bases': {
    cause: 'More bases than a colony may have.',
    remedy: 'Leave the last ones out.',
  },
  'bad-ids': {
    cause: 'Ids of layers that are not whole numbers, or occur twice.',
    remedy: 'Leave `id` out, or give each layer a number of its own.',
  },
  'bad-camera': {
    cause: 'A camera that is not six numbers, or one so near or so far that nothing would be seen.',
    remedy: 'Turn the picture as you want it, and copy the link again.',
  },
};
