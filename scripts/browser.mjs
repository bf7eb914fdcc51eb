// The browser of the browser tests: CHROME_PATH, then Playwright's own, then the system's; installed where there is none.
import { existsSync } from 'node:fs';
import path from 'node:path';
import { root } from './env.mjs';
import { Failure, isMain, isProgram, main, run, say, step, which } from './run.mjs';

const NAMES = ['chromium', 'chromium-browser', 'google-chrome', 'google-chrome-stable', 'chrome', 'msedge'];

/** The path of a Chromium or Chrome; `null` when none is found. */
export async function findBrowser() {
  const { CHROME_PATH } = process.env;
  if (CHROME_PATH) {
    if (!isProgram(CHROME_PATH)) throw new Failure(`CHROME_PATH names no program: ${CHROME_PATH}`);
    return CHROME_PATH;
  }
  const own = await playwrightsOwn();
  if (own) return own;
  return NAMES.map(which).find(Boolean) ?? usualPlaces().find(isProgram) ?? null;
}

async function playwrightsOwn() {
  const { chromium } = await import('playwright-core');
  const file = chromium.executablePath();
  return file && isProgram(file) ? file : null;
}

function usualPlaces() {
  if (process.platform === 'darwin') {
    const apps = ['Google Chrome', 'Chromium', 'Microsoft Edge'];
    return apps.flatMap((app) => ['/Applications', path.join(process.env.HOME ?? '', 'Applications')].map((folder) => `${folder}/${app}.app/Contents/MacOS/${app}`));
  }
  if (process.platform === 'win32') {
    const folders = ['ProgramFiles', 'ProgramFiles(x86)', 'LOCALAPPDATA'].map((name) => process.env[name]).filter(Boolean);
    const programs = ['Google/Chrome/Application/chrome.exe', 'Chromium/Application/chrome.exe', 'Microsoft/Edge/Application/msedge.exe'];
    return folders.flatMap((folder) => programs.map((program) => path.join(folder, program)));
  }
  return ['/snap/bin/chromium', '/opt/google/chrome/chrome'];
}

/** A browser's path, after installing one if there is none. */
export async function ensureBrowser() {
  const found = await findBrowser();
  if (found) {
    say(`• Browser: ${found}`);
    return found;
  }
  const { what, command, install } = recipe();
  say(`• No Chrome or Chromium was found. Installing ${what}`);
  try {
    await step(command, '1–3 min', install);
  } catch (error) {
    throw new Failure(`no browser for the browser tests (${error.message}). ${remedy(command)}`);
  }
  const installed = await findBrowser();
  if (!installed) throw new Failure(`no browser for the browser tests, although the installation succeeded. ${remedy(command)}`);
  return installed;
}

function remedy(command) {
  return `Install one with: ${command} (or set CHROME_PATH to a Chrome or Chromium; SKIP_BROWSERS=1 leaves these tests out)`;
}

function recipe() {
  if (process.platform === 'linux' && process.getuid() === 0 && existsSync('/etc/debian_version')) {
    return {
      what: "Debian's chromium",
      command: 'apt-get update && apt-get install -y chromium',
      install: async () => {
        await run('apt-get', ['update']);
        await run('apt-get', ['install', '-y', '--no-install-recommends', 'chromium'], { env: { DEBIAN_FRONTEND: 'noninteractive' } });
      },
    };
  }
  return {
    what: "Playwright's own Chromium",
    command: 'npx playwright-core install chromium',
    install: () => run(process.execPath, [path.join(root, 'node_modules', 'playwright-core', 'cli.js'), 'install', 'chromium'], { cwd: root }),
  };
}

if (isMain(import.meta)) await main(async () => console.log(await ensureBrowser()));
