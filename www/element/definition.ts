/** What a generator is to its element: everything in which `<rock-field>` and `<wood-ear-log>` differ but for what they show. */

import type { Language } from '../base/language.ts';
import type { Look } from '../data/look.ts';
import type { Runs, RunsHost } from '../generator/runs.ts';
import type { DecodedLink, Link } from '../table/link.ts';
import type { Row } from '../table/row.ts';
import type { Draw, Kind, Table } from '../table/table.ts';
import type { ElementAttributes } from './attribute-reader.ts';
import type { ExportInWorker } from './export-client.ts';
import type { ControlledElement, PanelModule } from './panel-owner.ts';
import type { RowProperties } from './parameter-properties.ts';

/** What is known of the parameters. */
export interface ParamsDefinition<K extends Kind> {
  table: Table<K>;
  properties: RowProperties<K>;
  newRuns(host: RunsHost<K['params'], K['result'], K['stage']>, element: HTMLElement): Runs<K['params'], K['result'], K['stage']>;
  /** Width and height of the ground, px. */
  groundSize(params: K['params']): [number, number];
}

/** What is known of the attributes. */
export interface AttributesDefinition<K extends Kind> extends ParamsDefinition<K> {
  /** By attribute: the rows of the whole. */
  rowAttributes: ReadonlyMap<string, Row>;
  /** Attributes that tell the items. */
  itemAttributes: readonly string[];
  /** Attributes of parameters that are no rows, with the key of each. */
  ownAttributes: Readonly<Record<string, keyof K['params']>>;
  /** What the items are called, as a property. */
  list: string;
  readAttributes(get: (name: string) => string | null): ElementAttributes<K>;
  lookOf(params: K['params']): Look;
}

export interface Definition<K extends Kind, Owner extends ControlledElement> extends AttributesDefinition<K> {
  encode(state: Link<K>): string;
  decode(text: string): DecodedLink<K>;
  /** Of the buffers of a result, hexadecimal. */
  hash(result: K['result']): Promise<string>;
  /** What is shown, in a sentence. */
  describe(result: K['result'], metresPerPixel: number, language: Language): Promise<string>;
  random(params: K['params'], draw: Draw): Promise<K['params']>;
  loadPanel(): Promise<PanelModule<K, Owner>>;
  /** What writes files, fetched when somebody exports. */
  loadExporter(): Promise<ExportInWorker<K>>;
}
