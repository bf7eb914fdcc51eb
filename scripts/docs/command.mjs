// The documentation's tables of the command line, from the lists that it is parsed by.
import { escaped, inline, table } from './html.mjs';
import { tables } from '../lib/tables.mjs';

const { EXITS, OUTPUT, PLACES, SAYING, SCENE, TARGET } = await tables();

const code = (text) => `<code>${escaped(String(text))}</code>`;

/** By the name that stands in the page. */
export const commandTables = {
  'command scene': () => options('Which scene', SCENE),
  'command output': () => options('Where the files go', [...OUTPUT, ...SAYING]),
  'command targets': () => options('The program', [TARGET]),
  'command places': () =>
    table(
      'Places in --out',
      ['in --out', 'stands for'],
      Object.entries(PLACES).map(([name, doc]) => `<tr><th scope="row">${code(`{${name}}`)}</th><td>${escaped(doc)}</td></tr>`),
    ),
  'command exits': () =>
    table(
      'Exit codes',
      ['exit code', 'what it means'],
      Object.values(EXITS).map(({ code: number, means }) => `<tr><th scope="row">${code(number)}</th><td>${escaped(means)}</td></tr>`),
    ),
};

function options(caption, rows) {
  return table(
    caption,
    ['option', 'what it means'],
    rows.map(({ name, short, value, choices, doc }) => {
      const words = choices ? ` ${choices.map(code).join(', ')}.` : '';
      const term = [`--${name}`, ...(short ? [`-${short}`] : [])].map((word) => code(value ? `${word} ${value}` : word)).join(', ');
      return `<tr><th scope="row">${term}</th><td>${inline(doc)}${words}</td></tr>`;
    }),
  );
}
