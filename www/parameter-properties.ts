/** A property for every row of the parameter table: `element.packing = 0.5`, `element.radius = [90, 30, 10]`. */

import { attributeOf, propertyOf } from './element-attributes.ts';
import { RockFieldError } from './errors.ts';
import type { Layer, Params, ParamSpec, Triple } from './params.ts';
import { defaultLayer, FIELD_ROWS, LAYER_ROWS, readValue, resolveParams, writeValue } from './params-flat.ts';
import { writeAttribute } from './reflected-properties.ts';

type LayerKey = Exclude<keyof Layer, 'id'>;

/** The layers' values of one parameter as a list, whose length is the number of layers; of a triple, one list for each part. */
type LayerProperties = {
  [Key in LayerKey as Layer[Key] extends Triple ? `${Key}${'Base' | 'Rock' | 'Vertex'}` : Key]: (Layer[Key] extends Triple ? number : Layer[Key])[];
};

export type ParameterProperties = Omit<Params, 'layers'> & LayerProperties;

const ROWS: readonly ParamSpec[] = [...FIELD_ROWS, ...LAYER_ROWS];

export const PARAMETER_PROPERTIES: readonly string[] = ROWS.map(propertyOf);

type Owner = HTMLElement & { params: Params };

/**
 * What was assigned to single properties of an element. Like its attributes these replace what the preset says, whichever came
 * first: a framework sets attributes and properties in the order of its template, and afterwards only those that changed.
 */
const assigned = new WeakMap<HTMLElement, Map<ParamSpec, unknown>>();

/** Makes the accessors, each in terms of `params`. */
export function defineParameterProperties(prototype: Owner): void {
  for (const spec of ROWS) {
    Object.defineProperty(prototype, propertyOf(spec), {
      configurable: true,
      enumerable: true,
      get(this: Owner): unknown {
        const { params } = this;
        return spec.scope === 'field' ? readValue(params, spec) : params.layers.map((layer) => readValue(layer, spec));
      },
      set(this: Owner, value: unknown) {
        // Frameworks assign what a template has as text, and nothing where it has it no longer.
        if (isAttribute(spec, value)) {
          const name = attributeOf(spec);
          // So that it counts as changed also where it says this, or nothing, already: something else was assigned in between.
          this.setAttribute(name, '');
          writeAttribute(this, name, value);
          return;
        }
        const others = [...(assigned.get(this) ?? [])].filter(([other]) => other !== spec);
        this.params = replaced(this.params, spec, value);
        assigned.set(this, new Map([...others, [spec, structuredClone(value)]]));
      },
    });
  }
}

/** `params` with what was assigned to single properties. */
export function withAssigned(element: HTMLElement, params: Params): Params {
  const values = [...(assigned.get(element) ?? [])];
  if (values.length === 0) return params;
  return resolveParams(values.reduce((result, [spec, value]) => replaced(result, spec, value), params));
}

/** What was assigned to single properties counts no more; with `attributes`, to those of whose attribute that is said. */
export function forgetAssigned(element: HTMLElement, attributes?: ReadonlySet<string>): void {
  const values = assigned.get(element);
  if (!attributes) values?.clear();
  else for (const spec of [...(values?.keys() ?? [])]) if (attributes.has(attributeOf(spec))) values?.delete(spec);
}

function isAttribute(spec: ParamSpec, value: unknown): value is string | null | undefined {
  return value === null || value === undefined || (typeof value === 'string' && (spec.scope === 'layer' || spec.kind !== 'choice'));
}

function replaced(params: Params, spec: ParamSpec, value: unknown): Params {
  return spec.scope === 'field' ? { ...params, [spec.key]: value } : { ...params, layers: withList(params, spec, value) };
}

/** `random` with the values of `old` for the properties named in `lock`. */
export function keepLocked(random: Params, old: Params, lock: readonly string[]): Params {
  const kept = structuredClone(random);
  if (lock.includes('layers')) kept.layers = old.layers;
  for (const spec of ROWS.filter((candidate) => lock.includes(propertyOf(candidate)))) {
    if (spec.scope === 'field') writeValue(kept, spec, readValue(old, spec));
    // Values of layers can only be kept with as many layers.
    else kept.layers = old.layers.map((layer, index) => withValue(kept.layers[index] ?? layer, spec, readValue(layer, spec)));
  }
  return kept;
}

function withList({ layers: old, notation }: Params, spec: ParamSpec, values: unknown): Layer[] {
  if (!Array.isArray(values)) {
    const name = propertyOf(spec);
    throw new RockFieldError({ name: 'WrongType', key: name, value: values, message: `${name} has to be a list with a value for each layer` });
  }
  // Not an id that another layer has, or had.
  const unused = 1 + Math.max(-1, ...old.map(({ id }) => id));
  return values.map((value: unknown, index) => withValue(old[index] ?? defaultLayer(unused + index - old.length, notation), spec, value));
}

function withValue(layer: Layer, spec: ParamSpec, value: unknown): Layer {
  const copy = structuredClone(layer);
  writeValue(copy, spec, value);
  return copy;
}
