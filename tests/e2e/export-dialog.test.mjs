// The page's dialog that saves rocks as files, and the same of a panel in an element.
import assert from 'node:assert/strict';
import { createHash } from 'node:crypto';
import { readFile } from 'node:fs/promises';
import { after, before, test } from 'node:test';
import { exportScene, exportWoodEar } from 'rock-field/export';
import { violations } from './axe.mjs';
import { launch, pageOf } from './browser.mjs';
import { pageWith, SMALL } from './element-page.mjs';
import { openRocks } from './rock-page.mjs';
import { openWoodEars } from './wood-ear-page.mjs';

const LINK = '#preset=journal-fig1&seed=4&w=200&h=150';
/** @type {import('rock-field/export').FieldRequest} */
const REQUEST = { preset: 'journal-fig1', seed: 4, imageWidth: 200, imageHeight: 150 };

let session;

before(async () => {
  session = await launch({
    intercept: pageOf('element.html', () =>
      pageWith(`<rock-field id="a" ${SMALL} seed="4" controls="open" metres-per-pixel="0.05"></rock-field><script>listenTo(a)</script>`),
    ),
  });
});

after(() => session?.close());

const sha256 = (bytes) => createHash('sha256').update(bytes).digest('hex');

/** The dialog once its file is written. */
async function written(page) {
  await page.locator('.dialog .button-primary:enabled').waitFor();
  return page.locator('.dialog');
}

/** What the Save button saves. */
async function saved(page) {
  const [download] = await Promise.all([page.waitForEvent('download'), page.locator('.dialog .button-primary').click()]);
  return { name: download.suggestedFilename(), bytes: await readFile(await download.path()) };
}

test('what is chosen is said with its figures, and saved: the same bytes as without a page', async () => {
  const { page, errors, close } = await openRocks(session, LINK, { viewport: { width: 960, height: 640 } });
  await page.getByRole('button', { name: 'Export', exact: true }).click();
  const dialog = await written(page);
  const { report, bytes } = await exportScene(REQUEST, { target: 'blender' });
  const said = await dialog.locator('.export-report').innerText();
  assert.match(said, /^journal-fig1-4\.glb: [\d.]+ MB/);
  assert.ok(said.includes(`${report.objects.toLocaleString('en')} objects, ${report.triangles.toLocaleString('en')} triangles`), said);
  const first = await saved(page);
  assert.deepEqual([first.name, sha256(first.bytes)], ['journal-fig1-4.glb', sha256(bytes)]);
  assert.deepEqual(await violations(page), []);

  await dialog.locator('#export-target').selectOption('print');
  await page.waitForFunction(() => document.querySelector('.dialog .export-report').textContent.includes('.stl'));
  const second = await saved(page);
  assert.deepEqual(
    [second.name, sha256(second.bytes)],
    ['journal-fig1-4.stl', sha256((await exportScene(REQUEST, { target: 'print' })).bytes)],
  );
  assert.match(await dialog.locator('.export-report').innerText(), /One unit is 1 mm/);

  // STL has no objects: asking for them chooses a format that has.
  await dialog.locator('input[value="rocks"]').check();
  await page.waitForFunction(() => document.querySelector('.dialog .export-report').textContent.includes('.glb'));
  await page.keyboard.press('Escape');
  await dialog.waitFor({ state: 'hidden' });
  assert.deepEqual(errors, []);
  await close();
});

test('of too many objects the dialog offers fewer meshes, and a press chooses them', async () => {
  const { page, errors, close } = await openRocks(session, '#preset=conference-fig1&seed=4&w=500&h=400', {
    viewport: { width: 360, height: 640 },
  });
  await page.locator('.sheet-toggle').click();
  await page.getByRole('button', { name: 'Export', exact: true }).click();
  const dialog = await written(page);
  assert.match(await dialog.locator('.export-report').innerText(), /2,626 objects: many programs/);
  assert.deepEqual(await violations(page), []);
  await dialog.getByRole('button', { name: 'Copies of a few' }).click();
  await page.waitForFunction(() => document.querySelector('.dialog .export-report').textContent.includes('like the rocks'));
  assert.equal(await dialog.locator('input[value="kit"]').isChecked(), true);
  assert.equal(await page.evaluate(() => document.activeElement?.getAttribute('value')), 'kit');
  assert.equal(await dialog.getByRole('button', { name: 'Copies of a few' }).count(), 0);
  assert.deepEqual(errors, []);
  await close();
});

test('of too many objects the dialog offers several files, each with fewer', async () => {
  const { page, errors, close } = await openRocks(session, '#preset=conference-fig1&seed=4&w=500&h=400', {
    viewport: { width: 960, height: 640 },
  });
  await page.getByRole('button', { name: 'Export', exact: true }).click();
  const dialog = await written(page);
  await dialog.getByRole('button', { name: 'Split into 4 files' }).click();
  await page.waitForFunction(() => document.querySelector('.dialog .export-report').textContent.includes('.zip'));
  assert.equal(await dialog.locator('#export-parts').inputValue(), '4');
  assert.equal(await page.evaluate(() => document.activeElement?.id), 'export-parts');
  assert.doesNotMatch(await dialog.locator('.export-report').innerText(), /many programs/);
  // All rocks of a kit share its meshes: choosing one is to be in one file again, and the other way round.
  await dialog.locator('input[value="kit"]').check();
  await page.waitForFunction(() => document.querySelector('.dialog .export-report').textContent.includes('like the rocks'));
  assert.equal(await dialog.locator('#export-parts').inputValue(), '1');
  await dialog.locator('#export-parts').selectOption('9');
  await page.waitForFunction(() => document.querySelector('.dialog .export-report').textContent.includes('.zip'));
  assert.equal(await dialog.locator('input[value="rocks"]').isChecked(), true);
  const { bytes } = await saved(page);
  /** @type {import('rock-field/export').FieldRequest} */
  const request = { preset: 'conference-fig1', seed: 4, imageWidth: 500, imageHeight: 400 };
  assert.equal(sha256(bytes), sha256((await exportScene(request, { target: 'blender', parts: 9 })).bytes));
  assert.deepEqual(errors, []);
  await close();
});

test('of rocks whose skirts would be seen the dialog offers to cut them off', async () => {
  const { page, errors, close } = await openRocks(session, '#preset=riverbed&seed=4&w=80&h=60&color=layer', {
    viewport: { width: 960, height: 640 },
  });
  await page.getByRole('button', { name: 'Export', exact: true }).click();
  const dialog = await written(page);
  await dialog.getByRole('button', { name: 'Cut off below ground' }).click();
  await page.waitForFunction(() => !document.querySelector('.dialog .export-report').textContent.includes('skirts'));
  await written(page);
  assert.equal(await page.evaluate(() => document.activeElement?.getAttribute('value')), 'cut');
  const { bytes } = await saved(page);
  /** @type {import('rock-field/export').FieldRequest} */
  const request = { preset: 'riverbed', seed: 4, imageWidth: 80, imageHeight: 60 };
  const expected = await exportScene(request, { target: 'blender', belowGround: 'cut', color: 'layer' });
  assert.equal(sha256(bytes), sha256(expected.bytes));
  assert.deepEqual(errors, []);
  await close();
});

test('a map is shown as it is saved, and points take the axes of the program: the same bytes as without a page', async () => {
  const { page, errors, close } = await openRocks(session, LINK, { viewport: { width: 960, height: 640 } });
  await page.getByRole('button', { name: 'Export', exact: true }).click();
  const dialog = await written(page);
  /** @param {string} name of the file that is to be written */
  const saves = async (name, options) => {
    await page.waitForFunction((name) => document.querySelector('.dialog .export-report').textContent.includes(`${name}:`), name);
    const { bytes } = await exportScene(REQUEST, options);
    const file = await saved(page);
    assert.deepEqual([file.name, sha256(file.bytes)], [name, sha256(bytes)]);
  };
  await dialog.locator('#export-target').selectOption('unreal');
  await dialog.locator('input[value="maps"]').check();
  await saves('journal-fig1-4-height.png', { format: 'png' });
  const shown = dialog.locator('.export-picture');
  assert.deepEqual(
    await shown.evaluate((/** @type {HTMLImageElement} */ image) => image.decode().then(() => [image.naturalWidth, image.naturalHeight])),
    [200, 150],
  );
  assert.deepEqual(await violations(page), []);
  await dialog.locator('#export-map').selectOption('normal');
  await saves('journal-fig1-4-normal.png', { format: 'png', map: 'normal', green: 'down' });
  await dialog.locator('#export-map').selectOption('all');
  await saves('journal-fig1-4-maps.zip', { target: 'unreal', format: 'zip' });
  assert.equal(await shown.count(), 0);
  await dialog.locator('#export-map').selectOption('height');
  await dialog.locator('input[value="r16"]').check();
  await dialog.locator('input[value="corners"]').check();
  await page.waitForFunction(() => document.querySelector('.dialog .export-report').textContent.includes('505 × 505'));
  await saves('journal-fig1-4-height.r16', { format: 'r16', side: 505, square: true, samples: 'corners' });

  await dialog.locator('input[value="points"]').check();
  await saves('journal-fig1-4.csv', { target: 'unreal', format: 'csv' });
  await dialog.locator('#export-target').selectOption('unity');
  await page.waitForFunction(() => !document.querySelector('.dialog .button-primary').hasAttribute('disabled'));
  await saves('journal-fig1-4.csv', { target: 'unity', format: 'csv' });
  // Printing has meshes alone.
  await dialog.locator('#export-target').selectOption('print');
  await page.waitForFunction(() => document.querySelector('.dialog .export-report').textContent.includes('.stl:'));
  assert.deepEqual(errors, []);
  await close();
});

test('the page of wood ears saves its colony, of which there are no copies to choose', async () => {
  const { page, errors, close } = await openWoodEars(session, '#preset=thesis-default&d=10&r=20&e=4&ls=6', {
    viewport: { width: 960, height: 640 },
  });
  await page.getByRole('button', { name: 'Export', exact: true }).click();
  const dialog = await written(page);
  assert.deepEqual(await dialog.locator('input[name="export-mesh"]').evaluateAll((inputs) => inputs.map((input) => input.value)), [
    'rocks',
    'one',
  ]);
  await dialog.locator('input[value="closed"]').check();
  await page.waitForFunction(() => document.querySelector('.dialog .export-report').textContent.includes('1.5 mm'));
  const { name, bytes } = await saved(page);
  /** @type {import('rock-field/export').WoodEarExportRequest} */
  const request = { preset: 'thesis-default', density: 10, range: 20, rings: 4, log: { spacing: 6 } };
  assert.deepEqual(
    [name, sha256(bytes)],
    ['thesis-default-0.glb', sha256((await exportWoodEar(request, { target: 'blender', solid: true })).bytes)],
  );
  assert.deepEqual(await violations(page), []);
  assert.deepEqual(errors, []);
  await close();
});

test('a file that cannot be written is said in the dialog, and the next choice tries again', async () => {
  const { page, close } = await openRocks(session, LINK, {
    viewport: { width: 960, height: 640 },
    locale: 'ja',
    prepare: (page) => page.route('**/export-worker*', (route) => route.abort()),
  });
  await page.getByRole('button', { name: '書き出す', exact: true }).click();
  const problem = page.locator('.dialog .control-problem');
  await problem.waitFor();
  assert.match(await problem.innerText(), /ワーカーを起動できませんでした/);
  assert.ok(await page.locator('.dialog .button-primary').isDisabled());
  await page.unroute('**/export-worker*');
  await page.locator('.dialog input[value="closed"]').check();
  await written(page);
  await close();
});

test('of a file that is too large the dialog says so in the page’s language, and offers what makes it smaller', async () => {
  const error = {
    name: 'ExportTooLarge',
    key: 'format',
    value: 3e9,
    max: 2 ** 31 - 1,
    message: 'no',
    words: { en: 'no', ja: '大きすぎます' },
  };
  const worker = `onmessage = () => postMessage(${JSON.stringify({ type: 'failed', error })}); postMessage({ type: 'ready' });`;
  const { page, close } = await openRocks(session, LINK, {
    viewport: { width: 360, height: 640 },
    locale: 'ja',
    prepare: (page) => page.route('**/export-worker*', (route) => route.fulfill({ contentType: 'text/javascript', body: worker })),
  });
  await page.locator('.sheet-toggle').click();
  await page.getByRole('button', { name: '書き出す', exact: true }).click();
  const report = page.locator('.dialog .export-report');
  await report.locator('.control-problem').waitFor();
  assert.equal(await report.locator('.control-problem').innerText(), '大きすぎます');
  const offered = () => report.getByRole('button').allInnerTexts();
  assert.deepEqual(await offered(), ['少数の複製', '4 ファイルに分割']);
  await page.locator('.dialog input[name="export-lods"][value="3"]').check();
  await report.getByRole('button', { name: '4 ファイルに分割' }).click();
  await report.getByRole('button', { name: '9 ファイルに分割' }).waitFor();
  assert.deepEqual(await offered(), ['少数の複製', '9 ファイルに分割', 'LOD を 1 段に']);
  assert.deepEqual(await violations(page), []);
  await report.getByRole('button', { name: 'LOD を 1 段に' }).click();
  assert.equal(await page.evaluate(() => document.activeElement?.getAttribute('value')), '1');
  await close();
});

test('a panel in an element exports too, in the size that the element has', async () => {
  const { page, errors, close } = await session.open('element.html', { viewport: { width: 960, height: 640 } });
  await page.getByRole('button', { name: 'Export', exact: true }).click();
  await written(page);
  const { bytes } = await saved(page);
  assert.equal(sha256(bytes), sha256((await exportScene(REQUEST, { target: 'blender', metresPerPixel: 0.05 })).bytes));
  assert.deepEqual(errors, []);
  await close();
});
