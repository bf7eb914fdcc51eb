// The documentation and the manifest: what is public is documented, each with an example, and nothing else is.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { members, problems } from '../../scripts/docs/members.mjs';
import { manifest } from '../../scripts/package/manifest.mjs';
import { propertyOf } from '../../www/element/attribute-reader.ts';
import { ATTRIBUTES, FIELD_ATTRIBUTES, LAYER_ATTRIBUTES } from '../../www/rocks/attributes.ts';
import { PARAM_DOCS } from '../../www/rocks/param-docs.gen.ts';

const found = await members();

test('every public member has an example that shows it, and every example is about a public member', () => {
  assert.deepEqual(problems(found), []);
});

test('a member without an example is noticed, and an example of something that is gone', () => {
  const without = found.map((member) => (member.id === 'method-generate' ? { ...member, example: '' } : member));
  assert.deepEqual(problems(without, []), ['the method generate has no example']);
  const swapped = found.map((member) => (member.id === 'event-load' ? { ...member, example: '<rock-field></rock-field>' } : member));
  assert.deepEqual(problems(swapped, []), ['the example of the event load does not show it']);
  assert.deepEqual(problems(found, ['slot-yore']), ['the example slot-yore is about nothing that there is']);
});

test('the manifest lists every attribute, and the parameters as attributes and as properties', async () => {
  const [
    {
      declarations: [declaration],
    },
  ] = (await manifest()).modules;
  const attributes = declaration.attributes.map(({ name }) => name);
  assert.deepEqual(
    ATTRIBUTES.filter((name) => !attributes.includes(name)),
    [],
  );
  assert.equal(new Set(attributes).size, attributes.length);
  const properties = new Map(declaration.members.map((member) => [member.name, member]));
  for (const [name, spec] of [...FIELD_ATTRIBUTES, ...LAYER_ATTRIBUTES]) {
    const attribute = declaration.attributes.find((candidate) => candidate.name === name);
    assert.equal(attribute.fieldName, propertyOf(spec));
    assert.equal(properties.get(attribute.fieldName)?.attribute, name);
    assert.ok(attribute.description.startsWith(PARAM_DOCS[spec.url].en), name);
  }
});
