/** `rock-field schema`: all that can be asked for, as JSON Schema. */

import { exportSchema } from '../../export/schema.ts';
import { schema } from '../../rocks/catalogue.ts';
import { woodEarSchema } from '../../wood-ear/catalogue.ts';
import type { Command } from '../command.ts';
import { misuse } from '../failures.ts';
import { didYouMean } from '../suggest.ts';

const SCHEMAS = { rocks: schema, 'wood-ears': woodEarSchema, export: exportSchema } as const;
const NAMES = Object.keys(SCHEMAS);

export const command: Command = {
  usage: '[rocks | wood-ears | export]',
  about:
    'Prints the JSON Schema (2020-12) of the parameters of rocks, of those of wood ears, or of the options of exports: names, bounds, defaults and what each means. Without a word, an object with all three.',
  groups: [],
  examples: [
    { what: 'all parameters of rocks', line: 'rock-field schema rocks' },
    { what: 'all options of exports', line: 'rock-field schema export' },
  ],
  run: async ({ positionals }, { out }) => {
    const [name, other] = positionals;
    if (other !== undefined) throw misuse('one schema at a time, or all of them without a word');
    if (name !== undefined && !Object.hasOwn(SCHEMAS, name))
      throw misuse(`there is no schema ${JSON.stringify(name)}; there are ${NAMES.join(', ')}.${didYouMean(name, NAMES)}`);
    out.write(`${JSON.stringify(name === undefined ? SCHEMAS : SCHEMAS[name as keyof typeof SCHEMAS], null, 2)}\n`);
    return 'done';
  },
};
