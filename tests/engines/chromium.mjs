// Chromium, by Playwright, on its own software GPU.
import { launch } from '../e2e/browser.mjs';

/** See `engines.mjs` for what an engine offers. */
export async function openChromium() {
  const session = await launch({ webgpu: true });
  let page;
  return {
    version: session.browser.version(),
    async go(url) {
      await page?.close();
      page = await session.open(url, { deviceScaleFactor: 1 });
    },
    evaluate: (expression) => page.page.evaluate(expression),
    screenshot: () => page.page.screenshot(),
    // What the page cannot hear itself: files that are missing, failures in workers.
    complaints: () => page.errors,
    close: session.close,
  };
}
