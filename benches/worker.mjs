// The bench in a worker of the browser, started by bench.mjs.
import { measure } from './workload.mjs';

addEventListener('message', async ({ data: { rounds } }) => {
  try {
    const result = await measure({ read: (url) => fetch(url), rounds, say: (text) => postMessage({ text }) });
    postMessage({ result });
  } catch (error) {
    postMessage({ error: String(error?.stack ?? error) });
  }
});
