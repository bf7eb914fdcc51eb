// dist/custom-elements.json: what editors, Storybook and documentation read about the elements. From the sources' JSDoc, their types and the parameter table.
import { readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { create, ts } from '@custom-elements-manifest/analyzer';
import { dist, root } from './env.mjs';
import { Failure } from './run.mjs';
import { tables } from './tables.mjs';

const REGISTERS = 'www/rock-field.ts';
const CLASSES = ['www/rock-field-element.ts', 'www/generator-element.ts', 'www/scene-element.ts'];
/** The types of each generator, for what its element inherits. */
const KINDS = 'www/rocks.ts';
/** Where the types of members are written out. */
const TYPES = [...CLASSES, 'www/renderer/renderer.ts'];

/** Said about every element by the platform, not by this package. */
const LIFECYCLE = ['connectedCallback', 'disconnectedCallback', 'attributeChangedCallback', 'observedAttributes'];

export async function writeManifest() {
  writeFileSync(path.join(dist, 'custom-elements.json'), `${JSON.stringify(await manifest(), null, 2)}\n`);
}

export async function manifest() {
  const sources = [REGISTERS, ...CLASSES].map(parse);
  const { modules } = create({ modules: sources, plugins: [], context: { dev: false } });
  const definitions = modules.flatMap(({ exports }) => exports).filter(({ kind }) => kind === 'custom-element-definition');
  if (definitions.length === 0) throw new Failure(`${REGISTERS} registers no element that the analyzer can see`);
  const known = await knowledge();
  const declarations = definitions.map(({ name, declaration }) => publicPart(name, modules.flatMap((module) => module.declarations).find((found) => found.name === declaration.name), known));
  const inPackage = (name) => ({ name, module: 'dist/element.js' });
  return {
    schemaVersion: '1.0.0',
    modules: [
      {
        kind: 'javascript-module',
        path: 'dist/element.js',
        declarations,
        exports: declarations.map(({ name }) => ({ kind: 'js', name, declaration: inPackage(name) })),
      },
      {
        kind: 'javascript-module',
        path: 'dist/rock-field.js',
        declarations: [],
        exports: definitions.map(({ name, declaration }) => ({ kind: 'custom-element-definition', name, declaration: inPackage(declaration.name) })),
      },
    ],
  };
}

function parse(file) {
  return ts.createSourceFile(file, readFileSync(path.join(root, file), 'utf8'), ts.ScriptTarget.ES2022, true);
}

/** A class as its users see it: the bundle has no modules to inherit from, and what is not public is nobody's. */
function publicPart(tagName, declaration, { attributeTypes, aliases, events, parameters }) {
  const settable = new Set(declaration.members.filter(({ readonly }) => !readonly).map(({ name }) => name));
  const attributes = declaration.attributes
    .filter(({ name }) => parameters.every((parameter) => parameter.attribute.name !== name))
    .map((attribute) => {
      const fieldName = camelCase(attribute.name);
      return { ...withoutOrigin(attribute), ...attributeTypes[attribute.name], ...(settable.has(fieldName) && { fieldName }) };
    });
  // A property that says nothing of its own is what its attribute is.
  const saidByAttribute = new Map(attributes.map(({ name, fieldName, description }) => [fieldName, { attribute: name, description }]));
  const members = declaration.members
    .filter(({ name, privacy }) => privacy !== 'private' && privacy !== 'protected' && !LIFECYCLE.includes(name))
    .map((member) => ({ ...saidByAttribute.get(member.name), ...spelledOut(withoutOrigin(member), aliases) }));
  return {
    kind: 'class',
    customElement: true,
    name: declaration.name,
    tagName,
    description: declaration.description,
    superclass: { name: 'HTMLElement' },
    attributes: [...attributes, ...parameters.map(({ attribute }) => attribute)],
    members: [...members, ...parameters.map(({ property }) => property)],
    // The analyzer also finds the one place that dispatches them all, and takes the name of its argument for an event.
    events: declaration.events?.filter(({ name, type }) => name !== 'type' || !type).map((event) => ({ ...withoutOrigin(event), type: { text: events.get(event.name) ?? 'CustomEvent' } })),
    slots: declaration.slots?.map(withoutOrigin),
    cssParts: declaration.cssParts?.map(withoutOrigin),
    cssProperties: declaration.cssProperties?.map(withoutOrigin),
  };
}

function withoutOrigin({ inheritedFrom, ...rest }) {
  return rest;
}

/** A member whose type is a list of words says the words. */
function spelledOut(member, aliases) {
  if (member.kind !== 'field' || !member.type) return member;
  return { ...member, type: { text: member.type.text.replace(/\b[A-Z]\w+\b/g, (name) => aliases.get(name) ?? name) } };
}

// What JSDoc does not say, because the sources say it already.

async function knowledge() {
  const { COLORS, INTERACTIONS, LOADINGS, METRES_PER_PIXEL, PARAMS, PRESETS, QUALITY_CHOICES, VIEWS } = await tables();
  const oneOf = (words) => ({ type: { text: union(words) }, default: words[0] });
  const sources = TYPES.map(parse);
  const aliases = literalUnions(sources);
  const backends = aliases.get('Backend');
  return {
    attributeTypes: {
      preset: oneOf(PRESETS.map(({ name }) => name)),
      view: oneOf(VIEWS),
      color: { type: { text: union(COLORS) } },
      quality: oneOf(QUALITY_CHOICES),
      interaction: oneOf(INTERACTIONS),
      loading: oneOf(LOADINGS),
      backend: { type: { text: `'auto' | ${backends}` }, default: 'auto' },
      'metres-per-pixel': { type: { text: 'number' }, default: String(METRES_PER_PIXEL) },
      'auto-rotate': { type: { text: 'boolean' }, default: 'false' },
      disabled: { type: { text: 'boolean' }, default: 'false' },
      'camera-orbit': { type: { text: 'string' } },
      poster: { type: { text: 'string' } },
      src: { type: { text: 'string' } },
    },
    aliases: new Map([...aliases, ['View', union(VIEWS)], ['ColorMode', union(COLORS)], ['WantedQuality', union(QUALITY_CHOICES)], ['Interaction', union(INTERACTIONS)]]),
    events: eventTypes(sources),
    parameters: await Promise.all(PARAMS.map(parameter)),
  };
}

/** A row of the parameter table, as an attribute and as a property. */
async function parameter(spec) {
  const { attributeOf, defaultOf, PARAM_DOCS, propertyOf } = await tables();
  const isList = spec.scope === 'layer';
  const type = spec.kind === 'choice' ? union(spec.choices.map(({ value }) => value)) : spec.kind === 'optional-integer' ? 'number | null' : 'number';
  const fallback = defaultOf(spec, 'px');
  const unit = spec.unit.px ? ` ${spec.unit.px}` : '';
  const range = spec.kind === 'choice' ? '' : ` From ${spec.min} to ${spec.max}${unit}.`;
  const description = `${PARAM_DOCS[spec.url].en}${range}`;
  return {
    attribute: {
      name: attributeOf(spec),
      fieldName: propertyOf(spec),
      type: { text: isList ? 'string' : type },
      ...(!isList && { default: String(fallback) }),
      description: isList ? `${description} A list with a value for each layer.` : description,
    },
    property: {
      kind: 'field',
      name: propertyOf(spec),
      type: { text: isList ? `(${type})[]`.replace('(number)', 'number') : type },
      attribute: attributeOf(spec),
      description: isList ? `${description} One for each layer.` : description,
    },
  };
}

/** `export type Theme = 'auto' | 'light' | 'dark'` → Theme: its words. */
function literalUnions(sources) {
  const found = new Map();
  for (const source of sources) {
    for (const { kind, name, type } of source.statements) {
      if (kind === ts.SyntaxKind.TypeAliasDeclaration && type.types?.every((part) => part.kind === ts.SyntaxKind.LiteralType)) found.set(name.text, type.getText(source));
    }
  }
  return found;
}

/** The members of the event map: name → type. */
function eventTypes(sources) {
  const found = new Map();
  for (const source of sources) {
    for (const { kind, name, members } of source.statements) {
      if (kind !== ts.SyntaxKind.InterfaceDeclaration || !name.text.endsWith('EventMap')) continue;
      for (const member of members) found.set(member.name.text, member.type.getText(source));
    }
  }
  return found;
}

function union(words) {
  return words.map((word) => `'${word}'`).join(' | ');
}

function camelCase(name) {
  return name.replace(/-([a-z])/g, (_, letter) => letter.toUpperCase());
}
