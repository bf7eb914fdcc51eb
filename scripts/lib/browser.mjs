// The browsers of the tests: an environment variable, a tool's own, PATH, the usual places; installed where there is none and it can be done.
//
//   node scripts/lib/browser.mjs firefox     prints its path
import { existsSync } from 'node:fs';
import path from 'node:path';
import { root } from './env.mjs';
import { Failure, capture, isMain, isProgram, main, messageOf, run, say, step, which } from './run.mjs';

/**
 * `own` is asked before PATH. `packages` are Debian's: the program's, then what it needs here beside what it depends on.
 * `remedy` is the command for other systems, `unavailable` says why there is none; `download` is for every system.
 */
const BROWSERS = {
  chromium: {
    called: 'Chrome or Chromium',
    variable: 'CHROME_PATH',
    own: playwrightsOwn,
    names: ['chromium', 'chromium-browser', 'google-chrome', 'google-chrome-stable', 'chrome', 'msedge'],
    places: {
      darwin: ['Google Chrome', 'Chromium', 'Microsoft Edge'].map((app) => `${app}.app/Contents/MacOS/${app}`),
      win32: ['Google/Chrome/Application/chrome.exe', 'Chromium/Application/chrome.exe', 'Microsoft/Edge/Application/msedge.exe'],
      linux: ['/snap/bin/chromium', '/opt/google/chrome/chrome'],
    },
    packages: ['chromium'],
    download: {
      what: "Playwright's own Chromium",
      command: 'npx playwright-core install chromium',
      install: () =>
        run(process.execPath, [path.join(root, 'node_modules', 'playwright-core', 'cli.js'), 'install', 'chromium'], { cwd: root }),
    },
  },
  firefox: {
    called: 'Firefox',
    variable: 'FIREFOX_PATH',
    names: ['firefox-esr', 'firefox'],
    places: { darwin: ['Firefox.app/Contents/MacOS/firefox'], win32: ['Mozilla Firefox/firefox.exe'], linux: ['/opt/firefox/firefox'] },
    // Without a graphics card Mesa draws, for WebGPU (Vulkan) and for WebGL; libpci lets Firefox find out.
    packages: ['firefox-esr', 'mesa-vulkan-drivers', 'libegl1', 'libgl1', 'libgl1-mesa-dri', 'libpci3'],
    remedy: {
      darwin: 'brew install --cask firefox',
      win32: 'winget install Mozilla.Firefox',
      linux: 'sudo dnf install firefox mesa-vulkan-drivers (Arch: sudo pacman -S firefox vulkan-swrast)',
    },
  },
  webkitgtk: {
    called: 'WebKitWebDriver (WebKitGTK)',
    variable: 'WEBKIT_DRIVER_PATH',
    names: ['WebKitWebDriver'],
    packages: ['webkit2gtk-driver', 'libgl1-mesa-dri'],
    unavailable: { darwin: 'There is none for macOS; look at the page in Safari.', win32: 'There is none for Windows.' },
    remedy: { linux: 'sudo pacman -S webkit2gtk-4.1 (elsewhere: the package with WebKitWebDriver and MiniBrowser)' },
  },
  xvfb: {
    called: 'Xvfb',
    variable: 'XVFB_PATH',
    names: ['Xvfb'],
    packages: ['xvfb'],
    remedy: { linux: 'sudo dnf install xorg-x11-server-Xvfb (Arch: sudo pacman -S xorg-server-xvfb)' },
  },
};

const isDebian = process.platform === 'linux' && existsSync('/etc/debian_version');
const isRoot = process.getuid?.() === 0;

/** The path of a browser, by default of a Chromium or Chrome; `null` when none is found. */
export async function findBrowser(name = 'chromium') {
  const { variable, own, names } = BROWSERS[name];
  const given = process.env[variable];
  if (given) {
    if (!isProgram(given)) throw new Failure(`${variable} names no program: ${given}`);
    return given;
  }
  return (await own?.()) ?? names.map(which).find(Boolean) ?? usualPlaces(name).find(isProgram) ?? null;
}

async function playwrightsOwn() {
  const { chromium } = await import('playwright-core');
  const file = chromium.executablePath();
  return file && isProgram(file) ? file : null;
}

function usualPlaces(name) {
  const places = BROWSERS[name].places?.[process.platform] ?? [];
  const folders = {
    darwin: ['/Applications', path.join(process.env.HOME ?? '', 'Applications')],
    win32: ['ProgramFiles', 'ProgramFiles(x86)', 'LOCALAPPDATA'].map((variable) => process.env[variable]).filter(Boolean),
  };
  return (folders[process.platform] ?? ['/']).flatMap((folder) => places.map((place) => path.join(folder, place)));
}

/** Whether a browser that is missing can be installed here without asking anybody. */
export function canInstall(name) {
  return (isDebian && isRoot) || BROWSERS[name].download !== undefined;
}

/** A browser's path, after installing it, and what it needs here, if something is missing. Fails where that cannot be done. */
export async function ensureBrowser(name = 'chromium') {
  const { called } = BROWSERS[name];
  const found = await findBrowser(name);
  const lacking = missingLibraries(name);
  if (found && lacking.length === 0) {
    say(`• ${called}: ${found}`);
    return found;
  }
  const { what, command, install } = recipe(name, found ? lacking : BROWSERS[name].packages);
  if (!install)
    throw new Failure(`${found ? `${called} lacks ${lacking.join(', ')}` : `no ${called} was found`}. ${remedy(name, command)}`);
  say(`• ${found ? `${called} lacks ${lacking.join(', ')}` : `No ${called} was found`}. Installing ${what}`);
  try {
    await step(command, '1–3 min', install);
  } catch (error) {
    throw new Failure(`no ${called} for the browser tests (${messageOf(error)}). ${remedy(name, command)}`);
  }
  const installed = await findBrowser(name);
  if (!installed) throw new Failure(`no ${called} for the browser tests, although the installation succeeded. ${remedy(name, command)}`);
  return installed;
}

/** What a program found here needs beside itself: known of Debian alone, elsewhere it is there or the tests will tell. */
function missingLibraries(name) {
  if (!isDebian) return [];
  const status = (library) => capture('dpkg-query', ['-W', `-f=\${db:Status-Status}`, library], { stdio: ['ignore', 'pipe', 'ignore'] });
  return BROWSERS[name].packages.slice(1).filter((library) => status(library) !== 'installed');
}

function remedy(name, command) {
  const { variable, unavailable } = BROWSERS[name];
  return unavailable?.[process.platform] ?? `Get it with: ${command} (or set ${variable} to one; SKIP_BROWSERS=1 leaves these tests out)`;
}

function recipe(name, packages) {
  const { download, remedy: byHand } = BROWSERS[name];
  const command = `apt-get update && apt-get install -y ${packages.join(' ')}`;
  if (isDebian && isRoot) {
    return {
      what: `Debian's ${packages.join(', ')}`,
      command,
      install: async () => {
        await run('apt-get', ['update']);
        await run('apt-get', ['install', '-y', '--no-install-recommends', ...packages], { env: { DEBIAN_FRONTEND: 'noninteractive' } });
      },
    };
  }
  if (download) return download;
  return { command: isDebian ? `sudo apt-get install ${packages.join(' ')}` : (byHand[process.platform] ?? byHand.linux) };
}

if (isMain(import.meta)) await main(async () => console.log(await ensureBrowser(process.argv[2])));
