/** How long work gives way to whatever else is waiting. */

// Node only: a MessageChannel there keeps the process alive, and setImmediate is cheaper.
declare const setImmediate: ((run: () => void) => void) | undefined;

let channel: MessageChannel | undefined;
/** Whether a message is on its way through the channel. */
let awaited = false;
const waiting: (() => void)[] = [];

/**
 * Lets every message and event that is waiting be handled. `setTimeout` would cost 4 ms each time.
 *
 * Each task resumes one of those that wait, in turn, so that the queue is read after every slice however many runs there are.
 */
export function nextTask(): Promise<void> {
  return new Promise((resolve) => {
    if (typeof setImmediate === 'function') {
      setImmediate(resolve);
      return;
    }
    waiting.push(resolve);
    wakeNext();
  });
}

function wakeNext(): void {
  if (awaited || waiting.length === 0) return;
  if (!channel) {
    channel = new MessageChannel();
    channel.port1.onmessage = () => {
      awaited = false;
      waiting.shift()?.();
      // Behind the slice that was resumed: what came in during it is read before the next.
      queueMicrotask(wakeNext);
    };
  }
  awaited = true;
  channel.port2.postMessage(null);
}
