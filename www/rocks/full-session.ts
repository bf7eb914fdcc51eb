/** Sessions of the full generator, which can also do what few fields ask for: mask and strokes. */

import type { Field } from '../data/field.ts';
import type { LoopCraft } from '../generator/loop.ts';
import type { FlatRequest, StageName } from '../generator/protocol.ts';
import { Session } from '../generator/session.ts';
import { FIELD_LOOPS, fieldSession, Fields, isSame } from './session.ts';
import type { FieldSession, GeneratorModule, RawGenerator } from './session.ts';
import { strokeNumbers } from './stroke-numbers.ts';

/** The class of the same name in pkg/generator-full.d.ts, as far as it is used. */
interface RawFullGenerator extends RawGenerator {
  /** The rows of a mask from the top, its width, and `strokeNumbers`; acts from the next start. */
  set_paint(rows: Uint8Array, width: number, strokes: Float64Array): void;
}

/** What pkg/generator-full.js exports, as far as it is used. */
export interface FullModule extends GeneratorModule {
  Generator: new () => RawFullGenerator;
}

const NO_MASK: NonNullable<FlatRequest['mask']> = { width: 0, rows: new Uint8Array() };

type FullSession = Session<RawFullGenerator, FlatRequest, Field, StageName>;

export function fullSession(generator: RawFullGenerator): FullSession {
  return new Session<RawFullGenerator, FlatRequest, Field, StageName>(generator, new FullFields());
}

/** The session of either generator. */
export function sessionOfEither(generator: RawGenerator | RawFullGenerator): FieldSession | FullSession {
  return 'set_paint' in generator ? fullSession(generator) : fieldSession(generator);
}

class FullFields extends Fields<RawFullGenerator> {
  /** The mask and the strokes that the generator has. */
  #mask = NO_MASK;
  #strokes = '';

  override start(generator: RawFullGenerator, request: FlatRequest): void {
    const { mask = NO_MASK, strokes = '' } = request;
    if (strokes !== this.#strokes || mask.width !== this.#mask.width || !isSame(mask.rows, this.#mask.rows)) {
      generator.set_paint(mask.rows, mask.width, strokeNumbers(strokes));
    }
    [this.#mask, this.#strokes] = [mask, strokes];
    this.begin(generator, request);
  }
}

/** For the worker's loops. */
export const FULL_LOOPS: LoopCraft<FullModule, FlatRequest, Field, StageName> = {
  open: ({ Generator }) => fullSession(new Generator()),
  pack: FIELD_LOOPS.pack,
};
