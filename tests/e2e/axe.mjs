// What axe finds on a page, shadow roots included.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';

const source = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

/** The rules that look at colours: what is left to ask in a second theme. */
export const COLOR_RULES = ['color-contrast', 'link-in-text-block'];

/**
 * Every violation of every rule, or of these, as `rule: selector – what is wrong`.
 *
 * @param {import('playwright-core').Page} page
 * @param {string[] | null} [rules]
 */
export async function violations(page, rules = null) {
  await page.evaluate(transitionsEnd);
  await page.evaluate(source);
  const found = await page.evaluate(
    async (only) => (await globalThis.axe.run(document, { resultTypes: ['violations'], ...(only && { runOnly: only }) })).violations,
    rules,
  );
  return found.flatMap(({ id, nodes }) =>
    nodes.map(({ target, failureSummary }) => `${id}: ${target.flat().join(' ')} – ${(failureSummary ?? '').replaceAll('\n', ' ')}`),
  );
}

/** In the page: after a change of theme, colours that are on their way have the contrast of neither theme. */
async function transitionsEnd() {
  const animations = (root) => [
    ...root.getAnimations(),
    ...[...root.querySelectorAll('*')].flatMap(({ shadowRoot }) => (shadowRoot ? animations(shadowRoot) : [])),
  ];
  const transitions = animations(document).filter((animation) => animation instanceof CSSTransition);
  // One that is cut short by another is not finished, but it has ended.
  await Promise.allSettled(transitions.map(({ finished }) => finished));
}
