// The reference pages: a section for each member, the overview of all, the gallery of presets and the types.
import { readFileSync } from 'node:fs';
import path from 'node:path';
import { ts } from '@custom-elements-manifest/analyzer';
import { codeBlock, escaped, heading, inline, liveExample, markdown } from './html.mjs';
import { root } from '../lib/env.mjs';
import { manifest } from '../package/manifest.mjs';
import { needed } from '../lib/run.mjs';
import { tables } from '../lib/tables.mjs';

const { ERRORS, encodeLink, presetLabel, presetName, presetParams, translate, word, LAYER_ROWS, PAPERS, PRESETS } = await tables();

/** How attributes are told apart; what stands in none of these is of the last. */
const GROUPS = [
  { name: 'Which rocks', has: ({ name, spec }) => ['src', 'preset'].includes(name) || (spec?.scope === 'field' && spec.stage !== 'look') },
  { name: 'The layers', has: ({ spec }) => spec?.scope === 'layer' },
  { name: 'The look', has: ({ spec }) => spec?.stage === 'look' },
  {
    name: 'View and camera',
    has: ({ name }) => ['view', 'color', 'camera-orbit', 'fov', 'navigation', 'auto-rotate', 'metres-per-pixel'].includes(name),
  },
  { name: 'Manners', has: () => true },
];
const KIND_GROUPS = { slot: 'Slots', part: 'CSS parts', 'css-property': 'CSS custom properties' };

/** Where the types are written; those that are exported and shown, in this order. */
const TYPE_SOURCES = [
  'www/rocks/params.gen.ts',
  'www/rocks/request.ts',
  'www/data/field.ts',
  'www/base/view.ts',
  'www/scene/picture.ts',
  'www/generator/protocol.ts',
  'www/base/errors.ts',
  'www/generator/headless.ts',
  'www/rocks/headless.ts',
];
const TYPES = [
  { name: 'Of the element', types: ['Params', 'Layer', 'CameraState', 'PictureOptions', 'Progress', 'ErrorInfo', 'ErrorName'] },
  { name: 'Of a field', types: ['Field', 'FieldLayer', 'FieldStats', 'StageTimes'] },
  { name: 'Of rock-field/core', types: ['FieldRequest', 'LayerRequest', 'FieldGenerator', 'GenerateOptions', 'GeneratorOptions'] },
];
const LINKED = new Set(TYPES.flatMap(({ types: names }) => names));

/** A section for each of these members. */
export async function sections(found, kinds) {
  const groups = groupsOf(found, kinds);
  const contents = groups.flatMap(({ name, list }) => [
    ...(name ? [{ name }] : []),
    ...list.map(({ id, name: of }) => ({ id, name: of, isCode: true })),
  ]);
  const html = groups
    .map(
      ({ name, list }) =>
        `${name ? `<h2 class="group">${name}</h2>` : ''}${list.map((member) => section(member, name ? 3 : 2)).join('\n')}`,
    )
    .join('\n');
  return { html, contents };
}

function groupsOf(found, kinds) {
  if (kinds.length > 1) return kinds.map((kind) => ({ name: KIND_GROUPS[kind], list: found.filter((member) => member.kind === kind) }));
  if (kinds[0] !== 'attribute') return [{ name: '', list: found }];
  const groupOf = (member) => GROUPS.find(({ has }) => has(member));
  return GROUPS.map((group) => ({ name: group.name, list: found.filter((member) => groupOf(member) === group) }));
}

function section(member, depth) {
  const { id, kind, name, description, note, example } = member;
  const title = `<code>${escaped(signature(member))}</code>`;
  return `<section class="member">
${heading(depth, id, title, name)}
<div class="words">${description ? `<p>${inline(closed(ownWords(member)))}</p>` : ''}${note ? markdown(note).html : ''}</div>
${facts(member)}
${example && liveExample(example, `${word(kind)} ${name}`)}
</section>`;
}

/** The manifest puts the range into the sentence, which here has a line of its own. */
function ownWords({ doc, description }) {
  return doc ?? description;
}

function closed(sentence) {
  return /[.!?]$/.test(sentence) ? sentence : `${sentence}.`;
}

function signature({ kind, name, parameters = [] }) {
  if (kind !== 'method') return name;
  return `${name}(${parameters.map((parameter) => parameter.name.replace(/\{ (\w+) = .*\}/, '{ $1 }')).join(', ')})`;
}

/** Type, default, range and so on. */
function facts(member) {
  const { kind, type, spec, property, readonly } = member;
  const list = [
    kind === 'method' ? [word('type'), typeOf(methodType(member))] : kind === 'event' ? [word('detail'), typeOf(type.text)] : null,
    kind === 'property' ? [word('type'), `${typeOf(type.text)}${readonly ? `, ${word('readonly')}` : ''}`] : null,
    kind === 'attribute' && member.name !== 'preset' && type ? [word('type'), attributeType(member)] : null,
    kind === 'attribute' ? [word('default'), defaultText(member)] : null,
    spec && spec.kind !== 'choice' ? [word('range'), range(spec)] : null,
    property ? [word('property'), `<code>${property.name}</code>: ${typeOf(property.type.text)}`] : null,
    spec ? [word('key'), `<code>${spec.url}</code>`] : null,
  ].flatMap((fact) => (fact?.[1] ? [fact] : []));
  if (list.length === 0) return '';
  return `<dl class="facts">${list.map(([term, text]) => `<div><dt>${term}</dt><dd>${text}</dd></div>`).join('')}</dl>`;
}

function methodType({ parameters = [], return: result }) {
  const given = parameters.map(
    ({ name, type, default: fallback }) =>
      `${name.startsWith('{') ? 'options' : name}${fallback ? '?' : ''}: ${type?.text ?? typeof JSON.parse(fallback)}`,
  );
  return `(${given.join(', ')}) => ${result.type.text}`;
}

/** A type, with links to those that are described. */
function typeOf(text) {
  return `<code>${escaped(text).replace(/\b[A-Z]\w+\b/g, (name) => (LINKED.has(name) ? `<a href="types.html#${name}">${name}</a>` : name))}</code>`;
}

function attributeType({ type, spec }) {
  if (spec?.scope !== 'layer') return typeOf(type.text.replaceAll("'", '').replaceAll(' | ', ', ')).replaceAll(', ', '</code>, <code>');
  return word('perLayer');
}

function defaultText({ default: fallback, name, spec }) {
  if (fallback !== undefined) return `<code>${fallback}</code>`;
  return spec || name === 'color' ? 'the preset’s' : '';
}

function range({ min, max, unit, relative }) {
  const [low, high] = [min, max].map((value) => String(value).replace('-', '−'));
  const text = `${low} … ${high}${unit.px ? ` ${unit.px}` : ''}`;
  if (!relative) return text;
  return `${text}; ${inline(word('relative', { range: `${String(relative.min).replace('-', '−')} … ${relative.max} ${unit.relative}` }))}`;
}

/** All of it in tables, for those who look something up. */
export async function overview(all, pages) {
  const fileOf = (kind) => pages.find(({ kinds }) => kinds?.includes(kind)).file;
  const html = Object.entries(groupedByKind(all)).map(([kind, list]) => {
    const rows = list.map((member) => {
      const also = member.property
        ? ` <span class="quiet">${word('property').toLowerCase()} <code>${member.property.name}</code></span>`
        : '';
      return `<tr><th scope="row"><a href="${fileOf(kind)}#${member.id}"><code>${escaped(signature(member))}</code></a>${also}</th><td>${inline(closed(member.description ? ownWords(member) : member.note.split('\n')[0]))}</td></tr>`;
    });
    const title = `${word(kind)}s`.replace(/ys$/, 'ies');
    return {
      id: kind,
      title,
      html: `${heading(2, kind, title, title)}<div class="table" tabindex="0" role="group" aria-label="${title}"><table>${rows.join('')}</table></div>`,
    };
  });
  return { html: html.map((part) => part.html).join('\n'), contents: html.map(({ id, title }) => ({ id, name: title })) };
}

function groupedByKind(all) {
  const groups = {};
  for (const member of all) {
    groups[member.kind] ??= [];
    groups[member.kind].push(member);
  }
  return groups;
}

/** Everything public of an element, in tables: what it is called, what it takes, what it is. */
export async function elementTables(tag) {
  const declaration = needed(
    (await manifest()).modules.flatMap(({ declarations }) => declarations).find(({ tagName }) => tagName === tag),
    `<${tag}> in the manifest`,
  );
  const paired = new Set(declaration.attributes.map(({ fieldName }) => fieldName));
  const ofKind = (kind) => declaration.members.filter((member) => member.kind === kind);
  const methods = ofKind('method').map(({ return: returned, ...member }) => ({
    ...member,
    name: signature({ ...member, kind: 'method' }),
    type: returned?.type,
  }));
  const parts = [
    ['attribute', 'Attributes', declaration.attributes],
    ['property', 'Properties without an attribute', ofKind('field').filter(({ name }) => !paired.has(name))],
    ['method', 'Methods', methods],
    ['event', 'Events', declaration.events],
    ['part', 'CSS parts', declaration.cssParts],
  ];
  const html = parts.map(([kind, title, list]) => {
    const rows = list.map(({ name, type, default: fallback, description = '' }) => {
      const taken = [
        type && `<code>${escaped(type.text)}</code>`,
        fallback && `${word('default').toLowerCase()} <code>${escaped(fallback)}</code>`,
      ]
        .filter(Boolean)
        .join(', ');
      return `<tr><th scope="row"><code>${escaped(name)}</code>${taken && ` <span class="quiet">${taken}</span>`}</th><td>${description && inline(closed(description))}</td></tr>`;
    });
    return `${heading(2, `${tag}-${kind}`, title, title)}<div class="table" tabindex="0" role="group" aria-label="${title}"><table>${rows.join('')}</table></div>`;
  });
  return { html: html.join('\n'), contents: parts.map(([kind, title]) => ({ id: `${tag}-${kind}`, name: title })) };
}

/** Every preset, live, with its link and its line. */
export async function gallery() {
  const columns = LAYER_ROWS.filter(({ kind }) => kind !== 'optional-integer').map(({ label }) => label.split(' ').at(-1));
  const groups = [
    { id: 'natural', name: 'Natural grounds', has: ({ natural }) => natural, label: (preset) => presetName('en', preset) },
    ...PAPERS.map((paper) => ({
      id: paper,
      name: translate('en', paper),
      has: ({ name }) => name.startsWith(paper),
      label: (preset) => presetLabel('en', preset, columns).replace(/_(\w+)/g, '<sub>$1</sub>'),
    })),
  ];
  const html = groups.map(({ id, name, has, label: labelOf }) => {
    const figures = PRESETS.filter(has).map((preset) => {
      const label = labelOf(preset);
      const link = encodeLink({ params: presetParams(preset.name), preset: preset.name });
      const line = `<rock-field preset="${preset.name}"></rock-field>`;
      return `<figure class="preset" id="${preset.name}"><div class="stage"><rock-field preset="${preset.name}" loading="lazy"></rock-field></div>
<figcaption><strong><code>${preset.name}</code></strong> <span>${label}</span>
<pre tabindex="0"><code>${escaped(line)}</code></pre>
<span class="preset-links"><a href="../#${escaped(link)}">${word('open')}</a></span></figcaption></figure>`;
    });
    return `${heading(2, id, name, name)}<div class="gallery">${figures.join('\n')}</div>`;
  });
  return { html: html.join('\n'), contents: groups };
}

/** The types as the sources have them, comments and all. */
export async function types() {
  const found = new Map();
  for (const file of TYPE_SOURCES) {
    const text = readFileSync(path.join(root, file), 'utf8');
    const source = ts.createSourceFile(file, text, ts.ScriptTarget.ES2022, true);
    for (const statement of source.statements) {
      const { name } = /** @type {{ name?: { text: string } }} */ (statement);
      if (!name || !LINKED.has(name.text)) continue;
      found.set(name.text, text.slice(statement.getStart(source, true), statement.end).replace(/^export /m, ''));
    }
  }
  // Written out: in the source it is the keys of a list.
  found.set(
    'ErrorName',
    `/** Every name of an error; see Troubleshooting. */\ntype ErrorName =\n${Object.keys(ERRORS)
      .map((name) => `  | '${name}'`)
      .join('\n')};`,
  );
  const missing = [...LINKED].filter((name) => !found.has(name));
  if (missing.length > 0) throw new Error(`scripts/docs/reference.mjs shows types that are not in its sources: ${missing.join(', ')}`);
  const html = TYPES.map(
    ({ name, types: names }) =>
      `<h2 class="group">${name}</h2>${names.map((type) => `${heading(3, type, `<code>${type}</code>`, type)}${codeBlock(found.get(type), 'ts')}`).join('')}`,
  );
  const contents = TYPES.flatMap(({ name, types: names }) => [{ name }, ...names.map((type) => ({ id: type, name: type, isCode: true }))]);
  return { html: html.join('\n'), contents };
}
