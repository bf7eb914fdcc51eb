// The recipes of "In your own scene", as they stand in the documentation, in scenes of three.js, React Three Fiber and Babylon.js from the packed package.
import assert from 'node:assert/strict';
import { cpSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { root } from '../../scripts/lib/env.mjs';
import { needed } from '../../scripts/lib/run.mjs';
import { readPicture } from '../../scripts/lib/pixels.mjs';
import { launch, screenshotPath, until } from '../e2e/browser.mjs';
import { install, tool, vite } from './projects.mjs';

const PAGE = path.join(root, 'www', 'docs', 'pages', 'engines.md');
/** Of the field in every scene, metres; no rock reaches over its border by more than `ROUGH`, or is higher than `HIGHEST`. */
const [WIDTH, DEPTH, HIGHEST, ROUGH] = [1.6, 1.2, 0.2, 0.1];

/** React Three Fiber uses what three.js is going to drop. */
const OF_OTHERS = /^THREE\.Clock: This module has been deprecated/;

/** Each with what the recipe is given. */
const RECIPES = {
  'three.js': ['scene'],
  'babylon.js': ['scene'],
  'babylon-levels.js': ['rocks'],
};

/** @param folder the unpacked package. */
export async function showScenes(site, folder) {
  const project = await install('scenes', folder);
  writeRecipes(path.join(project, 'src', 'recipes'));
  await tool(project, 'typescript/bin/tsc', []);
  // Those of Babylon.js and of three.js contradict each other, which three's alone do not.
  await tool(project, 'typescript/bin/tsc', ['-p', 'tsconfig.strict.json']);
  await vite(project, site);
  const session = await launch({ folder: site, webgpu: true });
  try {
    const { page, errors, warnings } = await session.open('', { deviceScaleFactor: 1 });
    const scenes = { 'three-webgl': ['three', 'webgl'], 'three-webgpu': ['three', 'webgpu'], fiber: ['fiber'], babylon: ['babylon'] };
    for (const [name, [scene, kind]] of Object.entries(scenes)) {
      const report = await page.evaluate(([one, argument]) => globalThis.scenes[one](argument), [scene, kind]);
      check(name, report);
    }
    await until(() => page.workers().length === 0, 'workers end after their fields');
    await showPage(session, site, project);
    assert.deepEqual([errors, warnings.filter((warning) => !OF_OTHERS.test(warning))], [[], []]);
  } finally {
    await session.close();
  }
}

/** The page that has no bundler. */
async function showPage({ open, url }, site, project) {
  const code = small(needed(blocks().get('index.html'), `index.html in ${PAGE}`));
  writeFileSync(path.join(site, 'plain.html'), code.replace('<script', '<link rel="icon" href="data:,">\n<script'));
  cpSync(path.join(project, 'node_modules', 'three', 'build'), path.join(site, 'build'), { recursive: true });
  cpSync(path.join(project, 'node_modules', 'rock-field', 'dist'), path.join(site, 'dist'), { recursive: true });
  const { page, errors, warnings } = await open(`${url}plain.html`, { viewport: { width: 240, height: 160 }, deviceScaleFactor: 1 });
  const file = screenshotPath('scene-plain');
  // Before, all of it has one colour.
  await until(async () => share(readPicture(await page.screenshot({ path: file }))) > 0.08, 'rocks in the page without a bundler');
  assert.deepEqual([errors, warnings], [[], []]);
}

/** By name, the code that the documentation shows. */
function blocks() {
  const page = readFileSync(PAGE, 'utf8');
  return new Map([...page.matchAll(/^```\w+ ([\w.-]+)\n(.*?)^```$/gms)].map(([, name, code]) => [name, code]));
}

/** A field is made small, since a software GPU draws it. */
function small(code) {
  return code.replace("preset: 'riverbed'", "preset: 'riverbed', imageWidth: 160, imageHeight: 120");
}

/** Each block that needs a bundler as a module. */
function writeRecipes(folder) {
  mkdirSync(folder, { recursive: true });
  const shown = blocks();
  for (const [name, given] of Object.entries(RECIPES)) {
    const lines = needed(shown.get(name), `${name} in ${PAGE}`).split('\n');
    const imports = lines.filter((line) => line.startsWith('import '));
    const body = lines.filter((line) => !line.startsWith('import ')).join('\n');
    const made = /^const rocks = /m.test(body) ? 'return { rocks };' : '';
    writeFileSync(
      path.join(folder, name),
      `${imports.join('\n')}\nexport async function recipe({ ${given.join(', ')} }) {\n${small(body)}${made}\n}\n`,
    );
  }
  writeFileSync(path.join(folder, 'rocks.jsx'), needed(shown.get('rocks.jsx'), `rocks.jsx in ${PAGE}`));
}

/** Writes the pictures, for those who want to look at them. */
function check(name, { min, max, triangles, held, pictures, aborted, rock }) {
  const shown = Object.fromEntries(
    Object.entries(pictures).map(([side, address]) => {
      const file = Buffer.from(address.slice(address.indexOf(',') + 1), 'base64');
      writeFileSync(screenshotPath(`scene-${name}-${side}`), file);
      return [side, share(readPicture(file))];
    }),
  );
  const [width, height, depth] = max.map((value, axis) => value - min[axis]);
  const what = `${name}: from ${min} to ${max}`;
  assert.ok(Math.abs(width - WIDTH) < ROUGH && Math.abs(depth - DEPTH) < ROUGH, what);
  assert.ok(min[1] > -HIGHEST / 2 && max[1] > HIGHEST / 4 && height < 2 * HIGHEST, what);
  assert.ok(Math.abs(min[0] + max[0]) < ROUGH && Math.abs(min[2] + max[2]) < ROUGH, `${what}: it is not in the middle`);
  assert.ok(
    shown.above > 0.4 && shown.below < 0.3 * shown.above,
    `${name}: rocks cover ${shown.above} of the picture from above, ${shown.below} from below`,
  );
  assert.ok(triangles.far > 0 && triangles.far < 0.4 * triangles.near, `${name}: ${triangles.near} triangles near, ${triangles.far} far`);
  assert.ok(
    held.with.some((count, k) => count > held.before[k]),
    `${name}: the engine holds ${held.with}`,
  );
  assert.deepEqual(held.after, held.before, `${name}: what is left of the rocks`);
  if (!name.startsWith('three')) return;
  assert.equal(aborted, 'AbortError');
  assert.ok(rock.id > 0 && rock.layer >= 0, JSON.stringify(rock));
}

/** Of the pixels, which do not have the colour of the upper left corner. */
function share({ width, height, data }) {
  let others = 0;
  for (let at = 0; at < data.length; at += 4) others += [0, 1, 2].some((c) => Math.abs(data[at + c] - data[c]) > 8) ? 1 : 0;
  return others / (width * height);
}
