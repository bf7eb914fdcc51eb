// dist/custom-elements.json: what editors, Storybook and documentation read about the elements. From the sources' JSDoc, their types and the parameter table.
import { readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { create, ts } from '@custom-elements-manifest/analyzer';
import { dist, root } from '../lib/env.mjs';
import { GENERATORS, camelCase, entryFile } from '../lib/generators.mjs';
import { Failure } from '../lib/run.mjs';
import { tables } from '../lib/tables.mjs';

/** The classes that every element inherits from, in the order in which their members are told after the element's own. */
const SHARED = [
  'www/element/params-element.ts',
  'www/element/attributes-element.ts',
  'www/element/generator-element.ts',
  'www/scene/drawn-element.ts',
  'www/scene/scene-element.ts',
  'www/scene/stage-element.ts',
];
/** Each with the files that register it and that it is written in, where the package has its class, and where the types of its kind stand. */
const ELEMENTS = GENERATORS.map(({ name, tag, classEntry, table, paramDocs, hasItemAttributes }) => ({
  registers: entryFile(tag),
  written: `www/${name}/element.ts`,
  inModule: `dist/${classEntry}.js`,
  kind: `www/${name}/table.ts`,
  table,
  paramDocs,
  hasItemAttributes,
}));
/** Where the types of members are written out. */
const TYPES = [...ELEMENTS.map(({ written }) => written), ...SHARED, 'www/base/view.ts'];

/** Said about every element by the platform, not by this package. */
const LIFECYCLE = ['connectedCallback', 'disconnectedCallback', 'attributeChangedCallback', 'observedAttributes'];

export async function writeManifest() {
  writeFileSync(path.join(dist, 'custom-elements.json'), `${JSON.stringify(await manifest(), null, 2)}\n`);
}

export async function manifest() {
  return { schemaVersion: '1.0.0', modules: (await Promise.all(ELEMENTS.map(modulesOf))).flat() };
}

async function modulesOf(element) {
  const { registers, written, inModule } = element;
  const { modules } = create({ modules: [registers, written, ...SHARED].map(parse), plugins: [], context: { dev: false } });
  const definitions = modules.flatMap(({ exports }) => exports ?? []).filter(({ kind }) => kind === 'custom-element-definition');
  if (definitions.length === 0) throw new Failure(`${registers} registers no element that the analyzer can see`);
  const known = await knowledge(element);
  const declarations = definitions.map(({ name, declaration }) =>
    publicPart(
      name,
      modules.flatMap((module) => module.declarations).find((found) => found?.name === declaration.name),
      known,
    ),
  );
  const inPackage = (name) => ({ name, module: inModule });
  const classes = { declarations, exports: declarations.map(({ name }) => ({ kind: 'js', name, declaration: inPackage(name) })) };
  const registered = definitions.map(({ name, declaration }) => ({
    kind: 'custom-element-definition',
    name,
    declaration: inPackage(declaration.name),
  }));
  const registering = `dist/${path.basename(registers, '.ts')}.js`;
  if (registering === inModule)
    return [{ kind: 'javascript-module', path: inModule, ...classes, exports: [...classes.exports, ...registered] }];
  return [
    { kind: 'javascript-module', path: inModule, ...classes },
    { kind: 'javascript-module', path: registering, declarations: [], exports: registered },
  ];
}

function parse(file) {
  return ts.createSourceFile(file, readFileSync(path.join(root, file), 'utf8'), ts.ScriptTarget.ES2022, true);
}

/** A class as its users see it: the bundle has no modules to inherit from, and what is not public is nobody's. */
function publicPart(tagName, declaration, { attributeTypes, aliases, events, parameters, ofKind }) {
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
    .sort((one, other) => layerOf(one) - layerOf(other))
    .map((member) => ({ ...saidByAttribute.get(member.name), ...spelledOut(withoutOrigin(member), aliases, ofKind) }));
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
    events: declaration.events
      ?.filter(({ name, type }) => name !== 'type' || !type)
      .map((event) => ({ ...withoutOrigin(event), type: { text: ofKind(events.get(event.name) ?? 'CustomEvent') } })),
    slots: declaration.slots?.map(withoutOrigin),
    cssParts: declaration.cssParts?.map(withoutOrigin),
    cssProperties: declaration.cssProperties?.map(withoutOrigin),
  };
}

/** Where in SHARED a member comes from; -1 if it is the element's own. */
function layerOf({ inheritedFrom }) {
  return SHARED.indexOf(inheritedFrom?.module);
}

function withoutOrigin({ inheritedFrom, ...rest }) {
  return rest;
}

/** A member whose type is a list of words says the words; the types of a kind are those of this one. */
function spelledOut(member, aliases, ofKind) {
  const spelled = (type) => ({ text: ofKind(type.text).replace(/\b[A-Z]\w+\b/g, (name) => aliases.get(name) ?? name) });
  if (member.kind === 'method')
    return { ...member, ...(member.return?.type && { return: { ...member.return, type: { text: ofKind(member.return.type.text) } } }) };
  return member.type ? { ...member, type: spelled(member.type) } : member;
}

// What JSDoc does not say, because the sources say it already.

async function knowledge({ written, kind, table, paramDocs, hasItemAttributes }) {
  const known = await tables();
  const { FOV, INTERACTIONS, LOADINGS, METRES_PER_PIXEL, NAVIGATIONS, QUALITY_CHOICES, REST_SAMPLES } = known;
  for (const name of [table, paramDocs]) if (!known[name]) throw new Failure(`no module of scripts/lib/tables.mjs exports ${name}`);
  const { colors, itemRows, presets, rows, views } = known[table];
  const oneOf = (words) => ({ type: { text: union(words) }, default: words[0] });
  const sources = TYPES.map(parse);
  const aliases = literalUnions(sources);
  const backends = aliases.get('Backend');
  // Layers are attributes and properties too; bases stand in a list of their own.
  const own = hasItemAttributes ? [...rows, ...itemRows] : rows;
  return {
    attributeTypes: {
      preset: oneOf(presets.map(({ name }) => name)),
      view: oneOf(views),
      color: { type: { text: union(colors) } },
      quality: oneOf(QUALITY_CHOICES),
      samples: { type: { text: 'number' }, default: String(REST_SAMPLES) },
      interaction: oneOf(INTERACTIONS),
      navigation: oneOf(NAVIGATIONS),
      loading: oneOf(LOADINGS),
      backend: { type: { text: `'auto' | ${backends}` }, default: 'auto' },
      'metres-per-pixel': { type: { text: 'number' }, default: String(METRES_PER_PIXEL) },
      fov: { type: { text: 'number' }, default: String(FOV) },
      'auto-rotate': { type: { text: 'boolean' }, default: 'false' },
      disabled: { type: { text: 'boolean' }, default: 'false' },
      editable: { type: { text: 'boolean' }, default: 'false' },
      'camera-orbit': { type: { text: 'string' } },
      poster: { type: { text: 'string' } },
      src: { type: { text: 'string' } },
    },
    aliases: new Map([
      ...aliases,
      ['View', union(views)],
      ['ColorMode', union(colors)],
      ['WantedQuality', union(QUALITY_CHOICES)],
      ['Interaction', union(INTERACTIONS)],
      ['Navigation', union(NAVIGATIONS)],
    ]),
    events: eventTypes([parse(written), ...SHARED.map(parse)]),
    parameters: own.map((row) => parameter(row, known, known[paramDocs][row.url].en)),
    ofKind: typesOf(parse(kind)),
  };
}

/** `K['params']` → `Params`, as the interface of the kind says; the stage of an event map is its own name. */
function typesOf(source) {
  const kind = source.statements.find(
    (statement) =>
      statement.kind === ts.SyntaxKind.InterfaceDeclaration &&
      statement.heritageClauses?.some((clause) => /\bKind\b/.test(clause.getText(source))),
  );
  const types = new Map(kind.members.map((member) => [member.name.text, member.type.getText(source)]));
  return (text) => text.replace(/K\['(\w+)'\]/g, (_, name) => types.get(name)).replace(/\bStage\b/g, types.get('stage'));
}

/** A row of a parameter table, as an attribute and as a property. */
function parameter(spec, { attributeOf, defaultOf, propertyOf }, doc) {
  const isList = spec.scope === 'layer';
  const type =
    spec.kind === 'choice' ? union(spec.choices.map(({ value }) => value)) : spec.kind.startsWith('optional') ? 'number | null' : 'number';
  const fallback = defaultOf(spec, 'px');
  const unit = spec.unit.px ? ` ${spec.unit.px}` : '';
  const range = spec.kind === 'choice' ? '' : ` From ${spec.min} to ${spec.max}${unit}.`;
  const description = `${doc}${range}`;
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
      if (kind === ts.SyntaxKind.TypeAliasDeclaration && type.types?.every((part) => part.kind === ts.SyntaxKind.LiteralType))
        found.set(name.text, type.getText(source));
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
