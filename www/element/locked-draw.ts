/** Parameters by lot, but for what is locked. */

import { RockFieldError } from '../base/errors.ts';
import type { ControlledElement } from './panel-owner.ts';
import type { Definition } from './definition.ts';
import { shown, wrongType } from '../table/param-checks.ts';
import type { Draw, Kind } from '../table/table.ts';

/**
 * Other parameters than `old`; what `lock` names, properties or the list of the items, is as it was.
 *
 * @throws {RockFieldError} `UnknownKey` for a name in `lock` that is no parameter.
 */
export async function lockedDraw<K extends Kind>(
  { table, properties, list, random }: Pick<Definition<K, ControlledElement>, 'table' | 'properties' | 'list' | 'random'>,
  old: K['params'],
  freshSeed: () => Promise<number>,
  { preset, lock }: Required<Omit<Draw, 'seed'>>,
): Promise<K['params']> {
  if (!Array.isArray(lock)) throw wrongType('lock', lock, 'a list of names');
  const stranger = lock.find((name) => name !== list && !properties.names.includes(name));
  if (stranger !== undefined)
    throw new RockFieldError({ name: 'UnknownKey', key: stranger, message: `there is no parameter called ${shown(stranger)}` });
  let params = await random(old, { seed: await freshSeed(), preset, lock });
  if (lock.includes(list)) params = table.withItems(params, table.items(old));
  for (const name of lock) {
    const row = properties.rowOf(name);
    if (!row) continue;
    // Values of items can only be kept with as many items.
    if (!table.itemRows.includes(row)) params = table.written(params, row, table.read(old, row));
    else
      params = table.withItems(
        params,
        table.items(old).map((item, index) => table.written(table.items(params)[index] ?? item, row, table.read(item, row))),
      );
  }
  return params;
}
