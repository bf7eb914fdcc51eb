// Where an element may stand and what may happen to it there: shadow roots, other documents, out of sight, zoomed, dropped on, under any style.
/** @import { Page } from 'playwright-core' */
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { holdTimers } from './browser.mjs';
import { ELEMENTS, launchPlaces, openPlace } from './places-page.mjs';

/** @type {import('./browser.mjs').Session} */
let session;

before(async () => {
  session = await launchPlaces();
});

after(() => session?.close());

const open = (body, options) => openPlace(session, body, options);

for (const [name, element] of Object.entries(ELEMENTS)) {
  test(`${name}: everything is in the language of the nearest lang across shadow roots, and changes with it`, async () => {
    const { page, errors, close } = await open('<div id="outer"></div>', { lang: 'ja', ready: false });
    const seen = await page.evaluate(async (element) => {
      const inner = outer.attachShadow({ mode: 'closed' });
      inner.innerHTML = '<section><div></div></section>';
      const host = inner.querySelector('div');
      const root = host.attachShadow({ mode: 'open' });
      root.innerHTML = `<style>:host > * { display: block; width: 700px; height: 400px }</style>${element.replace('>', ' controls="open">')}`;
      const a = root.querySelector('rock-field, wood-ear-log');
      await a.ready;
      const part = (name) => a.shadowRoot.querySelector(`[part=${name}]`);
      await until(() => part('panel') && a.shadowRoot.querySelector('#description').textContent);
      const japanese = /[\u3040-\u30ff\u4e00-\u9fff]/;
      const said = () => {
        const panel = part('panel');
        const stage = a.shadowRoot.querySelector('[role=application]');
        return [
          stage.ariaLabel,
          stage.getAttribute('aria-roledescription'),
          a.shadowRoot.querySelector('#description').textContent,
          part('controls-button').ariaLabel,
          panel.shadowRoot.querySelector('.panel').ariaLabel,
          panel.shadowRoot.querySelector('.panel-title').textContent,
        ].map((text) => japanese.test(String(text)));
      };
      const all = async (isJapanese) => {
        await until(() => said().every((is) => is === isJapanese));
        return panelLang();
      };
      const panelLang = () => part('panel').lang;
      const first = await all(true);
      document.documentElement.lang = 'en';
      const second = await all(false);
      inner.querySelector('section').lang = 'ja-JP';
      const third = await all(true);
      a.lang = 'en';
      const fourth = await all(false);
      a.removeAttribute('lang');
      const fifth = await all(true);
      document.body.append(a);
      const moved = await all(false);
      return [first, second, third, fourth, fifth, moved];
    }, element);
    assert.deepEqual([seen, errors], [['ja', 'en', 'ja', 'en', 'ja', 'en'], []]);
    await close();
  });

  test(`${name}: moved into a frame's document, a popup's, and back it has its styles, size, frames and panel`, async () => {
    const { page, errors, close } = await open(
      `${element.replace('>', ' controls="open">')}<iframe style="width: 500px; height: 400px"></iframe>`,
    );
    const seen = await page.evaluate(async () => {
      const shown = async (width) => {
        a.style.cssText = `display: block; width: ${width}px; height: 300px`;
        await a.ready;
        const panel = () => a.shadowRoot.querySelector('[part=panel]');
        const canvas = () => a.shadowRoot.querySelector('canvas');
        const view = /** @type {Window} */ (a.ownerDocument.defaultView);
        await until(
          () => panel() && canvas()?.width === Math.round(a.shadowRoot.querySelector('.stage').clientWidth * view.devicePixelRatio),
        );
        const style = (node) => view.getComputedStyle(node);
        const camera = JSON.stringify(a.camera);
        a.camera = { ...a.camera, azimuth: a.camera.azimuth + 1 };
        return [
          style(a).contain,
          style(a.shadowRoot.querySelector('.stage')).position,
          style(panel()).position,
          style(panel().shadowRoot.querySelector('.panel')).position,
          JSON.stringify(a.camera) !== camera,
        ];
      };
      const results = [await shown(400)];
      const { field } = a;
      const frame = document.querySelector('iframe');
      frame.contentDocument?.body.append(a);
      results.push(await shown(380));
      document.body.append(a);
      results.push(await shown(360));
      const popup = /** @type {Window} */ (window.open('', '', 'width=500,height=400'));
      popup.document.body.append(a);
      results.push(await shown(340));
      document.body.prepend(a);
      popup.close();
      results.push(await shown(320));
      return { results, same: a.field === field };
    });
    const row = ['strict', 'absolute', 'absolute', 'relative', true];
    assert.deepEqual([seen, errors], [{ results: [row, row, row, row, row], same: true }, []]);
    await close();
  });

  test(`${name}: loading changed from lazy to eager starts at once`, async () => {
    const { page, close } = await open(`<div style="height: 5000px"></div>${element.replace('>', ' loading="lazy">')}`, { ready: false });
    assert.equal(await page.evaluate(() => a.backend), null);
    await page.evaluate(async () => {
      a.loading = 'eager';
      await until(() => a.backend !== null && a.field !== null);
    });
    await close();
  });

  test(`${name}: under CSS zoom the canvas has the screen's pixels`, async () => {
    const { page, close } = await open(`<div style="zoom: 2">${element}</div>`);
    const seen = await page.evaluate(async () => {
      const canvas = a.shadowRoot.querySelector('canvas');
      await until(() => canvas.width === 800 && canvas.height === 600);
      document.querySelector('div').style.zoom = '1.5';
      await until(() => canvas.width === 600 && canvas.height === 450);
      return true;
    });
    assert(seen);
    await close();
  });

  test(`${name}: the theme is an attribute as well as a property`, async () => {
    const { page, close } = await open(element.replace('>', ' theme="dark" controls>'));
    const seen = await page.evaluate(async () => {
      await until(() => a.shadowRoot.querySelector('[part=controls-button]'));
      const theme = () => [a.theme, a.getAttribute('theme'), a.shadowRoot.querySelector('[part=controls-button]').dataset.theme];
      const first = theme();
      a.theme = 'light';
      const second = theme();
      a.removeAttribute('theme');
      return [first, second, [a.theme]];
    });
    assert.deepEqual(seen, [['dark', 'dark', 'dark'], ['light', 'light', 'light'], ['auto']]);
    await close();
  });
}

const SMALL = '<rock-field image-width="100" image-height="80" radius="30 10"></rock-field>';

test('in shadow roots that the page declares, from templates, in SVG, behind content-visibility, in dialogs, full screen and from right to left there is a picture of the box', async () => {
  const { page, errors, close } = await open(
    `<style>rock-field { width: 120px; height: 90px }</style>
    <div id="declared"><template shadowrootmode="open"><style>rock-field { display: block; width: 120px; height: 90px }</style>${SMALL}</template></div>
    <div id="own">${SMALL.replace('>', '><template shadowrootmode="open"><p>replaced</p></template>')}</div>
    <template>${SMALL}</template><div id="imported"></div><div id="cloned"></div><div id="copied"></div>
    <svg width="120" height="90"><foreignObject id="foreign" width="120" height="90">${SMALL}</foreignObject></svg>
    <div style="height: 3000px"></div><div id="skipped" style="content-visibility: auto; contain-intrinsic-size: 10px 10px">${SMALL}</div>
    <dialog>${SMALL}</dialog><div id="rtl" dir="rtl">${SMALL}</div>`,
    { ready: false },
  );
  const seen = await page.evaluate(async () => {
    const { content } = document.querySelector('template');
    const node = (id) => document.querySelector(`#${id}`);
    node('imported').append(document.importNode(content, true));
    node('cloned').append(content.cloneNode(true));
    node('copied').append(node('own').querySelector('rock-field').cloneNode(true));
    document.querySelector('dialog').showModal();
    const places = [
      ...['own', 'imported', 'cloned', 'copied', 'foreign', 'skipped', 'rtl'].map(node),
      document.querySelector('dialog'),
    ].map((place) => ({ name: place.id, element: place.querySelector('rock-field') }));
    places.unshift({ name: 'declared', element: node('declared').shadowRoot.querySelector('rock-field') });
    const results = [];
    for (const { name, element } of places) {
      element.scrollIntoView();
      await element.ready;
      const { width, height } = element.shadowRoot.querySelector('canvas');
      results.push([name, width, height, element.shadowRoot.querySelector('p') === null, element.field.stats.rocks]);
    }
    return results;
  });
  const [[, , , , rocks]] = seen;
  const names = ['declared', 'own', 'imported', 'cloned', 'copied', 'foreign', 'skipped', 'rtl', ''];
  assert(rocks > 0);
  assert.deepEqual([seen, errors], [names.map((name) => [name, 120, 90, true, rocks]), []]);
  const full = await page.evaluate(async () => {
    const element = document.querySelector('#rtl rock-field');
    document.querySelector('dialog').close();
    const { width, height } = element.shadowRoot.querySelector('canvas');
    await element.requestFullscreen();
    const canvas = element.shadowRoot.querySelector('canvas');
    await until(() => canvas.width === innerWidth && canvas.height === innerHeight);
    await document.exitFullscreen();
    await until(() => canvas.width === width && canvas.height === height);
    return true;
  });
  assert(full);
  await close();
});

test('whatever rules the page has for everything, canvases and boxes, the picture fills the element and nothing else', async () => {
  const box = async (rules, expected) => {
    const { page, errors, close } = await open(`<style>${rules}</style><p>before</p>${SMALL}<p>after</p>`);
    const seen = await page.evaluate(() => {
      const canvas = a.shadowRoot.querySelector('canvas');
      const [own, drawn] = [a, canvas].map((node) => {
        const { x, y, width, height } = node.getBoundingClientRect();
        return [x, y, width, height];
      });
      return { same: String(own) === String(drawn), size: own.slice(2), canvas: [canvas.width, canvas.height] };
    });
    assert.deepEqual([seen, errors], [{ same: true, size: expected, canvas: expected }, []], rules);
    await close();
  };
  await box('* { all: revert !important }', [300, 150]);
  await box('* { all: revert } rock-field { display: inline; width: 200px; height: 100px }', [200, 100]);
  await box('rock-field { position: static; contain: none; width: 200px; height: 100px }', [200, 100]);
  await box(
    'canvas { width: 10px !important; display: none !important } div { display: none !important } * { position: static !important; transform: none !important; opacity: 1 } rock-field { width: 200px; height: 100px }',
    [200, 100],
  );
});

test('a link has the address of the page, whatever its base', async () => {
  const { page, close } = await open(`${SMALL}<iframe srcdoc="<rock-field></rock-field>"></iframe>`);
  const seen = await page.evaluate(() => {
    const base = document.createElement('base');
    base.href = 'https://elsewhere.example/deep/';
    document.head.append(base);
    const own = new URL(a.shareURL());
    const other = a.shareURL('x.html');
    document.querySelector('iframe').contentDocument?.body.append(a);
    return [
      own.origin === location.origin && own.pathname === location.pathname,
      /^https?:/.test(a.shareURL()),
      other.startsWith('https://elsewhere.example/deep/x.html#'),
    ];
  });
  assert.deepEqual(seen, [true, true, true]);
  await close();
});

test('a slider of a panel in a frame is let go where it is held: two drags are two steps of undo', async () => {
  const { page, errors, close } = await open(
    `${SMALL.replace('>', ' controls="open">')}<iframe style="width: 800px; height: 500px"></iframe>`,
  );
  const seen = await page.evaluate(async () => {
    const frame = document.querySelector('iframe');
    a.style.cssText = 'width: 700px; height: 400px';
    frame.contentDocument?.body.append(a);
    await a.ready;
    const view = /** @type {typeof globalThis} */ (/** @type {unknown} */ (frame.contentWindow));
    const slider = () => a.shadowRoot.querySelector('[part=panel]')?.shadowRoot.querySelector('input.slider');
    await until(slider);
    const values = [];
    for (const share of [0.3, 0.6]) {
      const held = slider();
      held.dispatchEvent(new view.PointerEvent('pointerdown', { bubbles: true, composed: true }));
      held.value = String(Number(held.min) + share * (Number(held.max) - Number(held.min)));
      held.dispatchEvent(new view.InputEvent('input', { bubbles: true, composed: true }));
      held.dispatchEvent(new view.PointerEvent('pointerup', { bubbles: true, composed: true }));
      values.push(JSON.stringify(a.params));
    }
    a.undo();
    return [values[0] !== values[1], JSON.stringify(a.params) === values[0]];
  });
  assert.deepEqual([seen, errors], [[true, true], []]);
  await close();
});

test('what is dropped on the log is opened, also from a folder; what cannot be is said on the picture, unless a listener says it', async () => {
  // The words would go by themselves.
  const prepare = (/** @type {Page} */ page) => page.addInitScript(holdTimers);
  const { page, errors, close } = await open('<wood-ear-log ground="none" preset="thesis-minimum" editable></wood-ear-log>', { prepare });
  const seen = await page.evaluate(async () => {
    const message = () => a.shadowRoot.querySelector('[part=message] > span').textContent;
    const drop = (dataTransfer) => {
      const event = new DragEvent('drop', { bubbles: true, cancelable: true });
      Object.defineProperty(event, 'dataTransfer', { value: { types: ['Files'], files: [], items: [], ...dataTransfer } });
      a.dispatchEvent(event);
      return event.defaultPrevented;
    };
    const box = ['v 0 0 0', 'v 100 0 0', 'v 0 10 0', 'v 0 0 10', 'f 1 3 2', 'f 1 2 4', 'f 1 4 3', 'f 2 3 4'].join('\n');
    const entry = (file) => ({ isDirectory: false, file: (give) => give(file) });
    const folder = (...entries) => ({ isDirectory: true, createReader: () => ({ readEntries: (give) => give(entries.splice(0, 1)) }) });
    const dropFolder = (...entries) => drop({ files: [new File([], 'folder')], items: [{ webkitGetAsEntry: () => folder(...entries) }] });
    const texts = [];
    let before = message();
    const waited = async (prevented) => {
      await until(() => message() !== before);
      before = message();
      texts.push([prevented, before.trim().split('\n').at(-1)]);
    };

    let named = '';
    a.addEventListener('error', ({ detail }) => (named = detail.error.name));
    await waited(drop({ files: [new File(['v 0 0 0'], 'bad.obj')] }));
    texts.push(named);
    a.lang = 'ja';
    await until(() => a.shadowRoot.querySelector('.stage').ariaLabel !== 'Wood ears on a fallen log');
    await waited(dropFolder());
    a.lang = 'en';
    const saying = (event) => event.preventDefault();
    a.addEventListener('error', saying);
    named = '';
    drop({ files: [new File(['v 0 0 0'], 'worse.obj')] });
    await until(() => named !== '');
    const silent = !message().includes('worse');
    const opened = new Promise((resolve) => a.addEventListener('change', resolve, { once: true }));
    dropFolder(entry(new File(['x'], 'bark.png')), folder(entry(new File([box], 'log.obj'))), entry(new File(['newmtl a'], 'log.mtl')));
    await opened;
    return [texts, silent, document.querySelector('wood-ear-log').params.mesh?.indices.length];
  });
  assert.deepEqual(
    [seen, errors],
    [[[[true, 'bad.obj has no triangles'], 'LogFileNoMesh', [true, 'ドロップされたものにファイルがありません']], true, 12], []],
  );
  await close();
});
