// What axe finds on a page, shadow roots included.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';

const source = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

/** Every violation of every rule, as `rule: selector – what is wrong`. */
export async function violations(page) {
  await page.evaluate(source);
  const found = await page.evaluate(async () => (await globalThis.axe.run(document, { resultTypes: ['violations'] })).violations);
  return found.flatMap(({ id, nodes }) => nodes.map(({ target, failureSummary }) => `${id}: ${target.flat().join(' ')} – ${failureSummary.replaceAll('\n', ' ')}`));
}
