// docs/decisions.md: every decision that the sources, the tests and the documentation cite is explained there.
import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import path from 'node:path';
import { test } from 'node:test';
import { root } from '../../scripts/lib/env.mjs';

const DOCUMENT = 'docs/decisions.md';
const TEXT = /\.(rs|wgsl|ts|mjs|md|json|html)$/;

const text = read(DOCUMENT);
const headings = [...text.matchAll(/^### <a id="([ak]\d+)"><\/a>([AK]\d+) · \S/gm)].map(([, id, number]) => ({ id, number }));

function read(file) {
  return readFileSync(path.join(root, file), 'utf8');
}

/** The text files under the folders and files given, relative to the root; this test itself is left out. */
function textFiles(...places) {
  const files = places.flatMap((place) =>
    TEXT.test(place) ? [place] : readdirSync(path.join(root, place), { recursive: true }).map((name) => path.join(place, name)),
  );
  return files.filter((file) => TEXT.test(file) && !file.includes('node_modules') && path.basename(file) !== 'decisions.test.mjs');
}

/** The numbers of the decisions that a text cites: in comments of Rust and WGSL any, elsewhere those after the word. */
function cited(file, content) {
  const comments = /\.(rs|wgsl)$/.test(file)
    ? [...content.matchAll(/\/\/.*$/gm)].flatMap(([line]) => line.match(/\b[AK]\d{1,2}\b/g) ?? [])
    : [];
  // Across the end of a line, and what a comment begins the next one with.
  const prose = content.replaceAll(/\s*\n\s*(?:\/\/[/!]?|\*(?!\/)|#+)?\s*/g, ' ');
  const named = [...prose.matchAll(/\bdecisions?(?:\.md)? (\[?[A-K]\d+\b.{0,60})/g)].flatMap(
    ([, words]) => words.match(/\b[A-K]\d+\b/g) ?? [],
  );
  return [...comments, ...named];
}

test('every decision that is cited has a heading in docs/decisions.md', () => {
  const known = new Set(headings.map(({ number }) => number));
  const missing = [];
  let count = 0;
  for (const file of textFiles('src', 'www', 'tests', 'scripts', 'docs', 'README.md')) {
    for (const number of cited(file, read(file))) {
      count += 1;
      if (!known.has(number)) missing.push(`${file}: ${number}`);
    }
  }
  assert.deepEqual(missing, []);
  assert.ok(count > 60, `only ${count} citations were found`);
});

test('an unknown decision is noticed, in a comment of Rust and in prose', () => {
  assert.deepEqual(cited('a.rs', 'let a1 = K99; // as in K14 (decision A1)'), ['K14', 'A1', 'A1']);
  assert.deepEqual(cited('a.ts', ' * as in decision\n   * K98, and // decisions\n  // A97'), ['K98', 'A97']);
  assert.deepEqual(cited('a.md', 'Route A66; see decisions B2 and [K3](decisions.md#k3).'), ['B2', 'K3']);
});

test('decisions have anchors named after them, each once, and links within the page lead to one', () => {
  assert.equal(headings.length, 23 + 13);
  for (const { id, number } of headings) assert.equal(id, number.toLowerCase());
  const ids = new Set(headings.map(({ id }) => id));
  assert.equal(ids.size, headings.length);
  const links = [...text.matchAll(/\]\(#([^)]+)\)/g)].map(([, id]) => id);
  assert.deepEqual(
    links.filter((id) => !ids.has(id)),
    [],
  );
  assert.deepEqual(
    [...ids].filter((id) => !links.includes(id)),
    [],
  );
});
