/** Every word of the documentation's user interface. Its prose is English, and so are they. */

export const WORDS = {
  site: 'rock-field',
  documentation: 'Documentation',
  contents: 'Contents',
  skip: 'Skip to the content',
  openPage: 'Open the page',
  licences: 'Third-party licences',
  previous: 'Previous',
  next: 'Next',
  linkTo: 'Link to {name}',

  editor: 'HTML of the example “{name}”',
  editable: 'Edit me',
  result: 'Result of the example “{name}”',
  reset: 'Reset',
  copy: 'Copy',
  copied: 'Copied',
  notCopied: 'Not allowed; select it by hand',
  externalScript: 'Scripts with an address are left out here; the element is registered already.',
  noScript: 'The examples come alive with JavaScript. Everything else can be read without.',

  attribute: 'Attribute',
  property: 'Property',
  method: 'Method',
  event: 'Event',
  slot: 'Slot',
  part: 'CSS part',
  'css-property': 'CSS custom property',
  type: 'Type',
  default: 'Default',
  detail: 'Event type',
  range: 'Range',
  key: 'In links',
  readonly: 'read-only',
  perLayer: 'one value for each layer',
  relative: '{range} with the notation `relative`',

  open: 'Open in the page',
} as const;

export type Word = keyof typeof WORDS;

/** A word with its `{…}` filled in. */
export function word(key: Word, slots: Record<string, string> = {}): string {
  return WORDS[key].replace(/\{(\w+)\}/g, (_, name: string) => slots[name] ?? '');
}
