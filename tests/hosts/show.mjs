// Opens the page of a host in Chromium and waits for its rocks: without an error, and from nowhere but its own origin.
import assert from 'node:assert/strict';
import path from 'node:path';
import { serve } from '../../scripts/lib/serve.mjs';
import { launch } from '../e2e/browser.mjs';

/** What every host's element says. */
const SEED = 7;

/** Two software GPUs at once on a busy machine are slow. */
const TIMEOUT_MS = 120_000;

/**
 * The page of `site`, or of the server at `url`. `policy` is its Content-Security-Policy, `cdn` the address of another origin that it
 * may ask. A `live` page shows what it hears from the element, and has a button that calls it. Resolves with the addresses asked.
 *
 * @typedef {Awaited<ReturnType<typeof launch>>} Session
 * @typedef {(session: Session, page: import('playwright-core').Page) => Promise<void>} Look
 * @param {{ site?: string, url?: string, cdn?: string, policy?: string, live?: boolean, look?: Look }} host
 */
export async function show({ site, url, cdn, policy, live = false, look }) {
  const session = await launch({
    ...(site && { folder: site }),
    ...(policy && { intercept: (_request, response) => void response.setHeader('content-security-policy', policy) }),
  });
  try {
    const asked = new Set();
    const prepare = (page) => void page.context().on('request', (request) => asked.add(request.url()));
    const { page, errors, warnings } = await session.open(url ?? '', { prepare });
    page.setDefaultTimeout(TIMEOUT_MS);
    await page.waitForSelector('rock-field', { state: 'attached' });
    const { rocks, params } = await page.evaluate(async () => {
      await customElements.whenDefined('rock-field');
      const element = document.querySelector('rock-field');
      const failure = new Promise((_, reject) =>
        element.addEventListener('error', ({ detail }) => reject(new Error(detail.error.message))),
      );
      await Promise.race([element.ready, failure]);
      return { rocks: element.field.stats.rocks, params: element.params };
    });
    assert.ok(rocks > 2000, `${rocks} rocks`);
    assert.equal(params.seed, SEED);
    if (live) await answers(page, { rocks, params });
    await look?.(session, page);
    assert.deepEqual([errors, warnings], [[], []]);
    const known = [url ?? session.url, cdn].flatMap((address) => (address ? [new URL(address).origin] : []));
    const foreign = [...asked].filter((address) => /^https?:/.test(address) && !known.includes(new URL(address).origin));
    assert.deepEqual(foreign, [], 'others than our own were asked');
    return [...asked];
  } finally {
    await session.close();
  }
}

/** What the template says has reached the element, its events the component, and the component's calls the element. */
async function answers(page, { rocks, params }) {
  assert.deepEqual(
    [params.imageWidth, params.layers.map(({ radius, taper }) => [radius, taper[1]])],
    [
      1100,
      [
        [80, 6],
        [30, 6],
        [10, 2],
      ],
    ],
  );
  await page.getByText(`${rocks} rocks`).waitFor();
  await page.getByRole('button', { name: 'Whole field' }).click();
  await page.getByText('framed').waitFor();
}

/** The package's files as a public CDN has them: on another origin, for everybody. */
export function openCdn(folder) {
  const intercept = (_request, response) => {
    response.setHeader('access-control-allow-origin', '*');
    return false;
  };
  return serve(path.join(folder, 'dist'), { intercept });
}
