/** What a file says of how it was written is enough to write it again, and no more. */

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { exportScene } from 'rock-field/export';
import type { ExportOptions } from 'rock-field/export';
import { FORMS, isMap, MAPS, OPTIONS, resolveOptions } from '../../www/export/options.ts';
import type { OptionKey, ResolvedOptions } from '../../www/export/options.ts';
import { coloured, writtenOptions } from '../../www/export/origin/written-options.ts';

const REQUEST = { preset: 'scree', seed: 2, imageWidth: 40, imageHeight: 32 } as const;
/** Numbers that are other than the defaults, and little work. */
const NUMBERS: Partial<ResolvedOptions> = { kinds: 2, lods: 2, parts: 4, scale: 3, side: 17, contact: 0.3 };
const FORMATS = OPTIONS.format.choices;

/** Every value of an option that is not its default. */
function valuesOf(key: OptionKey): unknown[] {
  const row = OPTIONS[key];
  if (row.kind === 'switch') return [!row.default];
  if (row.kind === 'choice') return row.choices.filter((choice) => choice !== row.default);
  return NUMBERS[key] === undefined ? [] : [NUMBERS[key]];
}

/** A file of each format and form. */
const BASES: ExportOptions[] = FORMATS.flatMap((format): ExportOptions[] =>
  isMap({ format }) ? MAPS[format]!.map((map) => ({ format, map })) : FORMS[format]!.map((mesh) => ({ format, mesh })),
);

const bytesOf = async (options: ExportOptions): Promise<Buffer> => Buffer.from((await exportScene(REQUEST, options)).bytes);

/** The options that a page would pass: all of them. */
function all(options: ExportOptions): ResolvedOptions | undefined {
  try {
    return resolveOptions(options);
  } catch {
    // The two contradict each other.
    return undefined;
  }
}

test('a file of the options that a file says is the same file, and what it does not say would change nothing', async () => {
  let count = 0;
  for (const base of BASES) {
    const options = (Object.keys(OPTIONS) as OptionKey[]).filter(
      (key) => !['format', 'map', 'mesh', 'textures', 'metresPerPixel'].includes(key),
    );
    for (const [key, value] of options.flatMap((key) => valuesOf(key).map((value) => [key, value] as const))) {
      const resolved = all({ ...base, [key]: value });
      if (!resolved) continue;
      const { options: says = {} } = writtenOptions(coloured(resolved, true).options);
      const same = Object.hasOwn(says, key);
      const [asked, again] = await Promise.all([bytesOf({ ...base, [key]: value }), bytesOf(says)]);
      assert.ok(asked.equals(again), `${JSON.stringify(base)} ${key}: ${String(value)} is said as ${JSON.stringify(says)}`);
      // What it does not say has changed nothing.
      if (!same) assert.ok(asked.equals(await bytesOf(base)), `${JSON.stringify(base)} says nothing of ${key}: ${String(value)}`);
      count += 1;
    }
  }
  assert.ok(count > 200, `${count}`);
});
