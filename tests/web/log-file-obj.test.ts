// OBJ files: every spelling of a mesh gives it, and what cannot be meant is refused with its line.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { FARTHEST, MOST_LISTED, MOST_TRIANGLES, MOST_VERTICES } from '../../www/wood-ear/log-file/limits.ts';
import type { LogMesh } from '../../www/wood-ear/log-mesh.ts';
import { QUAD, given, meshOf, refusal, sides, stored, triangles } from './log-files.ts';

test('OBJ: spellings of one mesh give one mesh', async () => {
  const usual = triangles(await meshOf(given('usual.obj', `${QUAD}f 1 2 3 4\n`)));
  const utf16 = (text: string, isBig: boolean, mark: boolean) => {
    const codes = [...((mark ? '\ufeff' : '') + text)].map((char) => char.charCodeAt(0));
    return Uint8Array.from(codes.flatMap((code) => (isBig ? [code >> 8, code & 255] : [code & 255, code >> 8])));
  };
  const spellings: Record<string, BlobPart> = {
    'negative indices': `${QUAD}f -4 -3 -2 -1`,
    'texture and normal numbers': `${QUAD}vt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 3//1 4/1`,
    'a line that is continued': `v 0 0 \\\n0\nv 100 \\\r\n 0 0\nv 100 30 10\nv 0 30 10\nf 1 2 \\\n 3 4`,
    'a path that ends in a backslash': `mtllib C:\\logs\\\n# from C:\\logs\\\n${QUAD}f 1 2 3 4`,
    'weights and colours': `${QUAD.replaceAll(/(v .*)\n/g, '$1 1.0\n').replace('v 0 0 0 1.0', 'v 0 0 0 0.5 0.5 0.5')}f 1 2 3 4`,
    exponents: 'v 0e0 -0.0 +0\nv 1e2 0 0\nv 1.0E+02 3.e1 .1e2\nv 0 300e-1 10\nf 1 2 3 4',
    'faces before their vertices': `f 1 2 3 4\n${QUAD}`,
    'tabs, blank lines and groups': `\n\ng log\no log\ns off\n${QUAD.replaceAll(' ', '\t')}\n\tf\t1 2 3 4  \n`,
    'statements that nobody knows': `curv 0 1 1 2 3\nfoo\n${QUAD}f 1 2 3 4\nend`,
    'a comment without a blank': `${QUAD}f 1 2 3 4#bark`,
    'lines that end in CR LF': `${QUAD}f 1 2 3 4\n`.replaceAll('\n', '\r\n'),
    'a mark of UTF-8': `\ufeff${QUAD}f 1 2 3 4`,
    'UTF-16': utf16(`${QUAD}f 1 2 3 4`, false, true),
    'UTF-16, big end first': utf16(`${QUAD}f 1 2 3 4`, true, true),
    'UTF-16 without a mark': utf16(`${QUAD}f 1 2 3 4`, false, false),
    'an edge and a point among the faces': `${QUAD}l 1 2 3\np 4\nf 1 2\nf 1 2 3 4`,
  };
  for (const [what, text] of Object.entries(spellings)) assert.deepEqual(triangles(await meshOf(given(`${what}.obj`, text))), usual, what);
});

for (const name of ['F07-comment-after-face.obj', 'F09-usemtl-without-name.obj', 'F10-cr-only.obj']) {
  test(`${name}: is read as if it were spelled the usual way`, async () => {
    assert.deepEqual(
      triangles(await meshOf(stored(name))),
      triangles(await meshOf(given('usual.obj', 'v 0 0 0\nv 100 0 0\nv 100 30 10\nv 0 30 10\nf 1 2 3 4\n'))),
    );
  });
}

test('edges and points before faces are left out', async () => {
  const { positions, indices } = await meshOf(stored('F02-line-before-faces.obj'));
  assert.deepEqual([positions.length / 3, indices.length / 3], [6, 4]);
  assert.deepEqual(
    triangles({ positions, indices }),
    triangles(await meshOf(given('without.obj', (await stored('F02-line-before-faces.obj').text()).replace('l 1 2', '')))),
  );
});

test('OBJ: what cannot be meant is refused with its line', async () => {
  const cases: [string, RegExp][] = [
    ['v 0 0 0\nv 1 2\n', /line 2: a vertex has 2 coordinates/],
    ['v 0 0 0x10\n', /line 1: "0x10" is not a number/],
    ['v 0 0 nan\n', /line 1: "nan" is not a number/],
    ['v 0 0 1d5\n', /line 1: "1d5" is not a number/],
    ['v 0 0 1e999\n', /line 1: "1e999" is too large/],
    ['# \\\nv 0 \\\n0 x\n', /line 3: "x" is not a number/],
    [`${QUAD}f 1 2 9\n`, /line 5: a face names vertex 9, and there are 4/],
    [`${QUAD}f 1 2 0\n`, /line 5: a face names vertex 0/],
    [`${QUAD}f 1 2 -5\n`, /line 5: a face names vertex -5/],
    [`${QUAD}f 1 2 99999999999999999999\n`, /line 5: a face names vertex/],
    [`${QUAD}f 1 2 3.5\n`, /line 5: "3.5" is not the number of a vertex/],
    [`${QUAD}f 1,2,3\n`, /line 5: "1,2,3" is not the number of a vertex/],
    [`v 1e308 0 0\nv -1e308 0 0\nv 0 1 0\nf 1 2 3\n`, /infinitely far/],
  ];
  for (const [text, words] of cases) {
    const { name, message, key } = await refusal(given('log.obj', text));
    assert.deepEqual([name, key], ['LogFileBroken', 'log'], text);
    assert.match(message, words);
  }
});

test('a decimal comma is refused with its line, never cut off', async () => {
  const { name, message, value, words } = await refusal(stored('F08-decimal-comma.obj'));
  assert.equal(name, 'LogFileBroken');
  assert.match(message, /line 1: "0,0" is not a number; decimals are written with a point/);
  assert.match(words!.ja, /1 行目/);
  assert.equal(value, '0,0');
});

test('triangles without an area are no log', async () => {
  assert.equal((await refusal(stored('F03-collinear.obj'))).name, 'LogNoArea');
  // Once it is scaled, nothing of its width is left.
  assert.equal((await refusal(new File(['v 0 0 0\nv 1e308 1 0\nv 0 0 1\nf 1 2 3'], 'needle.obj'))).name, 'LogNoArea');
});

test('large coordinates keep their shape: they are centred before they are rounded', async () => {
  const mesh = await meshOf(stored('F04-large-coordinates.obj'));
  const scale = 200 / 3;
  sides(mesh).forEach((side, k) => assert.ok(Math.abs(side - [200, 0.2 * scale, 0.2 * scale][k]!) < 1e-3, `${k}: ${side}`));
});

test('a triangle without area decides neither size nor direction', async () => {
  const box = await stored('F02-line-before-faces.obj').text();
  const mesh = await meshOf(given('stray.obj', `${box}\nv 0 0 90000\nf 1 7 7\nf 1 1 7\n`));
  assert.deepEqual(sides(mesh), sides(await meshOf(given('box.obj', box))));
});

test('a face of any number of corners becomes triangles that cover it once, whatever its shape', async () => {
  const ring = (count: number, radius: (k: number) => number) =>
    Array.from(
      { length: count },
      (_, k) =>
        `v ${(radius(k) * Math.cos((2 * Math.PI * k) / count)).toFixed(6)} 0 ${(-radius(k) * Math.sin((2 * Math.PI * k) / count)).toFixed(6)}`,
    ).join('\n');
  const face = (count: number) => `\nf ${Array.from({ length: count }, (_, k) => k + 1).join(' ')}\n`;
  const area = ({ positions: p, indices }: LogMesh) => {
    let [signed, unsigned] = [0, 0];
    for (let i = 0; i < indices.length; i += 3) {
      const [a, b, c] = [0, 1, 2].map((k) => 3 * indices[i + k]!) as [number, number, number];
      const each = ((p[b]! - p[a]!) * (p[c + 1]! - p[a + 1]!) - (p[c]! - p[a]!) * (p[b + 1]! - p[a + 1]!)) / 2;
      signed += each;
      unsigned += Math.abs(each);
    }
    return { signed, unsigned };
  };
  for (const [count, radius] of [
    [4, (k: number) => (k === 0 ? 10 : 50)],
    [12, (k: number) => (k % 2 ? 20 : 60)],
    [500, (k: number) => (k % 2 ? 60 : 61)],
    [60, () => 60],
  ] as const) {
    const mesh = await meshOf(given('face.obj', ring(count, radius) + face(count)));
    const { signed, unsigned } = area(mesh);
    assert.ok(Math.abs(Math.abs(signed) - unsigned) < 1e-3 * unsigned, `${count} corners: ${signed} of ${unsigned}`);
    assert.ok(signed > 0, 'it faces up as the face does');
  }
  const many = await refusal(given('comb.obj', ring(20_000, (k) => (k % 2 ? 20 : 60)) + face(20_000)));
  assert.deepEqual([many.name, many.value, many.max], ['LogFileUnsupported', 20_000, 10_000]);
  assert.equal((await meshOf(given('disc.obj', ring(100_000, () => 60) + face(100_000)))).indices.length / 3 > 90_000, true);
});

test('a face of 400,000 corners is counted, not tried', async () => {
  const { name, max } = await refusal(given('face.obj', `${QUAD}f ${'1 2 3 4 '.repeat(110_000)}\n`));
  assert.deepEqual([name, max], ['LogTooLarge', MOST_TRIANGLES]);
});

test('more vertices than a log may have are refused with both numbers, and many more before the file is read to its end', async () => {
  const grid = (columns: number, rows: number) => {
    const lines: string[] = [];
    for (let x = 0; x < columns; x += 1) for (let y = 0; y < rows; y += 1) lines.push(`v ${x} ${y} ${(x * y) % 7}`);
    for (let x = 0; x + 1 < columns; x += 1)
      for (let y = 0; y + 1 < rows; y += 1) lines.push(`f ${x * rows + y + 1} ${(x + 1) * rows + y + 1} ${(x + 1) * rows + y + 2}`);
    return lines.join('\n');
  };
  const { name, value, max, message } = await refusal(given('grid.obj', grid(700, 300)));
  assert.equal(name, 'LogTooLarge');
  assert.ok((value as number) > max! && max === MOST_VERTICES);
  assert.match(message, /grid\.obj has \d+ vertices; a log may have at most 200000/);
  const listed = await refusal(given('cloud.obj', 'v 1 2 3\n'.repeat(MOST_LISTED + 10)));
  assert.deepEqual([listed.name, listed.max], ['LogTooLarge', MOST_LISTED]);
});

test('a log far higher than it is long is refused by the reader, before its numbers overflow', async () => {
  for (const height of ['1e38', '1e300', '20000']) {
    const { name, max } = await refusal(given('spike.obj', `v 0 ${height} 1\nv 1 0 0\nv 0 0 0\nf 1 2 3\n`));
    assert.deepEqual([name, max], ['LogBadPosition', FARTHEST], height);
  }
});
