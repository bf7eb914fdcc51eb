// rock-field/export: every pair of options. PAIRS=all takes every preset of both generators for every request.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import validator from 'gltf-validator';
import { unzipSync } from 'fflate';
import { PNG } from 'pngjs';
import { presets, woodEarPresets } from 'rock-field/core';
import { exportScene, exportWoodEar } from 'rock-field/export';
import type { ErrorInfo, ExportedFile, ExportOptions } from 'rock-field/export';
import { OPTIONS, resolveOptions, TARGETS } from '../../www/export/options.ts';
import type { OptionKey, ResolvedOptions } from '../../www/export/options.ts';

type Key = OptionKey | 'target';
type Given = Partial<Record<Key, unknown>>;
type NumberKey = { [K in OptionKey]: (typeof OPTIONS)[K] extends { kind: 'real' | 'integer' } ? K : never }[OptionKey];

/** What stands for all values of a number. */
const NUMBERS: Record<NumberKey, readonly number[]> = {
  kinds: [1, 3],
  lods: [1, 2, 4],
  parts: [1, 4],
  scale: [0.5, 1000],
  metresPerPixel: [0.01, 2],
  side: [0, 33],
  contact: [0.02, 0.5],
};

/** For each option its values, the first of which is not to give it. */
const VALUES = new Map<Key, readonly unknown[]>([
  ['target', [undefined, ...Object.keys(TARGETS)]],
  ...Object.entries(OPTIONS).map(([key, row]): [Key, unknown[]] => {
    if (row.kind === 'choice') return [key as Key, [undefined, ...row.choices]];
    return [key as Key, [undefined, ...(row.kind === 'switch' ? [false, true] : NUMBERS[key as NumberKey])]];
  }),
]);
const KEYS = [...VALUES.keys()];

/** That of options which cannot be had; anything else that was thrown is thrown on. */
function impossible(error: unknown): ErrorInfo {
  if ((error as ErrorInfo).name !== 'ExportImpossible') throw error;
  return error as ErrorInfo;
}

/** The error of these options; null where there is none. */
function refusal(given: Given): ErrorInfo | null {
  try {
    resolveOptions(given as ExportOptions);
    return null;
  } catch (error) {
    return impossible(error);
  }
}

const nameOf = (a: Key, v: unknown, b: Key, w: unknown): string => `${a}=${String(v)} ${b}=${String(w)}`;

/** Requests in which every pair of values that can be had together is found at least once, and the errors of the other pairs. */
function coveringArray(): { rows: Given[]; refused: { pair: Given; error: ErrorInfo }[] } {
  const open = new Map<string, Given>();
  KEYS.forEach((a, i) => {
    for (const b of KEYS.slice(i + 1)) {
      for (const v of VALUES.get(a)!) for (const w of VALUES.get(b)!) open.set(nameOf(a, v, b, w), { [a]: v, [b]: w });
    }
  });
  const covered = (row: Given, key: Key, value: unknown): string[] =>
    KEYS.filter((other) => other !== key && other in row)
      .map((other) =>
        KEYS.indexOf(other) < KEYS.indexOf(key) ? nameOf(other, row[other], key, value) : nameOf(key, value, other, row[other]),
      )
      .filter((name) => open.has(name));
  const [rows, refused]: [Given[], { pair: Given; error: ErrorInfo }[]] = [[], []];
  for (const pair of open.values()) {
    const error = refusal(pair);
    if (error) {
      refused.push({ pair, error });
      continue;
    }
    const row = { ...pair };
    // Another option in turn comes first, so that none of them always has to give way to the others.
    const turned = KEYS.map((_, k) => KEYS[(k + rows.length) % KEYS.length]!);
    for (const key of turned.filter((one) => !(one in pair))) {
      const choices = VALUES.get(key)!.filter((value) => refusal({ ...row, [key]: value }) === null);
      const uses = (value: unknown): number => rows.filter((other) => other[key] === value).length;
      row[key] = choices.toSorted((v, w) => covered(row, key, w).length - covered(row, key, v).length || uses(v) - uses(w))[0];
    }
    for (const key of KEYS) for (const name of covered(row, key, row[key])) open.delete(name);
    rows.push(row);
  }
  return { rows, refused };
}

type PresetName = keyof typeof presets;
type WoodEarPresetName = keyof typeof woodEarPresets;
const FIELDS = Object.keys(presets) as PresetName[];
const COLONIES = Object.keys(woodEarPresets) as WoodEarPresetName[];

/** In pixels; the lengths of the conference's presets are shares of the width, so that only a small image has few of their rocks. */
const sizeOf = (preset: PresetName): { imageWidth: number; imageHeight: number } =>
  preset.startsWith('conference') ? { imageWidth: 24, imageHeight: 18 } : { imageWidth: 80, imageHeight: 60 };
const rocks = (preset: PresetName, options: ExportOptions): Promise<ExportedFile> =>
  exportScene({ preset, seed: 3, ...sizeOf(preset) }, options);

/** With little to do. */
const SMALL = { rings: 4, meridians: 9, range: 20, density: 10, log: { length: 40, radius: 6, spacing: 3 }, ground: '' };
const woodEars = (preset: WoodEarPresetName, options: ExportOptions): Promise<ExportedFile> => exportWoodEar({ preset, ...SMALL }, options);

/** What each format has to be by what its report says. */
const CHECKS: Record<string, (file: ExportedFile) => unknown> = {
  glb: async ({ bytes }) => {
    const { issues } = await validator.validateBytes(bytes);
    assert.deepEqual([issues.numErrors, issues.numWarnings], [0, 0], JSON.stringify(issues.messages.slice(0, 3)));
  },
  obj: ({ bytes, report }) => {
    const lines = new TextDecoder().decode(bytes).split('\n');
    const triangles = (report.levels ?? [report.triangles]).reduce((sum, level) => sum + level, 0);
    assert.equal(lines.filter((line) => line.startsWith('f ')).length, triangles);
  },
  stl: ({ bytes, report }) => assert.equal(bytes.length, 84 + 50 * report.triangles),
  ply: ({ bytes, report }) => {
    const header = new TextDecoder().decode(bytes.subarray(0, 2000)).split('end_header')[0]!;
    if (header.includes('element face')) assert.ok(header.includes(`element face ${report.triangles}\n`), header);
    else assert.ok(header.includes(`element vertex ${report.objects}\n`), header);
  },
  csv: ({ bytes, report }) => {
    const [head, ...rows] = new TextDecoder().decode(bytes).trimEnd().split('\n');
    assert.equal(rows.length, report.objects);
    assert.ok(rows.every((row) => row.split(',').length === head!.split(',').length));
  },
  png: ({ bytes }) => assert.ok(PNG.sync.read(Buffer.from(bytes)).width > 0),
  r16: ({ bytes }) => assert.ok(bytes.length > 0 && bytes.length % 2 === 0),
  exr: ({ bytes }) => assert.deepEqual([...bytes.subarray(0, 4)], [0x76, 0x2f, 0x31, 0x01]),
  zip: ({ bytes }) => assert.equal(new TextDecoder().decode(bytes.subarray(0, 2)), 'PK'),
};

/** Each part by itself has to be what its format wants; what the report counts they have together. */
async function checkParts(file: ExportedFile, format: ResolvedOptions['format']): Promise<void> {
  const entries = Object.entries(unzipSync(file.bytes));
  assert.ok(entries.length > 0 && entries.length <= 4);
  for (const [name, bytes] of entries) {
    assert.match(name, new RegExp(`_x\\d_y\\d\\.${format}$`));
    if (format === 'glb') await CHECKS.glb!({ ...file, bytes: Uint8Array.from(bytes) });
    else assert.ok(bytes.length > 0);
  }
}

/** Every preset with every request. */
const ALL = process.env.PAIRS === 'all';

const { rows, refused } = coveringArray();

async function check(write: () => Promise<ExportedFile>, options: ExportOptions, what: string): Promise<void> {
  try {
    const file = await write();
    const { format, parts } = resolveOptions(options);
    await (parts > 1 ? checkParts(file, format) : CHECKS[format]!(file));
    assert.equal(file.report.bytes, file.bytes.length);
    assert.ok(file.name.endsWith(parts > 1 ? '.zip' : `.${format}`), file.name);
  } catch (error) {
    if ((error as ErrorInfo).name === 'ExportImpossible') throw error;
    throw new Error(`${what} with ${JSON.stringify(options)}`, { cause: error });
  }
}

/** For each request the preset that was least often together with its target, and of those with its form of meshes. */
function presetsFor(requests: readonly Given[]): PresetName[] {
  const met = new Map<string, number>();
  return requests.map(({ target, mesh }) => {
    const pairs = (preset: string): [string, string] => [`${preset} ${String(target)}`, `${preset} ${String(mesh)}`];
    const often = (preset: string): number => {
      const [withTarget, withMesh] = pairs(preset).map((pair) => met.get(pair) ?? 0);
      return requests.length * withTarget! + withMesh!;
    };
    const chosen = FIELDS.reduce((best, preset) => (often(preset) < often(best) ? preset : best));
    for (const pair of pairs(chosen)) met.set(pair, (met.get(pair) ?? 0) + 1);
    return chosen;
  });
}

test('every pair of options that can be had together is written as its format wants it, and every preset for every target', async (t) => {
  const chosen = presetsFor(rows);
  for (const [r, given] of rows.entries()) {
    const options = given as ExportOptions;
    for (const name of ALL ? FIELDS : [chosen[r]!]) await check(() => rocks(name, options), options, name);
  }
  t.diagnostic(`${rows.length} requests${ALL ? `, each of ${FIELDS.length} presets` : ''}`);
  const together = new Set(rows.map(({ target }, r) => `${chosen[r]} ${String(target)}`));
  for (const target of Object.keys(TARGETS) as (keyof typeof TARGETS)[]) {
    const left = FIELDS.filter((preset) => !together.has(`${preset} ${target}`));
    for (const preset of left) await check(() => rocks(preset, { target }), { target }, preset);
  }
});

test('the same of wood ears, but for the options of rocks alone, which are refused', async (t) => {
  let refusals = 0;
  let files = 0;
  for (const [r, given] of rows.entries()) {
    // Little of what an option does depends on what it is done to.
    if (!ALL && r % 4 > 0) continue;
    const options = given as ExportOptions;
    for (const name of ALL ? COLONIES : [COLONIES[(r / 4) % COLONIES.length]!]) {
      await check(() => woodEars(name, options), options, name).then(
        () => (files += 1),
        (error: unknown) => {
          impossible(error);
          refusals += 1;
        },
      );
    }
  }
  t.diagnostic(`${files} files, ${refusals} refused`);
  assert.ok(files > COLONIES.length && refusals > 0);
});

test('a pair of options that contradict each other is refused, and the error names one of the two', () => {
  assert.ok(refused.length > 0);
  for (const { pair, error } of refused) {
    assert.ok(error.key && error.key in pair, `${JSON.stringify(pair)}: ${error.message}`);
  }
});
