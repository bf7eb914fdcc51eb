// The documentation's tables of what can be exported, from the tables of options and targets.
import { escaped, inline, table } from './html.mjs';
import { tables } from '../lib/tables.mjs';

const { OPTIONS, SCENE_OPTIONS, TARGETS } = await tables();

const code = (text) => `<code>${escaped(String(text))}</code>`;

/** A line for each target. */
export function exportTargets() {
  const rows = Object.entries(TARGETS).map(([name, { title, options }]) => {
    const set = Object.entries(options).map(([key, value]) => code(`${key}: ${JSON.stringify(value)}`));
    return `<tr><th scope="row">${code(name)}</th><td>${escaped(title)}</td><td>${set.join(', ') || 'the defaults'}</td></tr>`;
  });
  return table('Targets', ['target', 'program', 'what it sets'], rows);
}

/** A line for each option. */
export function exportOptions() {
  return optionTable(Object.entries(OPTIONS));
}

/** A line for each that there is in scenes of three.js. */
export function sceneOptions() {
  return optionTable(Object.entries(SCENE_OPTIONS).map(([name, own]) => [name, { ...OPTIONS[name], ...own }]));
}

function optionTable(options) {
  const rows = options.map(
    ([name, row]) =>
      `<tr><th scope="row">${code(name)}</th><td>${valuesOf(row)}</td><td>${code(row.default)}</td><td>${inline(row.doc)}</td></tr>`,
  );
  return table('Options', ['option', 'values', 'default', 'what it means'], rows);
}

function valuesOf(row) {
  if (row.kind === 'choice') return row.choices.map(code).join(', ');
  if (row.kind === 'switch') return `${code(true)}, ${code(false)}`;
  return `${row.kind === 'integer' ? 'whole, ' : ''}${row.min} … ${row.max}`;
}
