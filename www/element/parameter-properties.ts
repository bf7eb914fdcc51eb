/** A property for every row of a parameter table: `element.packing = 0.5`, `element.radius = [90, 30, 10]`. */

import { attributeOf, propertyOf } from './attribute-reader.ts';
import { RockFieldError } from '../base/errors.ts';
import { isList } from '../table/param-checks.ts';
import { writeAttribute } from './reflected-properties.ts';
import { same } from '../table/table.ts';
import type { Row } from '../table/row.ts';
import type { Kind, Table } from '../table/table.ts';

/** The rows of a table that are properties: of its items each as a list, or none where items are a property themselves. */
export class RowProperties<K extends Kind> {
  readonly names: readonly string[];
  readonly #table: Table<K>;
  readonly #rows: readonly Row[];
  /**
   * What was assigned to single properties of an element. Like its attributes these replace what the preset says, whichever came
   * first: a framework sets attributes and properties in the order of its template, and afterwards only those that changed.
   */
  readonly #assigned = new WeakMap<HTMLElement, Map<Row, unknown>>();

  constructor(table: Table<K>, rows: readonly Row[]) {
    this.#table = table;
    this.#rows = rows;
    this.names = rows.map(propertyOf);
  }

  #isItems(row: Row): boolean {
    return this.#table.itemRows.includes(row);
  }

  /** Makes the accessors, each in terms of `params`. */
  define(prototype: HTMLElement & { params: K['params'] }): void {
    type Owner = typeof prototype;
    const table = this.#table;
    const properties = this;
    for (const row of this.#rows) {
      Object.defineProperty(prototype, propertyOf(row), {
        configurable: true,
        enumerable: true,
        get(this: Owner): unknown {
          const { params } = this;
          return properties.#isItems(row) ? table.items(params).map((item) => table.read(item, row)) : table.read(params, row);
        },
        set(this: Owner, value: unknown) {
          properties.#assign(this, row, value);
        },
      });
    }
  }

  #assign(element: HTMLElement & { params: K['params'] }, row: Row, value: unknown): void {
    // Frameworks assign what a template has as text, and nothing where it has it no longer.
    if (this.#isAttribute(row, value)) {
      const name = attributeOf(row);
      // So that it counts as changed also where it says this, or nothing, already: something else was assigned in between.
      element.setAttribute(name, '');
      writeAttribute(element, name, value);
      return;
    }
    const others = [...(this.#assigned.get(element) ?? [])].filter(([other]) => other !== row);
    element.params = this.#replaced(element.params, row, value);
    this.#assigned.set(element, new Map([...others, [row, structuredClone(value)]]));
  }

  #isAttribute(row: Row, value: unknown): boolean {
    return value === null || value === undefined || (typeof value === 'string' && (this.#isItems(row) || row.kind !== 'choice'));
  }

  /** `params` with what was assigned to single properties. */
  withAssigned(element: HTMLElement, params: K['params']): K['params'] {
    const values = [...(this.#assigned.get(element) ?? [])];
    if (values.length === 0) return params;
    return this.#table.resolve(values.reduce((result, [row, value]) => this.#replaced(result, row, value), params));
  }

  /** What was assigned to single properties counts no more; with `attributes`, to those of whose attribute that is said. */
  forget(element: HTMLElement, attributes?: ReadonlySet<string>): void {
    const values = this.#assigned.get(element);
    if (!attributes) values?.clear();
    else for (const row of [...(values?.keys() ?? [])]) if (attributes.has(attributeOf(row))) values?.delete(row);
  }

  /** What was assigned to single properties counts no more where `params` have another value. */
  keepTrue(element: HTMLElement, params: K['params']): void {
    const values = this.#assigned.get(element);
    for (const [row, value] of [...(values ?? [])]) if (!same(this.#table, this.#replaced(params, row, value), params)) values?.delete(row);
  }

  #replaced(params: K['params'], row: Row, value: unknown): K['params'] {
    return this.#isItems(row) ? this.#withList(params, row, value) : this.#table.written(params, row, value);
  }

  #withList(params: K['params'], row: Row, values: unknown): K['params'] {
    const table = this.#table;
    if (!isList(values)) {
      const name = propertyOf(row);
      throw new RockFieldError({
        name: 'WrongType',
        key: name,
        value: values,
        message: `${name} must be a list with a value for each ${row.scope}`,
      });
    }
    const old = table.items(params);
    // One too many is refused like a million.
    const { length } = values;
    const items = Array.from({ length: Math.min(length, table.itemCount.max + 1) }, (_, index) =>
      table.written(old[index] ?? table.newItem(index, params), row, values[index]),
    );
    return table.withItems(params, items);
  }

  /** The row of a property; undefined where the name is none. */
  rowOf(name: string): Row | undefined {
    return this.#rows[this.names.indexOf(name)];
  }
}
