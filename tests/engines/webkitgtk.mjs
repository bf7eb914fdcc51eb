// WebKitGTK's MiniBrowser, by WebKitWebDriver: W3C WebDriver over HTTP.
import { freePort, start, until } from './processes.mjs';

const START_MS = 60_000;

/**
 * 2D painting by the processor; WebGL stays as it is. With WebKitGTK 2.50 the web process ends now and then, whatever the page, while Skia
 * compiles its GPU shaders: `Unable to load module sksl_gpu`, `integer is too large: 0`.
 */
const SKIA_BY_CPU = { WEBKIT_SKIA_ENABLE_CPU_RENDERING: '1' };

/** See `engines.mjs` for what an engine offers. */
export async function openWebKitGtk(program, { env, timeoutMs }) {
  const port = await freePort();
  const driver = start(program, [`--port=${port}`], { env: { ...env, ...SKIA_BY_CPU } });
  const send = async (method, address, body) => {
    const response = await fetch(`http://127.0.0.1:${port}${address}`, {
      method,
      body: body && JSON.stringify(body),
      signal: AbortSignal.timeout(2 * timeoutMs),
    });
    const { value } = await response.json();
    if (!response.ok) throw new Error(`${value.error}: ${value.message} ${driver.said()}`.trim());
    return value;
  };
  try {
    let hasEnded = false;
    void driver.ended.then(() => (hasEnded = true));
    await until(
      async () => {
        if (hasEnded) throw new Error(`WebKitWebDriver ended: ${driver.said()}`);
        return send('GET', '/status').catch(() => undefined);
      },
      'Starting WebKitWebDriver',
      START_MS,
    );
    const { sessionId, capabilities } = await send('POST', '/session', {
      capabilities: { alwaysMatch: { timeouts: { script: timeoutMs, pageLoad: timeoutMs } } },
    });
    const session = `/session/${sessionId}`;
    const execute = (expression) => send('POST', `${session}/execute/sync`, { script: `return ${expression}`, args: [] });
    return {
      version: capabilities.browserVersion,
      go: (url) => send('POST', `${session}/url`, { url }),
      // On a busy machine a page may count as loaded while the one before it is still there, which then takes the question away with it.
      evaluate: (expression) =>
        execute(expression).catch((error) => {
          if (!error.message.includes('before the unload event')) throw error;
          return execute(expression);
        }),
      screenshot: async () => Buffer.from(await send('GET', `${session}/screenshot`), 'base64'),
      complaints: () => [],
      close: driver.stop,
    };
  } catch (error) {
    await driver.stop();
    throw error;
  }
}
