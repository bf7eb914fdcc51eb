// The engines, what each draws with, and how each is started. They are all driven in the same way:
//
//   version              as the browser says it
//   go(url)              opens a page and waits for its load event
//   evaluate(expression) its value in the page, awaited
//   screenshot()         PNG of what is in the window
//   complaints()         what the driver heard that the page cannot
//   close()              ends everything that was started for it
import { openChromium } from './chromium.mjs';
import { openFirefox } from './firefox.mjs';
import { openWebKitGtk } from './webkitgtk.mjs';

/**
 * `browser` is the name in scripts/lib/browser.mjs; `backends` in the order in which the element prefers them; `open(program, { env, timeoutMs })`
 * gives a running engine; one that `needsScreen` has no mode without a window in which it draws all of that.
 */
export const ENGINES = [
  { name: 'Chromium', browser: 'chromium', backends: ['webgpu', 'webgl'], needsScreen: false, open: openChromium },
  { name: 'Firefox', browser: 'firefox', backends: ['webgpu', 'webgl'], needsScreen: true, open: openFirefox },
  { name: 'WebKitGTK', browser: 'webkitgtk', backends: ['webgl'], needsScreen: true, open: openWebKitGtk },
];
