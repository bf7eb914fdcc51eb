// The list of errors: everything that is thrown is in it, and everything in it is thrown somewhere.
import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { ATTRIBUTE_NOTICES } from '../../www/attribute-notices.ts';
import { ATTRIBUTE_NOTICE_HELP, NOTICE_HELP } from '../../www/docs/notice-help.ts';
import { ERROR_GROUPS, ERRORS } from '../../www/error-list.ts';
import { NOTICES } from '../../www/notices.ts';

const NAMES = Object.keys(ERRORS);

/** The texts of all files of a folder whose name ends so, without comments. */
function sources(folder: string, extension: string): string[] {
  const root = fileURLToPath(new URL(`../../${folder}`, import.meta.url));
  const files = readdirSync(root, { recursive: true, encoding: 'utf8' }).filter((name) => name.endsWith(extension) && name !== 'error-list.ts');
  return files.map((name) => readFileSync(`${root}/${name}`, 'utf8').replaceAll(/^\s*(\/\/|\/?\*).*$/gm, ''));
}

/** Names that Rust gives: the words of every `fn code`. */
function rustNames(): string[] {
  return sources('src', '.rs').flatMap((text) => [...text.matchAll(/fn code\(&self\) -> &'static str \{([\s\S]*?)\n {4}\}/g)].flatMap(([, body = '']) => [...body.matchAll(/=> "(\w+)"/g)].map(([, name = '']) => name)));
}

/** Names that TypeScript gives: of an error in the making, or passed to a function that makes one. */
function scriptNames(): string[] {
  const texts = sources('www', '.ts');
  return texts.flatMap((text) => [...text.matchAll(/\bname: '([A-Z]\w+)',\s*(?:key|message|layer)\b|\brefused\('(\w+)'/g)].map(([, name, other]) => name ?? other ?? ''));
}

test('every error of Rust is in the list', () => {
  const names = rustNames();
  assert.ok(names.includes('OverBudget') && names.includes('LogNoArea') && names.includes('NoAdapter'), 'the search finds none');
  assert.deepEqual(names.filter((name) => !NAMES.includes(name)), []);
});

test('every error of TypeScript is in the list', () => {
  const names = scriptNames();
  assert.ok(names.includes('WrongType') && names.includes('NotConnected') && names.includes('LogFileBroken'), 'the search finds none');
  assert.deepEqual(names.filter((name) => !NAMES.includes(name)), []);
});

test('every error of the list is thrown somewhere', () => {
  const thrown = new Set([...rustNames(), ...scriptNames()]);
  assert.deepEqual(NAMES.filter((name) => !thrown.has(name)), []);
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
