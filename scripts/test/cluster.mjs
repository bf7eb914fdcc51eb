// The step `cluster` of `npm test`: the Python package of python/ and the examples, on clusters whose workers and schedulers are killed.
//
// It needs Python 3.10 or newer, and makes an environment with pinned packages in the cache folder. Where one of them cannot be had it is left out.
import { existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { cache, dist, hashOf, root } from '../lib/env.mjs';
import { Failure, capture, isMain, main, messageOf, run, say, step, which } from '../lib/run.mjs';

const PACKAGE = path.join(root, 'python');
const PINNED = path.join(PACKAGE, 'requirements-test.txt');
const OLDEST = [3, 10];

/** Runs the tests; resolves with a note where they are left out. */
export async function check() {
  const python = findPython();
  if (!python) return `left out, since there is no Python ${OLDEST.join('.')} or newer`;
  let program;
  try {
    program = await environment(python);
  } catch (error) {
    if (!(error instanceof Failure)) throw error;
    return `left out, since the packages of python/requirements-test.txt cannot be had (${messageOf(error)})`;
  }
  await run(program, ['-m', 'unittest', 'discover', '--start-directory', path.join(PACKAGE, 'tests')], {
    env: {
      // Of the sources: the environment has the packages that they need.
      PYTHONPATH: path.join(PACKAGE, 'src'),
      PYTHONDONTWRITEBYTECODE: '1',
      ROCK_FIELD: [process.execPath, path.join(dist, 'cli.js')].map(quoted).join(' '),
    },
  });
}

/** For Python's shlex, which reads it as a shell does. */
function quoted(word) {
  return `'${word.replaceAll("'", `'"'"'`)}'`;
}

function findPython() {
  const names = process.platform === 'win32' ? ['python', 'py'] : ['python3', 'python'];
  return names.map((name) => which(name)).find((program) => program !== null && isNewEnough(program)) ?? null;
}

function isNewEnough(program) {
  // Debian's Python has neither until python3-venv is installed.
  const version = capture(program, ['-c', 'import sys, venv, ensurepip; print(*sys.version_info[:2])']);
  const [major = 0, minor = 0] = version?.split(' ').map(Number) ?? [];
  return major === OLDEST[0] && minor >= OLDEST[1];
}

/** The Python of an environment with the pinned packages; made once for each list of them. */
async function environment(python) {
  const version = capture(python, ['-c', 'import sys; print(sys.version, sys.prefix)']) ?? '';
  const folder = path.join(cache, 'python', hashOf(readFileSync(PINNED, 'utf8'), version).slice(0, 16));
  const program = path.join(folder, ...(process.platform === 'win32' ? ['Scripts', 'python.exe'] : ['bin', 'python']));
  const stamp = path.join(folder, 'complete');
  if (existsSync(stamp)) return program;
  await step('Python packages for the tests of clusters', '20 s', async () => {
    rmSync(folder, { recursive: true, force: true });
    mkdirSync(path.dirname(folder), { recursive: true });
    await run(python, ['-m', 'venv', folder]);
    await run(program, ['-m', 'pip', 'install', '--quiet', '--disable-pip-version-check', '--requirement', PINNED]);
    writeFileSync(stamp, '');
  });
  return program;
}

if (isMain(import.meta)) {
  await main(async () => {
    const note = await check();
    if (note) say(note);
  });
}
