// The documentation's tables of errors and notices, from the list of errors and from the sentences of notices.
import { escaped, heading, inline, table } from './html.mjs';
import { tables } from '../lib/tables.mjs';

const { ATTRIBUTE_NOTICES, ATTRIBUTE_NOTICE_HELP, ERRORS, ERROR_GROUPS, NOTICES, NOTICE_HELP } = await tables();

const entries = Object.entries(ERRORS);

/** All names in a line for each group, for the page that explains errors as such. */
export function errorNames() {
  const rows = Object.entries(ERROR_GROUPS).map(([group, { title, means }]) => {
    const names = entries
      .filter(([, entry]) => entry.group === group)
      .map(([name]) => `<a href="troubleshooting.html#${name}"><code>${name}</code></a>`);
    return `<tr><th scope="row">${title}</th><td>${names.join(', ')}</td><td>${inline(means)}</td></tr>`;
  });
  return table('Names of errors', ['', 'names', 'what they mean'], rows);
}

/** Every message with its cause and its remedy. */
export function troubleshooting() {
  const errors = Object.entries(ERROR_GROUPS).map(([group, { title }]) => ({
    id: group,
    name: title,
    list: entries
      .filter(([, entry]) => entry.group === group)
      .map(([name, { message, cause, remedy }]) => entryOf(name, name, message, cause, remedy)),
  }));
  const notices = {
    id: 'notices',
    name: 'Notices about links',
    intro:
      '<p>Links and attributes never fail. What cannot be taken as it stands is replaced, and a notice says by what: on the picture, on the console, and by the <a href="events.html#event-notice"><code>notice</code></a> event.</p>',
    list: Object.entries(NOTICES).map(([code, message]) =>
      entryOf(`notice-${code}`, code, message, NOTICE_HELP[code].cause, NOTICE_HELP[code].remedy),
    ),
  };
  const attributes = {
    id: 'attribute-notices',
    name: 'Notices about attributes',
    intro:
      '<p>They begin with the attribute’s name. A link in <a href="attributes.html#attribute-src"><code>src</code></a> or <code>ground</code> gives the notices above.</p>',
    list: Object.entries(ATTRIBUTE_NOTICES).map(([code, message]) =>
      entryOf(`notice-${code}`, code, message, ATTRIBUTE_NOTICE_HELP[code].cause, ATTRIBUTE_NOTICE_HELP[code].remedy),
    ),
  };
  /** @type {{ id: string, name: string, intro?: string, list: string[] }[]} */
  const parts = [...errors, notices, attributes];
  const html = parts.map(({ id, name, intro = '', list }) => `${heading(2, id, name, name)}${intro}${list.join('')}`);
  return { html: html.join('\n'), contents: parts.map(({ id, name }) => ({ id, name })) };
}

function entryOf(id, name, message, cause, remedy) {
  return `${heading(3, id, `<code>${name}</code>`, name)}<p><em>${escaped(message)}</em></p><p>${inline(cause)} <strong>What helps:</strong> ${inline(remedy)}</p>`;
}
