// dist/custom-elements.json: what editors, Storybook and documentation read about the elements, from the sources' JSDoc.
import { readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { create, ts } from '@custom-elements-manifest/analyzer';
import { dist, root } from './env.mjs';
import { Failure } from './run.mjs';

const REGISTERS = 'www/rock-field.ts';
const CLASSES = ['www/rock-field-element.ts', 'www/scene-element.ts'];

/** Said about every element by the platform, not by this package. */
const LIFECYCLE = ['connectedCallback', 'disconnectedCallback', 'attributeChangedCallback', 'observedAttributes'];

export function writeManifest() {
  const sources = [REGISTERS, ...CLASSES].map((file) => ts.createSourceFile(file, readFileSync(path.join(root, file), 'utf8'), ts.ScriptTarget.ES2022, true));
  const { modules } = create({ modules: sources, plugins: [], context: { dev: false } });
  const definitions = modules.flatMap(({ exports }) => exports).filter(({ kind }) => kind === 'custom-element-definition');
  if (definitions.length === 0) throw new Failure(`${REGISTERS} registers no element that the analyzer can see`);
  const declarations = definitions.map(({ name, declaration }) => publicPart(name, modules.flatMap((module) => module.declarations).find((found) => found.name === declaration.name)));
  const inPackage = (name) => ({ name, module: 'dist/element.js' });
  const manifest = {
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
  writeFileSync(path.join(dist, 'custom-elements.json'), `${JSON.stringify(manifest, null, 2)}\n`);
}

/** A class as its users see it: the bundle has no modules to inherit from, and what is not public is nobody's. */
function publicPart(tagName, declaration) {
  const members = declaration.members
    .filter(({ name, privacy }) => privacy !== 'private' && privacy !== 'protected' && !LIFECYCLE.includes(name))
    .map(withoutOrigin);
  return {
    kind: 'class',
    customElement: true,
    name: declaration.name,
    tagName,
    description: declaration.description,
    superclass: { name: 'HTMLElement' },
    attributes: declaration.attributes?.map(withoutOrigin),
    members,
    // The analyzer also finds the one place that dispatches them all, and takes the name of its argument for an event.
    events: declaration.events?.filter(({ name, type }) => name !== 'type' || !type).map(withoutOrigin),
    slots: declaration.slots?.map(withoutOrigin),
    cssParts: declaration.cssParts?.map(withoutOrigin),
    cssProperties: declaration.cssProperties?.map(withoutOrigin),
  };
}

function withoutOrigin({ inheritedFrom, ...rest }) {
  return rest;
}
