// What is asked of the element, of rocks or of wood ears, in the page itself: it is loaded before the element is defined, so that nothing
// goes unheard.
import { hashColony, hashField } from '/golden.mjs';

const WAIT_MS = 90_000;

/** What has gone wrong, in sentences: of the element, of the page, of promises. */
const complaints = [];
const notices = [];
const generated = [];
const workers = { started: 0, ended: 0 };

globalThis.Worker = class extends Worker {
  constructor(/** @type {ConstructorParameters<typeof Worker>} */ ...args) {
    super(...args);
    workers.started += 1;
  }

  terminate() {
    workers.ended += 1;
    super.terminate();
  }
};

const element = document.querySelector('rock-field, wood-ear-log');
element.addEventListener('error', ({ detail }) => complaints.push(`error event: ${detail.error.name}: ${detail.error.message}`));
element.addEventListener('notice', ({ detail }) => notices.push(detail.message));
element.addEventListener('generate', ({ detail }) => generated.push(detail));
addEventListener('error', ({ message }) => complaints.push(`uncaught: ${message}`));
console.error = (...words) => complaints.push(`console error: ${words.join(' ')}`);
addEventListener('unhandledrejection', ({ reason }) => complaints.push(`unhandled: ${reason}`));

/** Waits for the first picture, or for something to go wrong. */
async function shown() {
  await until(() => complaints.length > 0 || customElements.get(element.localName), 'the definition of the element');
  let isReady = false;
  void element.ready?.then(() => (isReady = true));
  await until(() => complaints.length > 0 || isReady, 'the first picture');
  // Since the page was asked for.
  const ms = performance.now();
  await painted();
  const { x, y, width, height } = element.getBoundingClientRect();
  return {
    backend: element.backend,
    hash: complaints.length > 0 ? null : await hash(),
    rocks: element.field?.stats.rocks,
    generated: generated.map(({ stats, field }) => ({ rocks: stats.rocks, isShown: field === element.field })),
    notices,
    box: [x, y, width, height].map((length) => length * devicePixelRatio),
    complaints,
    ms,
  };
}

/** The golden hash of what is shown; of a colony when its collisions are solved. */
async function hash() {
  return element.localName === 'rock-field' ? hashField(element.field) : hashColony(await element.getColony());
}

/** Brings a log of one's own, in base64; what grows on it, and from what. */
async function bringLog(file, name) {
  const bytes = Uint8Array.from(atob(file), (letter) => letter.charCodeAt(0));
  await element.loadLog(new File([bytes], name));
  const { stats } = await element.getColony();
  await painted();
  const { mesh, ...params } = document.querySelector('wood-ear-log').params;
  const plain = { positions: Array.from(mesh?.positions ?? []), indices: Array.from(mesh?.indices ?? []) };
  return { hash: await hash(), params: { ...params, mesh: plain }, individuals: stats.individuals, complaints };
}

/** The picture as a file: its type and its address with everything in it. */
async function picture(options) {
  const blob = await element.toBlob(options);
  const reader = new FileReader();
  await new Promise((resolve, reject) => {
    reader.onload = resolve;
    reader.onerror = () => reject(reader.error);
    reader.readAsDataURL(blob);
  });
  return { type: blob.type, address: reader.result, complaints };
}

/** Sets an attribute and waits for what it gives. */
async function change(name, value) {
  const before = generated.length;
  element.setAttribute(name, value);
  await until(() => complaints.length > 0 || generated.length > before, 'another field');
  await painted();
  return { hash: await hashField(element.field), fields: generated.length - before, complaints };
}

/** Takes the element out of the page; what it had started ends some time later. */
async function remove() {
  element.remove();
  await until(() => workers.ended === workers.started, 'the end of the workers');
  return { workers, backend: element.backend, complaints };
}

/**
 * Waits for the picture that stays. Two frames later the compositor has what was drawn in the first; without a GPU that is a small picture, and half a second
 * after it comes, drawn in pieces out of sight, the whole one.
 */
async function painted() {
  const isDrawing = () => element.shadowRoot.querySelector('[data-drawing]') !== null;
  for (let quiet = 0; quiet < 5; quiet = isDrawing() ? 0 : quiet + 1) {
    await frames();
    await new Promise((resolve) => setTimeout(resolve, 120));
  }
}

async function frames() {
  for (let frame = 0; frame < 2; frame += 1) await new Promise((resolve) => requestAnimationFrame(resolve));
}

async function until(isSo, what) {
  for (const deadline = performance.now() + WAIT_MS; !isSo(); ) {
    if (performance.now() > deadline) throw new Error(`${what} did not come in ${WAIT_MS / 1000} s`);
    await new Promise((resolve) => setTimeout(resolve, 20));
  }
}

globalThis.examined = { shown, picture, change, bringLog, remove };
