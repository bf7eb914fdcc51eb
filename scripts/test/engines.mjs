// `npm run test:engines`: both elements, both pages and the documentation in Chromium, Firefox and WebKitGTK, with everything each of them
// can draw with.
//
// Each has to show the same fields and colonies (their golden hashes; on logs from files, what grows in Node) and, within what devices differ,
// the same picture. An engine that cannot be had on this system is left out, and it is said which, why, and how to get it. Screenshots:
// .cache/screenshots/engine-*.png.
// `-- firefox webkitgtk` runs these alone.
import { canInstall, ensureBrowser } from '../lib/browser.mjs';
import { build } from '../build/build.mjs';
import { dist } from '../lib/env.mjs';
import { Failure, beginningWith, inLanes, isMain, main, messageOf, say, seconds } from '../lib/run.mjs';
import { serve } from '../lib/serve.mjs';

/** Of one script in a page, and of loading it. Software rendering takes its time, more of it on a busy machine. */
const TIMEOUT_MS = 120_000;
/** Of an engine with all its backends. */
const ENGINE_MS = 600_000;

/** The picture that all others are compared with. */
const REFERENCE = 'Chromium with WebGPU';

const TITLES = { webgpu: 'WebGPU', webgl: 'WebGL2' };

/** Runs every engine, or those of these names; resolves with a note if some were left out. */
export async function check(names = []) {
  if (process.env.SKIP_BROWSERS) return 'left out, as SKIP_BROWSERS asks';
  // These need npm packages and a build.
  const { ENGINES } = await import('../../tests/engines/engines.mjs');
  const { intercept } = await import('../../tests/engines/examine.mjs');
  const { guard } = await import('../../tests/engines/processes.mjs');
  guard();
  const stranger = names.find((name) => !ENGINES.some(({ browser }) => browser === name));
  if (stranger) throw new Failure(`there is no engine ${stranger}; there are: ${ENGINES.map(({ browser }) => browser).join(', ')}`);
  const chosen = ENGINES.filter(({ browser }) => names.length === 0 || names.includes(browser));
  const server = await serve(dist, { intercept });
  const found = { pictures: [], problems: [], skipped: [] };
  try {
    // What is missing is installed first, one after the other. Then engines run side by side, since each of them waits for much of its time.
    const prepared = [];
    for (const engine of chosen) prepared.push({ engine, programs: await prepare(engine, found) });
    await inLanes(
      prepared.filter(({ programs }) => programs),
      ({ engine, programs }) => attempt(engine, programs, server.url, found),
    );
  } finally {
    await server.close();
  }
  const problems = [...found.problems, ...(await compare(found.pictures.toSorted(beginningWith([REFERENCE], ({ name }) => name))))];
  if (problems.length > 0) throw new Failure(problems.join('\n  '));
  return found.skipped.join('; ');
}

/** The programs that an engine needs; without them it is left out, which is added to what was found. */
async function prepare(engine, found) {
  try {
    return await install(engine);
  } catch (error) {
    if (!(error instanceof Failure)) throw error;
    missing(found, canInstall(engine.browser), `${engine.name} is left out: ${error.message}`);
    return null;
  }
}

/** Adds an engine's pictures, or what went wrong, to what was found. */
async function attempt(engine, programs, url, found) {
  const { startScreen } = await import('../../tests/engines/processes.mjs');
  let screen;
  let running;
  const work = async () => {
    screen = programs.xvfb && (await startScreen(programs.xvfb));
    running = await engine.open(programs.browser, { env: screen?.env, timeoutMs: TIMEOUT_MS });
    await examineAll(engine, running, url, found);
  };
  try {
    await within(ENGINE_MS, work());
  } catch (error) {
    say(`  ✗ ${engine.name}: ${messageOf(error)}`);
    found.problems.push(`${engine.name}: ${messageOf(error)}`);
  } finally {
    await running?.close();
    await screen?.stop();
  }
}

/** What should be here is a problem; what cannot be had is left out, and said. */
function missing(found, isDue, text) {
  say(`  ${isDue ? '✗' : '!'} ${text}`);
  (isDue ? found.problems : found.skipped).push(text);
}

async function install({ browser, needsScreen }) {
  const program = await ensureBrowser(browser);
  if (!needsScreen || process.platform !== 'linux') return { browser: program };
  try {
    return { browser: program, xvfb: await ensureBrowser('xvfb') };
  } catch (error) {
    // Somebody's desktop will do; a window opens there.
    if (!process.env.DISPLAY && !process.env.WAYLAND_DISPLAY) throw error;
    return { browser: program };
  }
}

async function examineAll({ name, browser, backends }, running, url, found) {
  const { examine, offers, PAGE } = await import('../../tests/engines/examine.mjs');
  const { examineColony, examineFrame, examinePages } = await import('../../tests/engines/visits.mjs');
  const version = `${name} ${running.version}`;
  const offered = await offers(running, url);
  for (const backend of backends) {
    const what = `${version}, ${TITLES[backend]}`;
    // On Linux Chromium brings a software device along, and what Firefox and WebKitGTK need is installed with them.
    if (!offered[backend]) missing(found, process.platform === 'linux' && canInstall(browser), `${what}: it is not offered here`);
    else {
      await report(what, found, async () => {
        const { statistics, rocks, ms } = await examine(running, url, { backend, name: `engine-${name.toLowerCase()}-${backend}` });
        found.pictures.push({ name: `${name} with ${TITLES[backend]}`, statistics });
        return `${rocks.toLocaleString('en')} rocks, first picture after ${seconds(ms)} s`;
      });
      await report(`${what}, wood ears`, found, async () => {
        const { individuals } = await examineColony(running, `${url}${PAGE}`, backend);
        return `${individuals.toLocaleString('en')} on a log from a file`;
      });
      await report(`${what}, pages`, found, async () => {
        await examinePages(running, url, backend);
        return 'rocks, wood ears, documentation';
      });
    }
  }
  const best = backends.find((backend) => offered[backend]);
  if (!best) return;
  await report(`${version}, in a frame without an origin`, found, async () => {
    await examineFrame(running, url, best);
    return 'rocks and wood ears';
  });
}

/** One line: what, whether it went well, how long it took. */
async function report(what, { problems }, work) {
  const start = performance.now();
  const line = (mark, text) => say(`  ${mark} ${what}: ${text} (${seconds(performance.now() - start)} s)`);
  try {
    line('✓', await work());
  } catch (error) {
    problems.push(`${what}: ${messageOf(error)}`);
    line('✗', messageOf(error));
  }
}

/** @param {{ name: string, statistics: ReturnType<typeof import('../../tests/engines/statistics.mjs').statistics> }[]} pictures */
async function compare([first, ...others]) {
  const { differences } = await import('../../tests/engines/statistics.mjs');
  return others.flatMap(({ name, statistics }) => {
    const found = differences(first.statistics, statistics);
    return found.length > 0 ? [`${first.name} and ${name} show different pictures: ${found.join('; ')}`] : [];
  });
}

async function within(ms, work) {
  let timer;
  const late = new Promise((_, reject) => {
    timer = setTimeout(() => reject(new Error(`not done after ${ms / 60_000} min`)), ms);
  });
  try {
    await Promise.race([work, late]);
  } finally {
    clearTimeout(timer);
  }
}

if (isMain(import.meta)) {
  await main(async () => {
    await build();
    const note = await check(process.argv.slice(2));
    say(note ? `! ${note}` : '✓ all engines show the same rocks and wood ears');
  });
}
