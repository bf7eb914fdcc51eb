/** What was typed after a command, as values of its options. */

import { parseArgs } from 'node:util';
import { misuse } from './failures.ts';
import type { Option } from './options.ts';
import { didYouMean } from './suggest.ts';

export class Arguments {
  readonly positionals: readonly string[];
  readonly #values: ReadonlyMap<string, readonly string[]>;
  readonly #switches: ReadonlyMap<string, boolean>;

  constructor(positionals: readonly string[], values: ReadonlyMap<string, readonly string[]>, switches: ReadonlyMap<string, boolean>) {
    this.positionals = positionals;
    this.#values = values;
    this.#switches = switches;
  }

  /** The value of an option; of several, the last. */
  get(name: string): string | undefined {
    return this.#values.get(name)?.at(-1);
  }

  all(name: string): readonly string[] {
    return this.#values.get(name) ?? [];
  }

  /** Undefined where neither `--name` nor `--no-name` was given. */
  switched(name: string): boolean | undefined {
    return this.#switches.get(name);
  }

  is(name: string): boolean {
    return this.#switches.get(name) ?? false;
  }

  /** Names of all that was given. */
  names(): string[] {
    return [...this.#values.keys(), ...this.#switches.keys()];
  }
}

/**
 * @param command as it stands in messages: `rock-field export`.
 * @throws {Ending} naming what is wrong, and what was probably meant.
 */
export function parse(argv: readonly string[], options: readonly Option[], command: string): Arguments {
  const known = new Map(options.flatMap((option) => namesOf(option).map((name) => [name, option])));
  const { tokens, positionals } = parseArgs({
    args: [...argv],
    // Not strict: what it says of an unknown option is no help.
    strict: false,
    allowPositionals: true,
    tokens: true,
    options: Object.fromEntries(
      [...known].map(([name, { value, short }]) => [
        name,
        {
          type: value === undefined ? ('boolean' as const) : ('string' as const),
          multiple: true,
          ...(short && known.get(name)?.name === name && { short }),
        },
      ]),
    ),
  });
  const values = new Map<string, string[]>();
  const switches = new Map<string, boolean>();
  for (const token of tokens) {
    if (token.kind !== 'option') continue;
    const { name, rawName, value } = token;
    const option = known.get(name);
    if (!option) throw unknown(rawName, [...known.keys()], command);
    if (option.value === undefined) {
      if (value !== undefined)
        throw misuse(`${rawName} is a switch and takes no value${option.isNegatable ? `: write ${rawName} or --no-${option.name}` : ''}`);
      switches.set(option.name, name === option.name);
      continue;
    }
    if (value === undefined || (!token.inlineValue && isOption(value, known)))
      throw misuse(`${rawName} needs a value: ${rawName} ${option.value}`);
    checkChoice(rawName, value, option);
    if (values.has(name) && !option.isList && values.get(name)?.at(-1) !== value)
      throw misuse(`${rawName} is given twice: ${values.get(name)?.at(-1)} and ${value}`);
    values.set(name, [...(values.get(name) ?? []), value]);
  }
  return new Arguments(positionals, values, switches);
}

function namesOf({ name, isNegatable }: Option): string[] {
  return isNegatable ? [name, `no-${name}`] : [name];
}

/** Whether what stands where a value should is the next option. */
function isOption(value: string, known: ReadonlyMap<string, Option>): boolean {
  return value.startsWith('--') && known.has(value.slice(2).split('=')[0] ?? '');
}

function checkChoice(rawName: string, value: string, { choices }: Option): void {
  if (!choices || choices.includes(value)) return;
  throw misuse(`${rawName} ${value}: there is no such choice; it may be ${choices.join(', ')}.${didYouMean(value, choices)}`);
}

function unknown(rawName: string, known: readonly string[], command: string): Error {
  const typed = rawName.replace(/^-+/, '');
  const meant = didYouMean(typed, known, (word) => `--${word}`);
  return misuse(`there is no option ${rawName}.${meant || ` ${command} --help lists them.`}`);
}
