/**
 * Fuzz tests of readers. In `npm test` each target reads a fixed number of inputs, made from a stored seed; with `FUZZ_MINUTES=5` it goes on
 * for so long from a seed of the day, which `FUZZ_SEED` repeats. An input that fails is made as small as it can be, then printed.
 */

import { AssertionError } from 'node:assert';
import { test } from 'node:test';
import { mulberry32 } from '../../www/controls/mulberry32.ts';

const STORED_SEED = 20_131_211;
const minutes = Number(process.env['FUZZ_MINUTES'] ?? 0);
const firstSeed = Number(process.env['FUZZ_SEED'] ?? (minutes > 0 ? Date.now() % 2 ** 32 : STORED_SEED));
/** How long a failing input is made smaller. */
const MAX_REDUCTIONS = 2000;

export interface FuzzTarget<Input extends string | Uint8Array> {
  /** What holds for every input: the name of the test. */
  name: string;
  /** Inputs in `npm test`; together a second or two. */
  cases: number;
  make(random: Random): Input;
  /** Throws, or rejects, where the property does not hold for `input`. */
  check(input: Input): void | Promise<void>;
}

export function fuzz<Input extends string | Uint8Array>({ name, cases, make, check }: FuzzTarget<Input>): void {
  test(`fuzzing: ${name}`, async (t) => {
    const end = Date.now() + minutes * 60_000;
    let count = 0;
    for (; minutes > 0 ? Date.now() < end : count < cases; count += 1) {
      const input = make(new Random(firstSeed + count));
      const thrown = await failureOf(check, input);
      if (thrown === undefined) continue;
      const smallest = await reduced(input, async (smaller) => (await failureOf(check, smaller)) !== undefined);
      const reason = (await failureOf(check, smallest)) ?? thrown;
      throw new AssertionError({
        message: `${name}: not for input ${count} of seed ${firstSeed}, made smaller:\n${printed(smallest)}\n${reason instanceof Error ? reason.stack : String(reason)}`,
      });
    }
    t.diagnostic(`${count} inputs from seed ${firstSeed}`);
  });
}

async function failureOf<Input>(check: (input: Input) => void | Promise<void>, input: Input): Promise<unknown> {
  try {
    await check(input);
    return undefined;
  } catch (thrown) {
    return thrown ?? new Error('undefined was thrown');
  }
}

/** A part of `input` that fails as well: pieces are left out, large ones first, as long as it does. */
async function reduced<Input extends string | Uint8Array>(input: Input, fails: (smaller: Input) => Promise<boolean>): Promise<Input> {
  let smallest = input;
  let tries = 0;
  for (let size = Math.ceil(input.length / 2); size >= 1; size = size === 1 ? 0 : Math.ceil(size / 2)) {
    for (let from = 0; from < smallest.length && tries < MAX_REDUCTIONS; ) {
      const smaller = without(smallest, from, from + size);
      tries += 1;
      if (await fails(smaller)) smallest = smaller;
      else from += size;
    }
  }
  return smallest;
}

function without<Input extends string | Uint8Array>(input: Input, from: number, to: number): Input {
  if (typeof input === 'string') return (input.slice(0, from) + input.slice(to)) as Input;
  return Uint8Array.from([...input.subarray(0, from), ...input.subarray(to)]) as Input;
}

/** An expression that gives the input again. */
function printed(input: string | Uint8Array): string {
  return typeof input === 'string'
    ? JSON.stringify(input)
    : `Uint8Array.from(Buffer.from('${Buffer.from(input).toString('base64')}', 'base64'))`;
}

/** Numbers from a seed, and what is made of them. */
export class Random {
  readonly #next: () => number;

  constructor(seed: number) {
    this.#next = mulberry32(seed);
  }

  /** From 0 up to, not including, 1. */
  real(): number {
    return this.#next();
  }

  /** From 0 up to, not including, `end`. */
  integer(end: number): number {
    return Math.floor(this.#next() * end);
  }

  chance(share: number): boolean {
    return this.#next() < share;
  }

  pick<T>(list: readonly T[]): T {
    return list[this.integer(list.length)] as T;
  }

  /** Up to `max` results of `make`. */
  several<T>(max: number, make: () => T): T[] {
    return Array.from({ length: this.integer(max + 1) }, make);
  }

  /** `text` with a few pieces taken out, doubled, moved, or replaced by something from `words`. */
  mutatedText(text: string, words: readonly string[]): string {
    let result = text;
    for (let count = 1 + this.integer(4); count > 0; count -= 1) {
      const from = this.integer(result.length + 1);
      const piece = result.slice(from, from + this.integer(12));
      const rest = result.slice(from + piece.length);
      const instead = this.pick([
        '',
        piece + piece,
        this.pick(words),
        piece + this.pick(words),
        String.fromCharCode(this.integer(0x3000)),
        piece.toUpperCase(),
      ]);
      result = result.slice(0, from) + instead + rest;
    }
    return result;
  }

  /** `bytes` with a few of them changed, and perhaps cut short. */
  mutatedBytes(bytes: Uint8Array): Uint8Array {
    const result = this.chance(0.2) ? bytes.slice(0, this.integer(bytes.length + 1)) : bytes.slice();
    for (let count = 1 + this.integer(8); count > 0 && result.length > 0; count -= 1) {
      const at = this.integer(result.length);
      const view = new DataView(result.buffer, result.byteOffset, result.byteLength);
      if (this.chance(0.5) || at + 4 > result.length) result[at] = this.integer(256);
      else view.setUint32(at, this.pick([0, 1, 2, 0x7fff_ffff, 0xffff_ffff, 0x7fc0_0000, 0x7f80_0000, this.integer(2 ** 32)]), true);
    }
    return result;
  }
}
