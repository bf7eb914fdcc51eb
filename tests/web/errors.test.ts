// The list of errors: everything that is thrown is in it, and everything in it is thrown somewhere.
import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { ATTRIBUTE_NOTICES } from '../../www/element/attribute-notices.ts';
import { ATTRIBUTE_NOTICE_HELP, NOTICE_HELP } from '../../www/docs/notice-help.ts';
import { ERROR_GROUPS, ERRORS } from '../../www/base/error-list.ts';
import { japaneseNotice } from '../../www/table/notices.ja.ts';
import { NOTICES, noticeText } from '../../www/table/notices.ts';
import type { Notice } from '../../www/table/notices.ts';
import { defaultParams, resolveParams } from '../../www/rocks/request.ts';
import { errorText } from '../../www/controls/strings-later.ts';

const NAMES = Object.keys(ERRORS);

/** The texts of all files of a folder whose name ends so, without comments; a string of Rust that goes on in the next line is in one. */
function sources(folder: string, extension: string): string[] {
  const root = fileURLToPath(new URL(`../../${folder}`, import.meta.url));
  const files = readdirSync(root, { recursive: true, encoding: 'utf8' }).filter(
    (name) => name.endsWith(extension) && !name.endsWith('error-list.ts'),
  );
  return files.map((name) =>
    readFileSync(`${root}/${name}`, 'utf8')
      .replaceAll(/^\s*(\/\/|\/?\*).*$/gm, '')
      .replaceAll(/\\\n\s*/g, ''),
  );
}

/** Names that Rust gives: the words of every `fn code`. */
function rustNames(): string[] {
  return sources('src', '.rs').flatMap((text) =>
    [...text.matchAll(/fn\s+code\(&self\)\s*->\s*&'static\s+str\s*\{([\s\S]*?)\n {4}\}/g)].flatMap(([, body = '']) =>
      [...body.matchAll(/=>\s*(?:\{\s*)?"(\w+)"/g)].map(([, name = '']) => name),
    ),
  );
}

/** Names that TypeScript gives: of an error in the making, or passed to a function that makes one. */
function scriptNames(): string[] {
  const texts = sources('www', '.ts');
  return texts.flatMap((text) =>
    [...text.matchAll(/\bname:\s*'([A-Z]\w+)',\s*(?:key|message|layer)\b|\brefused\(\s*'(\w+)'/g)].map(
      ([, name, other]) => name ?? other ?? '',
    ),
  );
}

test('every error of Rust is in the list', () => {
  const names = rustNames();
  assert.ok(names.includes('OverBudget') && names.includes('LogNoArea') && names.includes('NoAdapter'), 'the search finds none');
  assert.deepEqual(
    names.filter((name) => !NAMES.includes(name)),
    [],
  );
});

test('every error of TypeScript is in the list', () => {
  const names = scriptNames();
  assert.ok(names.includes('WrongType') && names.includes('NotConnected') && names.includes('LogFileBroken'), 'the search finds none');
  assert.deepEqual(
    names.filter((name) => !NAMES.includes(name)),
    [],
  );
});

test('every error of the list is thrown somewhere', () => {
  const thrown = new Set([...rustNames(), ...scriptNames()]);
  assert.deepEqual(
    NAMES.filter((name) => !thrown.has(name)),
    [],
  );
});

test('every error and notice says its message, its cause and what helps', () => {
  for (const [name, { group, message, cause, remedy }] of Object.entries(ERRORS)) {
    assert.ok(group in ERROR_GROUPS && message && /[.]$/.test(cause) && /[.]$/.test(remedy), name);
  }
  assert.deepEqual(Object.keys(NOTICE_HELP), Object.keys(NOTICES));
  assert.deepEqual(Object.keys(ATTRIBUTE_NOTICE_HELP), Object.keys(ATTRIBUTE_NOTICES));
  const codes = [...Object.keys(NOTICES), ...Object.keys(ATTRIBUTE_NOTICES)];
  assert.equal(new Set(codes).size, codes.length, 'each has a place of its own on the page of messages');
});

/** Sentences about values that are not allowed, by their names, with `{…}` for what differs. */
function valueSentences(): { en: [string, string][]; ja: [string, string][] } {
  const codes = Object.keys(NOTICES) as Notice['code'][];
  const blank = (code: Notice['code']) =>
    ({ code, text: '', key: '{key}', given: '{given}', used: '{used}', min: '{min}', max: '{max}' }) as unknown as Notice;
  const range = { name: 'OutOfRange', message: '', value: 0, min: '{min}', max: '{max}' } as unknown as Parameters<typeof errorText>[1];
  return {
    en: [
      ...Object.entries(ERRORS).map(([name, { message }]): [string, string] => [name, message]),
      ...Object.entries(ATTRIBUTE_NOTICES),
      ...codes.map((code): [string, string] => [code, noticeText(blank(code))]),
      ['the panel', errorText('en', range)],
    ],
    ja: [...codes.map((code): [string, string] => [code, japaneseNotice(blank(code))]), ['the panel', errorText('ja', range)]],
  };
}

test('bounds are told in one form: "must be between … and …", "may … at most …", and the same in Japanese', () => {
  const { en, ja } = valueSentences();
  const bounded = en.filter(([, text]) => /\{m(in|ax)\}/.test(text));
  assert.ok(bounded.length >= 6, 'there are fewer than there were');
  for (const [name, text] of bounded) {
    if (name !== 'OverBudget' && name !== 'FieldTooLarge')
      assert.match(text, /must be (\S+ )*between \{min\} and \{max\}|may (be|have) at most \{max\}/, name);
  }
  for (const [name, text] of ja) if (text.includes('{min}')) assert.match(text, /\{min\} 〜 \{max\} の範囲で指定してください/, name);
});

test('what is taken instead is told in one form: "using …" or "showing …", and the same in Japanese', () => {
  const { en, ja } = valueSentences();
  for (const [name, text] of en) if (text.includes('{used}')) assert.match(text, /\b(using|showing|reading|ignoring)\b/, name);
  for (const [name, text] of ja)
    if (/\{used\}.*[。]$/.test(text))
      assert.match(text, /(を使います|を表示しています|として読み込みました|だけを読み込みました)。$/, name);
});

test('no message says "has to", or tells a fallback in the passive', () => {
  const literals = [...sources('www', '.ts'), ...sources('src', '.rs')].flatMap(
    (text) => text.match(/'(?:[^'\\\n]|\\.)*'|"(?:[^"\\\n]|\\.)*"|`[^`]*`/g) ?? [],
  );
  assert.ok(literals.length > 1000, 'the search finds none');
  const messages = [...literals, ...Object.values(ERRORS).map(({ message }) => message)];
  assert.deepEqual(
    messages.filter((text) => /\bha(s|ve) to (be|lie)\b|; .{0,40}\b(is|are) used\b|\bis no (whole )?number\b|\bis none of\b/.test(text)),
    [],
  );
});

/** A message as it is with anything in the place of what differs. */
function patternOf(message: string): RegExp {
  return new RegExp(`^${message.replace(/[.*+?^$()|[\]\\]/g, '\\$&').replace(/"?\{\w+\}"?/g, '.+')}$`);
}

test('what is thrown for a bad request has the message of the list', () => {
  const [layer] = defaultParams().layers;
  const bad: [keyof typeof ERRORS, unknown][] = [
    ['OutOfRange', { packing: 2 }],
    ['OutOfRange', { layers: [{ radius: 0 }] }],
    ['NotAnInteger', { seed: 1.5 }],
    ['WrongType', { seed: '5' }],
    ['UnknownKey', { sed: 5 }],
    ['UnknownPreset', { preset: 'moon' }],
    ['TooManyLayers', { layers: Array(9).fill(layer) }],
    ['DuplicateLayerId', { layers: [{ id: 1 }, { id: 1 }] }],
    ['MalformedRequest', 5],
  ];
  for (const [name, request] of bad)
    assert.throws(() => resolveParams(request as object), { name, message: patternOf(ERRORS[name].message) }, JSON.stringify(request));
});

test('what Rust says of a parameter has the message of the list', () => {
  const texts = sources('src', '.rs').flatMap((text) =>
    [...text.matchAll(/Error::(\w+)\s*\{[^}]*\}\s*=>\s*(?:\{\s*)?\(\s*"((?:[^"\\]|\\.)*)"/g)].map(
      ([, name = '', message = '']) => [name, message.replaceAll('\\"', '"')] as const,
    ),
  );
  const found = new Map(texts);
  for (const name of ['OutOfRange', 'NotAnInteger', 'TooManyLayers', 'DuplicateLayerId'] as const)
    assert.match(found.get(name) ?? '', patternOf(ERRORS[name].message), name);
});
