// `npm run bench -- --flow`: whether the page answers on a machine without a GPU, in plain Chromium: how soon there is a picture, how a turn
// of the camera flows, and how long anybody who touches the page waits.
//
// The page is timed from outside it as well as inside: a mouse is moved by the browser itself, and a frame counts when it was put on the screen.
import { readFileSync, readdirSync } from 'node:fs';
import { chromium } from 'playwright-core';
import { findBrowser } from '../scripts/lib/browser.mjs';
import { dist } from '../scripts/lib/env.mjs';
import { serve } from '../scripts/lib/serve.mjs';

const VIEWPORT = { width: 1440, height: 900 };
/** How long the camera is turned by the mouse, ms, and how often the mouse moves. */
const DRAG_MS = 6000;
const MOVE_MS = 16;
/** Nothing drawn for so long is the end of a picture. */
const QUIET_MS = 1500;
const PATIENCE_MS = 90_000;

/** Medians of `rounds` visits of the page at `address`, each in a browser of its own; ms but for `fps`. */
export async function measureFlow(rounds, { address = '', folder = dist, args = [] } = {}) {
  const server = await serve(folder);
  try {
    const visits = [];
    for (let round = 0; round < rounds; round += 1) visits.push(await visit(new URL(address, server.url).href, args));
    const median = (key) => visits.map((one) => one[key]).toSorted((a, b) => a - b)[visits.length >> 1];
    return { ...visits[0], ...Object.fromEntries(Object.keys(ROWS).map((key) => [key, median(key)])) };
  } finally {
    await server.close();
  }
}

async function visit(url, args) {
  const executablePath = await findBrowser();
  const asRoot = process.platform === 'linux' && process.getuid?.() === 0;
  const browser = await chromium.launch({ executablePath, headless: true, chromiumSandbox: !asRoot, args });
  try {
    const page = await browser.newPage({ viewport: VIEWPORT, colorScheme: 'light' });
    page.setDefaultTimeout(PATIENCE_MS);
    await page.addInitScript(watch);
    await page.goto(url, { waitUntil: 'commit' });
    await page.waitForFunction(() => globalThis.flow?.first > 0, undefined, { polling: 100 });
    const beginning = await still(page);
    await page.evaluate(() => flow.reset());
    const box = await page.locator('rock-field').boundingBox();
    const middle = [box.x + box.width / 2, box.y + box.height / 2];
    await page.mouse.move(...middle);
    await page.mouse.down();
    const worked = cpuSeconds();
    const end = performance.now() + DRAG_MS;
    for (let k = 0; performance.now() < end; k += 1) {
      await page.mouse.move(middle[0] + 120 * Math.sin(k / 40), middle[1]);
      await new Promise((resolve) => setTimeout(resolve, MOVE_MS));
    }
    const dragged = await page.evaluate(() => flow.read());
    const cpu = (1000 * (cpuSeconds() - worked)) / Math.max(1, dragged.frames);
    await page.mouse.up();
    await page.evaluate(() => flow.reset());
    const rest = await still(page);
    return {
      backend: await page.evaluate(() => document.querySelector('rock-field').backend),
      first: beginning.first,
      still: beginning.full,
      best: beginning.last,
      gap: beginning.gap,
      fps: (1000 * dragged.frames) / DRAG_MS,
      cpu,
      dragGap: dragged.gap,
      input: dragged.input,
      restGap: rest.gap,
      tasks: beginning.tasks,
      pictures: beginning.pictures,
    };
  } finally {
    await browser.close();
  }
}

/** CPU seconds of all processes that this one has started; 0 where they cannot be known. */
function cpuSeconds() {
  const all = new Map();
  try {
    for (const name of readdirSync('/proc').filter((name) => /^\d+$/.test(name))) {
      const stat = readFileSync(`/proc/${name}/stat`, 'utf8');
      const [, parent, ...rest] = stat.slice(stat.lastIndexOf(')') + 2).split(' ');
      all.set(Number(name), { parent: Number(parent), seconds: (Number(rest[9]) + Number(rest[10])) / 100 });
    }
  } catch {}
  const isBelow = (id) => {
    for (let at = all.get(id)?.parent; at; at = all.get(at)?.parent) if (at === process.pid) return true;
    return false;
  };
  return [...all].reduce((sum, [id, { seconds }]) => sum + (isBelow(id) ? seconds : 0), 0);
}

/** What the page has done when it draws no more. */
async function still(page) {
  await page.waitForFunction((ms) => flow.isQuiet(ms), QUIET_MS, { polling: 200 });
  return page.evaluate(() => flow.read());
}

/** In the page: a heart that beats, and what comes between two beats. */
function watch() {
  const of = () => document.querySelector('rock-field');
  let beat = performance.now();
  const state = { gap: 0, input: 0, frames: 0, tasks: [], pictures: [], last: 0, full: 0, asked: 0 };
  const flow = {
    first: 0,
    reset: () => Object.assign(state, { gap: 0, input: 0, frames: 0, tasks: [], pictures: [] }),
    read: () => ({ ...state, first: flow.first }),
    isQuiet: (ms) => performance.now() - Math.max(state.last, state.asked) > ms,
  };
  globalThis.flow = flow;
  const channel = new MessageChannel();
  // Between any two of its own tasks a page answers, so both of a beat count.
  const beats = () => {
    const now = performance.now();
    if (now - beat > 50) state.tasks.push([Math.round(beat), Math.round(now - beat)]);
    state.gap = Math.max(state.gap, now - beat);
    beat = now;
  };
  channel.port1.onmessage = () => {
    beats();
    setTimeout(() => {
      beats();
      channel.port2.postMessage(0);
    }, 4);
  };
  channel.port2.postMessage(0);
  const request = requestAnimationFrame;
  globalThis.requestAnimationFrame = (callback) => {
    state.asked = performance.now();
    return request(callback);
  };
  addEventListener('pointermove', (event) => (state.input = Math.max(state.input, performance.now() - event.timeStamp)), true);
  // A picture is there when it was put on a canvas that is seen: by `drawImage`, or by a frame after a submission.
  const seen = (isFull) => {
    if (!flow.drawn) return;
    const now = performance.now();
    flow.first ||= now;
    // Where that cannot be known, the second one is.
    if (isFull ?? state.last > 0) state.full ||= now;
    state.last = now;
    state.frames += 1;
    state.pictures.push(Math.round(now));
  };
  const { drawImage } = CanvasRenderingContext2D.prototype;
  CanvasRenderingContext2D.prototype.drawImage = function (image, ...rest) {
    drawImage.call(this, image, ...rest);
    if (!(image instanceof HTMLCanvasElement) || !of()?.shadowRoot?.contains(this.canvas)) return;
    flow.drawn = true;
    const isFull = rest.length < 8 || rest[2] === this.canvas.width;
    request(() => setTimeout(() => seen(isFull)));
  };
  const queue = globalThis.GPUQueue?.prototype;
  if (!queue) return;
  const context = GPUCanvasContext.prototype;
  const { getCurrentTexture } = context;
  const { submit } = queue;
  let isTaken = false;
  context.getCurrentTexture = function (...rest) {
    if (of()?.shadowRoot?.contains(this.canvas)) isTaken = true;
    return getCurrentTexture.apply(this, rest);
  };
  queue.submit = function (...rest) {
    submit.apply(this, rest);
    if (!isTaken) return;
    isTaken = false;
    void this.onSubmittedWorkDone().then(() => {
      flow.drawn = true;
      seen();
    });
  };
}

const ROWS = {
  first: 'first picture',
  still: 'first picture with all its pixels',
  best: 'best still',
  gap: 'longest time without an answer until then',
  fps: 'pictures a second while the camera is turned',
  cpu: 'work of all processors for one of them',
  dragGap: 'longest time without an answer meanwhile',
  input: 'longest time from a move of the mouse to its handler',
  restGap: 'longest time without an answer until the still after it',
};

export function reportFlow(measured) {
  const rows = Object.entries(ROWS).map(
    ([key, text]) => `${text.padEnd(58)}${measured[key].toFixed(key === 'fps' ? 1 : 0).padStart(7)}${key === 'fps' ? '' : ' ms'}`,
  );
  return [`Plain Chromium without a GPU, ${VIEWPORT.width} × ${VIEWPORT.height}, ${measured.backend}`, ...rows].join('\n');
}
