// What the documentation says about each public member of the element: its entry in the manifest, and its example in www/docs/examples/.
import { readFileSync, readdirSync } from 'node:fs';
import path from 'node:path';
import { root } from '../lib/env.mjs';
import { manifest } from '../package/manifest.mjs';
import { Failure, needed } from '../lib/run.mjs';
import { tables } from '../lib/tables.mjs';

const EXAMPLES = path.join(root, 'www', 'docs', 'examples');
const TAG = 'rock-field';

/** One example of a file: a comment that names its subject, perhaps with a note in Markdown, and the HTML up to the next one. */
const EXAMPLE = /^<!-- (attribute|property|method|event|slot|part|css-property) (\S+)\s([\s\S]*?)-->\n([\s\S]*?)(?=^<!-- |(?![\s\S]))/gm;

/** Lists of the manifest → kinds of members. */
const LISTS = {
  attributes: 'attribute',
  members: 'member',
  events: 'event',
  slots: 'slot',
  cssParts: 'part',
  cssProperties: 'css-property',
};

/**
 * Every public member, in the manifest's order: `{ kind, name, id, description, type, note, example, property, spec }`. A property that has an
 * attribute stands with it, as its `property`. One without an example has an empty one: the build goes on, and a test fails.
 */
export async function members() {
  const examples = readExamples();
  return Promise.all(
    (await publicMembers()).map(async (member) => {
      const { note = '', html = '' } = examples.get(member.id) ?? (member.spec ? await parameterExample(member.spec) : {});
      return { ...member, note, example: html };
    }),
  );
}

/** What is wrong between members and examples, a sentence each. `ids` are those of the examples that were written. */
export function problems(found, ids = [...readExamples().keys()]) {
  const known = new Set(found.map(({ id }) => id));
  return [
    ...found.filter(({ example }) => !example).map(({ kind, name }) => `the ${kind} ${name} has no example`),
    ...found
      .filter((member) => member.example && !isShown(member))
      .map(({ kind, name }) => `the example of the ${kind} ${name} does not show it`),
    ...found
      .filter(({ example, property }) => property && example && !new RegExp(`\\.${property.name}\\b|{ ${property.name}:`).test(example))
      .map(({ name, property }) => `the example of ${name} does not show its property ${property.name}`),
    ...found.filter(({ description, note }) => !description && !note).map(({ kind, name }) => `nothing says what the ${kind} ${name} is`),
    ...ids.filter((id) => !known.has(id)).map((id) => `the example ${id} is about nothing that there is`),
  ];
}

/** The members of the manifest, without examples. */
export async function publicMembers() {
  const { PARAM_DOCS, PARAMS, attributeOf } = await tables();
  const declaration = needed(
    (await manifest()).modules[0].declarations.find(({ tagName }) => tagName === TAG),
    `<${TAG}> in the manifest`,
  );
  const properties = new Map(declaration.members.filter(({ kind }) => kind === 'field').map((member) => [member.name, member]));
  const paired = new Set(declaration.attributes.map(({ fieldName }) => fieldName));
  const specs = new Map(PARAMS.map((spec) => [attributeOf(spec), spec]));
  return Object.entries(LISTS).flatMap(([list, listed]) =>
    declaration[list].flatMap((entry) => {
      const kind = listed === 'member' ? { field: 'property', method: 'method' }[entry.kind] : listed;
      if (kind === 'property' && paired.has(entry.name)) return [];
      const isAttribute = kind === 'attribute';
      return [
        {
          ...entry,
          kind,
          id: idOf(kind, entry.name),
          property: isAttribute ? properties.get(entry.fieldName) : undefined,
          spec: isAttribute ? specs.get(entry.name) : undefined,
          doc: isAttribute ? PARAM_DOCS[specs.get(entry.name)?.url]?.en : undefined,
        },
      ];
    }),
  );
}

/** `attribute-image-width`, `css-property-rock-field-accent`. */
function idOf(kind, name) {
  return `${kind}-${name.replace(/^--/, '')}`;
}

/** By the id of what they are about: `{ note, html }`. */
function readExamples() {
  const found = new Map();
  for (const file of readdirSync(EXAMPLES)
    .filter((name) => name.endsWith('.html'))
    .sort()) {
    const text = readFileSync(path.join(EXAMPLES, file), 'utf8').replaceAll('\r\n', '\n');
    let read = 0;
    for (const [whole, kind, name, note, html] of text.matchAll(EXAMPLE)) {
      const id = idOf(kind, name);
      if (found.has(id)) throw new Failure(`${file} has a second example for the ${kind} ${name}`);
      found.set(id, { note: note.trim(), html: html.trim() });
      read += whole.length;
    }
    if (read !== text.length) throw new Failure(`${file}: between its examples stands something that is none`);
  }
  return found;
}

/** Whether an example has to do with its subject at all. */
function isShown({ kind, name, example }) {
  const expected = {
    attribute: new RegExp(`<rock-field[^>]*\\s${name}[\\s=>]`),
    property: new RegExp(`\\.${name}\\b|\\b${name}\\b[^{}]*} = field`),
    method: new RegExp(`\\.${name}\\(`),
    event: new RegExp(`'${name}'`),
    slot: new RegExp(`slot="${name}"`),
    part: new RegExp(`::part\\(${name}\\)`),
    'css-property': new RegExp(name),
  };
  return expected[kind].test(example);
}

// The examples of parameters: the attribute in the markup, the property behind a slider or a choice.

async function parameterExample(spec) {
  return { html: spec.kind === 'choice' ? await choiceExample(spec) : await numberExample(spec) };
}

async function choiceExample(spec) {
  const { attributeOf, presetParams, propertyOf } = await tables();
  const preset = presetOf(spec);
  const isList = spec.scope === 'layer';
  const name = propertyOf(spec);
  // What is not the default is what there is to see.
  const [first, ...rest] = [...spec.choices].reverse();
  const options = [first, ...rest].map(({ value }) => `  <option>${value}</option>`).join('\n');
  const words = isList
    ? presetParams(preset)
        .layers.map(() => first.value)
        .join(' ')
    : first.value;
  return `<rock-field ${attributesFor(preset)}${attributeOf(spec)}="${words}"></rock-field>
<select aria-label="${spec.label}">
${options}
</select>

<script type="module">
  const field = document.querySelector('rock-field');
  document.querySelector('select').onchange = ({ target }) => {
    field.${name} = ${isList ? `field.${name}.map(() => target.value)` : 'target.value'};
  };
</script>`;
}

/** Lists get the preset's values, so that the example has its layers. */
async function numberExample(spec) {
  const { attributeOf, boundsOf, presetParams, propertyOf, readValue } = await tables();
  const preset = presetOf(spec);
  const params = presetParams(preset);
  const isList = spec.scope === 'layer';
  const { min, max } = boundsOf(spec, 'px').slider;
  const values = isList ? params.layers.map((layer) => shown(spec, readValue(layer, spec))) : [shown(spec, readValue(params, spec))];
  const name = propertyOf(spec);
  const assignment = isList
    ? `const [, ...others] = field.${name};\n    field.${name} = [target.valueAsNumber, ...others];`
    : `field.${name} = target.valueAsNumber;`;
  const range = { min: SLIDER_MIN[name] ?? min, max: SLIDER_MAX[name] ?? max, step: SLIDER_STEP[name] ?? spec.step };
  return `<rock-field ${attributesFor(preset)}${attributeOf(spec)}="${values.join(' ')}"></rock-field>
<label>
  ${label(spec)}
  <input type="range" min="${range.min}" max="${range.max}" step="${range.step}" value="${values[0]}">
</label>

<script type="module">
  const field = document.querySelector('rock-field');
  document.querySelector('input').oninput = ({ target }) => {
    ${assignment}
  };
</script>`;
}

/** Of what no paper has there is nothing to see in the default preset. */
function presetOf({ stage, component, scope }) {
  const isNatural = stage === 'look' || (scope === 'layer' && stage === 'mesh' && component === null);
  return isNatural ? 'forest-floor' : 'journal-fig1';
}

function attributesFor(preset) {
  return preset === 'journal-fig1' ? '' : `preset="${preset}" `;
}

/** An example is no place for 8192 px, or for a slider whose one half shows nothing. */
const SLIDER_MIN = { imageWidth: 128, imageHeight: 128 };
const SLIDER_MAX = { imageWidth: 2048, imageHeight: 2048, radius: 200, cellCount: 100 };
const SLIDER_STEP = { radius: 1 };

function shown(spec, value) {
  return spec.key in SLIDER_MIN ? 700 : (value ?? 20);
}

function label(spec) {
  const [words] = spec.label.split(/ (?=[a-zA-Z]_|r$)/);
  return spec.scope === 'layer' ? `${words} of the first layer` : words;
}
