/** What the documentation says about each notice: where it comes from, and what helps. Markdown within a line. */

import type { AttributeNoticeCode } from '../element/attribute-notices.ts';
import type { NoticeCode } from '../table/notices.ts';

interface NoticeHelp {
  cause: string;
  remedy: string;
}

/** Of notices about links. */
export const NOTICE_HELP: Record<NoticeCode, NoticeHelp> = {
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
    cause: 'A number outside its bounds.',
    remedy: 'Choose a value within the bounds.',
  },
  'not-whole': {
    cause: 'A fraction where a whole number is expected: `seed`, `w`, `n`.',
    remedy: 'Round it; the nearest whole number is taken.',
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
  'bad-strokes': {
    cause: 'Painted strokes that a program has cut off or changed, or more than a link can have.',
    remedy: 'Copy the link again, or make the text with `strokesToText` of `rock-field/core`.',
  },
};

/** Of notices about attributes. */
export const ATTRIBUTE_NOTICE_HELP: Record<AttributeNoticeCode, NoticeHelp> = {
  'no-choice': {
    cause: 'A word that is not among the choices of this attribute.',
    remedy: 'Take one of the words in the message.',
  },
  'no-number': {
    cause: 'Text where a number is expected, a number outside its bounds, or a fraction where only whole numbers mean something.',
    remedy: 'Write a number within the bounds, with a point for decimals: `0.5`.',
  },
  'no-preset': {
    cause: 'A preset that this release does not have, or a misspelt one.',
    remedy: 'Take a name from the [gallery](gallery.html).',
  },
  'not-json': {
    cause:
      'A `src` that begins with `{` and is not JSON: often single quotes, a comma after the last value, or quotes that the page’s template has escaped.',
    remedy: 'Check it with `JSON.parse`, or write a [link](concepts.html) instead.',
  },
  'bad-request': {
    cause: 'A `src` whose JSON names a parameter that does not exist, or a value that is not allowed.',
    remedy: 'Do what the message says.',
  },
  'no-orbit': {
    cause: 'A `camera-orbit` that is not two angles and a distance.',
    remedy: 'Write it like `45deg 55deg 120%`; each part may be `auto`.',
  },
  'no-scale': {
    cause: 'A `metres-per-pixel` that is not a number of metres.',
    remedy: 'Write a number like `0.01`.',
  },
  'more-layers': {
    cause: 'A list with values for more layers than a field may have.',
    remedy: 'Leave the last ones out.',
  },
  'other-length': {
    cause:
      'Attributes that list different numbers of layers. The first list in the order of [Attributes](attributes.html) says how many there are.',
    remedy: 'Give every list a value for each layer: `radius="90 30" area-fraction="0.2 0.5"`.',
  },
  'no-bases': {
    cause: 'A `bases` whose entries are not three or four numbers each.',
    remedy: 'Write `x y z`, perhaps with a range after it, and commas between bases.',
  },
  'more-bases': {
    cause: 'More bases than a colony may have.',
    remedy: 'Leave the last ones out.',
  },
  'no-strokes': {
    cause: 'A `strokes` that is not what a link has.',
    remedy: 'Make the text with `strokesToText` of `rock-field/core`.',
  },
};
