// The pieces of the documentation's HTML: the frame of a page, blocks of code, live examples.
import hljs from 'highlight.js/lib/common';
import { Marked } from 'marked';
import { LICENCES_FILE } from '../build/licences.mjs';
import { tables } from '../lib/tables.mjs';

const { word } = await tables();

/** What the fences of the Markdown files say, as the highlighter calls it. */
const LANGUAGES = {
  html: 'xml',
  vue: 'xml',
  svelte: 'xml',
  jsx: 'javascript',
  tsx: 'typescript',
  js: 'javascript',
  ts: 'typescript',
  sh: 'bash',
  text: 'plaintext',
};

/** Lines of an editor before it scrolls. */
const MAX_ROWS = 40;

export function escaped(text) {
  return text.replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('>', '&gt;').replaceAll('"', '&quot;');
}

/** Code, coloured, under a caption. */
export function codeBlock(code, language, caption = '') {
  const { value } = hljs.highlight(code, { language: LANGUAGES[language] ?? language });
  const title = caption ? `<figcaption>${inline(caption)}</figcaption>` : '';
  // Whoever has no pointer scrolls long lines with the keys.
  return `<figure class="code">${title}<pre tabindex="0"><code>${value}</code></pre></figure>`;
}

/** An editor beside its result; `docs.ts` brings it to life. `name` is what it is an example of. */
export function liveExample(code, name) {
  const id = `code-${slug(name)}`;
  const rows = Math.min(MAX_ROWS, code.split('\n').length);
  return `<live-example data-name="${escaped(name)}">
<div class="editor"><label class="editor-label" for="${id}"><span class="visually-hidden">${escaped(word('editor', { name }))}</span><span aria-hidden="true">${word('editable')}</span></label>
<textarea class="editor-text" id="${id}" rows="${rows}" wrap="off" spellcheck="false" autocapitalize="off" autocomplete="off" autocorrect="off">
${escaped(code)}</textarea></div>
<div class="result" role="group" aria-label="${escaped(word('result', { name }))}"></div>
</live-example>`;
}

export function slug(text) {
  return text
    .toLowerCase()
    .replace(/<[^>]*>|&\w+;/g, '')
    .replace(/[^\p{L}\p{N}]+/gu, '-')
    .replace(/^-|-$/g, '');
}

/** A heading that can be linked to. */
export function heading(depth, id, html, name) {
  return `<h${depth} id="${id}">${html} <a class="anchor" href="#${id}" aria-label="${escaped(word('linkTo', { name }))}">#</a></h${depth}>`;
}

/** Markdown → `{ html, headings }`; fences may say `live` and a caption: ```` ```html live The hero ````. */
export function markdown(text) {
  const headings = [];
  const renderer = {
    code({ text: code, lang = '' }) {
      const [language, ...rest] = lang.split(' ');
      if (rest[0] === 'live') return liveExample(code, rest.slice(1).join(' '));
      return codeBlock(code, language || 'text', rest.join(' '));
    },
    heading({ tokens, depth }) {
      const html = this.parser.parseInline(tokens);
      const name = html.replace(/<[^>]*>/g, '');
      if (depth === 1) return `<h1>${html}</h1>`;
      const id = slug(name);
      if (depth === 2) headings.push({ id, name });
      return heading(depth, id, html, name);
    },
    table(token) {
      const cell =
        (tag) =>
        ({ tokens }) =>
          `<${tag}>${this.parser.parseInline(tokens)}</${tag}>`;
      const rows = token.rows.map((row) => `<tr>${row.map(cell('td')).join('')}</tr>`).join('');
      return `<div class="table" tabindex="0" role="group"><table><thead><tr>${token.header.map(cell('th')).join('')}</tr></thead><tbody>${rows}</tbody></table></div>`;
    },
  };
  const html = new Marked({ renderer }).parse(text, { async: false });
  return { html, headings };
}

/** Markdown within a line. */
export function inline(text) {
  return new Marked().parseInline(text);
}

/** A whole page. `pages` is the order of the navigation; `current` the one among them. */
export function frame({ pages, current, body, contents }) {
  const index = pages.indexOf(current);
  const link = ({ file, title }, label, key) => `<a class="turn" href="${file}" rel="${key}"><span>${word(label)}</span> ${title}</a>`;
  const before = pages[index - 1] ? link(pages[index - 1], 'previous', 'prev') : '<span></span>';
  const after = pages[index + 1] ? link(pages[index + 1], 'next', 'next') : '';
  return `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1, viewport-fit=cover">
<title>${escaped(index === 0 ? `${word('site')} – ${current.heading}` : `${current.title} – ${word('site')}`)}</title>
<meta name="description" content="${escaped(current.description)}">
<meta name="color-scheme" content="light dark">
<meta name="theme-color" content="#f8f8f6" media="(prefers-color-scheme: light)">
<meta name="theme-color" content="#1d1f22" media="(prefers-color-scheme: dark)">
<link rel="icon" href="../icon.svg" type="image/svg+xml">
<link rel="stylesheet" href="docs.css">
<script type="module" src="../rock-field.js"></script>
<script type="module" src="docs.js"></script>
</head>
<body>
<a class="skip-link" href="#content">${word('skip')}</a>
<header class="head">
<a class="mark" href="./"><img src="../icon.svg" alt="" width="24" height="24"> ${word('site')} <span>${word('documentation')}</span></a>
<a class="open-page" href="../">${word('openPage')}</a>
</header>
<div class="layout">
<nav class="nav" aria-label="${word('documentation')}"><details><summary>${word('contents')}</summary>${navigation(pages, current, contents)}</details></nav>
<main id="content" class="${current.className ?? 'prose'}" tabindex="-1">
<noscript><p class="no-script">${word('noScript')}</p></noscript>
${body}
<nav class="turns" aria-label="${word('previous')}, ${word('next')}">${before}${after}</nav>
<footer class="foot"><a href="../${LICENCES_FILE}">${word('licences')}</a></footer>
</main>
</div>
</body>
</html>
`;
}

function navigation(pages, current, contents) {
  const items = pages.map((page) => {
    const isCurrent = page === current;
    const list = isCurrent && contents.length > 0 ? `<ul>${contents.map(entry).join('')}</ul>` : '';
    const group = page.group ? `<li class="nav-group">${page.group}</li>` : '';
    return `${group}<li><a href="${page.file}"${isCurrent ? ' aria-current="page"' : ''}>${page.title}</a>${list}</li>`;
  });
  return `<ul>${items.join('')}</ul>`;
}

/** A link of the page's own contents; what has no id is a heading between them. */
function entry({ id, name, isCode }) {
  if (!id) return `<li class="nav-heading">${escaped(name)}</li>`;
  return `<li><a href="#${id}">${isCode ? `<code>${escaped(name)}</code>` : escaped(name)}</a></li>`;
}

/** A table that scrolls by itself where a page is narrow. */
export function table(label, columns, rows) {
  const head = columns.map((name) => (name ? `<th scope="col">${name}</th>` : '<td></td>')).join('');
  return `<div class="table" tabindex="0" role="group" aria-label="${label}"><table><thead><tr>${head}</tr></thead><tbody>${rows.join('')}</tbody></table></div>`;
}
