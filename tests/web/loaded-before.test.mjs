import assert from 'node:assert/strict';
import { test } from 'node:test';
import { filesBefore } from '../../scripts/build/loaded-before.mjs';

/** A graph as the bundler's metafile tells it: file → files imported at once, files imported later. */
function graph(files) {
  const records = (paths, kind) => paths.map((path) => ({ path, kind }));
  return Object.fromEntries(
    Object.entries(files).map(([file, [atOnce, later = []]]) => [
      file,
      { imports: [...records(atOnce, 'import-statement'), ...records(later, 'dynamic-import')] },
    ]),
  );
}

test('what is loaded before a later file is what all entries that lead to it import at once', () => {
  const inputs = graph({
    'www/page.ts': [['www/element.ts', 'www/panel.ts']],
    'www/guest.ts': [['www/element.ts']],
    'www/element.ts': [['www/errors.ts'], ['www/hands.ts']],
    'www/panel.ts': [[], ['www/help.ts']],
    'www/hands.ts': [['www/errors.ts'], ['www/touch.ts']],
    'www/touch.ts': [[]],
    'www/help.ts': [['www/errors.ts']],
    'www/errors.ts': [[]],
    'www/core.ts': [['www/errors.ts'], []],
  });
  const before = filesBefore(inputs, ['www/page.ts', 'www/guest.ts', 'www/core.ts']);
  const files = (name) => [...(before.get(name) ?? [])].sort();
  assert.deepEqual(files('www/hands.ts'), ['www/element.ts', 'www/errors.ts'], 'the guest has no panel');
  assert.deepEqual(files('www/touch.ts'), ['www/element.ts', 'www/errors.ts'], 'reached through a file that is itself imported later');
  assert.deepEqual(files('www/help.ts'), ['www/element.ts', 'www/errors.ts'], 'page and panel stay in the one file that has them');
  assert.deepEqual(files('www/errors.ts'), [], 'never imported later');
});

test('an entry that has a file at once is brought nothing of another that imports it later', () => {
  const inputs = graph({
    'www/page.ts': [['www/element.ts'], ['www/docs.ts']],
    'www/element.ts': [[]],
    'www/core.ts': [['www/docs.ts', 'www/errors.ts'], ['www/words.ts']],
    'www/guest.ts': [['www/words.ts', 'www/element.ts'], ['www/words.ts']],
    'www/docs.ts': [[]],
    'www/words.ts': [[]],
    'www/errors.ts': [[]],
  });
  const before = filesBefore(inputs, ['www/page.ts', 'www/core.ts', 'www/guest.ts']);
  assert.deepEqual(before.get('www/docs.ts'), ['www/element.ts'], 'the core never imports it later');
  assert.deepEqual(before.get('www/words.ts'), [], 'the core and the guest share nothing');
});

test('what one entry alone has is brought where the later file needs some of it', () => {
  const inputs = graph({
    'www/page.ts': [['www/element.ts', 'www/panel.ts', 'www/icons.ts'], ['www/help.ts']],
    'www/guest.ts': [['www/element.ts']],
    'www/element.ts': [[]],
    'www/panel.ts': [['www/icons.ts']],
    'www/icons.ts': [[]],
    'www/help.ts': [['www/icons.ts']],
  });
  const before = filesBefore(inputs, ['www/page.ts', 'www/guest.ts']);
  assert.deepEqual([...before.get('www/help.ts')].sort(), ['www/element.ts', 'www/icons.ts', 'www/page.ts', 'www/panel.ts']);
});
