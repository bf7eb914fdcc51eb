// A memory that cannot grow any further: a run that would need more ends in OverBudget, and no instance is lost.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { Session } from '../../www/generator/session.ts';
import type { RawSteps } from '../../www/generator/session.ts';
import { encodeParams, resolveParams } from '../../www/rocks/request.ts';
import type { FieldRequest } from '../../www/rocks/request.ts';
import { encodeColony, resolveColony } from '../../www/wood-ear/request.ts';
import type { WoodEarRequest } from '../../www/wood-ear/request.ts';

const CAP = 256 * 2 ** 20;

interface Raw extends RawSteps {
  start(params: Float64Array, maxBytes: number): void;
}

interface Glue {
  default(options: { module_or_path: Uint8Array }): Promise<unknown>;
  Generator: new () => Raw;
  WoodEarGenerator: new () => Raw;
}

/** The artefact's glue with the module's memory capped. */
async function capped(artefact: string): Promise<Glue> {
  const pkg = new URL('../../pkg/', import.meta.url);
  const glue = (await import(new URL(`${artefact}.js`, pkg).href)) as Glue;
  await glue.default({ module_or_path: withMostPages(readFileSync(new URL(`${artefact}_bg.wasm`, pkg)), CAP / 65_536) });
  return glue;
}

/** The module whose one memory (section 5) has no limit, with a limit. */
function withMostPages(wasm: Uint8Array, most: number): Uint8Array {
  const bytes = [...wasm];
  for (let at = 8; at < bytes.length; ) {
    const id = bytes[at];
    const [size, begin] = leb(bytes, at + 1);
    if (id === 5) {
      const [least] = leb(bytes, begin + 2);
      assert.deepEqual([bytes[begin], bytes[begin + 1]], [1, 0], 'one memory, without a limit');
      const section = [1, 1, ...toLeb(least), ...toLeb(most)];
      return Uint8Array.from([...bytes.slice(0, at), 5, ...toLeb(section.length), ...section, ...bytes.slice(begin + size)]);
    }
    at = begin + size;
  }
  throw new Error('the module has no memory of its own');
}

function leb(bytes: readonly number[], at: number): [number, number] {
  let value = 0;
  for (let shift = 0; ; shift += 7) {
    const byte = bytes[at++]!;
    value += (byte & 127) * 2 ** shift;
    if (byte < 128) return [value, at];
  }
}

function toLeb(value: number): number[] {
  return value < 128 ? [value] : [(value & 127) | 128, ...toLeb(value >> 7)];
}

/** The name of the error that a run ends in, or how it came out. */
async function outcome(raw: Raw, params: Float64Array): Promise<string> {
  const craft = { stages: ['all'] as const, start: (generator: Raw) => generator.start(params, CAP), collect: () => 'done' };
  const session = new Session<Raw, undefined, string, 'all'>(raw, craft);
  try {
    return await session.run(undefined);
  } catch (error) {
    return (error as Error).name;
  } finally {
    session.free();
  }
}

test('a field that does not fit ends in OverBudget, and the next one comes', async () => {
  const glue = await capped('generator');
  const end = (request: FieldRequest) => outcome(new glue.Generator(), encodeParams(resolveParams(request)));
  const detailed = { id: 1, radius: 3, areaFraction: 1, detail: 180 };
  const requests: FieldRequest[] = [
    { imageWidth: 800, imageHeight: 800, border: 'drop', layers: [{ radius: 300, areaFraction: 1 }, detailed] },
    { imageWidth: 800, imageHeight: 800, layers: [detailed] },
    { imageWidth: 2000, imageHeight: 2000, layers: [{ radius: 1.2, areaFraction: 1 }] },
  ];
  for (const request of requests) {
    assert.equal(await end(request), 'OverBudget', JSON.stringify(request));
    assert.equal(await end({ preset: 'journal-fig1', imageWidth: 256, imageHeight: 256 }), 'done');
  }
});

test('a colony that does not fit ends in OverBudget, and the next one comes', async () => {
  const glue = await capped('wood-ear');
  const end = (request: WoodEarRequest) => outcome(new glue.WoodEarGenerator(), encodeColony(resolveColony(request).params));
  const dense = { density: 100, range: 200, log: { length: 400, radius: 40, spacing: 1.5 } };
  for (const request of [dense, { ...dense, rings: 24, meridians: 64, log: { length: 200, spacing: 2 } }] satisfies WoodEarRequest[]) {
    assert.equal(await end(request), 'OverBudget', JSON.stringify(request));
    assert.equal(await end({ preset: 'thesis-minimum' }), 'done');
  }
});
