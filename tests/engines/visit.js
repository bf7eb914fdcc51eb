// What is asked of a whole page, in the page itself: the first script in its head, so that nothing goes unheard.
{
  const WAIT_MS = 90_000;
  /** Of the documentation's pages alone: they load the package as its users do. */
  const PLAIN = /\/(rock-field|wood-ear-log)\.js$/;
  const HASHED = /(-[A-Z0-9]{8})\.(js|css|wasm)$/;
  const complaints = [];
  addEventListener('error', ({ message }) => message && complaints.push(`uncaught: ${message}`));
  addEventListener('unhandledrejection', ({ reason }) => complaints.push(`unhandled: ${reason}`));
  console.error = (...words) => complaints.push(`console error: ${words.join(' ')}`);

  // The next visit gets the page from the server, with this script in it.
  if (globalThis.ServiceWorkerContainer) ServiceWorkerContainer.prototype.register = () => new Promise(() => {});

  if (document.currentScript?.dataset.allowed === 'webgl') Object.defineProperty(Navigator.prototype, 'gpu', { get: () => undefined });

  const told = {};
  addEventListener('message', ({ data }) => {
    if (!data?.element) return;
    const { element, ...rest } = data;
    told[element] = rest;
  });

  /** The first element of ours in the page, or in one of the documentation's examples. */
  function element() {
    const examples = Array.from(document.querySelectorAll('.result'), ({ shadowRoot }) => shadowRoot);
    return [document, ...examples].map((root) => root?.querySelector('rock-field, wood-ear-log')).find((found) => found?.backend);
  }

  /** Waits for the picture, or for something to go wrong. */
  async function visited() {
    const shown = await until(() => complaints.length > 0 || element());
    if (complaints.length > 0) return { complaints };
    await shown.ready;
    const { hashColony, hashField } = await import('/golden.mjs');
    const isColony = shown.localName === 'wood-ear-log';
    const hash = isColony ? await hashColony(await shown.getColony()) : await hashField(await shown.getField());
    const fetched = performance.getEntriesByType('resource').map(({ name }) => new URL(name).pathname);
    const plain = fetched.filter(
      (name) => /\.(js|css|wasm)$/.test(name) && !HASHED.test(name) && !PLAIN.test(name) && name !== '/visit.js',
    );
    return { element: shown.localName, backend: shown.backend, hash, params: isColony ? null : shown.params, plain, complaints };
  }

  /** Waits for what the elements in a frame come to. */
  async function framed(count) {
    await until(() => complaints.length > 0 || Object.keys(told).length === count);
    return { told, complaints };
  }

  async function until(found) {
    for (const deadline = performance.now() + WAIT_MS; performance.now() < deadline; ) {
      const value = found();
      if (value) return value;
      await new Promise((resolve) => setTimeout(resolve, 20));
    }
    complaints.push(`nothing came in ${WAIT_MS / 1000} s: ${JSON.stringify(told)}`);
  }

  globalThis.examined = { visited, framed };
}
